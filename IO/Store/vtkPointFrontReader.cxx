#include "vtkPointFrontReader.h"

#include "HostVTK.h"
#include "LocatedPoints.h"
#include "Overview.h"

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Disk/Epoch.h"
#include "pointfront/Disk/StopOfReads.h"
#include "pointfront/Tiles/StoredCloudFormats.h"
#include "vtkPointFrontStore.h"

#include <vtkDataArraySelection.h>
#include <vtkErrorCode.h>
#include <vtkIdTypeArray.h>
#include <vtkIndent.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkPointFrontReader);

namespace
{

/// Columns of the store that the selection names.
pointfront::ColumnSelection chosenColumns(
  const vtkPointFrontStore* store, vtkDataArraySelection* selection)
{
  pointfront::ColumnSelection columns;
  for (int i = 0; i < store->GetNumberOfAttributes(); ++i)
  {
    if (selection->ArrayIsEnabled(store->GetAttributeName(i)))
    {
      columns.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return columns;
}

std::vector<pointfront::OverviewPart> overviewOf(
  const pointfront::Hierarchy& hierarchy, vtkIdType points)
{
  return pointfront::chooseOverview(hierarchy, static_cast<std::uint64_t>(points));
}

} // namespace

vtkPointFrontReader::vtkPointFrontReader()
{
  this->SetNumberOfInputPorts(0);
}

vtkPointFrontReader::~vtkPointFrontReader() = default;

void vtkPointFrontReader::SetFileName(const char* fileName)
{
  const std::string name = fileName ? fileName : "";
  const std::size_t count = name.empty() ? 0 : 1;
  if (this->FileNames.size() != count || (count == 1 && this->FileNames.front() != name))
  {
    this->FileNames.assign(count, name);
    this->Modified();
  }
}

const char* vtkPointFrontReader::GetFileName() const
{
  return this->GetFileName(0);
}

void vtkPointFrontReader::AddFileName(const char* fileName)
{
  if (fileName && *fileName)
  {
    this->FileNames.emplace_back(fileName);
    this->Modified();
  }
}

void vtkPointFrontReader::RemoveAllFileNames()
{
  if (!this->FileNames.empty())
  {
    this->FileNames.clear();
    this->Modified();
  }
}

int vtkPointFrontReader::GetNumberOfFileNames() const
{
  return static_cast<int>(this->FileNames.size());
}

const char* vtkPointFrontReader::GetFileName(int time) const
{
  const bool known = time >= 0 && time < this->GetNumberOfFileNames();
  return known ? this->FileNames[static_cast<std::size_t>(time)].c_str() : nullptr;
}

int vtkPointFrontReader::CanReadFile(const char* fileName)
{
  if (!fileName || !*fileName)
  {
    return 0;
  }
  const pointfront::StoredCloudFormats& formats = vtkPointFrontStore::GetFormats();
  std::shared_ptr<const pointfront::ByteSource> held; // all kinds look at it
  if (pointfront::isAddress(fileName))
  {
    auto source = pointfront::StoredCloudFormats::openFar(fileName);
    if (!source)
    {
      return 0;
    }
    held = std::move(*source);
  }
  return formats.accepts(fileName) ? 1 : 0;
}

vtkDataArraySelection* vtkPointFrontReader::GetPointDataArraySelection()
{
  return this->PointDataArraySelection;
}

int vtkPointFrontReader::GetNumberOfPointArrays()
{
  return this->PointDataArraySelection->GetNumberOfArrays();
}

const char* vtkPointFrontReader::GetPointArrayName(int index)
{
  return this->PointDataArraySelection->GetArrayName(index);
}

int vtkPointFrontReader::GetPointArrayStatus(const char* name)
{
  return this->PointDataArraySelection->ArrayIsEnabled(name);
}

void vtkPointFrontReader::SetPointArrayStatus(const char* name, int status)
{
  if (status)
  {
    this->PointDataArraySelection->EnableArray(name);
  }
  else
  {
    this->PointDataArraySelection->DisableArray(name);
  }
}

vtkPointFrontStore* vtkPointFrontReader::GetStore()
{
  return this->Store;
}

vtkMTimeType vtkPointFrontReader::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->PointDataArraySelection->GetMTime());
}

/// The times of the files, or of the epochs of the one that is open.
void vtkPointFrontReader::FindSteps()
{
  this->Steps.clear();
  if (this->FileNames.size() > 1)
  {
    for (const std::string& name : this->FileNames)
    {
      this->Steps.push_back({ static_cast<double>(this->Steps.size()), name });
    }
    return;
  }
  const std::vector<std::string>& epochs = this->Store->GetStore()->description().epochs;
  if (epochs.size() < 2)
  {
    return;
  }
  for (const pointfront::EpochTime& epoch : pointfront::timesOf(epochs))
  {
    this->Steps.push_back(
      { epoch.time, pointfront::EpochAddress{ this->FileNames.front(), epoch.name }.text() });
  }
}

/// The store of the time that somebody asks for: between two steps the earlier one.
const std::string& vtkPointFrontReader::NameAt(vtkInformation* output, double& time) const
{
  const bool asked = output->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()) != 0;
  if (this->Steps.empty() || (!asked && this->FileNames.size() == 1))
  {
    return this->FileNames.front();
  }
  time = asked ? output->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()) : 0.0;
  const auto behind = std::find_if(this->Steps.begin() + 1, this->Steps.end(),
    [time](const Step& step) { return step.time > time; });
  time = std::prev(behind)->time;
  return std::prev(behind)->name;
}

bool vtkPointFrontReader::OpenStore(const std::string& name)
{
  vtkStdString reason;
  std::string named;
  if (!this->FindName(name, named))
  {
    return false;
  }
  this->Store = vtkPointFrontStore::Open(named.c_str(), reason);
  if (!this->Store)
  {
    const bool far = pointfront::isAddress(name); // asked twice, a server may take twice its time
    this->SetErrorCode(!far && CanReadFile(name.c_str()) ? vtkErrorCode::FileFormatError
                                                         : vtkErrorCode::CannotOpenFileError);
    vtkErrorMacro(<< reason);
    return false;
  }
  const pointfront::StoreDescription& description = this->Store->GetStore()->description();
  for (int i = 0; i < this->Store->GetNumberOfAttributes(); ++i)
  {
    const char* attribute = this->Store->GetAttributeName(i);
    if (!this->PointDataArraySelection->ArrayExists(attribute))
    {
      const bool computed = description.isComputed(static_cast<std::size_t>(i));
      this->PointDataArraySelection->AddArray(attribute, !computed);
    }
  }
  return true;
}

int vtkPointFrontReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  this->Store = nullptr;
  this->SetErrorCode(vtkErrorCode::NoError);
  if (this->FileNames.empty())
  {
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    vtkErrorMacro("no file name: set FileName to a .pfront store");
    return 0;
  }
  this->SetAbortExecute(0); // the stop of an earlier run does not stop this one
  const pointfront::StopOfReads stop([this] { return this->GetAbortExecute() != 0; });
  // The first comes last and stays.
  for (std::size_t time = this->FileNames.size(); time-- > 0;)
  {
    if (!this->OpenStore(this->FileNames[time]))
    {
      return 0;
    }
  }
  this->FindSteps();
  for (const std::string& warning : this->Store->GetStore()->description().warnings)
  {
    vtkWarningMacro(<< this->Store->GetFileName() << ": " << warning);
  }
  vtkInformation* output = outputs->GetInformationObject(0);
  double bounds[6];
  this->Store->GetBounds(bounds);
  output->Set(vtkStreamingDemandDrivenPipeline::BOUNDS(), bounds, 6);
  output->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  output->Remove(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
  output->Remove(vtkStreamingDemandDrivenPipeline::TIME_RANGE());
  if (!this->Steps.empty())
  {
    std::vector<double> times;
    for (const Step& step : this->Steps)
    {
      times.push_back(step.time);
    }
    const double range[2] = { times.front(), times.back() };
    output->Set(
      vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
    output->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
  }
  return 1;
}

int vtkPointFrontReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  if (!this->Store)
  {
    return 0; // RequestInformation has said why
  }
  vtkInformation* info = outputs->GetInformationObject(0);
  vtkPolyData* output = vtkPolyData::GetData(info);
  const int piece = info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER());
  const int pieces =
    std::max(1, info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES()));
  double time = std::numeric_limits<double>::quiet_NaN(); // without times
  if (!this->OpenStore(this->NameAt(info, time)))
  {
    return 0;
  }
  if (!std::isnan(time))
  {
    output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
  }

  const pointfront::StoredCloud& store = *this->Store->GetStore();
  const auto columns = chosenColumns(this->Store, this->PointDataArraySelection);
  const auto whole = overviewOf(*store.hierarchy(), this->OverviewPoints);
  const auto advance = [this](double fraction)
  {
    this->UpdateProgress(fraction);
    return !pointfront::isAborted(*this);
  };
  const auto filled = pointfront::fillOverview(
    store, pointfront::overviewPiece(whole, piece, pieces), columns, output, advance);
  if (!filled)
  {
    if (filled.error().kind == pointfront::Error::Kind::Cancelled)
    {
      return 1; // the user asked for an empty output
    }
    this->SetErrorCode(vtkErrorCode::FileFormatError);
    vtkErrorMacro(<< filled.error().what);
    return 0;
  }
  vtkPointFrontStore::SetStoreName(output, this->Store->GetFileName());
  this->UpdateProgress(1.0);
  return 1;
}

struct vtkPointFrontReader::Found
{
  pointfront::Result<std::vector<pointfront::NodeRows>> points;
};

bool vtkPointFrontReader::ReadPoints(
  vtkIdTypeArray* ids, int piece, int pieces, vtkPolyData* output)
{
  if (!this->Store)
  {
    vtkErrorMacro("no store is open: call UpdateInformation() first");
    return false;
  }
  if (!ids)
  {
    vtkErrorMacro("no array of ids was given");
    return false;
  }
  const vtkIdType* values = ids->GetPointer(0);
  std::vector<std::uint64_t> wanted(values, values + ids->GetNumberOfValues()); // -1: far beyond
  const pointfront::Hierarchy& hierarchy = *this->Store->GetStore()->hierarchy();
  return this->Fill({ pointfront::locatePoints(
                      hierarchy, std::move(wanted), overviewOf(hierarchy, this->OverviewPoints)) },
    piece, pieces, output);
}

bool vtkPointFrontReader::ReadRegion(const std::function<bool(const double bounds[6])>& overlaps,
  vtkIdType mostPoints, int piece, int pieces, vtkPolyData* output)
{
  if (!this->Store)
  {
    vtkErrorMacro("no store is open: call UpdateInformation() first");
    return false;
  }
  const pointfront::Hierarchy& hierarchy = *this->Store->GetStore()->hierarchy();
  const auto overlapsBox = [&](const pointfront::Bounds& box)
  {
    const double bounds[6] = { box.low.x, box.high.x, box.low.y, box.high.y, box.low.z,
      box.high.z };
    return overlaps(bounds);
  };
  Found found{ pointfront::pointsOfNodes(
    hierarchy, overlapsBox, overviewOf(hierarchy, this->OverviewPoints)) };
  if (found.points && pointfront::countOf(*found.points) > static_cast<std::uint64_t>(mostPoints))
  {
    vtkErrorMacro("the region reaches into parts of the cloud with "
      << pointfront::countOf(*found.points) << " points, and " << mostPoints
      << " are allowed: choose a smaller one");
    return false;
  }
  return this->Fill(std::move(found), piece, pieces, output);
}

bool vtkPointFrontReader::Fill(Found&& found, int piece, int pieces, vtkPolyData* output)
{
  if (!output || piece < 0 || piece >= pieces)
  {
    vtkErrorMacro(<< (output ? "piece " + std::to_string(piece) + " of " + std::to_string(pieces) +
                        " does not exist: pieces count from 0"
                             : std::string("no output was given for the points")));
    return false;
  }
  if (!found.points)
  {
    vtkErrorMacro(<< found.points.error().what);
    return false;
  }
  this->SetAbortExecute(0); // the stop of an earlier run does not stop this one
  const auto goOn = [this](double share)
  {
    this->UpdateProgress(share);
    return !this->GetAbortExecute();
  };
  if (!goOn(0.0))
  {
    vtkErrorMacro("stopped before the points were read");
    return false;
  }
  pointfront::QueryOptions options;
  options.progress = [&goOn](const pointfront::Progress& progress)
  { return goOn(progress.fraction); };
  const auto filled = pointfront::fillPoints(*this->Store->GetStore(),
    pointfront::shareOf(std::move(*found.points), piece, pieces),
    chosenColumns(this->Store, this->PointDataArraySelection), options, output);
  if (!filled)
  {
    vtkErrorMacro(<< filled.error().what);
  }
  return filled.ok();
}

void vtkPointFrontReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: "
     << (this->FileNames.empty() ? "(none)" : pointfront::publicForm(this->FileNames.front()))
     << "\n";
  os << indent << "NumberOfFileNames: " << this->FileNames.size() << "\n";
  this->PrintSettings(os, indent);
  os << indent << "OverviewPoints: " << this->OverviewPoints << "\n";
  os << indent << "PointDataArraySelection:\n";
  this->PointDataArraySelection->PrintSelf(os, indent.GetNextIndent());
}
