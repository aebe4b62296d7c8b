#pragma once

#include "pointfront/Points/QuantisationGrid.h"
#include "pointfront/Style/ResolvedStyle.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

namespace pointfront::test
{

inline std::uint32_t asBytes(const Rgba8& colour)
{
  std::uint32_t value;
  std::memcpy(&value, colour.data(), 4);
  return value;
}

inline Rgba8 fromBytes(std::uint32_t value)
{
  Rgba8 colour;
  std::memcpy(colour.data(), &value, 4);
  return colour;
}

/// Appends one of the two sources of a style's colours.
inline void appendOne(const PointColouring& colouring, const ColourMap* map, const Rgba8& flat,
  const NodeColumns& node, const AttributeSchema& schema, const QuantisationGrid& grid,
  std::vector<std::uint32_t>& colours)
{
  const std::size_t begin = colours.size();
  const auto count = static_cast<std::uint32_t>(node.size());
  switch (colouring.kind)
  {
    case PointColouring::Kind::Flat:
      colours.resize(begin + count, asBytes(flat));
      return;
    case PointColouring::Kind::Direct:
      colouring.encode(node, schema, 0, count, colours);
      return;
    case PointColouring::Kind::Elevation:
      for (const glm::u32vec3& position : node.positions)
      {
        const auto steps = static_cast<double>(node.origin.z + position.z);
        colours.push_back(asBytes(map->at(grid.offset.z + grid.scale.z * steps)));
      }
      return;
    case PointColouring::Kind::Table:
      colouring.encode(node, schema, 0, count, colours);
      for (std::size_t i = begin; i < colours.size(); ++i)
      {
        float number;
        std::memcpy(&number, &colours[i], 4);
        const auto value = static_cast<double>(number);
        colours[i] = asBytes(map->at(
          colouring.decades ? std::pow(10.0, value) : value * colouring.unit + colouring.base));
      }
      return;
  }
}

/// The final colours of the points of a node that has the style's columns, as bytes r, g, b, a in
/// memory order: what both back ends must give.
inline std::vector<std::uint32_t> referenceColours(const ResolvedStyle& style,
  const NodeColumns& node, const AttributeSchema& schema, const QuantisationGrid& grid)
{
  std::vector<std::uint32_t> colours;
  appendOne(style.colouring, style.map.get(), style.flat, node, schema, grid, colours);
  if (style.second.combination == ColourCombination::None)
  {
    return colours;
  }
  std::vector<std::uint32_t> others;
  appendOne(
    style.second.colouring, style.second.map.get(), style.second.flat, node, schema, grid, others);
  for (std::size_t i = 0; i < others.size(); ++i)
  {
    colours[i] = asBytes(combined(style.second.combination, style.second.share256,
      fromBytes(colours[i]), fromBytes(others[i])));
  }
  return colours;
}

} // namespace pointfront::test
