#include "ColourLegend.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

namespace pointfront
{
namespace
{

constexpr int rampSteps = 16; // between which a page mixes
constexpr std::size_t mostValues = 256;

std::string hexOf(const Rgba8& colour)
{
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", colour[0], colour[1], colour[2]);
  return text.data();
}

std::string nameOf(const StoreDescription& store, const PointColouring& colouring)
{
  if (colouring.kind == PointColouring::Kind::Elevation)
  {
    return "elevation";
  }
  if (colouring.heights)
  {
    return "global_height";
  }
  const std::string& name = store.schema[colouring.column].name;
  return name == "normal" && colouring.absolute ? "horizontality" : name;
}

} // namespace

nlohmann::ordered_json colourLegend(const StoreDescription& store, const ResolvedStyle& style)
{
  if (!style.colouring.usesTable() || !style.map)
  {
    return nullptr;
  }
  const ColourMap& map = *style.map;
  nlohmann::ordered_json legend;
  legend["attribute"] = nameOf(store, style.colouring);
  if (map.indexed && map.entries.size() <= mostValues)
  {
    auto& values = legend["values"] = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < map.entries.size(); ++i)
    {
      values.push_back({ map.range[0] + static_cast<double>(i), hexOf(map.entries[i]) });
    }
    return legend;
  }
  legend["range"] = { map.range[0], map.range[1] };
  auto& colours = legend["colours"] = nlohmann::ordered_json::array();
  for (int i = 0; i <= rampSteps; ++i)
  {
    const double part = static_cast<double>(i) / rampSteps;
    const double low = map.range[0];
    const double value = map.logarithmic ? low * std::pow(map.range[1] / low, part)
                                         : low * (1.0 - part) + part * map.range[1];
    colours.push_back(hexOf(map.at(value)));
  }
  return legend;
}

} // namespace pointfront
