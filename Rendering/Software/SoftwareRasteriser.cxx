#include "SoftwareRasteriser.h"

#include "LastPictures.h"
#include "RasterBuffers.h"
#include "RasterItems.h"
#include "RasterKernels.h"
#include "RasterPasses.h"
#include "RasterPieces.h"
#include "ShownRectangle.h"

#include "pointfront/Threads/ThreadCrew.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace pointfront
{
namespace
{

/// Pixels and viewports whose keys stay from frame to frame.
constexpr std::int64_t keptPixels = std::int64_t(8) << 20;
constexpr std::int64_t fewestKept = 4;
constexpr std::int64_t mostKept = 64;
/// Buffers of a picture take that much at most, over all threads: a larger one is drawn in bands.
constexpr std::int64_t mostBytes = std::int64_t(768) << 20;
constexpr int leastRows = 64;

RasterWindow windowOf(const PixelRectangle& place)
{
  RasterWindow window;
  window.left = place.left;
  window.width = place.width();
  window.bottom = place.bottom;
  window.height = place.height();
  window.stride = (window.width + 2 * rasterMargin + 15) & ~15;
  return window;
}

} // namespace

struct SoftwareRasteriser::Content
{
  /// One call of draw().
  struct Drawing
  {
    RasterPasses::Destination destination;
    LastPicture& picture;
    bool known = false; ///< all that is wanted of the part is in the target
    bool fits = false; ///< the target is made as large as what is shown
    std::uint64_t reused = 0;
    std::uint64_t drawn = 0; ///< points that the last picture did not have
    std::uint64_t blended = 0;
  };

  explicit Content(ThreadCrew& threads)
    : passes(threads)
  {
  }

  RasterPasses passes;
  LastPictures last;
  /// Last pictures of stand-ins, by part and store, for each level: a point that is no longer seen
  /// hides nothing coarser.
  std::map<std::uint32_t, std::map<std::uint8_t, LastPicture>> lastStandIns;

  RasterStatistics draw(const FramePlan& asked, SoftwareTarget& target, std::uint16_t store,
    const RasterPart& part, bool fits);
  void drawRound(const RasterItems& items, Drawing& drawing);
  void drawAtOnce(const RasterItems& items, RasterWindow window, Drawing& drawing);
  std::uint64_t drawStandIns(const FramePlan& plan, std::uint32_t picture, const Drawing& seen);
  void keep(const RasterItems& items, const RasterWindow& window, Drawing& drawing,
    RasterPasses::Lasting lasting);
};

SoftwareRasteriser::SoftwareRasteriser(ThreadCrew* crew)
  : content_(std::make_unique<Content>(crew ? *crew : ThreadCrew::ofProcess()))
{
}

SoftwareRasteriser::~SoftwareRasteriser() = default;

int SoftwareRasteriser::keptPictures(std::int64_t viewportPixels)
{
  const std::int64_t most = keptPixels / std::max<std::int64_t>(viewportPixels, 1);
  return static_cast<int>(std::clamp(most, fewestKept, mostKept));
}

/// The next picture of the store goes on from this one; where the memory that it may take is taken,
/// from who was visible in it only. `lasting`: where these are not the first thread's keys.
void SoftwareRasteriser::Content::keep(const RasterItems& items, const RasterWindow& window,
  Drawing& drawing, RasterPasses::Lasting lasting)
{
  const FrameCamera& camera = items.plan().camera;
  const RasterWindow viewport = windowOf({ 0, 0, camera.width, camera.height });
  const bool standIns = drawing.destination.standIns;
  std::int64_t pixels = window.pixels() + (standIns ? 0 : last.keyPixels());
  for (const auto& [store, levels] : lastStandIns)
  {
    for (const auto& [level, other] : levels)
    {
      pixels += standIns ? other.keyPixels() : 0;
    }
  }
  const std::int64_t kept = keptPictures(std::int64_t(camera.width) * camera.height);
  if (pixels <= (standIns ? kept + kept / 2 : kept) * viewport.pixels())
  {
    drawing.picture.keep(items, window,
      std::move(lasting.keys.data() ? lasting.keys : passes.buffers[0].keys),
      passes.takeSums(lasting));
  }
  else
  {
    drawing.picture.keepVisible(items, window, passes.buffers[0].keys.data(), passes.crew);
  }
}

/// All that the plan shows, in one window.
void SoftwareRasteriser::Content::drawAtOnce(
  const RasterItems& items, RasterWindow window, Drawing& drawing)
{
  LastPicture& picture = drawing.picture;
  const FrameCamera& camera = items.plan().camera;
  const PixelRectangle most = drawing.fits ? PixelRectangle{ 0, 0, camera.width, camera.height }
                                           : drawing.destination.target.rectangle();
  const LastPicture::Pieces pieces =
    picture.begin(items, window, passes.crew, drawing.known ? most : PixelRectangle());
  drawing.reused += pieces.reused;
  drawing.drawn += pieces.drawn;
  if (drawing.fits)
  {
    drawing.destination.target.reset(window.rectangle());
  }
  RasterBuffer<RasterKey> spare;
  if (picture.hasKeys())
  {
    spare = std::exchange(passes.buffers[0].keys, picture.takeKeys());
  }
  RasterPasses::Lasting lasting = passes.drawPoints(items, window, pieces, picture.takeSums());
  drawing.blended += lasting.blended;
  passes.resolve(items, window, drawing.destination);
  if (drawing.known)
  {
    keep(items, window, drawing, std::move(lasting));
  }
  else
  {
    picture.forget();
  }
  if (!passes.buffers[0].keys.data())
  {
    passes.buffers[0].keys = std::move(spare);
  }
}

/// As many of the plan's points as 32 bits can count: all, but for the largest plans.
void SoftwareRasteriser::Content::drawRound(const RasterItems& items, Drawing& drawing)
{
  const FramePlan& plan = items.plan();
  const PixelRectangle viewport{ 0, 0, plan.camera.width, plan.camera.height };
  const bool only = items.first() && items.last();
  if (plan.exchange)
  {
    drawAtOnce(items, windowOf(viewport), drawing); // every process has all of the same pixels
    return;
  }
  const PixelRectangle most = drawing.fits ? viewport : drawing.destination.target.rectangle();
  PixelRectangle place = shownRectangle(items);
  place = !drawing.fits ? common(place, most) : only ? withHoles(place, plan) : viewport;
  // New points make the place larger, and a larger one would be begun anew.
  place = plan.refining && !place.empty() ? common(viewport, most) : place;
  const std::int64_t pixelBytes =
    std::int64_t(passes.crew.threads()) * (items.blended() ? 24 : 8) + 4;
  const std::int64_t rowBytes = pixelBytes * windowOf(place).stride;
  const auto rows =
    static_cast<int>(std::max<std::int64_t>(mostBytes / rowBytes - 2 * rasterMargin, leastRows));
  if (only && !place.empty() && rows >= place.height())
  {
    drawAtOnce(items, windowOf(place), drawing);
    return;
  }
  for (const RasterItem& item : items.items())
  {
    // No pixel is wanted of a cloud beside the view.
    const std::uint32_t points = item.passes.walls() ? 0 : item.item->last - item.item->first;
    (place.empty() ? drawing.reused : drawing.drawn) += points;
  }
  drawing.picture.forget();
  if (drawing.fits && items.first())
  {
    drawing.destination.target.reset(place);
  }
  for (int bottom = place.bottom; bottom < place.top && !place.empty(); bottom += rows)
  {
    const RasterWindow window =
      windowOf({ place.left, bottom, place.right, std::min(bottom + rows, place.top) });
    passes.drawPoints(items, window, { false, {}, piecesOf(items), {} }, {});
    passes.resolve(items, window, drawing.destination);
  }
}

/// Behind what is drawn already, level by level, and opaque, as on OpenGL: the screen is passed
/// over once for each. Returns the number of points that are new.
std::uint64_t SoftwareRasteriser::Content::drawStandIns(
  const FramePlan& plan, std::uint32_t picture, const Drawing& seen)
{
  std::map<std::uint8_t, LastPicture>& levels = lastStandIns[picture];
  std::set<std::uint8_t> present;
  std::uint64_t drawn = 0;
  auto batch = plan.standIns.begin();
  while (batch != plan.standIns.end())
  {
    const std::uint8_t level = batch->level;
    FramePlan standIns;
    static_cast<FrameSetting&>(standIns) = plan;
    for (; batch != plan.standIns.end() && batch->level == level; ++batch)
    {
      standIns.batches.push_back(*batch);
    }
    const RasterItems items(standIns, 0, true);
    if (!items.last())
    {
      continue; // more than 32 bits can count: the picture has holes until it is complete
    }
    Drawing drawing{ seen.destination, levels[level], seen.known };
    drawing.destination.standIns = true;
    drawRound(items, drawing);
    drawn += drawing.drawn;
    present.insert(level);
  }
  for (auto each = levels.begin(); each != levels.end();)
  {
    each = present.count(each->first) ? std::next(each) : levels.erase(each);
  }
  return drawn;
}

RasterStatistics SoftwareRasteriser::Content::draw(const FramePlan& asked, SoftwareTarget& target,
  std::uint16_t store, const RasterPart& part, bool fits)
{
  const auto begin = std::chrono::steady_clock::now();
  passes.buffers.resize(passes.crew.threads());
  const PixelRectangle viewport{ 0, 0, asked.camera.width, asked.camera.height };
  const std::uint32_t picture = std::uint32_t(part.number) << 16 | store;
  const bool whole = fits || target.rectangle().contains(viewport);
  Drawing drawing{ { target, store }, last.of(store, part.number), whole || part.complete, fits };
  for (auto each = lastStandIns.begin(); each != lastStandIns.end();)
  {
    each = last.has(each->first) ? std::next(each) : lastStandIns.erase(each);
  }
  const bool keeps = asked.keepsVisible && !asked.exchange && drawing.known && !target.keepPoints;
  if (asked.batches.empty() && asked.standIns.empty() && keeps)
  {
    fits ? target.reset(PixelRectangle()) : void();
    return {}; // other stores have the whole budget for a frame: the next one goes on
  }
  const VisiblePoints& visible = drawing.picture.visibleFor(asked, keeps, passes.crew);
  RasterStatistics statistics;
  statistics.points = asked.pointCount();
  statistics.keptVisible = visible.count();
  FramePlan extended;
  if (!visible.empty())
  {
    extended = asked;
    visible.addTo(extended);
  }
  const FramePlan& plan = visible.empty() ? asked : extended;
  std::size_t from = 0;
  bool done = false;
  while (!done) // once, unless the points are more than 32 bits can count
  {
    const RasterItems items(plan, from);
    drawRound(items, drawing);
    from = items.end();
    done = items.last();
  }
  statistics.reused = drawing.reused;
  statistics.blended = drawing.blended;
  statistics.standIns = drawStandIns(asked, picture, drawing);
  statistics.drawn = drawing.drawn + statistics.standIns;
  statistics.milliseconds =
    std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  return statistics;
}

PixelRectangle shownRectangle(const FramePlan& plan)
{
  const PixelRectangle viewport{ 0, 0, plan.camera.width, plan.camera.height };
  const RasterItems items(plan, 0);
  return items.last() ? withHoles(shownRectangle(items), plan) : viewport;
}

RasterStatistics SoftwareRasteriser::draw(
  const FramePlan& plan, SoftwareTarget& target, std::uint16_t store, const RasterPart& part)
{
  return content_->draw(plan, target, store, part, false);
}

RasterStatistics SoftwareRasteriser::drawShown(
  const FramePlan& plan, SoftwareTarget& target, std::uint16_t store)
{
  return content_->draw(plan, target, store, {}, true);
}

void SoftwareRasteriser::release()
{
  auto fresh = std::make_unique<Content>(content_->passes.crew);
  fresh->passes.loops = content_->passes.loops;
  content_ = std::move(fresh);
}

const char* SoftwareRasteriser::instructionSet() const
{
  return content_->passes.loops->instructionSet;
}

bool SoftwareRasteriser::setInstructionSet(const char* name)
{
  const RasterKernels* const found = rasterKernelsOf(name);
  content_->passes.loops = found ? found : content_->passes.loops;
  return found != nullptr;
}

} // namespace pointfront
