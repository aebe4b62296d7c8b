#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Neighbourhood/CellHistogram.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace pointfront
{

/// How a cloud is cut into tiles.
struct TilingOptions
{
  unsigned axes = 3; ///< 2: tiles are columns without top and bottom
  std::uint64_t tilePoints = 1u << 17; ///< a tile has at most as many, where cells are fine enough
  /// Around each tile, in world units, the points of which it gets copies; 0: estimated for each
  /// tile from its density so that `neighbours` neighbours of most of its points lie inside.
  double halo = 0.0;
  unsigned neighbours = 16;
};

/// One tile: the boxes are half open below infinity and closed where they are infinite.
struct Tile
{
  Bounds own; ///< no two tiles share a point; together they cover all of space
  Bounds gathered; ///< own and a halo around it, whose points the tile gets too
  std::uint64_t points = 0; ///< in `own`
  std::uint64_t mostGathered = 0; ///< in `gathered`: at most
};

/// A cloud cut into tiles of about equal numbers of points by planes between cells (a kd-tree).
/// Depends on the points only: not on memory, threads or their order.
/// Threads  immutable.
class TileLayout
{
public:
  TileLayout(const CellHistogram& histogram, const TilingOptions& options);

  const std::vector<Tile>& tiles() const { return tiles_; }
  std::size_t tileOf(const glm::dvec3& p) const;
  /// Calls `found` with each tile whose gathered box has a point in common with [low, high].
  void forEachGathering(const glm::dvec3& low, const glm::dvec3& high,
    const std::function<void(std::size_t)>& found) const;
  /// True if no other tile than its own gathers `p`: a fast answer for most points.
  bool isInner(const glm::dvec3& p, std::size_t tile) const;

private:
  struct Node
  {
    int axis = -1; ///< -1: a leaf
    double cut = 0.0;
    std::size_t below = 0; ///< child, or the tile of a leaf
    std::size_t above = 0;
    Bounds gathered; ///< by all tiles below this node
  };
  using CellIterator = std::vector<PopulatedCell>::iterator;
  std::size_t divide(CellIterator begin, CellIterator end, const Bounds& own);
  double estimatedHalo(std::size_t cells, std::uint64_t points) const;
  void countGathered(const std::vector<PopulatedCell>& cells);
  Bounds gatherBelow(std::size_t node);
  void visit(std::size_t node, const glm::dvec3& low, const glm::dvec3& high,
    const std::function<void(std::size_t)>& found) const;

  TilingOptions options_;
  double edge_;
  double largestHalo_ = 0.0;
  std::vector<double> halos_; // halo of each tile
  std::vector<Tile> tiles_;
  std::vector<Node> nodes_;
};

} // namespace pointfront
