#pragma once

#include "pointfront/Mosaic/InputSurvey.h"
#include "pointfront/Points/AttributePass.h"
#include "pointfront/Threads/WorkCrew.h"

#include <cstdint>
#include <vector>

namespace pointfront
{

/// The inputs of a tile, in the order of all inputs.
struct TileInputs
{
  PointSources sources;
  /// Numbers of the chunks that can have points in the tile or its margin, of each source. None:
  /// the source only says what attributes and systems the cloud has.
  std::vector<std::vector<std::uint64_t>> chunks;
  /// The hashOfPoints() of each of them when it was surveyed.
  std::vector<std::vector<std::uint64_t>> hashes;
  /// Whether the largest 16-bit colour of each source as a whole has more than 8 bits.
  std::vector<bool> deepColours;
};

/// The points of a tile and its margin, decoded once: sources that may be read again and again. A
/// quarter of a large memory holds them, and an unnamed file in the temporary folder what is more.
/// Order   one source for each input, in its order; chunks in theirs.
/// Threads sources as PointSource promises.
/// Errors  those of the inputs; Corrupt: a chunk is not as it was surveyed; Unwritable; Cancelled.
struct TilePieces
{
  PointSources sources;
  std::vector<std::vector<std::uint64_t>> own; ///< points of each chunk that are the tile's own
  std::uint64_t heldBytes = 0; ///< memory that the sources keep

  /// `known`: the box whose points are taken; it encloses the tile.
  static Result<TilePieces> of(const TileInputs& inputs, const TileGrid& grid,
    const TileIndex& tile, const Bounds& known, const PassResources& resources, WorkCrew& crew);
};

/// The sources without what is not the tile's own. `own`: as TilePieces counted.
PointSources ownPoints(PointSources sources, std::vector<std::vector<std::uint64_t>> own,
  const TileGrid& grid, const TileIndex& tile);

} // namespace pointfront
