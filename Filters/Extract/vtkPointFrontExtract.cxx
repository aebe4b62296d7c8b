#include "vtkPointFrontExtract.h"

#include "ExtractedPoints.h"
#include "ExtractionRegions.h"
#include "HostVTK.h"
#include "InterpreterPause.h"

#include "pointfront/Query/ChosenColumns.h"
#include "pointfront/Query/MissedRegion.h"
#include "pointfront/Query/PointsById.h"
#include "pointfront/Query/QueryPlan.h"
#include "pointfront/Query/SphereRegion.h"
#include "pointfront/Query/TextRegion.h"
#include "vtkPointFrontStore.h"

#include <vtkCommand.h>
#include <vtkDataArraySelection.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkIndent.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPlanes.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkPointFrontExtract);

using pointfront::Error;
using pointfront::QueryReport;
using pointfront::Result;

struct vtkPointFrontExtract::Content
{
  std::vector<std::uint8_t> Classes;
  std::optional<int> NoClass; ///< asked for, and none of 0 to 255
  vtkSmartPointer<vtkPointFrontStore> Store;

  static Result<void> AddRegions(const vtkPointFrontExtract& filter, pointfront::PointQuery& query);
  Result<pointfront::PointQuery> Query(const vtkPointFrontExtract& filter) const;
  std::vector<std::string> Attributes(const vtkPointFrontExtract& filter) const;
  static pointfront::QueryOptions Options(
    vtkPointFrontExtract& filter, pointfront::InterpreterPause& pause);
  Result<QueryReport> Run(
    vtkPointFrontExtract& filter, unsigned piece, unsigned pieces, vtkPolyData* output) const;
};

Result<void> vtkPointFrontExtract::Content::AddRegions(
  const vtkPointFrontExtract& filter, pointfront::PointQuery& query)
{
  std::vector<Result<std::shared_ptr<const pointfront::Region>>> regions;
  if (filter.UseBox)
  {
    regions.push_back(pointfront::regionOfBounds(filter.Box));
  }
  if (filter.UseSphere)
  {
    const double* const c = filter.SphereCenter;
    const auto sphere = pointfront::SphereRegion::make({ c[0], c[1], c[2] }, filter.SphereRadius);
    if (!sphere)
    {
      return sphere.error();
    }
    query.regions.push_back(*sphere);
  }
  if (filter.Frustum)
  {
    regions.push_back(pointfront::regionOfPlanes(filter.Frustum));
  }
  if (filter.WellKnownText && *filter.WellKnownText)
  {
    regions.push_back(pointfront::regionOfText(filter.WellKnownText, filter.LineDistance));
  }
  for (const auto& region : regions)
  {
    if (!region)
    {
      return region.error();
    }
    query.regions.push_back(*region);
  }
  return {};
}

std::vector<std::string> vtkPointFrontExtract::Content::Attributes(
  const vtkPointFrontExtract& filter) const
{
  std::vector<std::string> names;
  const pointfront::StoreDescription& store = this->Store->GetStore()->description();
  vtkDataArraySelection* const chosen = filter.PointDataArraySelection;
  for (std::size_t c = 0; c < store.schema.size(); ++c)
  {
    const std::string& name = store.schema[c].name;
    const bool known = chosen->ArrayExists(name.c_str()) != 0;
    if (known ? chosen->ArrayIsEnabled(name.c_str()) != 0 : !store.isComputed(c))
    {
      names.push_back(name);
    }
  }
  return names;
}

Result<pointfront::PointQuery> vtkPointFrontExtract::Content::Query(
  const vtkPointFrontExtract& filter) const
{
  pointfront::PointQuery query;
  if (Result<void> added = AddRegions(filter, query); !added)
  {
    return added.error();
  }
  auto where = pointfront::FilterExpression::parse(filter.Where ? filter.Where : "");
  if (!where)
  {
    return where.error();
  }
  if (this->NoClass)
  {
    return pointfront::makeError(Error::Kind::BadArgument,
      "a class " + std::to_string(*this->NoClass) + " is none of 0 to 255");
  }
  query.where = std::move(*where);
  query.classes = this->Classes;
  query.spacing = filter.Spacing;
  query.attributes = filter.CountOnly ? std::vector<std::string>() : this->Attributes(filter);
  return query;
}

pointfront::QueryOptions vtkPointFrontExtract::Content::Options(
  vtkPointFrontExtract& filter, pointfront::InterpreterPause& pause)
{
  pointfront::QueryOptions options;
  options.memoryBytes = static_cast<std::size_t>(filter.MemoryLimit);
  options.progress = [&filter, &pause](const pointfront::Progress& state)
  {
    const pointfront::InterpreterPause::Resumed resumed(pause);
    filter.SetProgressText(state.phase);
    filter.UpdateProgress(state.fraction);
    return !pointfront::isAborted(filter) && !resumed.interrupted();
  };
  return options;
}

Result<QueryReport> vtkPointFrontExtract::Content::Run(
  vtkPointFrontExtract& filter, unsigned piece, unsigned pieces, vtkPolyData* output) const
{
  const pointfront::StoredCloud& store = *this->Store->GetStore();
  pointfront::InterpreterPause pause;
  const pointfront::QueryOptions options = Options(filter, pause);
  const auto cancelled = pointfront::makeError(Error::Kind::Cancelled, "stopped");
  if (!options.progress({ "reading" })) // a short query ends before the first report is due
  {
    return cancelled;
  }
  const auto fetch = [&](const pointfront::StoreDescription& description,
                       const auto& run) -> Result<QueryReport>
  {
    pointfront::ExtractedPoints points(
      description, static_cast<std::uint64_t>(filter.MaximumNumberOfPoints), filter.ColorsAsStored);
    Result<QueryReport> report = run([&](const pointfront::QueryBatch& batch)
      { return filter.CountOnly ? Result<void>() : points.add(batch); });
    if (report && pointfront::isAborted(filter))
    {
      return cancelled;
    }
    report ? points.moveTo(output, filter.VertexCells) : void();
    return report;
  };
  if (filter.PointIds)
  {
    const auto names = this->Attributes(filter);
    const auto columns = pointfront::ChosenColumns::make(store.description(), names);
    if (!columns)
    {
      return columns.error();
    }
    const auto ids = pointfront::pieceOf(pointfront::ascendingIds(filter.PointIds), piece, pieces);
    return fetch(columns->description,
      [&](const auto& consume)
      { return pointfront::pointsById(store, ids, names, options, consume); });
  }
  const Result<pointfront::PointQuery> query = this->Query(filter);
  if (!query)
  {
    return query.error();
  }
  const auto plan = pointfront::QueryPlan::make(store, *query);
  if (!plan)
  {
    return plan.error();
  }
  if (const auto missed = pointfront::missedRegion(store.description(), *query); missed && !piece)
  {
    vtkWarningWithObjectMacro(&filter, << *missed);
  }
  return fetch(plan->description(),
    [&](const auto& consume) { return plan->piece(piece, pieces).run(store, options, consume); });
}

vtkPointFrontExtract::vtkPointFrontExtract()
  : MaximumNumberOfPoints(VTK_ID_MAX) // no initialiser of a member: vtkWrapHierarchy stumbles
  , Internals(new Content)
{
}

vtkPointFrontExtract::~vtkPointFrontExtract()
{
  this->SetFileName(nullptr);
  this->SetWellKnownText(nullptr);
  this->SetWhere(nullptr);
}

void vtkPointFrontExtract::SetFrustum(vtkPlanes* planes)
{
  if (this->Frustum != planes)
  {
    this->Frustum = planes;
    this->Modified();
  }
}

vtkPlanes* vtkPointFrontExtract::GetFrustum()
{
  return this->Frustum;
}

void vtkPointFrontExtract::SetPointIds(vtkIdTypeArray* ids)
{
  if (this->PointIds != ids)
  {
    this->PointIds = ids;
    this->Modified();
  }
}

vtkIdTypeArray* vtkPointFrontExtract::GetPointIds()
{
  return this->PointIds;
}

void vtkPointFrontExtract::AddObjectClass(int objectClass)
{
  if (objectClass < 0 || objectClass > 255)
  {
    this->Internals->NoClass = objectClass; // the update says so
  }
  else
  {
    this->Internals->Classes.push_back(static_cast<std::uint8_t>(objectClass));
  }
  this->Modified();
}

void vtkPointFrontExtract::ClearObjectClasses()
{
  this->Internals->Classes.clear();
  this->Internals->NoClass.reset();
  this->Modified();
}

int vtkPointFrontExtract::GetNumberOfObjectClasses()
{
  return static_cast<int>(this->Internals->Classes.size());
}

int vtkPointFrontExtract::GetObjectClass(int index)
{
  return index >= 0 && index < this->GetNumberOfObjectClasses()
    ? this->Internals->Classes[static_cast<std::size_t>(index)]
    : -1;
}

vtkDataArraySelection* vtkPointFrontExtract::GetPointDataArraySelection()
{
  return this->PointDataArraySelection;
}

int vtkPointFrontExtract::GetNumberOfPointArrays()
{
  return this->PointDataArraySelection->GetNumberOfArrays();
}

const char* vtkPointFrontExtract::GetPointArrayName(int index)
{
  return this->PointDataArraySelection->GetArrayName(index);
}

int vtkPointFrontExtract::GetPointArrayStatus(const char* name)
{
  return this->PointDataArraySelection->ArrayIsEnabled(name);
}

void vtkPointFrontExtract::SetPointArrayStatus(const char* name, int status)
{
  this->PointDataArraySelection->AddArray(name, status != 0);
  this->PointDataArraySelection->SetArraySetting(name, status);
}

vtkMTimeType vtkPointFrontExtract::GetMTime()
{
  vtkMTimeType time =
    std::max(this->Superclass::GetMTime(), this->PointDataArraySelection->GetMTime());
  time = this->Frustum ? std::max(time, this->Frustum->GetMTime()) : time;
  return this->PointIds ? std::max(time, this->PointIds->GetMTime()) : time;
}

int vtkPointFrontExtract::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

bool vtkPointFrontExtract::OpenStore(const char* fileName)
{
  this->Internals->Store = nullptr;
  this->SetErrorCode(vtkErrorCode::NoError);
  if (!fileName || !*fileName)
  {
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    vtkErrorMacro("no store: set FileName, or connect a vtkPointFrontReader");
    return false;
  }
  vtkStdString reason;
  this->Internals->Store = vtkPointFrontStore::Open(fileName, reason);
  if (!this->Internals->Store)
  {
    this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
    vtkErrorMacro(<< reason);
    return false;
  }
  return true;
}

int vtkPointFrontExtract::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* const output = outputs->GetInformationObject(0);
  output->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  const bool named = this->FileName && *this->FileName;
  if (!named && this->GetNumberOfInputConnections(0) > 0)
  {
    return 1; // which store it is stands in the data
  }
  if (!this->OpenStore(this->FileName))
  {
    return 0;
  }
  const vtkPointFrontStore& store = *this->Internals->Store;
  for (int i = 0; i < store.GetNumberOfAttributes(); ++i)
  {
    if (!this->PointDataArraySelection->ArrayExists(store.GetAttributeName(i)))
    {
      const bool computed = store.GetStore()->description().isComputed(static_cast<std::size_t>(i));
      this->PointDataArraySelection->AddArray(store.GetAttributeName(i), !computed);
    }
  }
  return 1;
}

int vtkPointFrontExtract::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (!this->FileName || !*this->FileName)
  {
    vtkDataObject* const input = vtkDataObject::GetData(inputs[0], 0);
    const vtkStdString name = input ? vtkPointFrontStore::GetStoreName(input) : vtkStdString();
    if (!this->OpenStore(name.c_str()))
    {
      return 0;
    }
  }
  else if (!this->Internals->Store)
  {
    return 0; // RequestInformation has said why
  }
  this->SetErrorCode(vtkErrorCode::NoError);
  this->NumberOfPointsChosen = 0;
  vtkInformation* const info = outputs->GetInformationObject(0);
  vtkPolyData* const output = vtkPolyData::GetData(info);
  // VTK has passed the input's field data on; a mapper would draw the whole store.
  output->GetFieldData()->RemoveArray(vtkPointFrontStore::FieldName());
  const int piece = info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER());
  const int pieces =
    std::max(1, info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES()));
  if (piece < 0 || piece >= pieces)
  {
    return 1; // more ranks than pieces
  }
  const auto report = this->Internals->Run(
    *this, static_cast<unsigned>(piece), static_cast<unsigned>(pieces), output);
  if (!report)
  {
    if (report.error().kind == Error::Kind::Cancelled)
    {
      return 1; // the user asked for an empty output
    }
    const bool damaged =
      report.error().kind == Error::Kind::Corrupt || report.error().kind == Error::Kind::Truncated;
    this->SetErrorCode(damaged ? vtkErrorCode::FileFormatError : vtkErrorCode::UnknownError);
    vtkErrorMacro(<< report.error().what);
    return 0;
  }
  this->NumberOfPointsChosen = static_cast<vtkIdType>(report->pointsChosen);
  this->NumberOfNodesRead = static_cast<vtkIdType>(report->nodesRead);
  this->NumberOfPointsRead = static_cast<vtkIdType>(report->pointsRead);
  this->NumberOfBytesRead = static_cast<vtkTypeInt64>(report->bytesRead);
  this->UpdateProgress(1.0);
  return 1;
}

void vtkPointFrontExtract::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto text = [](const char* value) { return value ? value : "(none)"; };
  os << indent << "FileName: " << text(this->FileName) << "\n";
  os << indent << "UseBox: " << this->UseBox << "\n";
  os << indent << "Box:";
  for (const double end : this->Box)
  {
    os << " " << end;
  }
  os << "\n" << indent << "UseSphere: " << this->UseSphere << "\n";
  os << indent << "SphereCenter: " << this->SphereCenter[0] << " " << this->SphereCenter[1] << " "
     << this->SphereCenter[2] << "\n";
  os << indent << "SphereRadius: " << this->SphereRadius << "\n";
  os << indent << "Frustum: " << (this->Frustum ? "set" : "(none)") << "\n";
  os << indent << "WellKnownText: " << text(this->WellKnownText) << "\n";
  os << indent << "LineDistance: " << this->LineDistance << "\n";
  os << indent << "ObjectClasses: " << this->Internals->Classes.size() << " named\n";
  os << indent << "Where: " << text(this->Where) << "\n";
  os << indent << "Spacing: " << this->Spacing << "\n";
  os << indent << "PointIds: " << (this->PointIds ? this->PointIds->GetNumberOfValues() : 0)
     << "\n";
  os << indent << "MaximumNumberOfPoints: " << this->MaximumNumberOfPoints << "\n";
  os << indent << "CountOnly: " << this->CountOnly << "\n";
  os << indent << "VertexCells: " << this->VertexCells << "\n";
  os << indent << "ColorsAsStored: " << this->ColorsAsStored << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
}
