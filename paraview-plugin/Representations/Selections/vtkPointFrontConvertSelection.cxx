#include "vtkPointFrontConvertSelection.h"

#include "QueryCandidates.h"
#include "UpstreamReader.h"

#include "pointfront/Store/StoredCloud.h"

#include "vtkDataSet.h"
#include "vtkIdTypeArray.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointFrontExtractSelection.h"
#include "vtkPointFrontReader.h"
#include "vtkPointFrontStore.h"
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
  vtkPointFrontReader* reader = this->GetNumberOfInputConnections(1) > 0
    ? pointfront::upstreamReader(this->GetInputConnection(1, 0)->GetProducer())
    : nullptr;
  const bool ofStore = reader && reader->GetStore();
  bool named = input && input->GetNumberOfNodes() > 0;
  for (unsigned int i = 0; named && i < input->GetNumberOfNodes(); ++i)
  {
    named = input->GetNode(i)->GetContentType() == vtkSelectionNode::GLOBALIDS;
  }
  if (ofStore && named)
  {
    vtkSelection::GetData(outputVector, 0)->ShallowCopy(input);
    return 1;
  }
  if (ofStore && input && pointfront::choosesStoredPoints(input) &&
    !pointfront::asksForRows(input, reader->GetStore()->GetStore()->description()))
  {
    return this->NameWhatIsSelected(input, vtkSelection::GetData(outputVector, 0)) ? 1 : 0;
  }
  return this->Superclass::RequestData(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
bool vtkPointFrontConvertSelection::NameWhatIsSelected(
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
  vtkNew<vtkIdTypeArray> pointIds;
  if (ids)
  {
    pointIds->DeepCopy(ids);
  }
  else if (extract->GetErrorCode() != 0)
  {
    return true; // it has said why nothing is selected
  }
  else if (!points || points->GetNumberOfPoints() > 0)
  {
    vtkErrorMacro("the selected points cannot be named: they could not be extracted");
    return false;
  }
  vtkNew<vtkSelectionNode> node;
  node->SetContentType(vtkSelectionNode::GLOBALIDS);
  node->SetFieldType(vtkSelectionNode::POINT);
  node->SetSelectionList(pointIds);
  output->AddNode(node);
  return true;
}

//------------------------------------------------------------------------------
void vtkPointFrontConvertSelection::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
