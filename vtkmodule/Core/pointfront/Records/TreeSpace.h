#pragma once

#include "pointfront/Points/QuantisationGrid.h"
#include "pointfront/Records/RecordLayout.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace pointfront
{

/// Where the octree stands on the store's grid. Grid steps may have another length on each axis
/// (LAS files with a finer z scale are common); axes with coarser steps are shifted left, so
/// that a tree step is about as long on all axes and a cell about a cube in the world.
/// While points are read the origin is not known yet: absoluteSteps() keeps the low 32 bits, and
/// the difference to the origin, modulo 2^32, is right once the extent is known to fit 32 bits.
struct TreeSpace
{
  QuantisationGrid grid;
  std::array<unsigned, 3> shift{ 0, 0, 0 }; ///< tree step = grid step / 2^shift
  GridPosition origin{ 0 }; ///< origin of the root cube, in tree steps

  /// Low 32 bits of the tree coordinates of a grid position.
  TreePosition absoluteSteps(const GridPosition& g) const
  {
    return { static_cast<std::uint32_t>(static_cast<std::uint64_t>(g.x) << shift[0]),
      static_cast<std::uint32_t>(static_cast<std::uint64_t>(g.y) << shift[1]),
      static_cast<std::uint32_t>(static_cast<std::uint64_t>(g.z) << shift[2]) };
  }
  TreePosition relativeSteps(const TreePosition& absolute) const
  {
    return absolute -
      TreePosition(static_cast<std::uint32_t>(static_cast<std::uint64_t>(origin.x)),
        static_cast<std::uint32_t>(static_cast<std::uint64_t>(origin.y)),
        static_cast<std::uint32_t>(static_cast<std::uint64_t>(origin.z)));
  }
  GridPosition gridPosition(const TreePosition& relative) const
  {
    return { (origin.x + relative.x) >> shift[0], (origin.y + relative.y) >> shift[1],
      (origin.z + relative.z) >> shift[2] };
  }
  /// Length of a tree step in world units, the longest of the three.
  double stepLength() const
  {
    double longest = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int bits = -static_cast<int>(shift[static_cast<std::size_t>(axis)]);
      longest = std::max(longest, std::ldexp(grid.scale[axis], bits));
    }
    return longest;
  }
};

/// Axis shifts for a grid: none when its steps differ by more than a factor of 16, since such axes
/// do not have the same unit (degrees and metres).
std::array<unsigned, 3> axisShifts(const glm::dvec3& scale);

/// Those shifts, made less where the grid positions low to high would need more than 32 bits: cells
/// are then longer on some axes. Files whose steps are their extent divided by 2^31 need that.
std::array<unsigned, 3> fittingShifts(
  std::array<unsigned, 3> shift, const GridPosition& low, const GridPosition& high);

/// A root cube has 2^rootCellsLog2 cells an edge; its origin is a multiple of their side.
constexpr unsigned rootCellsLog2 = 6;

/// Sets the origin of the smallest root cube around the grid positions low to high and returns
/// log2 of its side. Nothing when they need more than 32 bits.
std::optional<unsigned> placeRoot(
  TreeSpace& space, const GridPosition& low, const GridPosition& high);

} // namespace pointfront
