#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Points/PointSource.h"
#include "pointfront/Points/QuantisationGrid.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

struct GridChoice
{
  QuantisationGrid grid;
  GridPosition low{ 0 }; ///< low corner of the declared extent, in steps; a hint
  GridPosition high{ 0 };
  std::vector<std::string> warnings; ///< which source is rounded, by how much at most
};

/// The one grid of a store (FRONT-1: one uniform coordinate system, one defined precision).
/// Lossless   when all sources lie on the grid of the finest of them: same scale or whole
///            multiples, offsets apart by whole steps. The first such offset is taken.
/// Rounded    otherwise, to at most half a step of the finest scale, with a warning.
/// Empty      sources without points have no say, unless none has points.
/// `precision` world units a step on every axis, > 0 and finite, and no finer than double precision
/// tells apart at the farthest declared coordinate; BadArgument otherwise.
/// Sources without a grid (floating point) and without `precision` get a millionth of the power of
/// ten below their declared extent: 0.1 mm for 100 m; a millimetre if the extent is not known.
/// Heights that extend farther than the plane may be of another unit: the plane then has a step by
/// its own extent. The extent may be a thousand times what most points occupy, because some lie far
/// away or the cloud has parts far apart (some chunks are read for that). The finest decimal step
/// is then taken that holds all; if it does not tell most points apart, that is BadArgument:
/// nothing collapses without being asked.
Result<GridChoice> chooseGrid(
  const std::vector<std::unique_ptr<PointSource>>& sources, const std::optional<double>& precision);

/// A grid that is decided already.
Result<GridChoice> givenGrid(
  const std::vector<std::unique_ptr<PointSource>>& sources, const QuantisationGrid& grid);

} // namespace pointfront
