#pragma once

#include "pointfront/Build/StoreBuilder.h"
#include "pointfront/Mosaic/TilePieces.h"

#include <functional>
#include <string>
#include <vector>

namespace pointfront
{

/// One tile of a mosaic, as it is to be built.
struct TileTask
{
  TileGrid grid;
  TileIndex tile;
  /// World units around the tile whose points its passes see at first.
  double margin = 0.0;
  /// World units beyond the margin whose points are read, too, because passes cut the cloud into
  /// cells (GroundOptions::cell).
  double rim = 0.0;
  /// Margins from here on take in the whole cloud.
  double cloudExtent = 0.0;
  /// `inputs(d)`: those with points within d of the tile; d may be infinite.
  std::function<Result<TileInputs>(double)> inputs;
  const AttributePasses* passes = nullptr;
  BuildOptions options; ///< its grid is set: the same for all tiles
};

struct TileOutcome
{
  BuildReport report;
  double margin =
    0.0; ///< at least as far as any value of the tile looks; infinite: the whole cloud
};

/// Builds the store of one tile, whose points have the values that they would have in one store of
/// all inputs. Passes run over the tile and a margin; a margin that turns out to be less than how
/// far a neighbour is looked for is made wider, and the passes run again.
/// Guarantees  as buildStore(). The tile depends on the inputs within the outcome's margin only.
/// Memory      points of tile and margin wait in the temporary folder; else as the passes and
///             buildStore().
/// Errors      those of the inputs, the passes and buildStore().
/// Threads     called from one thread; runs its own.
Result<TileOutcome> buildTile(const TileTask& task, const ProgressFunction& progress);

/// World units around a tile that most of its points' nearest neighbours lie in: what a margin
/// begins with. `points`: the most that it or a tile beside it has, because a tile of few points
/// finds its neighbours in the denser one beside it.
double firstMargin(const AttributePasses& passes, double edge, std::uint64_t points);

} // namespace pointfront
