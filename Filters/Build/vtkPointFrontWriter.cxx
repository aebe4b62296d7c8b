#include "vtkPointFrontWriter.h"

#include "vtkPointFrontBuilder.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkErrorCode.h>
#include <vtkIndent.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointSet.h>

#include <string>

vtkStandardNewMacro(vtkPointFrontWriter);

namespace
{

void handOn(vtkObject* caller, unsigned long, void* writerOf, void* fraction)
{
  auto* builder = static_cast<vtkPointFrontBuilder*>(caller);
  auto* writer = static_cast<vtkPointFrontWriter*>(writerOf);
  writer->SetProgressText(builder->GetProgressText());
  writer->UpdateProgress(*static_cast<double*>(fraction));
  if (writer->GetAbortExecute())
  {
    builder->AbortExecuteOn();
  }
}

/// The writer says what the builder says, to those who observe the writer.
void sayAgain(vtkObject*, unsigned long event, void* writerOf, void* text)
{
  auto* writer = static_cast<vtkPointFrontWriter*>(writerOf);
  std::string message = text ? static_cast<const char*>(text) : "";
  const std::size_t named = message.find("): "); // behind file, line and the builder's name
  message.erase(0, named == std::string::npos ? 0 : named + 3);
  message.erase(message.find_last_not_of('\n') + 1);
  if (event == vtkCommand::ErrorEvent)
  {
    vtkErrorWithObjectMacro(writer, << message);
  }
  else
  {
    vtkWarningWithObjectMacro(writer, << message);
  }
}

} // namespace

vtkPointFrontWriter::vtkPointFrontWriter() = default;

vtkPointFrontWriter::~vtkPointFrontWriter()
{
  this->SetFileName(nullptr);
}

int vtkPointFrontWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  return 1;
}

void vtkPointFrontWriter::WriteData()
{
  if (!this->FileName || !*this->FileName)
  {
    vtkErrorMacro("no file name: call SetFileName() first");
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    return;
  }
  vtkNew<vtkCallbackCommand> messages;
  messages->SetCallback(sayAgain);
  messages->SetClientData(this);
  vtkNew<vtkCallbackCommand> progress;
  progress->SetCallback(handOn);
  progress->SetClientData(this);
  vtkNew<vtkPointFrontBuilder> builder;
  builder->AddObserver(vtkCommand::ProgressEvent, progress);
  builder->AddObserver(vtkCommand::ErrorEvent, messages);
  builder->AddObserver(vtkCommand::WarningEvent, messages);
  builder->SetPoints(vtkPointSet::SafeDownCast(this->GetInput()));
  builder->SetOutputFileName(this->FileName);
  builder->OverwriteOn();
  builder->PreviewOff();
  builder->SetStructure(this->Structure);
  builder->SetLayers(this->Layers);
  builder->SetNormals(this->Normals);
  builder->SetPrecision(this->Precision);
  builder->Write(); // has said what is wrong
  this->SetErrorCode(builder->GetErrorCode());
}

void vtkPointFrontWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n"
     << indent << "Structure: " << this->Structure << "\n"
     << indent << "Layers: " << this->Layers << "\n"
     << indent << "Normals: " << this->Normals << "\n"
     << indent << "Precision: " << this->Precision << "\n";
}
