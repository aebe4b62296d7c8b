#include "SoftwareRasteriser.h"

#include "LastPictures.h"
#include "PointShapes.h"
#include "RasterBuffers.h"
#include "RasterItems.h"
#include "RasterKernels.h"
#include "RasterPieces.h"
#include "SharedSums.h"
#include "ShownRectangle.h"
#include "WinnerResolve.h"

#include "pointfront/Threads/ThreadCrew.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

namespace pointfront
{
namespace
{

constexpr int rowsOfPiece = 8;
/// Keys that stay until the next picture of their store, of all stores.
constexpr std::int64_t mostKeptPictures = SoftwareRasteriser::keptPictures;
/// Buffers of a picture take that much at most, over all threads: a larger one is drawn in bands.
constexpr std::int64_t mostBytes = std::int64_t(768) << 20;
constexpr int leastRows = 64;

float depthBits(RasterKey key)
{
  const auto bits = static_cast<std::uint32_t>(static_cast<std::uint64_t>(key) >> 32);
  float depth;
  std::memcpy(&depth, &bits, 4);
  return depth;
}

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
    SoftwareTarget& target;
    LastPicture& picture;
    std::uint16_t store = 0;
    bool whole = false; ///< all of the viewport is wanted
    bool known = false; ///< all that is wanted of the part is in the target
    bool fits = false; ///< the target is made as large as what is shown
    std::uint64_t reused = 0;
  };

  explicit Content(ThreadCrew& threads)
    : crew(threads)
  {
  }

  ThreadCrew& crew;
  const RasterKernels* loops = &rasterKernels();
  std::vector<ThreadBuffers> buffers;
  RasterBuffer<float> nearest;
  LastPictures last;

  RasterStatistics draw(const FramePlan& asked, SoftwareTarget& target, std::uint16_t store,
    const RasterPart& part, bool fits);
  void drawRound(const RasterItems& items, Drawing& drawing);
  void drawAtOnce(const RasterItems& items, RasterWindow window, Drawing& drawing);
  void keep(const RasterItems& items, const RasterWindow& window, LastPicture& picture);
  void drawKeys(const RasterItems& items, const RasterWindow& now,
    const std::vector<RasterPiece>& pieces, bool goingOn);
  void mergeKeys(const RasterWindow& now, float* depths);
  void addColours(
    const RasterItems& items, const RasterWindow& now, const std::vector<RasterPiece>& pieces);
  void drawPoints(const RasterItems& items, const RasterWindow& now,
    const std::vector<RasterPiece>& pieces, bool goingOn);
  void resolve(
    const RasterItems& items, const RasterWindow& now, std::uint16_t store, SoftwareTarget& target);
};

/// First pass. The first thread's keys may hold the last picture's.
void SoftwareRasteriser::Content::drawKeys(const RasterItems& items, const RasterWindow& now,
  const std::vector<RasterPiece>& pieces, bool goingOn)
{
  const RasterKernels& kernels = *loops;
  const PointShapes shapes(items, kernels);
  for (std::size_t thread = 0; thread < buffers.size(); ++thread)
  {
    buffers[thread].keysDrawn = thread == 0 && goingOn;
  }
  const auto drawInto = [&](ThreadBuffers& mine) -> RasterKey*
  {
    RasterKey* const keys = mine.keys.ofSize(now.pixels());
    if (!mine.keysDrawn)
    {
      std::fill(keys, keys + now.pixels(), emptyKey);
      mine.keysDrawn = true;
    }
    return keys;
  };
  crew.run(pieces.size(),
    [&](std::size_t number, unsigned thread)
    {
      ThreadBuffers& mine = buffers[thread];
      RasterKey* const keys = drawInto(mine);
      RasterBatch& batch = mine.scratch();
      const RasterPiece& piece = pieces[number];
      const RasterItem& item = *piece.item;
      projectBatches(items, kernels, piece, batch,
        [&](std::uint32_t first, int count)
        {
          if (item.passes.squares)
          {
            kernels.drawSquares(now, batch, count, item.passes.squareSize, item.base + first, keys);
            return;
          }
          shapes.fill(item, first, count, item.passes.firstRadius, batch);
          kernels.setUp(item.camera, now, item.passes.first, count, batch);
          kernels.drawSplats(
            item.camera, now, item.passes.first, batch, count, item.base + first, keys);
        });
    });
  drawInto(buffers[0]); // all are merged into these
}

/// All threads' keys into the first one's, and the depth of each: infinite negative where nothing
/// is.
void SoftwareRasteriser::Content::mergeKeys(const RasterWindow& now, float* depths)
{
  RasterKey* const merged = buffers[0].keys.data();
  crew.run(static_cast<std::size_t>(now.height + 2 * rasterMargin),
    [&](std::size_t y, unsigned)
    {
      const std::int64_t begin = std::int64_t(y) * now.stride, end = begin + now.stride;
      for (std::size_t other = 1; other < buffers.size(); ++other)
      {
        const ThreadBuffers& one = buffers[other];
        const RasterKey* const keys = one.keysDrawn ? one.keys.data() : merged;
        for (std::int64_t p = begin; p < end; ++p)
        {
          merged[p] = keys[p] < merged[p] ? keys[p] : merged[p];
        }
      }
      for (std::int64_t p = begin; p < end; ++p)
      {
        const RasterKey key = merged[p];
        depths[p] = key == emptyKey ? -std::numeric_limits<float>::infinity() : depthBits(key);
      }
    });
  std::for_each(
    buffers.begin() + 1, buffers.end(), [](ThreadBuffers& one) { one.keysDrawn = false; });
}

/// Second pass, of blended items: weights and colours of what is not behind.
void SoftwareRasteriser::Content::addColours(
  const RasterItems& items, const RasterWindow& now, const std::vector<RasterPiece>& pieces)
{
  float* const depths = nearest.ofSize(now.pixels());
  mergeKeys(now, depths);
  PictureExchange* const all = items.plan().exchange;
  const bool together = all && shareDepths(*all, depths, now.pixels());
  for (ThreadBuffers& one : buffers)
  {
    one.sumsDrawn = false;
  }
  const RasterKernels& kernels = *loops;
  const PointShapes shapes(items, kernels);
  crew.run(pieces.size(),
    [&](std::size_t number, unsigned thread)
    {
      const RasterPiece& piece = pieces[number];
      const RasterItem& item = *piece.item;
      if (!item.passes.blended)
      {
        return;
      }
      ThreadBuffers& mine = buffers[thread];
      std::uint32_t* const sums = mine.sums.ofSize(4 * now.pixels());
      if (!mine.sumsDrawn)
      {
        std::fill(sums, sums + 4 * now.pixels(), 0u);
        mine.sumsDrawn = true;
      }
      RasterBatch& batch = mine.scratch();
      projectBatches(items, kernels, piece, batch,
        [&](std::uint32_t first, int count)
        {
          item.colours->fetchAhead(nextBatch(piece, first));
          shapes.fillBlended(item, first, count, item.passes.secondRadius, batch);
          kernels.setUp(item.camera, now, item.passes.second, count, batch);
          item.colours->fill(first, count, batch.colour);
          kernels.addSplats(item.camera, now, item.passes.second, batch, count, depths, sums);
        });
    });
  together ? shareSums(*all, buffers, 4 * now.pixels()) : void();
}

/// All passes but the last.
void SoftwareRasteriser::Content::drawPoints(const RasterItems& items, const RasterWindow& now,
  const std::vector<RasterPiece>& pieces, bool goingOn)
{
  drawKeys(items, now, pieces, goingOn);
  if (items.blended() || items.plan().exchange)
  {
    addColours(items, now, piecesOf(items));
  }
}

void SoftwareRasteriser::Content::resolve(
  const RasterItems& items, const RasterWindow& now, std::uint16_t store, SoftwareTarget& target)
{
  const FrameShading& shading = items.plan().shading;
  const std::size_t pixels = target.depth.size(); // what is there already has that size
  target.normals.resize(shading.anyLit() ? 3 * pixels : target.normals.size());
  target.highlights.resize(shading.highlights.empty() ? target.highlights.size() : pixels);
  target.looks.resize(shading.lookCount() > 1 ? pixels : target.looks.size());
  WinnerResolve::Source source;
  source.kernels = loops;
  source.items = &items;
  source.window = now;
  source.merged = buffers[0].keys.data();
  source.store = store;
  source.normals = shading.anyLit();
  for (const ThreadBuffers& one : buffers)
  {
    if (one.keysDrawn)
    {
      source.keys.push_back(one.keys.data());
    }
    if (items.blended() && one.sumsDrawn)
    {
      source.sums.push_back(one.sums.data());
    }
  }
  const auto pieces = static_cast<std::size_t>((now.height + rowsOfPiece - 1) / rowsOfPiece);
  crew.run(pieces,
    [&](std::size_t piece, unsigned thread)
    {
      const int begin = static_cast<int>(piece) * rowsOfPiece;
      WinnerResolve(source, buffers[thread])
        .rows(begin, std::min(begin + rowsOfPiece, now.height), target);
    });
}

SoftwareRasteriser::SoftwareRasteriser(ThreadCrew* crew)
  : content_(std::make_unique<Content>(crew ? *crew : ThreadCrew::ofProcess()))
{
}

SoftwareRasteriser::~SoftwareRasteriser() = default;

/// The next picture of the store goes on from this one; where the memory that it may take is taken,
/// from who was visible in it only.
void SoftwareRasteriser::Content::keep(
  const RasterItems& items, const RasterWindow& window, LastPicture& picture)
{
  const FrameCamera& camera = items.plan().camera;
  const RasterWindow viewport = windowOf({ 0, 0, camera.width, camera.height });
  const std::int64_t pixels = window.pixels() + last.keyPixels();
  if (pixels <= mostKeptPictures * viewport.pixels())
  {
    picture.keep(items, window, std::move(buffers[0].keys));
  }
  else
  {
    picture.keepVisible(items, window, buffers[0].keys.data(), crew);
  }
}

/// All that the plan shows, in one window.
void SoftwareRasteriser::Content::drawAtOnce(
  const RasterItems& items, RasterWindow window, Drawing& drawing)
{
  LastPicture& picture = drawing.picture;
  std::vector<RasterPiece> pieces;
  const bool goingOn = drawing.whole && picture.goOn(items, window, crew, pieces, drawing.reused);
  if (!goingOn)
  {
    pieces = piecesOf(items);
  }
  if (drawing.fits)
  {
    drawing.target.reset(window.rectangle());
  }
  RasterBuffer<RasterKey> spare;
  if (picture.hasKeys())
  {
    spare = std::exchange(buffers[0].keys, picture.takeKeys());
  }
  drawPoints(items, window, pieces, goingOn);
  resolve(items, window, drawing.store, drawing.target);
  if (drawing.whole)
  {
    keep(items, window, picture);
  }
  else if (drawing.known)
  {
    picture.keepVisible(items, window, buffers[0].keys.data(), crew);
  }
  else
  {
    picture.forget();
  }
  if (!buffers[0].keys.data())
  {
    buffers[0].keys = std::move(spare);
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
  PixelRectangle place = shownRectangle(items);
  if (drawing.fits)
  {
    place = only ? withHoles(place, plan) : viewport;
  }
  else
  {
    place = common(place, drawing.target.rectangle());
  }
  const std::int64_t pixelBytes = std::int64_t(crew.threads()) * (items.blended() ? 24 : 8) + 4;
  const std::int64_t rowBytes = pixelBytes * windowOf(place).stride;
  const auto rows =
    static_cast<int>(std::max<std::int64_t>(mostBytes / rowBytes - 2 * rasterMargin, leastRows));
  if (only && !place.empty() && rows >= place.height())
  {
    drawAtOnce(items, windowOf(place), drawing);
    return;
  }
  drawing.picture.forget();
  if (drawing.fits && items.first())
  {
    drawing.target.reset(place);
  }
  for (int bottom = place.bottom; bottom < place.top && !place.empty(); bottom += rows)
  {
    const RasterWindow window =
      windowOf({ place.left, bottom, place.right, std::min(bottom + rows, place.top) });
    drawPoints(items, window, piecesOf(items), false);
    resolve(items, window, drawing.store, drawing.target);
  }
}

RasterStatistics SoftwareRasteriser::Content::draw(const FramePlan& asked, SoftwareTarget& target,
  std::uint16_t store, const RasterPart& part, bool fits)
{
  const auto begin = std::chrono::steady_clock::now();
  buffers.resize(crew.threads());
  const PixelRectangle viewport{ 0, 0, asked.camera.width, asked.camera.height };
  const bool whole = fits || target.rectangle().contains(viewport);
  Drawing drawing{ target, last.of(store, part.number), store, whole, whole || part.complete,
    fits };
  const bool keeps = asked.keepsVisible && !asked.exchange && drawing.known && !target.keepPoints;
  if (asked.batches.empty() && keeps)
  {
    fits ? target.reset(PixelRectangle()) : void();
    return {}; // other stores have the whole budget for a frame: the next one goes on
  }
  const VisiblePoints& visible = drawing.picture.visibleFor(asked, keeps, crew);
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
  auto fresh = std::make_unique<Content>(content_->crew);
  fresh->loops = content_->loops;
  content_ = std::move(fresh);
}

const char* SoftwareRasteriser::instructionSet() const
{
  return content_->loops->instructionSet;
}

bool SoftwareRasteriser::setInstructionSet(const char* name)
{
  const RasterKernels* const found = rasterKernelsOf(name);
  content_->loops = found ? found : content_->loops;
  return found != nullptr;
}

} // namespace pointfront
