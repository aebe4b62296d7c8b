#include "DrawnStores.h"

#include "LightDoubt.h"
#include "ShownClasses.h"

#include "pointfront/Detail/DetailLevel.h"
#include "pointfront/Quality/QualityCurve.h"
#include "pointfront/Residency/LoadScheduler.h"
#include "pointfront/Style/ClassHeights.h"

#include <chrono>
#include <set>
#include <utility>

namespace pointfront
{

namespace
{
using Clock = std::chrono::steady_clock;

/// One store's arrivals are waited for that long before the others are looked at.
constexpr std::chrono::milliseconds lookAtOthers{ 20 };
constexpr int mostRounds = 64; // rounds in which the fronts of a complete picture move
constexpr std::uint64_t overviewPoints = 2000000; // as vtkPointFrontMapper's
} // namespace

Result<void> DrawnStores::open(const std::vector<std::string>& paths, StyleSheet sheet)
{
  for (const std::string& path : paths)
  {
    Result<std::unique_ptr<DrawnStore>> store = DrawnStore::open(path);
    if (!store)
    {
      return store.error();
    }
    bounds_.add(store.value()->cloud()->description().bounds);
    allPoints_ += store.value()->cloud()->description().pointCount;
    stores_.push_back(std::move(store).value());
  }
  return resolve(std::move(sheet));
}

Result<void> DrawnStores::resolve(StyleSheet sheet)
{
  std::vector<std::shared_ptr<const StoredCloud>> clouds;
  for (const auto& store : stores_)
  {
    clouds.push_back(store->cloud());
  }
  lightDoubt_ = doubtOfLight(sheet, clouds);
  const AttributeRanges ranges(clouds);
  if (!sheet.standard.colour) // the first store decides for all
  {
    sheet.standard.colour =
      ColourSource::ofAttribute(defaultColourAttribute(clouds.front()->description()));
  }
  if (sheet.wantsShares() &&
    std::none_of(clouds.begin(), clouds.end(),
      [](const auto& cloud) { return isLayered(cloud->description()); }))
  {
    return noClassTrees(clouds.front()->description().path);
  }
  const auto window = std::make_shared<const WindowDemand>();
  std::uint64_t shown = 0;
  for (const auto& store : stores_)
  {
    const StoreDescription& description = store->cloud()->description();
    StoreSurroundings surroundings;
    surroundings.ranges = &ranges;
    if (sheet.wantsHeights(description))
    {
      surroundings.heights = std::make_shared<const ClassHeights>(store->cloud());
    }
    Result<std::vector<LayerStyling>> layers = sheet.resolveAll(description, surroundings);
    if (!layers)
    {
      return layers.error();
    }
    if (const Result<void> set = store->setStyles(std::move(layers).value()); !set)
    {
      return set;
    }
    store->enterWindow(window);
    shown += store->pointsShown();
  }
  if (sheet.shownClasses && shown == 0)
  {
    return noClassShown();
  }
  return {};
}

std::vector<std::string> DrawnStores::warnings() const
{
  std::vector<std::string> all;
  for (const auto& store : stores_)
  {
    const StoreDescription& description = store->cloud()->description();
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

std::vector<double> DrawnStores::update(
  const FrameRequest& common, const FrameCamera& camera, const FrameShading& shading)
{
  std::vector<double> milliseconds(stores_.size(), 0.0);
  const auto wantsUpdate = [&]
  {
    return std::any_of(
      stores_.begin(), stores_.end(), [](const auto& store) { return store->wantsUpdate(); });
  };
  int rounds = 0;
  do
  {
    for (std::size_t i = 0; i < stores_.size(); ++i)
    {
      const auto begin = Clock::now();
      FrameRequest own = common;
      own.overviewPoints =
        overviewShare(overviewPoints, stores_[i]->cloud()->description().pointCount, allPoints_);
      stores_[i]->update(std::move(own), camera, shading);
      milliseconds[i] += std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    }
  } while (common.complete && ++rounds < mostRounds && wantsUpdate());
  return milliseconds;
}

FrameRecord DrawnStores::record() const
{
  FrameRecord frame;
  frame.complete = true;
  for (const auto& store : stores_)
  {
    const FrontDelta& delta = store->last();
    const ResidencyStatistics residency = store->residency().statistics();
    noteLeftOut(delta.layersLeftOut, store->cloud()->description(), frame);
    frame.nodes += static_cast<std::int64_t>(delta.draw.size());
    frame.frontLength += delta.frontLength;
    frame.moves += delta.moves;
    frame.requests += static_cast<std::int64_t>(delta.requests.size());
    frame.thresholdPx = std::max(frame.thresholdPx, delta.thresholdPx);
    frame.errorPx = std::max(frame.errorPx, delta.errorPx);
    frame.complete = frame.complete && delta.complete;
    frame.limitedByPoints = frame.limitedByPoints || delta.limitedByBudget;
    frame.limitedByMemory = frame.limitedByMemory || delta.limitedByMemory;
    frame.failedNodes += delta.failedNodes;
    frame.residentBytes += residency.residentBytes;
    frame.bytesRead += residency.bytesRead;
    frame.cancelled += residency.cancelled;
  }
  MeasuredTechnique technique;
  forEachStyle([&technique](const ResolvedStyle& style) { technique.add(style); });
  frame.technique = technique.name();
  return frame;
}

Result<void> DrawnStores::outcome()
{
  for (const auto& store : stores_)
  {
    if (Result<void> fine = store->outcome(); !fine)
    {
      return fine;
    }
  }
  return {};
}

bool DrawnStores::needsFrame()
{
  bool needed = false;
  for (const auto& store : stores_)
  {
    needed = store->needsFrame() || needed; // each is asked: it moves its front
  }
  return needed;
}

bool DrawnStores::waitForArrival()
{
  while (!needsFrame())
  {
    const auto loading = std::find_if(
      stores_.begin(), stores_.end(), [](const auto& store) { return store->loads(); });
    if (loading == stores_.end())
    {
      return false;
    }
    const Residency& residency = (*loading)->residency();
    residency.waitForArrival(residency.arrivals(), lookAtOthers);
  }
  return true;
}

bool DrawnStores::loads() const
{
  return std::any_of(
    stores_.begin(), stores_.end(), [](const auto& store) { return store->loads(); });
}

std::vector<std::string> DrawnStores::attributesRead() const
{
  std::set<std::string> names;
  for (const auto& store : stores_)
  {
    for (const std::uint32_t column : store->residency().columns())
    {
      names.insert(store->cloud()->description().schema[column].name);
    }
  }
  return { names.begin(), names.end() };
}

LoadingRecord DrawnStores::loading() const
{
  const LoadSchedulerStatistics s = scheduler().statistics();
  return { s.fetchedBytes, s.decodedBytes, s.fetchSeconds, s.decodeSeconds, s.lastLoaded };
}

} // namespace pointfront
