#include "pointfront/Style/PointColours.h"

#include <cstring>

namespace pointfront
{
namespace
{

std::uint32_t asBytes(const Rgba8& colour)
{
  std::uint32_t value;
  std::memcpy(&value, colour.data(), 4);
  return value;
}

Rgba8 fromBytes(std::uint32_t value)
{
  Rgba8 colour;
  std::memcpy(colour.data(), &value, 4);
  return colour;
}

void appendOne(const PointColouring& colouring, const ColourMap* map, const Rgba8& flat,
  const NodeColumns& node, const AttributeSchema& schema, const QuantisationGrid& grid,
  std::uint32_t first, std::uint32_t count, std::vector<std::uint32_t>& colours)
{
  const std::size_t begin = colours.size();
  switch (colouring.kind)
  {
    case PointColouring::Kind::Flat:
      colours.resize(begin + count, asBytes(flat));
      return;
    case PointColouring::Kind::Direct:
      colouring.encode(node, schema, first, count, colours);
      return;
    case PointColouring::Kind::Elevation:
      for (std::uint32_t i = first; i < first + count; ++i)
      {
        const auto steps = static_cast<double>(node.origin.z + node.positions[i].z);
        colours.push_back(asBytes(map->at(grid.offset.z + grid.scale.z * steps)));
      }
      return;
    case PointColouring::Kind::Table:
      colouring.encode(node, schema, first, count, colours);
      for (std::size_t i = begin; i < colours.size(); ++i)
      {
        float number;
        std::memcpy(&number, &colours[i], 4);
        colours[i] = asBytes(map->at(static_cast<double>(number) + colouring.base));
      }
      return;
  }
}

} // namespace

void appendColours(const ResolvedStyle& style, const NodeColumns& node,
  const AttributeSchema& schema, const QuantisationGrid& grid, std::uint32_t first,
  std::uint32_t count, std::vector<std::uint32_t>& colours)
{
  const std::size_t begin = colours.size();
  appendOne(
    style.colouring, style.map.get(), style.flat, node, schema, grid, first, count, colours);
  if (style.second.combination == ColourCombination::None)
  {
    return;
  }
  std::vector<std::uint32_t> others;
  appendOne(style.second.colouring, style.second.map.get(), style.second.flat, node, schema, grid,
    first, count, others);
  for (std::size_t i = 0; i < others.size(); ++i)
  {
    colours[begin + i] = asBytes(combined(style.second.combination, style.second.share256,
      fromBytes(colours[begin + i]), fromBytes(others[i])));
  }
}

} // namespace pointfront
