#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/Infinity.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <tuple>

namespace pointfront
{

/// A square of a mosaic, by its column and row from the world's origin.
struct TileIndex
{
  std::int64_t x = 0;
  std::int64_t y = 0;

  std::string name() const { return std::to_string(x) + "_" + std::to_string(y); }
  friend bool operator==(const TileIndex& a, const TileIndex& b)
  {
    return a.x == b.x && a.y == b.y;
  }
  friend bool operator<(const TileIndex& a, const TileIndex& b)
  {
    return std::tie(a.x, a.y) < std::tie(b.x, b.y);
  }
};

/// The squares, of `edge` world units, that a mosaic is cut into. Each point that has a place
/// (CellHistogram.h) lies in one.
struct TileGrid
{
  double edge = 1.0;

  TileIndex of(const glm::dvec3& p) const { return { column(p.x), column(p.y) }; }
  /// The tile and `margin` around it; all heights.
  Bounds box(const TileIndex& tile, double margin) const
  {
    Bounds box;
    box.low = { edge * static_cast<double>(tile.x) - margin,
      edge * static_cast<double>(tile.y) - margin, -infinity };
    box.high = { edge * static_cast<double>(tile.x + 1) + margin,
      edge * static_cast<double>(tile.y + 1) + margin, infinity };
    return box;
  }

  /// The box that has all points of the tile, wherever the rounding of of() puts those of its
  /// faces.
  Bounds ownBox(const TileIndex& tile) const
  {
    constexpr double rounding = 8.0 * std::numeric_limits<double>::epsilon();
    const double farthest = 1.0 + static_cast<double>(std::max(std::abs(tile.x), std::abs(tile.y)));
    return box(tile, rounding * edge * farthest);
  }

private:
  std::int64_t column(double coordinate) const
  {
    return static_cast<std::int64_t>(std::floor(coordinate / edge));
  }
};

} // namespace pointfront
