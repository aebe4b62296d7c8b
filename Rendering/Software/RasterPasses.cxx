#include "RasterPasses.h"

#include "PointShapes.h"
#include "SharedSums.h"
#include "WinnerResolve.h"

#include "pointfront/Threads/ThreadCrew.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace pointfront
{
namespace
{

constexpr int rowsOfPiece = 8;

/// Squares of points that grow have a whole number of pixels, too. Along a node's order sizes fall,
/// so a batch has few of them.
void drawGrowingSquares(const RasterKernels& kernels, const RasterWindow& now,
  const RasterItem& item, std::uint32_t first, int count, RasterBatch& batch, RasterKey* keys)
{
  float depths[RasterBatch::size];
  int sizes[RasterBatch::size];
  std::copy(batch.depth, batch.depth + count, depths);
  int largest = 0;
  for (int j = 0; j < count; ++j)
  {
    const float grown = item.item->growth.of(first + static_cast<std::uint32_t>(j));
    sizes[j] = grownSquare(item.passes.squareSize, grown);
    largest = std::max(largest, sizes[j]);
  }
  for (int size = largest; size > 0; --size)
  {
    bool any = false;
    for (int j = 0; j < count; ++j)
    {
      batch.depth[j] = sizes[j] == size ? depths[j] : -1.0f;
      any = any || sizes[j] == size;
    }
    if (any)
    {
      kernels.drawSquares(now, batch, count, size, item.base + first, keys);
    }
  }
}

float depthBits(RasterKey key)
{
  const auto bits = static_cast<std::uint32_t>(static_cast<std::uint64_t>(key) >> 32);
  float depth;
  std::memcpy(&depth, &bits, 4);
  return depth;
}

} // namespace

/// First pass. The first thread's keys may hold the last picture's.
void RasterPasses::drawKeys(const RasterItems& items, const RasterWindow& now,
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
          if (item.passes.squares && !item.item->growth.whole())
          {
            drawGrowingSquares(kernels, now, item, first, count, batch, keys);
            return;
          }
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

/// All threads' keys into the first one's. Calls `then` with each row's place while it is at hand.
template <typename Then>
void RasterPasses::mergeKeys(const RasterWindow& now, const Then& then)
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
      then(begin, end);
    });
  std::for_each(
    buffers.begin() + 1, buffers.end(), [](ThreadBuffers& one) { one.keysDrawn = false; });
}

/// The same, and the depth of each: infinite negative where nothing is.
void RasterPasses::mergeKeys(const RasterWindow& now, float* depths)
{
  const RasterKey* const merged = buffers[0].keys.data();
  mergeKeys(now,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t p = begin; p < end; ++p)
      {
        const RasterKey key = merged[p];
        depths[p] = key == emptyKey ? -std::numeric_limits<float>::infinity() : depthBits(key);
      }
    });
}

RasterBuffer<RasterKey> RasterPasses::copyOfKeys(const RasterWindow& now)
{
  RasterBuffer<RasterKey> copy;
  const RasterKey* const keys = buffers[0].keys.data();
  RasterKey* const copied = copy.ofSize(now.pixels());
  mergeKeys(now,
    [&](std::int64_t begin, std::int64_t end)
    { std::copy(keys + begin, keys + end, copied + begin); });
  return copy;
}

/// Second pass, of blended items: weights and colours of what is not behind.
void RasterPasses::addPiecesTo(const RasterItems& items, const RasterWindow& now,
  const float* depths, const std::vector<RasterPiece>& pieces, Lasting& lasting)
{
  const RasterKernels& kernels = *loops;
  const PointShapes shapes(items, kernels);
  for (const RasterPiece& piece : pieces)
  {
    lasting.blended += piece.item->passes.blended ? piece.last - piece.first : 0;
  }
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
}

/// All threads' sums into the first one's.
void RasterPasses::mergeSums(const RasterWindow& now)
{
  ThreadBuffers& first = buffers[0];
  std::uint32_t* const merged = first.sums.ofSize(4 * now.pixels());
  const bool empty = !first.sumsDrawn;
  first.sumsDrawn = true;
  crew.run(static_cast<std::size_t>(now.height + 2 * rasterMargin),
    [&](std::size_t y, unsigned)
    {
      const std::int64_t begin = 4 * std::int64_t(y) * now.stride, end = begin + 4 * now.stride;
      if (empty)
      {
        std::fill(merged + begin, merged + end, 0u);
      }
      for (std::size_t other = 1; other < buffers.size(); ++other)
      {
        const std::uint32_t* const sums = buffers[other].sums.data();
        for (std::int64_t i = begin; buffers[other].sumsDrawn && i < end; ++i)
        {
          merged[i] += sums[i];
        }
      }
    });
  std::for_each(
    buffers.begin() + 1, buffers.end(), [](ThreadBuffers& one) { one.sumsDrawn = false; });
}

/// Whether the sums of the last picture are those that this one begins with. Where something is
/// much nearer than before, what lies behind it is forgotten while a view is refining; a complete
/// picture takes the sums of one go alone.
bool RasterPasses::goOnWithSums(const RasterItems& items, const RasterWindow& now,
  const float* depths, const LastPicture::Pieces& pieces, BlendedSums& last)
{
  const bool unchanged = pieces.lasting.empty() && pieces.passing.empty();
  const bool usable = items.plan().refining || (last.exact && unchanged);
  if (!pieces.goesOn || !last.sums.data() || !usable)
  {
    return false;
  }
  const float* const before = last.depths.data();
  std::uint32_t* const sums = last.sums.data();
  const RasterCamera& camera = items.items().front().camera;
  const float pixel = forgottenPixels / camera.scaleY;
  crew.run(static_cast<std::size_t>(now.height + 2 * rasterMargin),
    [&](std::size_t y, unsigned)
    {
      const std::int64_t begin = std::int64_t(y) * now.stride, end = begin + now.stride;
      for (std::int64_t p = begin; p < end; ++p)
      {
        const float reach = camera.parallel ? 1.0f : depths[p];
        if (depths[p] < before[p] - pixel * reach)
        {
          std::fill(sums + 4 * p, sums + 4 * p + 4, 0u);
        }
      }
    });
  last.exact = last.exact && unchanged;
  return true;
}

void RasterPasses::addColours(const RasterItems& items, const RasterWindow& now,
  const LastPicture::Pieces& pieces, BlendedSums last, Lasting& lasting)
{
  float* const depths = nearest.ofSize(now.pixels());
  mergeKeys(now, depths);
  const FramePlan& plan = items.plan();
  PictureExchange* const all = plan.exchange;
  const bool together = all && shareDepths(*all, depths, now.pixels());
  for (ThreadBuffers& one : buffers)
  {
    one.sumsDrawn = false;
  }
  if (!together && goOnWithSums(items, now, depths, pieces, last))
  {
    std::swap(buffers[0].sums, last.sums);
    buffers[0].sumsDrawn = true;
  }
  else
  {
    last.exact = true;
    if (!buffers[0].sums.data()) // they went with the last picture
    {
      std::swap(buffers[0].sums, last.sums); // their memory, which is costly to get
    }
    addPiecesTo(items, now, depths, pieces.there, lasting);
  }
  addPiecesTo(items, now, depths, pieces.lasting, lasting);
  lasting.sumsLast = !all && (plan.refining || !plan.keepsVisible);
  if (lasting.sumsLast)
  {
    mergeSums(now);
    lasting.sums.exact = last.exact;
    std::swap(lasting.sums.depths, last.depths); // its memory
  }
  if (!pieces.passing.empty())
  {
    if (lasting.sumsLast)
    {
      std::uint32_t* const copy = lasting.sums.sums.ofSize(4 * now.pixels());
      std::copy_n(buffers[0].sums.data(), 4 * now.pixels(), copy);
    }
    addPiecesTo(items, now, depths, pieces.passing, lasting);
  }
  together ? shareSums(*all, buffers, 4 * now.pixels()) : void();
}

BlendedSums RasterPasses::takeSums(Lasting& lasting)
{
  if (!lasting.sumsLast)
  {
    return {};
  }
  std::swap(lasting.sums.depths, nearest);
  if (!lasting.sums.sums.data())
  {
    lasting.sums.sums = std::move(buffers[0].sums);
    buffers[0].sumsDrawn = false;
  }
  return std::move(lasting.sums);
}

RasterPasses::Lasting RasterPasses::drawPoints(const RasterItems& items, const RasterWindow& now,
  const LastPicture::Pieces& pieces, BlendedSums sums)
{
  Lasting lasting;
  drawKeys(items, now, pieces.lasting, pieces.goesOn);
  if (!pieces.passing.empty())
  {
    lasting.keys = copyOfKeys(now);
    drawKeys(items, now, pieces.passing, true);
  }
  if (items.blended() || items.plan().exchange)
  {
    addColours(items, now, pieces, std::move(sums), lasting);
  }
  return lasting;
}

void RasterPasses::resolve(
  const RasterItems& items, const RasterWindow& now, const Destination& destination)
{
  SoftwareTarget& target = destination.target;
  const FrameShading& shading = items.plan().shading;
  const std::size_t pixels = target.depth.size(); // the target has that size already
  target.normals.resize(shading.anyLit() ? 3 * pixels : target.normals.size());
  target.highlights.resize(shading.highlights.empty() ? target.highlights.size() : pixels);
  target.looks.resize(shading.lookCount() > 1 ? pixels : target.looks.size());
  WinnerResolve::Source source;
  source.kernels = loops;
  source.items = &items;
  source.window = now;
  source.merged = buffers[0].keys.data();
  source.store = destination.store;
  source.normals = shading.anyLit();
  source.standIns = destination.standIns;
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

} // namespace pointfront
