#pragma once

#include "pointfront/Points/QuantisationGrid.h"
#include "pointfront/Style/ResolvedStyle.h"

#include <cstdint>
#include <vector>

namespace pointfront
{

/// The final colour of points [first, first + count) of a node that has the style's columns, as
/// bytes r, g, b, a in memory order; appended. Looks values up in the style's maps and combines two
/// colours. Back ends that compute neither use it; the others are tested against it.
void appendColours(const ResolvedStyle& style, const NodeColumns& node,
  const AttributeSchema& schema, const QuantisationGrid& grid, std::uint32_t first,
  std::uint32_t count, std::vector<std::uint32_t>& colours);

} // namespace pointfront
