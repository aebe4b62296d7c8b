#include "vtkPointFrontConvertSelection.h"

#include "UpstreamReader.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"

vtkStandardNewMacro(vtkPointFrontConvertSelection);

//------------------------------------------------------------------------------
vtkPointFrontConvertSelection::vtkPointFrontConvertSelection() = default;

//------------------------------------------------------------------------------
vtkPointFrontConvertSelection::~vtkPointFrontConvertSelection() = default;

//------------------------------------------------------------------------------
int vtkPointFrontConvertSelection::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkSelection* input = vtkSelection::GetData(inputVector[0], 0);
  const bool ofStore = this->GetNumberOfInputConnections(1) > 0 &&
    pointfront::upstreamReader(this->GetInputConnection(1, 0)->GetProducer());
  bool named = input && input->GetNumberOfNodes() > 0;
  for (unsigned int i = 0; named && i < input->GetNumberOfNodes(); ++i)
  {
    named = input->GetNode(i)->GetContentType() == vtkSelectionNode::GLOBALIDS;
  }
  if (!ofStore || !named)
  {
    return this->Superclass::RequestData(request, inputVector, outputVector);
  }
  vtkSelection::GetData(outputVector, 0)->ShallowCopy(input);
  return 1;
}

//------------------------------------------------------------------------------
void vtkPointFrontConvertSelection::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
