#include "vtkSMPointFrontExtractProxy.h"

#include "vtkObjectFactory.h"
#include "vtkSMPropertyHelper.h"

#include <string>

vtkStandardNewMacro(vtkSMPointFrontExtractProxy);

//------------------------------------------------------------------------------
vtkSMPointFrontExtractProxy::vtkSMPointFrontExtractProxy() = default;

//------------------------------------------------------------------------------
vtkSMPointFrontExtractProxy::~vtkSMPointFrontExtractProxy() = default;

//------------------------------------------------------------------------------
void vtkSMPointFrontExtractProxy::SetPropertyModifiedFlag(const char* name, int flag)
{
  if (flag != 0 && this->ObjectsCreated && name && name == std::string("Input"))
  {
    vtkSMPropertyHelper input(this, name);
    for (unsigned int i = 0; i < input.GetNumberOfElements(); ++i)
    {
      if (auto* source = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy(i)))
      {
        source->UpdateVTKObjects();
        source->UpdatePipeline();
      }
    }
  }
  this->Superclass::SetPropertyModifiedFlag(name, flag);
}
