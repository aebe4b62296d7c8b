#include "vtkPointFrontReader.h"

#include "Overview.h"
#include "RankedPoints.h"

#include "pointfront/Store/StoredCloudFormats.h"
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
#include <vtkVersionMacros.h>

#include <algorithm>
#include <iterator>
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

vtkPointFrontReader::~vtkPointFrontReader()
{
  this->SetFileName(nullptr);
}

int vtkPointFrontReader::CanReadFile(const char* fileName)
{
  return fileName && *fileName && pointfront::StoredCloudFormats::ofProcess().accepts(fileName) ? 1
                                                                                         : 0;
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

int vtkPointFrontReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  this->Store = nullptr;
  this->SetErrorCode(vtkErrorCode::NoError);
  if (!this->FileName || !*this->FileName)
  {
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    vtkErrorMacro("no file name: set FileName to a .pfront store");
    return 0;
  }
  vtkStdString reason;
  this->Store = vtkPointFrontStore::Open(this->FileName, reason);
  if (!this->Store)
  {
    this->SetErrorCode(CanReadFile(this->FileName) ? vtkErrorCode::FileFormatError
                                                   : vtkErrorCode::CannotOpenFileError);
    vtkErrorMacro(<< reason);
    return 0;
  }
  for (int i = 0; i < this->Store->GetNumberOfAttributes(); ++i)
  {
    const char* name = this->Store->GetAttributeName(i);
    if (!this->PointDataArraySelection->ArrayExists(name))
    {
      this->PointDataArraySelection->AddArray(name);
    }
  }
  vtkInformation* output = outputs->GetInformationObject(0);
  double bounds[6];
  this->Store->GetBounds(bounds);
  output->Set(vtkStreamingDemandDrivenPipeline::BOUNDS(), bounds, 6);
  output->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
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

  const pointfront::StoredCloud& store = *this->Store->GetStore();
  const auto columns = chosenColumns(this->Store, this->PointDataArraySelection);
  const auto whole = overviewOf(*store.hierarchy(), this->OverviewPoints);
  const auto advance = [this](double fraction)
  {
    this->UpdateProgress(fraction);
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220101)
    return !this->CheckAbort();
#else
    return this->GetAbortExecute() == 0;
#endif
  };
  const auto filled = pointfront::fillOverview(
    store, pointfront::overviewPiece(whole, piece, pieces), columns, output, advance);
  if (!filled)
  {
    if (filled.error().kind == pointfront::Error::Kind::Cancelled)
    {
      return 1; // what the user asked for: an empty output
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
  vtkIdTypeArray* ranks, int piece, int pieces, vtkPolyData* output)
{
  if (!this->Store)
  {
    vtkErrorMacro("no store is open: call UpdateInformation() first");
    return false;
  }
  const vtkIdType* values = ranks->GetPointer(0);
  std::vector<std::uint64_t> wanted;
  std::copy_if(values, values + ranks->GetNumberOfValues(), std::back_inserter(wanted),
    [](vtkIdType rank) { return rank >= 0; });
  const pointfront::Hierarchy& hierarchy = *this->Store->GetStore()->hierarchy();
  return this->Fill({pointfront::locatePoints(hierarchy, std::move(wanted),
                      overviewOf(hierarchy, this->OverviewPoints))},
    piece, pieces, output);
}

bool vtkPointFrontReader::ReadRegion(
  const std::function<bool(const double bounds[6])>& overlaps, vtkIdType mostPoints, int piece,
  int pieces, vtkPolyData* output)
{
  if (!this->Store)
  {
    vtkErrorMacro("no store is open: call UpdateInformation() first");
    return false;
  }
  const pointfront::Hierarchy& hierarchy = *this->Store->GetStore()->hierarchy();
  const auto overlapsBox = [&](const pointfront::Bounds& box)
  {
    const double bounds[6] = {
      box.low.x, box.high.x, box.low.y, box.high.y, box.low.z, box.high.z};
    return overlaps(bounds);
  };
  Found found{pointfront::pointsOfNodes(
    hierarchy, overlapsBox, overviewOf(hierarchy, this->OverviewPoints))};
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
  if (!found.points)
  {
    vtkErrorMacro(<< found.points.error().what);
    return false;
  }
  const auto filled = pointfront::fillPoints(*this->Store->GetStore(),
    pointfront::shareOf(std::move(*found.points), piece, pieces),
    chosenColumns(this->Store, this->PointDataArraySelection), output);
  if (!filled)
  {
    vtkErrorMacro(<< filled.error().what);
  }
  return filled.ok();
}

void vtkPointFrontReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "OverviewPoints: " << this->OverviewPoints << "\n";
  os << indent << "PointDataArraySelection:\n";
  this->PointDataArraySelection->PrintSelf(os, indent.GetNextIndent());
}
