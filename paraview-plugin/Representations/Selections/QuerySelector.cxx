#include "QuerySelector.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkObjectFactory.h"
#include "vtkSelectionNode.h"
#include "vtkSignedCharArray.h"

namespace pointfront
{

QuerySelector* QuerySelector::New()
{
  VTK_STANDARD_NEW_BODY(QuerySelector);
}

void QuerySelector::wrap(vtkSelector* inner, vtkAlgorithm* filter)
{
  inner_ = inner;
  filter_ = filter;
}

void QuerySelector::Initialize(vtkSelectionNode* node)
{
  this->Superclass::Initialize(node);
  inner_->Initialize(node);
}

void QuerySelector::Finalize()
{
  inner_->Finalize();
}

void QuerySelector::Execute(vtkDataObject* input, vtkDataObject* output)
{
  const std::string name = this->GetInsidednessArrayName();
  inner_->SetInsidednessArrayName(name);
  inner_->Execute(input, output);
  const int association =
    vtkSelectionNode::ConvertSelectionFieldToAttributeType(this->Node->GetFieldType());
  vtkDataSetAttributes* attributes = output->GetAttributes(association);
  if (!attributes || vtkSignedCharArray::SafeDownCast(attributes->GetArray(name.c_str())))
  {
    return;
  }
  const vtkIdType elements = output->GetNumberOfElements(association);
  vtkNew<vtkSignedCharArray> none;
  none->SetName(name.c_str());
  none->SetNumberOfValues(elements);
  none->FillValue(0);
  attributes->AddArray(none);
  const char* const query = this->Node->GetQueryString();
  vtkErrorWithObjectMacro(filter_, << "the query \"" << (query ? query : "")
                                   << "\" cannot be evaluated, and selects nothing: the messages "
                                      "before this one say where it is wrong");
}

} // namespace pointfront
