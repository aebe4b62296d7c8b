#include "SoftwareScene.h"

#include "CancelSignal.h"
#include "Frustum.h"
#include "Ground.h"
#include "PeakMemory.h"
#include "PicturePixels.h"
#include "ShownClasses.h"

#include "RasterBatch.h"

#include "pointfront/Detail/DetailLevel.h"
#include "pointfront/Residency/LoadScheduler.h"
#include "pointfront/Style/ClassHeights.h"
#include "pointfront/Style/TechniqueNames.h"
#include "pointfront/Threads/ThreadCrew.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace pointfront
{

namespace
{
using Clock = std::chrono::steady_clock;

/// One store's arrivals are waited for that long before the others are looked at.
constexpr std::chrono::milliseconds lookAtOthers{ 20 };
constexpr int mostRounds = 64; // rounds in which the fronts of a complete picture move
constexpr double frameMsInMotion = 1000.0 / 15; // that VTK allots to a moving view
constexpr std::uint64_t framePointBudget = 5000000; // as vtkPointFrontMapper's
constexpr std::uint64_t overviewPoints = 2000000; // likewise

double millisecondsSince(Clock::time_point begin)
{
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

} // namespace

SoftwareScene::SoftwareScene(const DrawingOptions& options)
  : options_(options)
  , shading_(options.style.frameShading())
{
}

Result<std::unique_ptr<SoftwareScene>> SoftwareScene::open(const DrawingOptions& options)
{
  std::unique_ptr<SoftwareScene> scene(new SoftwareScene(options));
  if (options.measureEmptyScene)
  {
    scene->target_.reset(options.size[0], options.size[1]);
    scene->emptySceneBytes_ = residentBytesNow();
  }
  for (const auto step :
    { &SoftwareScene::openStores, &SoftwareScene::chooseStyles, &SoftwareScene::shareMemory })
  {
    if (Result<void> done = (scene.get()->*step)(); !done)
    {
      return done.error();
    }
  }
  return scene;
}

Result<void> SoftwareScene::openStores()
{
  for (const std::string& path : options_.stores)
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
  target_.keepDecided = stores_.size() > 1;
  return {};
}

Result<void> SoftwareScene::chooseStyles()
{
  std::vector<std::shared_ptr<const StoredCloud>> clouds;
  for (const auto& store : stores_)
  {
    clouds.push_back(store->cloud());
  }
  const AttributeRanges ranges(clouds);
  StyleSheet sheet = options_.style;
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

/// Before anything is loaded.
Result<void> SoftwareScene::shareMemory()
{
  bool blends = false;
  std::set<std::tuple<int, bool, int>> parts; // that have targets of their own
  forEachStyle(
    [&](const ResolvedStyle& style)
    {
      blends = blends || style.blended || style.technique == Technique::Ewa;
      parts.insert({ style.lens, style.lensMask, style.group });
    });
  const std::uint64_t targets = std::max<std::size_t>(1, parts.size());
  PictureCost cost;
  cost.pixelBytes = sizeof(std::uint32_t) + sizeof(float); // colour and depth
  cost.pixelBytes += shading_.anyLit() ? 3 * sizeof(float) : 0; // normals
  cost.pixelBytes += shading_.lookCount() > 1 ? sizeof(std::uint16_t) : 0;
  cost.pixelBytes += shading_.highlights.empty() ? 0 : 4; // who stands out, how far that is
  cost.pixelBytes += target_.keepDecided ? sizeof(float) : 0;
  cost.pixelBytes *= targets;
  cost.pixelBytes += shading_.anyEyeDome() ? sizeof(float) : 0; // logarithms of depth
  cost.pixelBytes += blends ? sizeof(float) : 0; // the nearest depth
  cost.pixelBytes += stores_.size() > 1 // keys of their last pictures
    ? SoftwareRasteriser::keptPictures * sizeof(RasterKey)
    : 0;
  cost.threadPixelBytes = sizeof(RasterKey) + (blends ? 4 * sizeof(std::uint32_t) : 0);
  cost.marginPixels = rasterMargin;
  cost.threads = ThreadCrew::ofProcess().threads();
  cost.overlapRows = shading_.reachPx();
  std::uint64_t& budget = options_.memoryBytes;
  budget = budget > 0 ? budget : LoadScheduler::processBudgetBytes(); // before it is shared below
  const Result<PictureMemory> memory = PictureMemory::share(options_.size, budget, cost);
  if (!memory)
  {
    return memory.error();
  }
  memory_ = *memory;
  const unsigned threads = memory_->frameThreads();
  if (!rasteriser_ || threads != (crew_ ? crew_->threads() : cost.threads))
  {
    rasteriser_.reset(); // first, as it works with the crew
    crew_ = threads == cost.threads ? nullptr : std::make_unique<ThreadCrew>(threads);
    rasteriser_ = std::make_unique<SoftwareRasteriser>(crew_.get());
  }
  LoadScheduler::setProcessBudgetBytes(memory_->pointBytesOfFrames());
  return {};
}

std::vector<std::string> SoftwareScene::warnings() const
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
  return all;
}

Result<double> SoftwareScene::ground() const
{
  return groundOf(*stores_.front()->cloud());
}

void SoftwareScene::setCamera(const Camera& camera)
{
  camera_ = frameCameraOf(camera, bounds_, options_.size[0], options_.size[1]);
}

/// But for what each store adds of its own.
FrameRequest SoftwareScene::demand(const View& view, bool complete) const
{
  FrameRequest demand;
  demand.method =
    options_.detail == "view" ? DetailMethod::ViewSpecific : DetailMethod::RenderingFront;
  demand.view = view;
  demand.targetErrorPx = options_.errorPx;
  const std::uint64_t unsaid = complete ? 0 : framePointBudget;
  demand.pointBudget =
    options_.pointBudget > 0 ? static_cast<std::uint64_t>(options_.pointBudget) : unsaid;
  demand.interacting = interactive_ && !complete;
  demand.frameMs = options_.frameMs > 0.0 ? options_.frameMs : frameMsInMotion;
  demand.complete = complete;
  // Where a signal is kept for later (renderInBands), waiting for points ends with it.
  demand.aborted = [] { return CancelSignal::requested(); };
  return demand;
}

/// Milliseconds that each store's front took are left in `ownMs_`.
void SoftwareScene::updateFronts(const View& view, bool complete)
{
  const FrameRequest common = demand(view, complete);
  ownMs_.assign(stores_.size(), 0.0);
  const auto wantsUpdate = [&]
  {
    return std::any_of(
      stores_.begin(), stores_.end(), [](const auto& store) { return store->wantsUpdate(); });
  };
  // Stores that share a budget come to one error within a few rounds.
  int rounds = 0;
  do
  {
    for (std::size_t i = 0; i < stores_.size(); ++i)
    {
      const auto begin = Clock::now();
      FrameRequest own = common;
      own.overviewPoints =
        overviewShare(overviewPoints, stores_[i]->cloud()->description().pointCount, allPoints_);
      stores_[i]->update(std::move(own), camera_, shading_);
      ownMs_[i] += millisecondsSince(begin);
    }
  } while (complete && ++rounds < mostRounds && wantsUpdate());
}

/// Records the state of the fronts before the frame is drawn.
FrameRecord SoftwareScene::record(bool complete) const
{
  FrameRecord frame;
  frame.complete = true;
  for (std::size_t i = 0; i < stores_.size(); ++i)
  {
    const FrontDelta& delta = stores_[i]->last();
    const ResidencyStatistics residency = stores_[i]->residency().statistics();
    frame.frontMilliseconds += ownMs_[i];
    frame.nodes += static_cast<std::int64_t>(delta.draw.size());
    frame.frontLength += delta.frontLength;
    frame.moves += delta.moves;
    frame.requests += static_cast<std::int64_t>(delta.requests.size());
    frame.thresholdPx = std::max(frame.thresholdPx, delta.thresholdPx);
    frame.errorPx = std::max(frame.errorPx, delta.errorPx);
    // In motion the frame time limits the front: at rest the same view may show more.
    const bool limited = interactive_ && !complete && delta.errorPx > options_.errorPx;
    frame.complete = frame.complete && delta.complete && !limited;
    frame.limitedByPoints = frame.limitedByPoints || delta.limitedByBudget;
    frame.limitedByMemory = frame.limitedByMemory || delta.limitedByMemory;
    frame.failedNodes += delta.failedNodes;
    frame.residentBytes += residency.residentBytes;
    frame.bytesRead += residency.bytesRead;
    frame.cancelled += residency.cancelled;
  }
  return frame;
}

/// A part of the viewport into the target, which becomes that part. Points drawn and the
/// milliseconds of it go into `frame`.
void SoftwareScene::drawPart(
  SoftwareRasteriser& rasteriser, const PixelRectangle& place, FrameRecord& frame)
{
  const auto begin = Clock::now();
  target_.reset(place);
  frame.rasteriseMilliseconds = 0.0;
  std::vector<std::uint64_t> points(stores_.size()), kept(stores_.size());
  double own = 0.0;
  GrowthMoment moment;
  moment.seconds = std::chrono::duration<double>(begin.time_since_epoch()).count();
  moment.duration = 1e-3 * options_.growthMs;
  for (std::size_t i = 0; i < stores_.size(); ++i)
  {
    const auto beginOfStore = Clock::now();
    const FramePlan plan = stores_[i]->plan(camera_, shading_, moment);
    const RasterStatistics drawn =
      composition_.draw(rasteriser, plan, target_, static_cast<std::uint16_t>(i));
    *frame.rasteriseMilliseconds += drawn.milliseconds;
    kept[i] = drawn.keptVisible;
    points[i] = plan.pointCount();
    countClasses(plan.layerPoints(), stores_[i]->cloud()->description(), frame);
    frame.complete = frame.complete && stores_[i]->isGrown();
    frame.points += static_cast<std::int64_t>(points[i]);
    ownMs_[i] += millisecondsSince(beginOfStore);
    own += millisecondsSince(beginOfStore);
  }
  composition_.finish(camera_, shading_, target_);
  putBackground(options_.background, target_);
  // All stores share the rest of the time, or frames of a given time would be longer.
  const double shared = (millisecondsSince(begin) - own) / static_cast<double>(stores_.size());
  for (std::size_t i = 0; i < stores_.size(); ++i)
  {
    stores_[i]->noteFrame(points[i], kept[i], ownMs_[i] + shared);
  }
}

Result<void> SoftwareScene::outcome()
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

Result<FrameRecord> SoftwareScene::render(bool complete)
{
  if (const Result<void> fits = memory_->checkFrame(); !fits)
  {
    return fits.error();
  }
  reads_.since();
  const auto begin = Clock::now();
  updateFronts(viewOf(camera_), complete);
  FrameRecord frame = record(complete);
  drawPart(*rasteriser_, { 0, 0, camera_.width, camera_.height }, frame);
  if (const Result<void> fine = outcome(); !fine)
  {
    return fine.error();
  }
  frame.milliseconds = millisecondsSince(begin);
  frame.threadReadBytes = reads_.since();
  return frame;
}

bool SoftwareScene::needsFrame()
{
  bool needed = false;
  for (const auto& store : stores_)
  {
    needed = store->needsFrame() || needed; // each is asked: it moves its front
  }
  return needed;
}

bool SoftwareScene::waitForArrival()
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

Result<void> SoftwareScene::resize(std::array<int, 2> size)
{
  options_.size = size;
  return shareMemory();
}

bool SoftwareScene::loads() const
{
  return std::any_of(
    stores_.begin(), stores_.end(), [](const auto& store) { return store->loads(); });
}

std::vector<std::string> SoftwareScene::attributesRead() const
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

std::uint64_t SoftwareScene::residentBytesMax() const
{
  return stores_.front()->residency().scheduler().statistics().residentBytesMax;
}

std::uint64_t SoftwareScene::pictureBytes() const
{
  return target_.height == options_.size[1] ? memory_->frameBytes() : memory_->bandBytes();
}

LoadingRecord SoftwareScene::loading() const
{
  const LoadSchedulerStatistics s = stores_.front()->residency().scheduler().statistics();
  return { s.fetchedBytes, s.decodedBytes, s.fetchSeconds, s.decodeSeconds, s.lastLoaded };
}

Result<void> SoftwareScene::writePicture(const std::string& path)
{
  Result<std::unique_ptr<PNGWriter>> png = pngOf(path, options_.size);
  if (!png)
  {
    return png.error();
  }
  Result<void> written = appendRows(**png, target_, 0, target_.height);
  return written ? (*png)->finish() : written;
}

} // namespace pointfront
