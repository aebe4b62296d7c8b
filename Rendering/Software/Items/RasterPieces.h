#pragma once

#include "RasterItems.h"
#include "RasterKernels.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// Part of an item's points: what a thread draws at a time.
struct RasterPiece
{
  const RasterItem* item;
  std::uint32_t first;
  std::uint32_t last;
};

/// An item's points [first, last).
void addPieces(const RasterItem& item, std::uint32_t first, std::uint32_t last,
  std::vector<RasterPiece>& pieces);
/// All points of all items.
std::vector<RasterPiece> piecesOf(const RasterItems& items);

/// The points behind the batch that begins with `first`.
inline PointRange nextBatch(const RasterPiece& piece, std::uint32_t first)
{
  constexpr std::uint32_t most = RasterBatch::size;
  const std::uint32_t begin = first + std::min(piece.last - first, most);
  return { begin, begin + std::min(piece.last - begin, most) };
}

/// Calls `take(first, count)` for each batch of the piece, once its points are projected.
template <typename Take>
void projectBatches(const RasterItems& items, const RasterKernels& kernels,
  const RasterPiece& piece, RasterBatch& batch, const Take& take)
{
  const RasterItem& item = *piece.item;
  RasterPositions positions = item.positions;
  constexpr std::uint32_t most = RasterBatch::size;
  for (std::uint32_t first = piece.first; first < piece.last; first += most)
  {
    const auto count = static_cast<int>(std::min(piece.last - first, most));
    positions.xyz = item.positions.xyz + 3 * std::size_t(first);
    positions.filtered = RasterItems::filter(items.plan(), item, first, count, batch);
    kernels.project(item.camera, positions, count, batch);
    item.fetchAhead(nextBatch(piece, first));
    take(first, count);
  }
}

} // namespace pointfront
