#include "vtkPointFrontConvertSelection.h"

#include "QueryCandidates.h"
#include "UpstreamReader.h"

#include "vtkDataSet.h"
#include "vtkIdTypeArray.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointFrontExtractSelection.h"
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
  if (ofStore && input && pointfront::asksForValues(input) && !pointfront::asksForRows(input))
  {
    this->NameWhatIsSelected(input, vtkSelection::GetData(outputVector, 0));
    return 1;
  }
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
void vtkPointFrontConvertSelection::NameWhatIsSelected(
  vtkSelection* selection, vtkSelection* output)
{
  vtkNew<vtkPointFrontExtractSelection> extract;
  extract->SetInputConnection(0, this->GetInputConnection(1, 0));
  extract->SetInputData(1, selection);
  auto* controller = vtkMultiProcessController::GetGlobalController();
  extract->UpdatePiece(controller ? controller->GetLocalProcessId() : 0,
    controller ? controller->GetNumberOfProcesses() : 1, 0);
  vtkDataSet* points = vtkDataSet::SafeDownCast(extract->GetOutputDataObject(0));
  vtkDataArray* ids = points ? points->GetPointData()->GetArray("point_id") : nullptr;
  vtkNew<vtkIdTypeArray> ranks;
  ids ? ranks->DeepCopy(ids) : void();
  vtkNew<vtkSelectionNode> node;
  node->SetContentType(vtkSelectionNode::GLOBALIDS);
  node->SetFieldType(vtkSelectionNode::POINT);
  node->SetSelectionList(ranks);
  output->AddNode(node);
}

//------------------------------------------------------------------------------
void vtkPointFrontConvertSelection::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
