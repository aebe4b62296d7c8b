#include "SoftwareScene.h"

#include "CancelSignal.h"
#include "Frustum.h"
#include "Ground.h"
#include "PeakMemory.h"
#include "PicturePixels.h"

#include "RasterBatch.h"

#include "pointfront/Residency/LoadScheduler.h"
#include "pointfront/Style/TechniqueNames.h"
#include "pointfront/Threads/ThreadCrew.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <tuple>
#include <unordered_map>

namespace pointfront
{

namespace
{
using Clock = std::chrono::steady_clock;

constexpr double frameMsInMotion = 1000.0 / 15; // that VTK allots to a moving view
constexpr std::uint64_t framePointBudget = 5000000; // as vtkPointFrontMapper's
/// How far a splat reaches beyond the rows that its centre lies in, where its size is no number of
/// pixels.
constexpr int splatReachRows = 64;

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
  if (Result<void> opened = scene->stores_.open(options.stores, options.style); !opened)
  {
    return opened.error();
  }
  scene->target_.keepDecided = scene->stores_.count() > 1;
  if (Result<void> shared = scene->shareMemory(); !shared)
  {
    return shared.error();
  }
  return scene;
}

/// Before anything is loaded.
Result<void> SoftwareScene::shareMemory()
{
  bool blends = false;
  std::set<std::tuple<int, bool, int>> parts; // that have targets of their own
  stores_.forEachStyle(
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
  const std::int64_t pixels = std::int64_t(options_.size[0]) * options_.size[1];
  const auto most = static_cast<std::size_t>(SoftwareRasteriser::keptPictures(pixels));
  // Keys of last pictures: each store has one of each part. One alone is that of a thread.
  const auto pictures = static_cast<std::size_t>(targets) * stores_.count();
  cost.pixelBytes += pictures > 1 ? std::min(most, pictures) * sizeof(RasterKey) : 0;
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

Result<double> SoftwareScene::ground() const
{
  return groundOf(*stores_.first().cloud());
}

void SoftwareScene::setCamera(const Camera& camera)
{
  camera_ = frameCameraOf(camera, stores_.bounds(), options_.size[0], options_.size[1]);
}

/// But for what each store adds of its own.
FrameRequest SoftwareScene::frameRequest(const View& view, bool complete) const
{
  FrameRequest request;
  request.method =
    options_.detail == "view" ? DetailMethod::ViewSpecific : DetailMethod::RenderingFront;
  request.view = view;
  request.targetErrorPx = options_.errorPx;
  const std::uint64_t unsaid = complete ? 0 : framePointBudget;
  request.pointBudget =
    options_.pointBudget > 0 ? static_cast<std::uint64_t>(options_.pointBudget) : unsaid;
  request.interacting = interactive_ && !complete;
  request.frameMs = options_.frameMs > 0.0 ? options_.frameMs : frameMsInMotion;
  request.complete = complete;
  // Where a signal is kept for later (renderInBands), waiting for points ends with it.
  request.aborted = [] { return CancelSignal::requested(); };
  return request;
}

/// Moves the fronts, and records their state before the frame is drawn.
FrameRecord SoftwareScene::updateFronts(const View& view, bool complete)
{
  ownMs_ = stores_.update(frameRequest(view, complete), camera_, shading_);
  FrameRecord frame = stores_.record();
  frame.frontMilliseconds = std::accumulate(ownMs_.begin(), ownMs_.end(), 0.0);
  // In motion the frame time limits the front: at rest the same view may show more.
  const bool limited = interactive_ && !complete && frame.errorPx > options_.errorPx;
  frame.complete = frame.complete && !limited;
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
  std::vector<std::uint64_t> points(stores_.count()), kept(stores_.count());
  double own = 0.0;
  GrowthMoment moment;
  moment.seconds = std::chrono::duration<double>(begin.time_since_epoch()).count();
  moment.duration = 1e-3 * options_.growthMs;
  for (std::size_t i = 0; i < stores_.count(); ++i)
  {
    const auto beginOfStore = Clock::now();
    const FramePlan plan = stores_[i].plan(camera_, shading_, moment);
    const RasterStatistics drawn =
      composition_.draw(rasteriser, plan, target_, static_cast<std::uint16_t>(i));
    *frame.rasteriseMilliseconds += drawn.milliseconds;
    kept[i] = drawn.keptVisible;
    points[i] = plan.pointCount();
    countClasses(plan.layerPoints(), stores_[i].cloud()->description(), frame);
    frame.complete = frame.complete && stores_[i].isGrown();
    frame.points += static_cast<std::int64_t>(points[i]);
    ownMs_[i] += millisecondsSince(beginOfStore);
    own += millisecondsSince(beginOfStore);
  }
  composition_.finish(camera_, shading_, target_);
  putBackground(options_.background, target_);
  // All stores share the rest of the time, or frames of a given time would be longer.
  const double shared = (millisecondsSince(begin) - own) / static_cast<double>(stores_.count());
  for (std::size_t i = 0; i < stores_.count(); ++i)
  {
    stores_[i].noteFrame(points[i], kept[i], ownMs_[i] + shared);
  }
}

Result<FrameRecord> SoftwareScene::render(bool complete)
{
  if (const Result<void> fits = memory_->checkFrame(); !fits)
  {
    return fits.error();
  }
  reads_.since();
  const auto begin = Clock::now();
  FrameRecord frame = updateFronts(viewOf(camera_), complete);
  drawPart(*rasteriser_, { 0, 0, camera_.width, camera_.height }, frame);
  frame.showsPoints = complete && showsPoints(target_);
  if (const Result<void> fine = stores_.outcome(); !fine)
  {
    return fine.error();
  }
  frame.milliseconds = millisecondsSince(begin);
  frame.threadReadBytes = reads_.since();
  return frame;
}

/// The nodes that bands have drawn, each node once: neighbours share many.
struct SoftwareScene::DrawnNodes
{
  std::vector<std::unordered_map<NodeIndex, std::uint32_t>> points; ///< by node, for each store
  std::vector<std::vector<std::uint64_t>> layerPoints; ///< likewise by layer

  explicit DrawnNodes(std::size_t stores)
    : points(stores)
    , layerPoints(stores)
  {
  }
  void add(std::size_t store, const Hierarchy& hierarchy, const FrontDelta& delta)
  {
    for (const DrawItem& item : delta.draw)
    {
      std::uint32_t& most = points[store][item.node];
      if (item.pointCount > most)
      {
        const std::size_t layer = hierarchy.node(item.node).layer;
        std::vector<std::uint64_t>& layers = layerPoints[store];
        layers.resize(std::max(layers.size(), layer + 1));
        layers[layer] += item.pointCount - most;
        most = item.pointCount;
      }
    }
  }
  void countIn(const DrawnStores& stores, FrameRecord& frame) const
  {
    frame.points = 0;
    frame.nodes = 0;
    frame.classPoints.clear();
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const std::vector<std::uint64_t>& layers = layerPoints[i];
      frame.nodes += static_cast<std::int64_t>(points[i].size());
      frame.points += std::accumulate(layers.begin(), layers.end(), std::int64_t(0));
      countClasses(layers, stores[i].cloud()->description(), frame);
    }
  }
};

Result<FrameRecord> SoftwareScene::renderInBands(const std::string& path)
{
  const CancelSignal finishing(CancelSignal::Mode::Finish);
  const auto begin = Clock::now();
  Result<std::unique_ptr<PNGWriter>> png = pngOf(path, options_.size);
  if (!png)
  {
    return png.error();
  }
  stores_.scheduler().setBudgetBytes(memory_->pointBytesOfBands());
  ThreadCrew crew(memory_->bandThreads());
  SoftwareRasteriser rasteriser(&crew);
  rasteriser_->release();
  FrameRecord whole;
  whole.complete = true;
  whole.rasteriseMilliseconds = 0.0;
  DrawnNodes drawn(stores_.count());
  reads_.since();
  for (int top = camera_.height; top > 0; top -= memory_->bandRows())
  {
    const int bottom = std::max(0, top - memory_->bandRows());
    const PixelRectangle rows{ 0, std::max(0, bottom - memory_->overlapRows()), camera_.width,
      std::min(camera_.height, top + memory_->overlapRows()) };
    const Result<FrameRecord> band = renderBand(rasteriser, rows, drawn);
    if (!band)
    {
      return band;
    }
    if (!band->complete && !CancelSignal::requested())
    {
      return makeError(Error::Kind::NoMemory,
        "there is no memory to load the points; close other programs, raise the limit, or ask for "
        "less (--memory, --size)");
    }
    whole.add(*band);
    Result<void> fine = appendRows(**png, target_, bottom - rows.bottom, top - rows.bottom);
    if (fine && CancelSignal::requested())
    {
      fine = makeError(Error::Kind::Cancelled, "stopped; nothing was written");
    }
    if (!fine)
    {
      return fine.error();
    }
  }
  if (Result<void> written = whole.showsPoints ? (*png)->finish() : noPointShown(); !written)
  {
    return written.error();
  }
  drawn.countIn(stores_, whole);
  whole.milliseconds = millisecondsSince(begin);
  whole.threadReadBytes = reads_.since();
  return whole;
}

Result<FrameRecord> SoftwareScene::renderBand(
  SoftwareRasteriser& rasteriser, const PixelRectangle& rows, DrawnNodes& drawn)
{
  // Points outside the rows may reach into them.
  const int reach = static_cast<int>(std::ceil(reachRows()));
  const int bottom = std::max(0, rows.bottom - reach);
  const int top = std::min(camera_.height, rows.top + reach);
  FrameRecord frame = updateFronts(viewOfRows(camera_, bottom, top), true);
  drawPart(rasteriser, rows, frame);
  frame.showsPoints = showsPoints(target_);
  rasteriser.release(); // it holds what it has drawn, and the next band needs the memory
  for (std::size_t i = 0; i < stores_.count(); ++i)
  {
    drawn.add(i, *stores_[i].cloud()->hierarchy(), stores_[i].last());
  }
  if (const Result<void> fine = stores_.outcome(); !fine)
  {
    return fine.error();
  }
  return frame;
}

double SoftwareScene::reachRows() const
{
  double reach = 0.0;
  stores_.forEachStyle(
    [&reach](const ResolvedStyle& style)
    {
      const bool pixels = style.size.mode == SplatSize::Mode::Pixels;
      reach = std::max<double>(reach, pixels ? 0.5 * style.size.value + 1.0 : splatReachRows);
    });
  return reach;
}

Result<std::optional<SoftwareScene::SeenPoint>> SoftwareScene::pick(
  const std::array<int, 2>& pixel, int reach)
{
  target_.keepPoints = true;
  const Result<FrameRecord> drawn = renderFrame();
  target_.keepPoints = false;
  const PictureValues<PixelPoint> points = std::move(target_.points);
  target_.points = {};
  if (!drawn)
  {
    return drawn.error();
  }
  std::optional<SeenPoint> nearest;
  int least = std::numeric_limits<int>::max();
  for (int y = std::max(0, pixel[1] - reach); y <= std::min(target_.height - 1, pixel[1] + reach);
       ++y)
  {
    for (int x = std::max(0, pixel[0] - reach); x <= std::min(target_.width - 1, pixel[0] + reach);
         ++x)
    {
      const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(target_.width) +
        static_cast<std::size_t>(x);
      const int dx = x - pixel[0];
      const int dy = y - pixel[1];
      const int distance = dx * dx + dy * dy;
      const PixelPoint& seen = points[at];
      if (seen.store != PixelPoint::nothing && distance <= reach * reach && distance < least)
      {
        const Hierarchy& hierarchy = *stores_[seen.store].cloud()->hierarchy();
        least = distance;
        nearest = SeenPoint{ seen.store, hierarchy.node(seen.node).firstPoint + seen.index };
      }
    }
  }
  return nearest;
}

Result<void> SoftwareScene::resize(std::array<int, 2> size)
{
  options_.size = size;
  return shareMemory();
}

std::uint64_t SoftwareScene::residentBytesMax() const
{
  return stores_.scheduler().statistics().residentBytesMax;
}

std::uint64_t SoftwareScene::pictureBytes() const
{
  return target_.height == options_.size[1] ? memory_->frameBytes() : memory_->bandBytes();
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
