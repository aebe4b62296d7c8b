#include "StyleJSON.h"

#include "pointfront/Style/TechniqueNames.h"

#include <nlohmann/json.hpp>

#include <array>
#include <charconv>
#include <initializer_list>
#include <optional>
#include <utility>

namespace pointfront
{
namespace
{

using Json = nlohmann::ordered_json;

Json colour(const ColourSource& source);

Json mapped(const ColourSource& source)
{
  const ColourMapChoice& map = source.map;
  if (map == ColourMapChoice() && source.attribute != "auto" && source.attribute[0] != '#')
  {
    return source.attribute;
  }
  Json result{ { "attribute", source.attribute } };
  switch (map.kind)
  {
    case ColourMapChoice::Kind::Automatic:
      break;
    case ColourMapChoice::Kind::Viridis:
      result["map"] = "viridis";
      break;
    case ColourMapChoice::Kind::Grey:
      result["map"] = "grey";
      break;
    case ColourMapChoice::Kind::Classification:
      result["map"] = "classification";
      break;
    case ColourMapChoice::Kind::Direct:
      result["map"] = "direct";
      break;
    case ColourMapChoice::Kind::Colours:
      for (const Rgba8& stop : map.colours)
      {
        result["map"].push_back(colourCode(stop));
      }
      break;
  }
  if (map.range)
  {
    result["range"] = *map.range;
  }
  if (map.logarithmic)
  {
    result["logarithmic"] = true;
  }
  return result;
}

Json combination(const ColourSource& source)
{
  const Json first = colour(source.parts.at(0));
  const Json second = colour(source.parts.at(1));
  switch (source.combination)
  {
    case ColourCombination::Mix:
      return { { "mix", Json::array({ first, second }) }, { "share", source.share } };
    case ColourCombination::HueValue:
      return { { "hue", first }, { "value", second } };
    case ColourCombination::None:
    case ColourCombination::Multiply:
      break;
  }
  return { { "multiply", Json::array({ first, second }) } };
}

Json colour(const ColourSource& source)
{
  switch (source.kind)
  {
    case ColourSource::Kind::Automatic:
      return "auto";
    case ColourSource::Kind::Constant:
      return colourCode(source.constant);
    case ColourSource::Kind::Combination:
      return combination(source);
    case ColourSource::Kind::Attribute:
      break;
  }
  return mapped(source);
}

Json size(const StyleSize& size)
{
  switch (size.mode)
  {
    case SplatSize::Mode::Pixels:
      return { { "mode", "fixed" }, { "px", size.value } };
    case SplatSize::Mode::World:
      return { { "mode", "fixed" }, { "metres", size.value } };
    case SplatSize::Mode::Spacing:
      return { { "mode", "spacing" }, { "factor", size.value } };
    case SplatSize::Mode::Attribute:
      break;
  }
  Json result{ { "mode", "attribute" } };
  if (!size.attribute.empty())
  {
    result["attribute"] = size.attribute;
  }
  result["factor"] = size.value;
  return result;
}

Json orientation(const StyleOrientation& orientation)
{
  switch (orientation.mode)
  {
    case SplatOrientation::Automatic:
      return "auto";
    case SplatOrientation::Normal:
      return "normal";
    case SplatOrientation::View:
      return "view";
    case SplatOrientation::Fixed:
      break;
  }
  const glm::dvec3& d = orientation.direction;
  return Json::array({ d.x, d.y, d.z });
}

const char* accuracy(SplatAccuracy accuracy)
{
  return accuracy == SplatAccuracy::Affine ? "affine"
    : accuracy == SplatAccuracy::Exact     ? "exact"
                                           : "full";
}

/// The double of the fewest digits that becomes this float again: 0.4, not 0.4000000059604645.
double briefly(float number)
{
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
  double brief = 0.0;
  std::from_chars(text.data(), end, brief);
  return brief;
}

/// `true`, `false`, or the numbers that are set, with `on` where that is false.
Json switched(bool on, std::initializer_list<std::pair<const char*, std::optional<float>>> numbers)
{
  Json result = Json::object();
  for (const auto& [key, number] : numbers)
  {
    if (number)
    {
      result[key] = briefly(*number);
    }
  }
  if (!on && !result.empty())
  {
    result["on"] = false;
  }
  return result.empty() ? Json(on) : result;
}

Json light(const StyleLight& light)
{
  return switched(light.on, { { "ambient", light.ambient }, { "diffuse", light.diffuse } });
}

Json eyeDome(const StyleEyeDome& eyeDome)
{
  return switched(
    eyeDome.on, { { "strength", eyeDome.strength }, { "radius_px", eyeDome.radiusPx } });
}

Json layerStyle(const LayerStyle& style)
{
  Json result = Json::object();
  const auto put = [&result](const char* key, const auto& value, auto convert)
  {
    if (value)
    {
      result[key] = convert(*value);
    }
  };
  const auto same = [](const auto& value) { return value; };
  put("technique", style.technique, [](Technique t) { return traitsOf(t).name; });
  put("color", style.colour, colour);
  put("size", style.size, size);
  put("orientation", style.orientation, orientation);
  put("opacity", style.opacity, same);
  put("visible", style.visible, same);
  put("error_factor", style.errorFactor, same);
  put("budget_share", style.budgetShare, same);
  put("blended", style.blended, same);
  put("accuracy", style.accuracy, accuracy);
  put("rim_color", style.rim, colourCode);
  put("wall_color", style.wall,
    [](const std::array<Rgba8, 2>& wall) {
      return Json::array({ colourCode(wall[0]), colourCode(wall[1]) });
    });
  put("where", style.where, [](const FilterExpression& filter) { return filter.text; });
  put("epoch", style.epoch, same);
  put("light", style.light, light);
  put("edl", style.eyeDome, eyeDome);
  return result;
}

Json shading(const FrameShading& shading)
{
  Json result = Json::object();
  Json modes = Json::array();
  if (shading.lit)
  {
    modes.push_back("lit");
  }
  if (shading.lit || shading.ambient != FrameLook().ambient)
  {
    result["ambient"] = briefly(shading.ambient);
  }
  if (shading.lit || shading.diffuse != FrameLook().diffuse)
  {
    result["diffuse"] = briefly(shading.diffuse);
  }
  if (shading.eyeDomeStrength > 0.0f)
  {
    modes.push_back("edl");
    result["strength"] = briefly(shading.eyeDomeStrength);
    result["radius_px"] = briefly(shading.eyeDomeRadiusPx);
  }
  result["mode"] = modes;
  if (shading.fillHoles)
  {
    result["fill_holes"] = true;
  }
  return result;
}

Json pixels(const glm::vec2& pair)
{
  return Json::array({ briefly(pair.x), briefly(pair.y) });
}

Json rowsOf(const LensMask& mask)
{
  Json rows = Json::array();
  const auto width = static_cast<std::size_t>(mask.width);
  for (auto row = static_cast<std::size_t>(mask.height); row-- > 0;)
  {
    std::string text;
    for (std::size_t column = 0; column < width; ++column)
    {
      text += mask.values[row * width + column] != 0 ? '#' : '.';
    }
    rows.push_back(text);
  }
  return rows;
}

Json lens(const StyleLens& written)
{
  Json result = Json::object();
  const FrameLens& place = written.place;
  switch (place.shape)
  {
    case LensShape::Circle:
      result["shape"] = "circle";
      result["center_px"] = pixels(place.centrePx);
      result["radius_px"] = briefly(place.halfSizePx.x);
      break;
    case LensShape::Rectangle:
      result["shape"] = "rectangle";
      result["center_px"] = pixels(place.centrePx);
      result["size_px"] = pixels(2.0f * place.halfSizePx);
      break;
    case LensShape::Mask:
      result["shape"] = "mask";
      result["mask"] = place.mask ? rowsOf(*place.mask) : Json::array({ "." });
      break;
    case LensShape::AroundClass:
      result["around_class"] = written.aroundClass;
      result["radius"] = written.aroundRadius;
      break;
  }
  result["inside"] = Json::object();
  if (!written.standard.empty())
  {
    result["inside"]["default"] = layerStyle(written.standard);
  }
  for (const auto& [code, style] : written.classes)
  {
    result["inside"][std::to_string(code)] = layerStyle(style);
  }
  return result;
}

} // namespace

std::string writeColour(const ColourSource& source)
{
  return colour(source).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string writeLayerStyle(const LayerStyle& style)
{
  return layerStyle(style).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string writeSize(const StyleSize& wanted)
{
  return size(wanted).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string writeStyleSheet(const StyleSheet& sheet)
{
  Json result = Json::object();
  if (!sheet.standard.empty())
  {
    result["default"] = layerStyle(sheet.standard);
  }
  for (const auto& [code, style] : sheet.classes)
  {
    result["classes"][std::to_string(code)] = layerStyle(style);
  }
  if (sheet.shownClasses)
  {
    result["show_classes"] = *sheet.shownClasses;
  }
  if (!sheet.where.empty())
  {
    result["where"] = sheet.where.text;
  }
  const FrameShading& shade = sheet.shading;
  if (!(shade == FrameShading()))
  {
    result["shading"] = shading(shade);
  }
  for (const StyleLens& one : sheet.lenses)
  {
    result["lenses"].push_back(lens(one));
  }
  for (const StyleHighlight& one : sheet.highlights)
  {
    result["highlight"].push_back(
      { { "class", one.objectClass }, { "color", colourCode(one.colour) },
        { "halo_px", briefly(one.haloPx) }, { "tint", briefly(one.tint) } });
  }
  constexpr int indent = 2;
  return result.dump(indent, ' ', false, Json::error_handler_t::replace);
}

} // namespace pointfront
