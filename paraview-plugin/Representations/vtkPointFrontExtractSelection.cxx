#include "vtkPointFrontExtractSelection.h"

#include "UpstreamReader.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkExtractSelectedFrustum.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointFrontStore.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <array>
#include <string>

vtkStandardNewMacro(vtkPointFrontExtractSelection);

namespace
{

/// That a selection through the cloud may read, on all processes together: some GB.
constexpr vtkIdType MostPoints = 50000000;

/// Ranks of the points that a selection names, whoever's they are.
void appendNamedPoints(vtkSelection* selection, vtkIdTypeArray* ranks)
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
      ranks->InsertTuples(ranks->GetNumberOfTuples(), ids->GetNumberOfTuples(), 0, ids);
    }
  }
}

/// Whether a selection asks for values that points have: not by their names, nor by a place.
bool asksForValues(vtkSelection* selection)
{
  for (unsigned int i = 0; i < selection->GetNumberOfNodes(); ++i)
  {
    vtkSelectionNode* node = selection->GetNode(i);
    const char* query = node->GetQueryString();
    const int content = node->GetContentType();
    vtkAbstractArray* list = node->GetSelectionList();
    const bool named = list && list->GetName() && std::string(list->GetName()) == "point_id";
    if ((query && *query) || content == vtkSelectionNode::QUERY ||
      content == vtkSelectionNode::THRESHOLDS || (content == vtkSelectionNode::VALUES && !named))
    {
      return true;
    }
  }
  return false;
}

/// The view frustum that a selection consists of, if it has one.
vtkDoubleArray* frustumOf(vtkSelection* selection)
{
  for (unsigned int i = 0; i < selection->GetNumberOfNodes(); ++i)
  {
    vtkSelectionNode* node = selection->GetNode(i);
    auto* corners = vtkDoubleArray::SafeDownCast(node->GetSelectionList());
    if (node->GetContentType() == vtkSelectionNode::FRUSTUM && corners &&
      corners->GetNumberOfValues() == 32)
    {
      return corners;
    }
  }
  return nullptr;
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
int vtkPointFrontExtractSelection::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  auto* overview = vtkPolyData::GetData(inputVector[0], 0);
  vtkSelection* selection = vtkSelection::GetData(inputVector[1], 0);
  vtkPointFrontReader* reader = pointfront::upstreamReaderOf(this);
  if (!reader || !overview || !selection)
  {
    return this->Superclass::RequestData(request, inputVector, outputVector);
  }
  vtkInformation* output = outputVector->GetInformationObject(0);
  const int piece = output->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER());
  const int pieces =
    std::max(1, output->Get(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES()));
  const bool partly = asksForValues(selection) && reader->GetStore() &&
    reader->GetStore()->GetNumberOfPoints() > reader->GetOverviewPoints();
  if (partly && !this->ToldOfOverview && piece == 0)
  {
    vtkWarningMacro("a query selects among the "
      << reader->GetOverviewPoints()
      << " points of the "
         "overview, not among all of the store: for those, use the filter PointFront Extract "
         "(Where)");
  }
  this->ToldOfOverview = partly;
  vtkNew<vtkIdTypeArray> ranks;
  appendNamedPoints(selection, ranks);
  vtkNew<vtkPolyData> further;
  bool read = true;
  if (vtkDoubleArray* corners = frustumOf(selection))
  {
    vtkNew<vtkExtractSelectedFrustum> frustum;
    frustum->CreateFrustum(corners->GetPointer(0));
    const auto overlaps = [&](const double bounds[6])
    {
      std::array<double, 6> box;
      std::copy_n(bounds, 6, box.begin());
      return frustum->OverallBoundsTest(box.data()) != 0;
    };
    read = reader->ReadRegion(overlaps, MostPoints, piece, pieces, further);
  }
  else if (ranks->GetNumberOfTuples() > 0)
  {
    read = reader->ReadPoints(ranks, piece, pieces, further);
  }
  if (!read)
  {
    return 0; // the reader has said why
  }
  vtkInformation* input = inputVector[0]->GetInformationObject(0);
  const vtkSmartPointer<vtkDataObject> kept = overview;
  input->Set(vtkDataObject::DATA_OBJECT(), joined(overview, further));
  const int done = this->Superclass::RequestData(request, inputVector, outputVector);
  input->Set(vtkDataObject::DATA_OBJECT(), kept);
  return done;
}

//------------------------------------------------------------------------------
void vtkPointFrontExtractSelection::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
