#include "vtkPointFrontMapper.h"

#include "MapperContent.h"
#include "RoomWarning.h"

#include "pointfront/Detail/DetailLevel.h"
#include "pointfront/Plan/FramePlanner.h"
#include "pointfront/Plan/FrameStatistics.h"
#include "pointfront/Quality/QualityChoice.h"
#include "pointfront/Style/GpuStreams.h"
#include "pointfront/Views/WallReach.h"
#include "vtkPointFrontStyle.h"

#include <vtkActor.h>
#include <vtkCommand.h>
#include <vtkIndent.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>
#include <vtkScalarsToColors.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

vtkAbstractObjectFactoryNewMacro(vtkPointFrontMapper);

vtkPointFrontMapper::vtkPointFrontMapper()
  : Internals(new Content(this))
{
}

vtkPointFrontMapper::~vtkPointFrontMapper()
{
  this->Internals->Timer.stop();
}

void vtkPointFrontMapper::SetTargetError(double pixels)
{
  if (std::isnan(pixels))
  {
    vtkErrorMacro(
      "a target error is a number of pixels, and this is none; it stays " << this->TargetError);
    return;
  }
  const double kept =
    std::clamp(pixels, this->GetTargetErrorMinValue(), this->GetTargetErrorMaxValue());
  if (kept != this->TargetError)
  {
    this->TargetError = kept;
    this->Modified();
  }
}

void vtkPointFrontMapper::SetClassVisibility(int objectClass, bool visible)
{
  if (visible != this->GetClassVisibility(objectClass))
  {
    this->Internals->Limits[objectClass].visible = visible;
    this->Modified();
  }
}

bool vtkPointFrontMapper::GetClassVisibility(int objectClass) const
{
  return this->Internals->Limits.of(objectClass).visible;
}

void vtkPointFrontMapper::SetClassTargetErrorFactor(int objectClass, double factor)
{
  const double kept = std::isnan(factor) ? 1.0 : std::clamp(factor, 0.01, 100.0);
  if (kept != this->GetClassTargetErrorFactor(objectClass))
  {
    this->Internals->Limits[objectClass].errorFactor = kept;
    this->Modified();
  }
}

double vtkPointFrontMapper::GetClassTargetErrorFactor(int objectClass) const
{
  return this->Internals->Limits.of(objectClass).errorFactor;
}

void vtkPointFrontMapper::SetClassBudgetShare(int objectClass, double share)
{
  const double kept = std::isnan(share) ? 0.0 : std::clamp(share, 0.0, 1.0);
  if (kept != this->GetClassBudgetShare(objectClass))
  {
    this->Internals->Limits[objectClass].share = kept;
    this->Modified();
  }
}

double vtkPointFrontMapper::GetClassBudgetShare(int objectClass) const
{
  return this->Internals->Limits.of(objectClass).share;
}

bool vtkPointFrontMapper::GetLastExpectedDifference(
  double psnr[3], double ssim[3], double shareOver8[3]) const
{
  const pointfront::FrameStatistics& last = this->GetStatistics();
  const auto expected = pointfront::expectedDifference(last.technique, last.errorPx);
  if (!expected)
  {
    return false;
  }
  const auto set = [](const pointfront::CurveRange& range, double values[3])
  {
    values[0] = range.least;
    values[1] = range.middle;
    values[2] = range.most;
  };
  set(expected->psnr, psnr);
  set(expected->ssim, ssim);
  set(expected->off, shareOver8);
  return true;
}

std::string vtkPointFrontMapper::GetLastExpectedSource() const
{
  return pointfront::curveSource();
}

std::string vtkPointFrontMapper::GetLastTechnique() const
{
  return this->GetStatistics().technique;
}

const std::vector<std::uint64_t>& vtkPointFrontMapper::GetLastLayerPoints() const
{
  return this->GetStatistics().layerPoints;
}

const std::vector<std::uint16_t>& vtkPointFrontMapper::GetLastLayersLeftOut() const
{
  return this->GetStatistics().layersLeftOut;
}

void vtkPointFrontMapper::IgnoreLeftOut()
{
  this->Internals->LeftOutIgnored = true;
}

std::string vtkPointFrontMapper::GetLastLeftOut()
{
  vtkPointFrontStore* const store = this->GetStore();
  return store
    ? pointfront::leftOutOf(store->GetStore()->description(), this->GetLastLayersLeftOut())
    : std::string();
}

vtkIdType vtkPointFrontMapper::GetLastClassPointsDrawn(int objectClass)
{
  vtkPointFrontStore* const store = this->GetStore();
  const std::vector<std::uint64_t>& points = this->GetLastLayerPoints();
  vtkIdType drawn = 0;
  for (int i = 0; store && i < store->GetNumberOfObjectClasses(); ++i)
  {
    const auto layer = static_cast<std::size_t>(i);
    drawn += store->GetObjectClassNumber(i) == objectClass && layer < points.size()
      ? static_cast<vtkIdType>(points[layer])
      : 0;
  }
  return drawn;
}

void vtkPointFrontMapper::ClearClassLimits()
{
  if (!this->Internals->Limits.empty())
  {
    this->Internals->Limits.clear();
    this->Modified();
  }
}

vtkPointFrontStore* vtkPointFrontMapper::GetStore()
{
  Content& content = *this->Internals;
  vtkPolyData* input = this->GetNumberOfInputConnections(0) > 0 ? this->GetInput() : nullptr;
  const std::string name = vtkPointFrontStore::GetStoreName(input);
  const vtkMTimeType inputTime = input ? input->GetMTime() : 0;
  if (name == content.StoreName && (inputTime == content.InputTime || name.empty()))
  {
    return content.Views.store();
  }
  content.StoreName = name;
  content.InputTime = inputTime;
  vtkStdString reason;
  auto store = name.empty() ? nullptr : vtkPointFrontStore::Open(name.c_str(), reason);
  if (!store && !name.empty())
  {
    vtkErrorMacro(<< reason);
  }
  content.Views.setStore(store);
  content.MissingTold = false;
  content.Statistics = pointfront::FrameStatistics(); // no frame yet
  content.Statistics.complete = !store; // no frame shows more
  return content.Views.store();
}

double* vtkPointFrontMapper::GetBounds()
{
  this->Superclass::GetBounds(); // brings the input, and with it the store's name, up to date
  if (vtkPointFrontStore* store = this->GetStore())
  {
    store->GetBounds(this->Bounds);
  }
  return this->Bounds;
}

bool vtkPointFrontMapper::IsInteracting(vtkRenderer* renderer)
{
  return pointfront::isInteracting(renderer);
}

bool vtkPointFrontMapper::HasTranslucentPolygonalGeometry()
{
  vtkPointFrontStore* store = this->GetStore();
  vtkScalarsToColors* table = this->GetLookupTable();
  if (!store || !table || this->GetStyleSheet() || // a style has the say, whatever the table is
    !this->Internals->Style.colouringOf(*this, store->GetStore()).usesTable())
  {
    return false;
  }
  table->Build();
  return table->IsOpaque() == 0;
}

void vtkPointFrontMapper::SetStyleSheet(std::shared_ptr<const pointfront::StyleSheet> sheet)
{
  if (sheet != this->Internals->Sheet)
  {
    this->Internals->Sheet = std::move(sheet);
    this->Modified();
  }
}

std::shared_ptr<const pointfront::StyleSheet> vtkPointFrontMapper::GetStyleSheet() const
{
  const Content& content = *this->Internals;
  return content.VTKStyle ? content.VTKStyle->GetSharedStyleSheet() : content.Sheet;
}

void vtkPointFrontMapper::SetStyle(vtkPointFrontStyle* style)
{
  if (style != this->Internals->VTKStyle)
  {
    this->Internals->VTKStyle = style;
    this->Modified();
  }
}

bool vtkPointFrontMapper::SetQuality(const std::string& name)
{
  const pointfront::Result<pointfront::QualityChoice> choice = pointfront::chooseQuality(name);
  if (!choice)
  {
    vtkErrorMacro(<< choice.error().what);
    return false;
  }
  if (!this->GetStyle())
  {
    vtkNew<vtkPointFrontStyle> style;
    this->SetStyle(style);
  }
  this->SetTargetError(choice->preset.errorPx);
  return this->GetStyle()->SetQuality(name);
}

vtkPointFrontStyle* vtkPointFrontMapper::GetStyle() const
{
  return this->Internals->VTKStyle;
}

vtkMTimeType vtkPointFrontMapper::GetMTime()
{
  vtkPointFrontStyle* const style = this->GetStyle();
  return std::max(this->Superclass::GetMTime(), style ? style->GetMTime() : 0);
}

void vtkPointFrontMapper::ShallowCopy(vtkAbstractMapper* mapper)
{
  if (auto* const other = vtkPointFrontMapper::SafeDownCast(mapper))
  {
    this->SetTargetError(other->TargetError);
    this->SetPointBudget(other->PointBudget);
    this->SetGPUMemoryBudget(other->GPUMemoryBudget);
    this->SetDetailSelection(other->DetailSelection);
    this->SetOverviewPoints(other->OverviewPoints);
    this->SetPointSize(other->PointSize);
    this->SetBackend(other->Backend);
    this->SetComplete(other->Complete);
    this->SetTargetFrameTime(other->TargetFrameTime);
    this->SetGrowthTime(other->GrowthTime);
    this->SetUploadLimit(other->UploadLimit);
    this->SetStorePiece(other->StorePiece);
    this->SetNumberOfStorePieces(other->NumberOfStorePieces);
    this->SetStyle(other->GetStyle());
    this->SetStyleSheet(other->Internals->Sheet);
    this->Internals->Limits = other->Internals->Limits;
    this->Modified();
  }
  this->Superclass::ShallowCopy(mapper);
}

void vtkPointFrontMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "TargetError: " << this->TargetError << "\n";
  os << indent << "PointBudget: " << this->PointBudget << "\n";
  os << indent << "GPUMemoryBudget: " << this->GPUMemoryBudget << "\n";
  os << indent << "DetailSelection: " << this->DetailSelection << "\n";
  os << indent << "OverviewPoints: " << this->OverviewPoints << "\n";
  os << indent << "PointSize: " << this->PointSize << "\n";
  os << indent << "Backend: " << this->Backend << "\n";
  os << indent << "Complete: " << this->Complete << "\n";
  os << indent << "TargetFrameTime: " << this->TargetFrameTime << "\n";
  os << indent << "GrowthTime: " << this->GrowthTime << "\n";
  os << indent << "UploadLimit: " << this->UploadLimit << "\n";
  os << indent << "StorePiece: " << this->StorePiece << " of " << this->NumberOfStorePieces << "\n";
  const pointfront::FrameStatistics& last = this->GetStatistics();
  os << indent << "LastPointsDrawn: " << last.points << "\n";
  os << indent << "LastError: " << last.errorPx << "\n";
  os << indent << "LastComplete: " << last.complete << "\n";
  os << indent << "LastLimitedByPoints: " << last.limitedByPoints << "\n";
  os << indent << "LastLimitedByGPUMemory: " << last.limitedByGpuMemory << "\n";
  os << indent << "LastLimitedByMemory: " << last.limitedByMemory << "\n";
  os << indent << "LastLeftOut: " << this->GetLastLeftOut() << "\n";
  os << indent << "LastFailedNodes: " << last.failedNodes << "\n";
}
