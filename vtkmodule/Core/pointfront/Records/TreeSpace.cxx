#include "pointfront/Records/TreeSpace.h"

#include <algorithm>

namespace pointfront
{

std::array<unsigned, 3> axisShifts(const glm::dvec3& scale)
{
  constexpr long mostBits = 4;
  const double finest = std::min({ scale.x, scale.y, scale.z });
  std::array<unsigned, 3> shift{ 0, 0, 0 };
  for (int axis = 0; axis < 3; ++axis)
  {
    const long bits = std::lround(std::log2(scale[axis] / finest));
    if (bits > mostBits)
    {
      return { 0, 0, 0 };
    }
    shift[static_cast<std::size_t>(axis)] = static_cast<unsigned>(bits);
  }
  return shift;
}

std::array<unsigned, 3> fittingShifts(
  std::array<unsigned, 3> shift, const GridPosition& low, const GridPosition& high)
{
  // The part of 2^32 that stays when the origin is rounded down to a cell.
  constexpr double room = 4294967296.0 * (1.0 - 1.0 / (1u << rootCellsLog2));
  for (int axis = 0; axis < 3; ++axis)
  {
    const double steps = static_cast<double>(high[axis]) - static_cast<double>(low[axis]);
    unsigned& bits = shift[static_cast<std::size_t>(axis)];
    while (bits > 0 && std::ldexp(steps, static_cast<int>(bits)) >= room)
    {
      --bits;
    }
  }
  return shift;
}

std::optional<unsigned> placeRoot(
  TreeSpace& space, const GridPosition& low, const GridPosition& high)
{
  constexpr std::int64_t reach = std::int64_t(1) << 58; // 2^53 steps, shifted by at most 4
  GridPosition first{ 0 };
  GridPosition last{ 0 };
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t step = std::int64_t(1) << space.shift[static_cast<std::size_t>(axis)];
    first[axis] = std::clamp(low[axis] * step, -reach, reach);
    last[axis] = std::clamp(high[axis] * step, -reach, reach);
  }
  for (unsigned log2Side = 0; log2Side <= 32; ++log2Side)
  {
    const unsigned cell = log2Side > rootCellsLog2 ? log2Side - rootCellsLog2 : 0;
    space.origin = first & GridPosition(-(std::int64_t(1) << cell)); // rounds down
    const GridPosition reached = (last - space.origin) >> GridPosition(log2Side);
    if (reached == GridPosition(0))
    {
      return log2Side;
    }
  }
  return std::nullopt;
}

} // namespace pointfront
