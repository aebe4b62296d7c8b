#include "MappedStores.h"

#include "Frustum.h"
#include "LightDoubt.h"
#include "MapperColour.h"
#include "MapperSheet.h"
#include "ShownClasses.h"

#include "pointfront/Residency/LoadScheduler.h"
#include "pointfront/Residency/Residency.h"
#include "pointfront/Style/StyleSheet.h"

#include "vtkPointFrontMapper.h"
#include "vtkPointFrontReader.h"
#include "vtkPointFrontStore.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>
#include <vtkWeakPointer.h>

#include <algorithm>
#include <set>
#include <utility>

namespace pointfront
{

namespace
{
constexpr int mostRounds = 64; // rounds of a complete render
}

/// One store with what draws it.
struct MappedStores::MappedStore
{
  ~MappedStore()
  {
    if (renderer)
    {
      renderer->RemoveActor(actor);
    }
  }

  vtkSmartPointer<vtkPointFrontStore> store;
  vtkNew<vtkPointFrontReader> reader;
  vtkNew<vtkPointFrontMapper> mapper;
  vtkNew<vtkActor> actor;
  vtkWeakPointer<vtkRenderer> renderer; ///< that draws it
};

MappedStores::MappedStores() = default;
MappedStores::~MappedStores() = default;

Result<std::unique_ptr<MappedStores::MappedStore>> MappedStores::openStore(
  const std::string& path, ErrorListener& errors)
{
  auto mapped = std::make_unique<MappedStore>();
  vtkStdString why;
  mapped->store = vtkPointFrontStore::Open(path.c_str(), why);
  if (!mapped->store)
  {
    return makeError(Error::Kind::BadFormat, why);
  }
  errors.observe(mapped->reader);
  errors.ignoreWarnings(mapped->reader); // they are those of warnings()
  errors.observe(mapped->mapper);
  mapped->mapper->IgnoreLeftOut(); // left_out and a warning of our own say it
  mapped->reader->SetFileName(path.c_str());
  mapped->reader->SetOverviewPoints(0); // the mapper alone draws
  mapped->mapper->SetInputConnection(mapped->reader->GetOutputPort());
  mapped->actor->SetMapper(mapped->mapper);
  return mapped;
}

Result<void> MappedStores::open(const DrawingOptions& options)
{
  if (options.memoryBytes > 0)
  {
    vtkPointFrontStore::SetProcessMemoryBudget(static_cast<vtkTypeInt64>(options.memoryBytes));
  }
  std::vector<std::unique_ptr<MappedStore>> stores;
  Bounds bounds;
  for (const std::string& path : options.stores)
  {
    Result<std::unique_ptr<MappedStore>> mapped = openStore(path, errors_);
    if (!mapped)
    {
      return mapped.error();
    }
    bounds.add((*mapped)->store->GetStore()->description().bounds);
    stores.push_back(std::move(*mapped));
  }
  stores_.swap(stores);
  std::swap(bounds_, bounds);
  const Result<void> hidden = hideOtherClasses(options);
  if (!hidden)
  {
    stores_.swap(stores);
    std::swap(bounds_, bounds);
  }
  return hidden;
}

bool MappedStores::growing() const
{
  return std::any_of(
    stores_.begin(), stores_.end(), [](const auto& mapped) { return mapped->store->IsPreview(); });
}

bool MappedStores::follow()
{
  bool other = false;
  for (const auto& mapped : stores_)
  {
    vtkPointFrontStore* const drawn =
      mapped->store->IsPreview() ? mapped->mapper->GetStore() : nullptr;
    if (drawn != nullptr && drawn != mapped->store)
    {
      mapped->store = drawn;
      other = true;
    }
  }
  if (other)
  {
    bounds_ = Bounds();
    for (const auto& mapped : stores_)
    {
      bounds_.add(mapped->store->GetStore()->description().bounds);
    }
  }
  return other;
}

Result<void> MappedStores::hideOtherClasses(const DrawingOptions& options)
{
  std::uint64_t points = 0;
  const bool all = options.classes.empty() && !hidden_;
  hidden_ = !options.classes.empty();
  for (std::size_t i = 0; i < stores_.size() && !all; ++i)
  {
    const StoreDescription& store = stores_[i]->store->GetStore()->description();
    if (!isLayered(store))
    {
      points += store.pointCount; // its points are filtered, by the sheet
      continue;
    }
    const Result<ShownClasses> shown = ShownClasses::choose(options.classes, store);
    if (!shown)
    {
      return shown.error();
    }
    for (std::size_t layer = 0; layer < store.layers.size(); ++layer)
    {
      stores_[i]->mapper->SetClassVisibility(
        store.layers[layer].objectClass, shown->layers[layer].visible);
    }
    points += shown->points;
  }
  return options.classes.empty() || points > 0 ? Result<void>() : noClassShown();
}

Result<void> MappedStores::show(const DrawingOptions& options, int backend, vtkRenderer* renderer)
{
  const std::vector<std::shared_ptr<const StoredCloud>> stores = clouds();
  if (options.style.wantsShares() &&
    std::none_of(stores.begin(), stores.end(),
      [](const auto& store) { return isLayered(store->description()); }))
  {
    return noClassTrees(stores.front()->description().path);
  }
  lightDoubt_ = doubtOfLight(options.style, stores);
  const std::string attribute = options.colourBy.empty()
    ? defaultColourAttribute(stores.front()->description())
    : options.colourBy;
  const Result<ColourChoice> colour = chooseColour(attribute, stores);
  if (!colour)
  {
    return colour.error();
  }
  if (Result<void> hidden = hideOtherClasses(options); !hidden)
  {
    return hidden;
  }
  const bool layered = std::all_of(stores.begin(), stores.end(),
    [](const auto& store) { return isLayered(store->description()); });
  const bool plain = isPlain(options) && (options.classes.empty() || layered);
  const auto sheet = plain ? nullptr : sheetOf(options, stores);
  for (const auto& mapped : stores_)
  {
    vtkPointFrontMapper* const mapper = mapped->mapper;
    mapper->SetBackend(backend);
    mapper->SetStyleSheet(sheet);
    mapper->SetPointSize(options.pointSizePx); // where there is no sheet
    applyColour(colour.value(), mapper);
    mapper->SetTargetError(options.errorPx);
    mapper->SetDetailSelection(options.detail == "view" ? vtkPointFrontMapper::VIEW_SPECIFIC
                                                        : vtkPointFrontMapper::RENDERING_FRONT);
    if (options.pointBudget > 0)
    {
      mapper->SetPointBudget(options.pointBudget);
    }
    mapper->SetGPUMemoryBudget(static_cast<vtkTypeInt64>(options.gpuBytes));
    mapper->SetTargetFrameTime(options.frameMs);
    mapper->SetGrowthTime(options.growthMs);
    mapped->actor->GetProperty()->LightingOff(); // colours are drawn as they are
    renderer->AddActor(mapped->actor);
    mapped->renderer = renderer;
  }
  return {};
}

std::vector<std::shared_ptr<const StoredCloud>> MappedStores::clouds() const
{
  std::vector<std::shared_ptr<const StoredCloud>> clouds;
  for (const auto& mapped : stores_)
  {
    clouds.push_back(mapped->store->GetStore());
  }
  return clouds;
}

std::shared_ptr<const StoredCloud> MappedStores::cloudOf(const vtkProp* prop) const
{
  const auto found = std::find_if(stores_.begin(), stores_.end(),
    [prop](const auto& mapped) { return mapped->actor.Get() == prop; });
  vtkPointFrontStore* const drawn = found == stores_.end() ? nullptr : (*found)->mapper->GetStore();
  return drawn ? drawn->GetStore() : nullptr;
}

std::vector<std::string> MappedStores::warnings() const
{
  std::vector<std::string> all;
  for (const auto& mapped : stores_)
  {
    const StoreDescription& description = mapped->store->GetStore()->description();
    for (const std::string& warning : description.warnings)
    {
      all.push_back(description.path + ": " + warning);
    }
  }
  if (!lightDoubt_.empty())
  {
    all.push_back(lightDoubt_);
  }
  return all;
}

void MappedStores::aim(const Camera& camera, vtkCamera* target) const
{
  target->SetPosition(camera.position.x, camera.position.y, camera.position.z);
  target->SetFocalPoint(camera.focalPoint.x, camera.focalPoint.y, camera.focalPoint.z);
  target->SetViewUp(camera.viewUp.x, camera.viewUp.y, camera.viewUp.z);
  target->SetViewAngle(camera.viewAngleDegrees);
  target->SetParallelProjection(camera.parallelScale ? 1 : 0);
  target->SetParallelScale(camera.parallelScale.value_or(1.0));
  target->SetClippingRange(clippingRange(camera, bounds_).data());
}

void MappedStores::setPointBudget(std::int64_t points)
{
  for (const auto& mapped : stores_)
  {
    mapped->mapper->SetPointBudget(points);
  }
}

void MappedStores::draw(vtkRenderWindow* window, bool complete)
{
  for (const auto& mapped : stores_)
  {
    mapped->mapper->SetComplete(complete);
  }
  // Stores that share a budget come to one error within a few rounds.
  int rounds = 0;
  do
  {
    window->Render();
  } while (complete && ++rounds < mostRounds && needsRender());
  window->WaitForCompletion();
}

FrameRecord MappedStores::record() const
{
  FrameRecord frame;
  frame.complete = true;
  frame.technique = stores_.empty() ? "" : stores_.front()->mapper->GetLastTechnique();
  for (const auto& mapped : stores_)
  {
    vtkPointFrontMapper* const mapper = mapped->mapper;
    const bool alike = frame.technique == mapper->GetLastTechnique();
    frame.technique = alike ? frame.technique : std::string();
    const ResidencyStatistics residency = mapped->store->GetResidency().statistics();
    frame.frontMilliseconds += mapper->GetLastFrontTime();
    frame.points += mapper->GetLastPointsDrawn();
    countClasses(mapper->GetLastLayerPoints(), mapped->store->GetStore()->description(), frame);
    noteLeftOut(mapper->GetLastLayersLeftOut(), mapped->store->GetStore()->description(), frame);
    frame.nodes += mapper->GetLastNodesDrawn();
    frame.frontLength += mapper->GetLastFrontLength();
    frame.moves += mapper->GetLastMoves();
    frame.requests += mapper->GetLastRequests();
    frame.thresholdPx = std::max(frame.thresholdPx, mapper->GetLastThreshold());
    frame.errorPx = std::max(frame.errorPx, mapper->GetLastError());
    frame.complete = frame.complete && mapper->GetLastComplete();
    frame.limitedByPoints = frame.limitedByPoints || mapper->GetLastLimitedByPoints();
    frame.limitedByGpu = frame.limitedByGpu || mapper->GetLastLimitedByGPUMemory();
    frame.limitedByMemory = frame.limitedByMemory || mapper->GetLastLimitedByMemory();
    frame.failedNodes += mapper->GetLastFailedNodes();
    frame.gpuBytes = std::max<std::int64_t>(frame.gpuBytes, mapper->GetLastWindowGPUBytes());
    frame.residentBytes += residency.residentBytes;
    frame.bytesRead += residency.bytesRead;
    frame.cancelled += residency.cancelled;
  }
  return frame;
}

bool MappedStores::needsRender() const
{
  return std::any_of(stores_.begin(), stores_.end(),
    [](const auto& mapped) { return mapped->mapper->NeedsRender(); });
}

const Residency* MappedStores::loading() const
{
  const auto found = std::find_if(stores_.begin(), stores_.end(),
    [](const auto& mapped)
    {
      const ResidencyStatistics now = mapped->store->GetResidency().statistics();
      return now.loading > 0 || (now.pending > 0 && !mapped->store->GetResidency().exhausted());
    });
  return found == stores_.end() ? nullptr : &(*found)->store->GetResidency();
}

bool MappedStores::lacksPoints() const
{
  return std::any_of(stores_.begin(), stores_.end(),
    [](const auto& mapped)
    {
      return mapped->store->GetResidency().statistics().failed > 0 ||
        mapped->store->GetStore()->hierarchy()->fault();
    });
}

std::vector<std::string> MappedStores::attributesRead() const
{
  std::set<std::string> names;
  for (const auto& mapped : stores_)
  {
    const AttributeSchema& schema = mapped->store->GetStore()->description().schema;
    for (const std::uint32_t column : mapped->store->GetResidency().columns())
    {
      names.insert(schema[column].name);
    }
  }
  return { names.begin(), names.end() };
}

const LoadScheduler& MappedStores::scheduler() const
{
  return stores_.front()->store->GetResidency().scheduler();
}

} // namespace pointfront
