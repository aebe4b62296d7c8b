#include "LayerStyleJSON.h"

#include "pointfront/Style/TechniqueNames.h"

#include <glm/geometric.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

Rgba8 colourCodeAt(const JSONPlace& place)
{
  const std::optional<Rgba8> colour = parseColourCode(place.text("a colour, \"#rrggbb\""));
  if (!colour)
  {
    place.refuse("expected a colour, \"#rrggbb\", not " + place.shown());
  }
  return *colour;
}

FilterExpression filterAt(const JSONPlace& place)
{
  const Result<FilterExpression> filter = FilterExpression::parse(place.text("a condition"));
  if (!filter)
  {
    place.refuse(filter.error().what);
  }
  return *filter;
}

namespace
{

std::array<double, 2> rangeAt(const JSONPlace& place)
{
  if (!place.isArray() || place.value().size() != 2)
  {
    place.refuse("expected \"auto\" or two numbers, [low, high], not " + place.shown());
  }
  const std::array<double, 2> range{ place.at(std::size_t(0)).number(),
    place.at(std::size_t(1)).number() };
  if (!(range[0] < range[1]))
  {
    place.refuse("expected the smaller number first, not " + place.shown());
  }
  return range;
}

ColourMapChoice mapAt(const JSONPlace& colour)
{
  ColourMapChoice map;
  if (colour.has("map") && colour.at("map").isArray())
  {
    const JSONPlace list = colour.at("map");
    map.kind = ColourMapChoice::Kind::Colours;
    for (std::size_t i = 0; i < list.value().size(); ++i)
    {
      map.colours.push_back(colourCodeAt(list.at(i)));
    }
    if (map.colours.empty())
    {
      list.refuse("expected at least one colour");
    }
  }
  else if (colour.has("map"))
  {
    using Kind = ColourMapChoice::Kind;
    map.kind = oneOf<Kind>(colour.at("map"),
      { { "auto", Kind::Automatic }, { "viridis", Kind::Viridis }, { "grey", Kind::Grey },
        { "classification", Kind::Classification }, { "direct", Kind::Direct } });
  }
  if (colour.has("range") && colour.at("range").value() != "auto")
  {
    map.range = rangeAt(colour.at("range"));
  }
  map.logarithmic = colour.has("logarithmic") && colour.at("logarithmic").truth();
  if (map.logarithmic && map.range && !(map.range->front() > 0.0))
  {
    colour.at("range").refuse("a logarithmic map needs a range above 0");
  }
  if (map.kind == ColourMapChoice::Kind::Classification && (map.range || map.logarithmic))
  {
    colour.refuse("the map 'classification' has a colour for each code: neither range nor "
                  "logarithmic apply");
  }
  return map;
}

ColourSource colourAt(const JSONPlace& place);

ColourSource partAt(const JSONPlace& place)
{
  if (place.has("multiply") || place.has("mix") || place.has("hue"))
  {
    place.refuse("a combination is of two colours that are none themselves");
  }
  return colourAt(place);
}

ColourSource pairAt(const JSONPlace& place, ColourCombination combination, double share)
{
  if (!place.isArray() || place.value().size() != 2)
  {
    place.refuse("expected two colours, [first, second]");
  }
  return ColourSource::ofTwo(
    combination, partAt(place.at(std::size_t(0))), partAt(place.at(std::size_t(1))), share);
}

ColourSource colourAt(const JSONPlace& place)
{
  if (place.isString())
  {
    const std::string text = place.text("");
    if (text == "auto")
    {
      return ColourSource();
    }
    if (text.empty() || text[0] == '#')
    {
      return ColourSource::ofConstant(colourCodeAt(place));
    }
    return ColourSource::ofAttribute(text);
  }
  if (place.has("multiply"))
  {
    place.expectKeys({ "multiply" });
    return pairAt(place.at("multiply"), ColourCombination::Multiply, 0.5);
  }
  if (place.has("mix"))
  {
    place.expectKeys({ "mix", "share" });
    const double share = place.has("share") ? place.at("share").number(0.0, 1.0) : 0.5;
    return pairAt(place.at("mix"), ColourCombination::Mix, share);
  }
  if (place.has("hue"))
  {
    place.expectKeys({ "hue", "value" });
    if (!place.has("value"))
    {
      place.refuse("expected the key value beside hue");
    }
    return ColourSource::ofTwo(
      ColourCombination::HueValue, partAt(place.at("hue")), partAt(place.at("value")));
  }
  if (!place.has("attribute"))
  {
    place.refuse("expected \"#rrggbb\", an attribute's name, or an object with attribute, "
                 "multiply, mix or hue, not " +
      place.shown());
  }
  place.expectKeys({ "attribute", "map", "range", "logarithmic" });
  const std::string name = place.at("attribute").text("an attribute's name");
  if (name.empty())
  {
    place.at("attribute").refuse("expected an attribute's name");
  }
  return ColourSource::ofAttribute(name, mapAt(place));
}

StyleSize sizeAt(const JSONPlace& place)
{
  enum class Mode
  {
    Fixed,
    Spacing,
    Attribute
  };
  place.expectKeys({ "mode", "px", "metres", "factor", "attribute" });
  if (!place.has("mode"))
  {
    place.refuse("expected the key mode");
  }
  const Mode mode = oneOf<Mode>(place.at("mode"),
    { { "fixed", Mode::Fixed }, { "spacing", Mode::Spacing }, { "attribute", Mode::Attribute } });
  StyleSize size;
  if (mode == Mode::Fixed)
  {
    place.expectKeys({ "mode", "px", "metres" });
    const bool pixels = place.has("px");
    if (pixels == place.has("metres"))
    {
      place.refuse("a fixed size has either px or metres");
    }
    size.mode = pixels ? SplatSize::Mode::Pixels : SplatSize::Mode::World;
    size.value = place.at(pixels ? "px" : "metres").positive();
    return size;
  }
  size.value = place.has("factor") ? place.at("factor").positive() : 1.0;
  if (mode == Mode::Spacing)
  {
    place.expectKeys({ "mode", "factor" });
    return size;
  }
  place.expectKeys({ "mode", "attribute", "factor" });
  size.mode = SplatSize::Mode::Attribute;
  size.attribute = place.has("attribute") ? place.at("attribute").text("an attribute's name") : "";
  return size;
}

StyleOrientation orientationAt(const JSONPlace& place)
{
  StyleOrientation orientation;
  if (place.isString())
  {
    orientation.mode = oneOf<SplatOrientation>(place,
      { { "auto", SplatOrientation::Automatic }, { "normal", SplatOrientation::Normal },
        { "view", SplatOrientation::View } });
    return orientation;
  }
  if (!place.isArray() || place.value().size() != 3)
  {
    place.refuse(
      "expected \"auto\", \"normal\", \"view\" or a vector [x, y, z], not " + place.shown());
  }
  orientation.mode = SplatOrientation::Fixed;
  for (int axis = 0; axis < 3; ++axis)
  {
    orientation.direction[axis] = place.at(static_cast<std::size_t>(axis)).number(-1e9, 1e9);
  }
  if (!(glm::length(orientation.direction) > 1e-9))
  {
    place.refuse("a vector of length 0 has no direction");
  }
  return orientation;
}

Technique techniqueAt(const JSONPlace& place)
{
  const std::string name = place.text("a technique");
  const std::optional<Technique> technique = techniqueOf(name);
  if (!technique)
  {
    std::vector<std::string> known;
    for (const TechniqueTraits& traits : techniqueTraits)
    {
      known.emplace_back(traits.name);
    }
    place.refuse("'" + name + "' is unknown: use " + techniqueList() + didYouMean(name, known));
  }
  return *technique;
}

std::array<Rgba8, 2> wallAt(const JSONPlace& place)
{
  if (place.isString())
  {
    const Rgba8 both = colourCodeAt(place);
    return { both, both };
  }
  if (!place.isArray() || place.value().size() != 2)
  {
    place.refuse("expected one colour or two, [upper, lower], not " + place.shown());
  }
  return { colourCodeAt(place.at(std::size_t(0))), colourCodeAt(place.at(std::size_t(1))) };
}

/// A number of an object, as far as the key is there.
std::optional<float> numberOf(const JSONPlace& place, const char* key, double most)
{
  return place.has(key) ? std::optional<float>(static_cast<float>(place.at(key).number(0.0, most)))
                        : std::nullopt;
}

/// Whether it is on: an object is, unless its key `on` is false.
bool switchAt(const JSONPlace& place)
{
  if (!place.value().is_boolean() && !place.isObject())
  {
    place.refuse("expected true, false or an object, not " + place.shown());
  }
  return place.isObject() ? !place.has("on") || place.at("on").truth() : place.truth();
}

/// A number of what can be switched on: its key, its place in the value, and its largest value.
template <typename Switched>
struct SwitchedNumber
{
  const char* key;
  std::optional<float> Switched::*number;
  double most;
};

/// A switch, or an object with two numbers of what it switches on.
template <typename Switched>
Switched switchedAt(const JSONPlace& place, const SwitchedNumber<Switched>& first,
  const SwitchedNumber<Switched>& second)
{
  Switched switched;
  switched.on = switchAt(place);
  if (place.isObject())
  {
    place.expectKeys({ "on", first.key, second.key });
    for (const SwitchedNumber<Switched>& one : { first, second })
    {
      switched.*one.number = numberOf(place, one.key, one.most);
    }
  }
  return switched;
}

StyleLight lightAt(const JSONPlace& place)
{
  return switchedAt<StyleLight>(place, { "ambient", &StyleLight::ambient, mostLight },
    { "diffuse", &StyleLight::diffuse, mostLight });
}

StyleEyeDome eyeDomeAt(const JSONPlace& place)
{
  return switchedAt<StyleEyeDome>(place,
    { "strength", &StyleEyeDome::strength, mostEyeDomeStrength },
    { "radius_px", &StyleEyeDome::radiusPx, mostEyeDomeRadiusPx });
}

} // namespace

LayerStyle layerStyleAt(const JSONPlace& place)
{
  place.expectKeys({ "technique", "color", "size", "orientation", "opacity", "visible",
    "error_factor", "budget_share", "blended", "accuracy", "rim_color", "wall_color", "where",
    "epoch", "light", "edl" });
  LayerStyle style;
  const auto read = [&place](const char* key, auto& target, auto reader)
  {
    if (place.has(key))
    {
      target = reader(place.at(key));
    }
  };
  read("technique", style.technique, techniqueAt);
  read("color", style.colour, colourAt);
  read("size", style.size, sizeAt);
  read("orientation", style.orientation, orientationAt);
  read("opacity", style.opacity, [](const JSONPlace& at) { return at.number(0.0, 1.0); });
  read("visible", style.visible, [](const JSONPlace& at) { return at.truth(); });
  read("error_factor", style.errorFactor, [](const JSONPlace& at) { return at.positive(); });
  read("budget_share", style.budgetShare, [](const JSONPlace& at) { return at.number(0.0, 1.0); });
  read("blended", style.blended, [](const JSONPlace& at) { return at.truth(); });
  read("accuracy", style.accuracy,
    [](const JSONPlace& at)
    {
      return oneOf<SplatAccuracy>(at,
        { { "affine", SplatAccuracy::Affine }, { "exact", SplatAccuracy::Exact },
          { "full", SplatAccuracy::Full } });
    });
  read("rim_color", style.rim, colourCodeAt);
  read("wall_color", style.wall, wallAt);
  read("where", style.where, filterAt);
  read("epoch", style.epoch, [](const JSONPlace& at) { return at.text("the name of an epoch"); });
  read("light", style.light, lightAt);
  read("edl", style.eyeDome, eyeDomeAt);
  return style;
}

} // namespace pointfront
