#include "vtkPointFrontExtractSelection.h"

#include "FrustumSelector.h"
#include "HostVTK.h"
#include "QueryCandidates.h"
#include "QuerySelector.h"
#include "RegionPlanes.h"
#include "UpstreamReader.h"

#include "pointfront/Store/StoredCloud.h"

#include "vtkAbstractArray.h"
#include "vtkAppendFilter.h"
#include "vtkCellArray.h"
#include "vtkCommunicator.h"
#include "vtkDataSet.h"
#include "vtkErrorCode.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPlanes.h"
#include "vtkPointData.h"
#include "vtkPointFrontReader.h"
#include "vtkPointFrontSettings.h"
#include "vtkPointFrontStore.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkPointFrontExtractSelection);

namespace
{

/// Ids of the points that a selection names, whoever's they are.
void appendNamedPoints(vtkSelection* selection, vtkIdTypeArray* pointIds)
{
  for (unsigned int i = 0; i < selection->GetNumberOfNodes(); ++i)
  {
    vtkSelectionNode* node = selection->GetNode(i);
    auto* ids = vtkIdTypeArray::SafeDownCast(node->GetSelectionList());
    const bool values = node->GetContentType() == vtkSelectionNode::VALUES && ids &&
      ids->GetName() && std::string(ids->GetName()) == "point_id";
    const bool named = node->GetContentType() == vtkSelectionNode::GLOBALIDS || values;
    if (ids && named && node->GetFieldType() == vtkSelectionNode::POINT)
    {
      pointIds->InsertTuples(pointIds->GetNumberOfTuples(), ids->GetNumberOfTuples(), 0, ids);
    }
  }
}

/// Whether it is so on all ranks: those that went on alone would wait for the others.
bool everywhere(bool here, int pieces)
{
  auto* controller = vtkMultiProcessController::GetGlobalController();
  if (!controller || pieces < 2)
  {
    return here;
  }
  const int mine = here ? 1 : 0;
  int all = 0;
  controller->AllReduce(&mine, &all, 1, vtkCommunicator::MIN_OP);
  return all != 0;
}

/// By name: VTK's statistics over time take columns by their order.
void sortArrays(vtkPointData* attributes)
{
  std::map<std::string, vtkSmartPointer<vtkAbstractArray>> arrays;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = attributes->GetAbstractArray(i);
    arrays[array->GetName() ? array->GetName() : ""] = array;
  }
  attributes->Initialize();
  for (const auto& [name, array] : arrays)
  {
    attributes->AddArray(array);
  }
}

/// Moves what all ranks have to the first.
void gatherOnFirst(vtkDataSet* share)
{
  auto* controller = vtkMultiProcessController::GetGlobalController();
  std::vector<vtkSmartPointer<vtkDataObject>> shares;
  controller->Gather(share, shares, 0);
  vtkNew<vtkAppendFilter> all;
  for (const auto& one : shares)
  {
    all->AddInputData(one);
  }
  if (!shares.empty())
  {
    all->Update();
    share->ShallowCopy(all->GetOutput());
  }
  else
  {
    share->Initialize();
  }
}

/// The points of `first` and behind them those of `second`, which has the same arrays.
vtkSmartPointer<vtkPolyData> joined(vtkPolyData* first, vtkPolyData* second)
{
  auto both = vtkSmartPointer<vtkPolyData>::New();
  both->ShallowCopy(first);
  if (second->GetNumberOfPoints() == 0)
  {
    return both;
  }
  if (first->GetNumberOfPoints() == 0)
  {
    both->ShallowCopy(second);
    both->SetFieldData(first->GetFieldData());
    return both;
  }
  const vtkIdType before = first->GetNumberOfPoints();
  const vtkIdType added = second->GetNumberOfPoints();
  vtkNew<vtkPoints> points;
  points->SetDataType(first->GetPoints()->GetDataType());
  points->DeepCopy(first->GetPoints());
  points->InsertPoints(before, added, 0, second->GetPoints());
  vtkNew<vtkPointData> attributes;
  attributes->CopyAllOn();
  attributes->DeepCopy(first->GetPointData());
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = attributes->GetAbstractArray(i);
    vtkAbstractArray* more = second->GetPointData()->GetAbstractArray(array->GetName());
    if (more)
    {
      array->InsertTuples(before, added, 0, more);
    }
  }
  vtkNew<vtkCellArray> vertices;
  vertices->DeepCopy(first->GetVerts());
  vertices->Append(second->GetVerts(), before);
  both->SetPoints(points);
  both->SetVerts(vertices);
  both->GetPointData()->ShallowCopy(attributes);
  return both;
}

} // namespace

//------------------------------------------------------------------------------
vtkPointFrontExtractSelection::vtkPointFrontExtractSelection() = default;

//------------------------------------------------------------------------------
vtkPointFrontExtractSelection::~vtkPointFrontExtractSelection() = default;

//------------------------------------------------------------------------------
void vtkPointFrontExtractSelection::SetHyperTreeGridsConverted(bool converted)
{
  pointfront::convertHyperTreeGrids(*this, converted);
}

//------------------------------------------------------------------------------
void vtkPointFrontExtractSelection::SetReader(vtkPointFrontReader* reader)
{
  if (this->Reader != reader)
  {
    this->Reader = reader;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkPointFrontExtractSelection::SetDroppedArrays(const std::vector<std::string>& names)
{
  if (this->DroppedArrays != names)
  {
    this->DroppedArrays = names;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> vtkPointFrontExtractSelection::GetCandidates(
  vtkPointFrontReader* reader, vtkPolyData* overview, vtkSelection* selection, int piece,
  int pieces)
{
  vtkPointFrontStore* store = reader->GetStore();
  if (pointfront::isPreview(reader) && selection->GetNumberOfNodes() > 0)
  {
    vtkErrorMacro(<< pointfront::previewRefusal());
    return nullptr;
  }
  const vtkIdType mostPoints = vtkPointFrontSettings::MostSelectionPoints();
  vtkNew<vtkPolyData> further;
  const bool hasMore = store && store->GetNumberOfPoints() > reader->GetOverviewPoints();
  const bool rows = hasMore && pointfront::asksForRows(selection, store->GetStore()->description());
  const bool byValues = hasMore && !rows && pointfront::asksForValues(selection);
  if (byValues && pointfront::namesRows(selection))
  {
    vtkErrorMacro("the selection joins rows of the spreadsheet, which are those of the overview, "
                  "and a query, which is about all points. Select by one of the two.");
    return nullptr;
  }
  if (byValues)
  {
    const std::string condition = this->GetPreserveTopology()
      ? std::string()
      : pointfront::conditionOfSelection(selection, store->GetStore()->description());
    std::string error;
    const bool read =
      pointfront::readCandidates(reader, condition, mostPoints, piece, pieces, further, error);
    if (!read)
    {
      vtkErrorMacro("the query selects among too many points, or they cannot be read: "
        << error
        << ". The filter PointFront Extract (Region, Classes, Where) gives a part of them.");
      return nullptr;
    }
    further->SetFieldData(overview->GetFieldData());
    return further;
  }
  vtkNew<vtkIdTypeArray> pointIds;
  appendNamedPoints(selection, pointIds);
  bool read = true;
  if (const double* corners = pointfront::frustumOf(selection))
  {
    const auto sides = pointfront::planesOf(corners);
    const auto overlaps = [&](const double bounds[6])
    { return pointfront::mayOverlap(corners, sides, bounds); };
    read = reader->ReadRegion(overlaps, mostPoints, piece, pieces, further);
  }
  else if (pointIds->GetNumberOfTuples() > 0)
  {
    read = reader->ReadPoints(pointIds, piece, pieces, further);
  }
  return read ? joined(overview, further) : nullptr; // the reader has said why
}

//------------------------------------------------------------------------------
int vtkPointFrontExtractSelection::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  auto* overview = vtkPolyData::GetData(inputVector[0], 0);
  vtkSelection* selection = vtkSelection::GetData(inputVector[1], 0);
  vtkPointFrontReader* reader =
    this->Reader ? this->Reader.Get() : pointfront::upstreamReaderOf(this);
  if (!reader || !overview || !selection)
  {
    return this->Superclass::RequestData(request, inputVector, outputVector);
  }
  this->SetErrorCode(vtkErrorCode::NoError);
  vtkInformation* output = outputVector->GetInformationObject(0);
  const int piece = output->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER());
  const int pieces =
    std::max(1, output->Get(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES()));
  const vtkSmartPointer<vtkPolyData> candidates =
    this->GetCandidates(reader, overview, selection, piece, pieces);
  if (!everywhere(candidates != nullptr, pieces))
  {
    // Has been said, here or by another rank: no failure of the pipeline's besides.
    this->SetErrorCode(vtkErrorCode::UnknownError);
    return 1;
  }
  vtkInformation* input = inputVector[0]->GetInformationObject(0);
  const vtkSmartPointer<vtkDataObject> kept = overview;
  input->Set(vtkDataObject::DATA_OBJECT(), candidates);
  const int done = this->Superclass::RequestData(request, inputVector, outputVector);
  input->Set(vtkDataObject::DATA_OBJECT(), kept);
  if (vtkDataSet* extracted = vtkDataSet::GetData(outputVector, 0))
  {
    for (const std::string& name : this->DroppedArrays)
    {
      extracted->GetPointData()->RemoveArray(name.c_str());
    }
    if (this->Reader && pieces > 1)
    {
      gatherOnFirst(extracted);
    }
    if (this->Reader)
    {
      sortArrays(extracted->GetPointData());
    }
  }
  return done;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkSelector> vtkPointFrontExtractSelection::NewSelectionOperator(
  vtkSelectionNode::SelectionContent type)
{
  if (type == vtkSelectionNode::FRUSTUM)
  {
    return vtkSmartPointer<pointfront::FrustumSelector>::New();
  }
  const vtkSmartPointer<vtkSelector> selector = this->Superclass::NewSelectionOperator(type);
  if (!selector || type != vtkSelectionNode::QUERY)
  {
    return selector;
  }
  vtkNew<pointfront::QuerySelector> checked;
  checked->wrap(selector, this);
  return checked;
}

//------------------------------------------------------------------------------
void vtkPointFrontExtractSelection::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
