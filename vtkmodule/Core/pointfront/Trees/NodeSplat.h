#pragma once

#include "pointfront/Neighbourhood/SplatCell.h"
#include "pointfront/Records/MortonOrder.h"
#include "pointfront/Records/RecordLayout.h"
#include "pointfront/Records/TreeSpace.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// Collects what splatRadius() says of some points of a node, and gives one radius for all.
/// Quantile  discs of that size close the surface around most points, and do not follow the few
///           that are far from all others.
class SplatQuantile
{
public:
  void begin()
  {
    radii_.clear();
    rims_.clear();
  }
  /// `around`: all points near those `asked`, which are numbers in it.
  void add(const std::vector<glm::dvec3>& around, const std::vector<std::uint32_t>& asked);
  /// 0: no point had a neighbour.
  float radius();

private:
  void nearOf(const std::vector<glm::dvec3>& around, const glm::dvec3& from, double bound);

  std::vector<double> radii_;
  std::vector<double> rims_; ///< distances at the rim of the known part, for want of others
  NearOffsets near_;
};

/// The cheap measure of how large splats of a node must be: at most some fifty of its points are
/// looked at, in compact groups along the Morton curve, which gives their neighbours without an
/// index.
/// Order    depends on the positions only.
/// Threads  one a thread.
class NodeSplat
{
public:
  explicit NodeSplat(const TreeSpace& space);
  /// Measures the points with these numbers, in Morton order: all that are drawn of a region. World
  /// units; 0 for a single place.
  float measure(const RecordSpan& positions, const std::vector<std::uint32_t>& points);

private:
  struct Points
  {
    const RecordSpan& positions;
    const std::vector<std::uint32_t>& numbers;

    TreePosition operator[](std::size_t i) const { return positions.position(numbers[i]); }
    std::size_t size() const { return numbers.size(); }
  };
  /// Those in a cell of the tree, as a range.
  struct Range
  {
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  static Range inCell(const Points& points, std::size_t near, const OctreeCell& cell);
  static unsigned likelySide(const Points& points, std::size_t from);
  std::size_t cellsAround(const Points& points, std::size_t from, unsigned log2Side);
  void lookAround(const Points& points, std::size_t from);

  glm::dvec3 stepLengths_; ///< length of a tree step on each axis, world units
  SplatQuantile quantile_;
  std::array<Range, 27> cells_; ///< around a point, its own in the middle
  std::vector<glm::dvec3> around_;
  std::vector<std::uint32_t> asked_;
};

} // namespace pointfront
