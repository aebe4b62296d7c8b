#include "SoftwareRasteriser.h"

#include "PointShapes.h"
#include "RasterBuffers.h"
#include "RasterItems.h"
#include "RasterKernels.h"
#include "VisiblePoints.h"
#include "WinnerResolve.h"

#include "pointfront/Threads/ThreadCrew.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <limits>

namespace pointfront
{
namespace
{

/// Points that a thread draws at a time: a node, or a part of a large one.
constexpr std::uint32_t pointsOfPiece = 1u << 14;
constexpr int rowsOfPiece = 8;
/// Buffers of a picture take that much at most, over all threads: a larger one is drawn in bands.
constexpr std::int64_t mostBytes = std::int64_t(768) << 20;
constexpr int leastRows = 64;

/// Part of an item's points.
struct Piece
{
  const RasterItem* item;
  std::uint32_t first;
  std::uint32_t last;
};

float depthBits(RasterKey key)
{
  const auto bits = static_cast<std::uint32_t>(static_cast<std::uint64_t>(key) >> 32);
  float depth;
  std::memcpy(&depth, &bits, 4);
  return depth;
}

} // namespace

struct SoftwareRasteriser::Content
{
  explicit Content(ThreadCrew& threads)
    : crew(threads)
  {
  }

  ThreadCrew& crew;
  const RasterKernels* loops = &rasterKernels();
  std::vector<ThreadBuffers> buffers;
  RasterBuffer<float> nearest;
  // Of the last picture, to go on from:
  bool kept = false;
  FrameCamera camera;
  std::vector<glm::dvec4> clippingPlanes;
  RasterWindow window;
  std::vector<DrawnItem> drawn;
  ItemNumbers numbers; ///< of what was drawn
  std::vector<std::shared_ptr<const ResolvedStyle>> styles; ///< alive, as the nodes
  VisiblePoints visible;
  std::uint16_t keptStore = 0;
  QuantisationGrid grid;
  std::shared_ptr<const AttributeSchema> schema;

  void keepVisible(const FramePlan& plan, std::uint16_t store, bool wanted);

  std::uint64_t goOn(const RasterItems& items, const RasterWindow& now, std::vector<Piece>& pieces);
  bool renumber(const RasterItems& items, std::vector<std::uint32_t>& drawnUpTo);
  void keep(const RasterItems& items, const RasterWindow& now, std::uint16_t store);
  void drawKeys(const RasterItems& items, const RasterWindow& now, const std::vector<Piece>& pieces,
    bool goingOn);
  void addColours(
    const RasterItems& items, const RasterWindow& now, const std::vector<Piece>& pieces);
  std::uint64_t drawPoints(const RasterItems& items, const RasterWindow& now);
  void resolve(const RasterItems& items, const RasterWindow& now, std::uint16_t store,
    SoftwareTarget& target, int firstRow);
};

namespace
{

void addPieces(
  const RasterItem& item, std::uint32_t first, std::uint32_t last, std::vector<Piece>& pieces)
{
  for (; first < last; first += std::min(pointsOfPiece, last - first))
  {
    pieces.push_back({ &item, first, first + std::min(pointsOfPiece, last - first) });
  }
}

bool sameCamera(const FrameCamera& a, const FrameCamera& b)
{
  return a.storeToView == b.storeToView && a.viewToClip == b.viewToClip &&
    a.reference == b.reference && a.referenceInView == b.referenceInView &&
    a.parallel == b.parallel && a.width == b.width && a.height == b.height;
}

bool sameWindow(const RasterWindow& a, const RasterWindow& b)
{
  return a.width == b.width && a.bottom == b.bottom && a.height == b.height;
}

/// The item is what was drawn before, or that and more of its points.
bool continues(const RasterItem& item, const DrawnItem& drawn)
{
  return item.item->node == drawn.node &&
    (item.style == drawn.style || *item.style == *drawn.style) &&
    item.passes == drawn.passes && item.item->first == drawn.first &&
    item.item->last >= drawn.last && item.radius == drawn.radius &&
    item.radiusScale == drawn.radiusScale && item.item->refined == drawn.refined;
}

} // namespace

/// Whether all that was drawn is part of the new items; then keys get the new items' numbers, and
/// `drawnUpTo` says for each item which of its points are there.
bool SoftwareRasteriser::Content::renumber(
  const RasterItems& items, std::vector<std::uint32_t>& drawnUpTo)
{
  const std::vector<RasterItem>& now = items.items();
  drawnUpTo.assign(now.size(), 0);
  std::vector<std::uint32_t> shift(drawn.size());
  bool moved = false;
  std::size_t next = 0;
  for (std::size_t old = 0; old < drawn.size(); ++old, ++next)
  {
    while (next < now.size() && !continues(now[next], drawn[old]))
    {
      ++next;
    }
    if (next == now.size())
    {
      return false;
    }
    drawnUpTo[next] = drawn[old].last;
    shift[old] = now[next].base - drawn[old].base;
    moved = moved || shift[old] != 0;
  }
  if (!moved)
  {
    return true;
  }
  RasterKey* const keys = buffers[0].keys.data();
  const auto renumbered = [&](RasterKey key)
  {
    const auto index = static_cast<std::uint32_t>(key);
    const auto after = std::upper_bound(drawn.begin(), drawn.end(), index,
      [](std::uint32_t i, const DrawnItem& item) { return i < item.base; });
    const std::uint32_t by = shift[static_cast<std::size_t>(after - drawn.begin()) - 1];
    return static_cast<RasterKey>(
      (static_cast<std::uint64_t>(key) & 0xffffffff00000000u) | (index + by));
  };
  crew.run(static_cast<std::size_t>(window.height),
    [&](std::size_t y, unsigned)
    {
      RasterKey* const row = keys + window.at(0, static_cast<int>(y));
      for (int x = 0; x < window.width; ++x)
      {
        row[x] = row[x] == emptyKey ? emptyKey : renumbered(row[x]);
      }
    });
  return true;
}

/// The pieces that have to be drawn, and how many points are there already.
std::uint64_t SoftwareRasteriser::Content::goOn(
  const RasterItems& items, const RasterWindow& now, std::vector<Piece>& pieces)
{
  const FramePlan& plan = items.plan();
  std::vector<std::uint32_t> drawnUpTo;
  const bool same = kept && sameWindow(window, now) && sameCamera(camera, plan.camera) &&
    clippingPlanes == plan.clippingPlanes && renumber(items, drawnUpTo);
  std::uint64_t reused = 0;
  for (std::size_t i = 0; i < items.items().size(); ++i)
  {
    const RasterItem& item = items.items()[i];
    const std::uint32_t first = item.item->first;
    const std::uint32_t from = same ? std::max(first, drawnUpTo[i]) : first;
    reused += from - first;
    addPieces(item, from, item.item->last, pieces);
  }
  kept = same;
  return reused;
}

void SoftwareRasteriser::Content::keep(
  const RasterItems& items, const RasterWindow& now, std::uint16_t store)
{
  const FramePlan& plan = items.plan();
  kept = true;
  camera = plan.camera;
  clippingPlanes = plan.clippingPlanes;
  keptStore = store;
  grid = plan.grid;
  schema = plan.schema;
  window = now;
  numbers = items.numbers();
  drawn.clear();
  for (const RasterItem& item : items.items())
  {
    drawn.push_back({ item.item->node, item.style, item.passes, item.base, item.item->first,
      item.item->last, item.radius, item.radiusScale, item.item->refined,
      item.item->closingRadius, item.item->radiusScale });
  }
  styles.clear();
  for (const DrawBatch& batch : plan.batches)
  {
    styles.push_back(batch.style);
  }
}

/// What was visible stays while a view moves or is being completed. From the same camera it is what
/// it was: the picture goes on from there.
void SoftwareRasteriser::Content::keepVisible(
  const FramePlan& plan, std::uint16_t store, bool wanted)
{
  const bool follows = wanted && kept && keptStore == store && grid == plan.grid &&
    *schema == *plan.schema && window.height == plan.camera.height;
  if (!follows)
  {
    visible.clear();
  }
  else if (!sameCamera(camera, plan.camera) || clippingPlanes != plan.clippingPlanes)
  {
    visible.choose(buffers[0].keys.data(), window, numbers, drawn, plan, crew);
  }
}

/// First pass. The first thread's keys may hold the last picture's.
void SoftwareRasteriser::Content::drawKeys(const RasterItems& items, const RasterWindow& now,
  const std::vector<Piece>& pieces, bool goingOn)
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
  drawInto(buffers[0]);
  crew.run(pieces.size(),
    [&](std::size_t number, unsigned thread)
    {
      ThreadBuffers& mine = buffers[thread];
      RasterKey* const keys = drawInto(mine);
      RasterBatch& batch = mine.scratch();
      const Piece& piece = pieces[number];
      const RasterItem& item = *piece.item;
      RasterPositions positions = item.positions;
      for (std::uint32_t first = piece.first; first < piece.last; first += RasterBatch::size)
      {
        const int count =
          static_cast<int>(std::min<std::uint32_t>(RasterBatch::size, piece.last - first));
        positions.xyz = item.positions.xyz + 3 * std::size_t(first);
        positions.filtered = RasterItems::filter(items.plan(), item, first, count, batch);
        kernels.project(item.camera, positions, count, batch);
        if (item.passes.squares)
        {
          kernels.drawSquares(
            now, batch, count, item.passes.squareSize, item.base + first, keys);
          continue;
        }
        shapes.fill(item, first, count, item.passes.firstRadius, batch);
        kernels.setUp(item.camera, now, item.passes.first, count, batch);
        kernels.drawSplats(
          item.camera, now, item.passes.first, batch, count, item.base + first, keys);
      }
    });
}

/// Second pass, of blended items: weights and colours of what is not behind.
void SoftwareRasteriser::Content::addColours(
  const RasterItems& items, const RasterWindow& now, const std::vector<Piece>& pieces)
{
  float* const depths = nearest.ofSize(now.pixels());
  const int rows = now.height + 2 * rasterMargin;
  crew.run(static_cast<std::size_t>(rows),
    [&](std::size_t y, unsigned)
    {
      const std::int64_t begin = std::int64_t(y) * now.stride;
      for (std::int64_t p = begin; p < begin + now.stride; ++p)
      {
        RasterKey key = emptyKey;
        for (const ThreadBuffers& one : buffers)
        {
          key = one.keysDrawn ? std::min(key, one.keys.data()[p]) : key;
        }
        depths[p] =
          key == emptyKey ? -std::numeric_limits<float>::infinity() : depthBits(key);
      }
    });
  for (ThreadBuffers& one : buffers)
  {
    one.sumsDrawn = false;
  }
  const RasterKernels& kernels = *loops;
  const PointShapes shapes(items, kernels);
  crew.run(pieces.size(),
    [&](std::size_t number, unsigned thread)
    {
      const Piece& piece = pieces[number];
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
      RasterPositions positions = item.positions;
      for (std::uint32_t first = piece.first; first < piece.last; first += RasterBatch::size)
      {
        const int count =
          static_cast<int>(std::min<std::uint32_t>(RasterBatch::size, piece.last - first));
        positions.xyz = item.positions.xyz + 3 * std::size_t(first);
        positions.filtered = RasterItems::filter(items.plan(), item, first, count, batch);
        kernels.project(item.camera, positions, count, batch);
        shapes.fill(item, first, count, item.passes.secondRadius, batch);
        kernels.setUp(item.camera, now, item.passes.second, count, batch);
        item.colours->fill(first, count, batch.colour);
        kernels.addSplats(item.camera, now, item.passes.second, batch, count, depths, sums);
      }
    });
}

/// All passes but the last. Gives how many points the last picture already had.
std::uint64_t SoftwareRasteriser::Content::drawPoints(
  const RasterItems& items, const RasterWindow& now)
{
  std::vector<Piece> pieces;
  const std::uint64_t reused = goOn(items, now, pieces);
  drawKeys(items, now, pieces, kept);
  kept = false;
  if (items.blended())
  {
    std::vector<Piece> all;
    for (const RasterItem& item : items.items())
    {
      addPieces(item, item.item->first, item.item->last, all);
    }
    addColours(items, now, all);
  }
  return reused;
}

void SoftwareRasteriser::Content::resolve(const RasterItems& items, const RasterWindow& now,
  std::uint16_t store, SoftwareTarget& target, int firstRow)
{
  WinnerResolve::Source source;
  source.kernels = loops;
  source.items = &items;
  source.window = now;
  source.merged = buffers[0].keys.data();
  source.store = store;
  source.normals = items.plan().shading.lit;
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
        .rows(begin, std::min(begin + rowsOfPiece, now.height), target, firstRow);
    });
}

SoftwareRasteriser::SoftwareRasteriser(ThreadCrew* crew)
  : content_(std::make_unique<Content>(crew ? *crew : ThreadCrew::ofProcess()))
{
}

SoftwareRasteriser::~SoftwareRasteriser() = default;

RasterStatistics SoftwareRasteriser::draw(
  const FramePlan& plan, SoftwareTarget& target, std::uint16_t store)
{
  return draw(plan, { 0, plan.camera.height }, target, store);
}

RasterStatistics SoftwareRasteriser::draw(const FramePlan& asked, const RasterBand& band,
  SoftwareTarget& target, std::uint16_t store)
{
  const auto begin = std::chrono::steady_clock::now();
  Content& content = *content_;
  content.buffers.resize(content.crew.threads());
  const bool whole = band.bottom == 0 && band.top == asked.camera.height;
  content.keepVisible(asked, store, asked.keepsVisible && whole && !target.keepPoints);
  FramePlan extended;
  if (!content.visible.empty())
  {
    extended = asked;
    content.visible.addTo(extended);
  }
  const FramePlan& plan = content.visible.empty() ? asked : extended;
  if (plan.shading.lit && target.normals.empty())
  {
    target.normals.assign(3 * target.depth.size(), 0.0f);
  }
  RasterStatistics statistics;
  RasterWindow viewport;
  viewport.width = plan.camera.width;
  viewport.stride = (plan.camera.width + 2 * rasterMargin + 15) & ~15;
  std::size_t from = 0;
  bool last = false;
  while (!last) // once, unless the points are more than 32 bits can count
  {
    const RasterItems items(plan, from);
    const std::int64_t threads = content.crew.threads();
    const std::int64_t pixelBytes = threads * (items.blended() ? 24 : 8) + 4;
    const std::int64_t rowBytes = pixelBytes * viewport.stride;
    const int rows = static_cast<int>(std::clamp<std::int64_t>(
      mostBytes / rowBytes - 2 * rasterMargin, leastRows, band.top - band.bottom));
    for (int bottom = band.bottom; bottom < band.top; bottom += rows)
    {
      RasterWindow window = viewport;
      window.bottom = bottom;
      window.height = std::min(rows, band.top - bottom);
      statistics.reused += content.drawPoints(items, window);
      content.resolve(items, window, store, target, bottom - band.bottom);
      if (window.height == band.top - band.bottom && from == 0 && items.last())
      {
        content.keep(items, window, store);
      }
    }
    from = items.end();
    last = items.last();
  }
  statistics.points = asked.pointCount();
  statistics.keptVisible = content.visible.count();
  statistics.milliseconds =
    std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  return statistics;
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
