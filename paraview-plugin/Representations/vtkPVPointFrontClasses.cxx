#include "vtkPVPointFrontClasses.h"

#include "vtkClientServerStream.h"
#include "vtkObjectFactory.h"
#include "vtkPointFrontRepresentation.h"

vtkStandardNewMacro(vtkPVPointFrontClasses);

//------------------------------------------------------------------------------
vtkPVPointFrontClasses::vtkPVPointFrontClasses() = default;

//------------------------------------------------------------------------------
vtkPVPointFrontClasses::~vtkPVPointFrontClasses() = default;

//------------------------------------------------------------------------------
void vtkPVPointFrontClasses::CopyFromObject(vtkObject* object)
{
  auto* representation = vtkPointFrontRepresentation::SafeDownCast(object);
  if (!representation)
  {
    vtkErrorMacro("A vtkPointFrontRepresentation is asked for its classes, not "
      << (object ? object->GetClassName() : "nothing"));
    return;
  }
  this->Names.clear();
  for (int i = 0; i < representation->GetNumberOfClasses(); ++i)
  {
    this->Names.emplace_back(representation->GetNameOfClass(i));
  }
}

//------------------------------------------------------------------------------
void vtkPVPointFrontClasses::AddInformation(vtkPVInformation* information)
{
  auto* other = vtkPVPointFrontClasses::SafeDownCast(information);
  if (other && this->Names.empty())
  {
    this->Names = other->Names;
  }
}

//------------------------------------------------------------------------------
void vtkPVPointFrontClasses::CopyToStream(vtkClientServerStream* stream)
{
  stream->Reset();
  *stream << vtkClientServerStream::Reply << static_cast<int>(this->Names.size());
  for (const std::string& name : this->Names)
  {
    *stream << name.c_str();
  }
  *stream << vtkClientServerStream::End;
}

//------------------------------------------------------------------------------
void vtkPVPointFrontClasses::CopyFromStream(const vtkClientServerStream* stream)
{
  int count = 0;
  bool read = stream->GetArgument(0, 0, &count) != 0;
  this->Names.clear();
  for (int i = 0; read && i < count; ++i)
  {
    const char* name = nullptr;
    read = stream->GetArgument(0, i + 1, &name) != 0;
    this->Names.emplace_back(read ? name : "");
  }
  if (!read)
  {
    this->Names.clear();
    vtkErrorMacro("The server's classes cannot be read: client and server have different plugins. "
                  "Load the same build of the PointFront plugin on both.");
  }
}

//------------------------------------------------------------------------------
void vtkPVPointFrontClasses::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Names:";
  for (const std::string& name : this->Names)
  {
    os << " " << name;
  }
  os << "\n";
}
