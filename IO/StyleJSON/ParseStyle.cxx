#include "StyleJSON.h"

#include "JSONText.h"
#include "LayerStyleJSON.h"

#include <charconv>
#include <set>
#include <utility>

namespace pointfront
{
namespace
{

/// `read`: what a place means; its refusals get the line they are of.
template <typename Meaning>
auto readFrom(std::string_view text, const Meaning& read)
  -> Result<decltype(read(std::declval<JSONPlace>()))>
{
  const Result<JSONText> parsed = JSONText::parse(std::string(text), JSONText::Keys::Unique);
  if (!parsed)
  {
    return makeError(Error::Kind::BadArgument, parsed.error().what);
  }
  try
  {
    return read(JSONPlace(parsed->value(), ""));
  }
  catch (const JSONRefusal& refusal)
  {
    return makeError(Error::Kind::BadArgument,
      (refusal.value ? parsed->lineOf(*refusal.value) : std::string()) + refusal.what);
  }
}

} // namespace

std::uint8_t classCode(const JSONPlace& place, const std::string& text)
{
  int code = -1;
  const char* const end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(text.data(), end, code);
  const bool plain = text == std::to_string(code); // no 06, which would be a second 6
  if (failure != std::errc() || stop != end || !plain || code < 0 || code > 255)
  {
    place.refuse("a class is a code from 0 to 255");
  }
  return static_cast<std::uint8_t>(code);
}

namespace
{

void addShadingMode(const JSONPlace& place, bool& lit, bool& eyeDome)
{
  const int mode = oneOf<int>(place, { { "none", 0 }, { "lit", 1 }, { "edl", 2 } });
  lit = lit || mode == 1;
  eyeDome = eyeDome || mode == 2;
}

/// `style`: the default. The mode none says that it has no light, though it may be of spheres.
FrameShading shadingAt(const JSONPlace& place, LayerStyle& style)
{
  place.expectKeys({ "mode", "strength", "radius_px", "ambient", "diffuse", "fill_holes" });
  FrameShading shading;
  bool eyeDome = false;
  if (place.has("mode"))
  {
    const JSONPlace mode = place.at("mode");
    for (std::size_t i = 0; mode.isArray() && i < mode.value().size(); ++i)
    {
      addShadingMode(mode.at(i), shading.lit, eyeDome);
    }
    if (!mode.isArray())
    {
      addShadingMode(mode, shading.lit, eyeDome);
      if (!shading.lit && !eyeDome && !style.light)
      {
        style.light = StyleLight{ false, {}, {} };
      }
    }
  }
  for (const char* key : { "strength", "radius_px" })
  {
    if (place.has(key) && !eyeDome)
    {
      place.at(key).refuse("means something with the mode edl only");
    }
  }
  const auto number = [&place](const char* key, double usual, double most)
  { return static_cast<float>(place.has(key) ? place.at(key).number(0.0, most) : usual); };
  if (eyeDome)
  {
    shading.eyeDomeStrength = number("strength", usualEyeDomeStrength, mostEyeDomeStrength);
    shading.eyeDomeRadiusPx = number("radius_px", shading.eyeDomeRadiusPx, mostEyeDomeRadiusPx);
  }
  shading.ambient = number("ambient", shading.ambient, mostLight);
  shading.diffuse = number("diffuse", shading.diffuse, mostLight);
  shading.fillHoles = place.has("fill_holes") && place.at("fill_holes").truth();
  return shading;
}

std::vector<std::uint8_t> codesAt(const JSONPlace& place)
{
  if (!place.isArray())
  {
    place.refuse("expected a list of class codes, not " + place.shown());
  }
  std::set<std::uint8_t> codes;
  for (std::size_t i = 0; i < place.value().size(); ++i)
  {
    codes.insert(classCode(place.at(i), place.at(i).shown()));
  }
  return std::vector<std::uint8_t>(codes.begin(), codes.end());
}

StyleSheet sheetAt(const JSONPlace& place)
{
  place.expectKeys(
    { "default", "classes", "show_classes", "where", "shading", "lenses", "highlight" });
  StyleSheet sheet;
  if (place.has("default"))
  {
    sheet.standard = layerStyleAt(place.at("default"));
  }
  if (place.has("classes"))
  {
    const JSONPlace classes = place.at("classes");
    if (!classes.isObject())
    {
      classes.refuse("expected an object with class codes as keys, not " + classes.shown());
    }
    for (const auto& [key, unused] : classes.value().items())
    {
      static_cast<void>(unused);
      const JSONPlace one = classes.at(key);
      sheet.classes[classCode(one, key)] = layerStyleAt(one);
    }
  }
  if (place.has("show_classes"))
  {
    sheet.shownClasses = codesAt(place.at("show_classes"));
  }
  if (place.has("where"))
  {
    sheet.where = filterAt(place.at("where"));
  }
  if (place.has("shading"))
  {
    sheet.shading = shadingAt(place.at("shading"), sheet.standard);
  }
  if (place.has("lenses"))
  {
    sheet.lenses = lensesAt(place.at("lenses"));
  }
  if (place.has("highlight"))
  {
    sheet.highlights = highlightsAt(place.at("highlight"));
  }
  for (const char* key : { "ambient", "diffuse" })
  {
    if (place.has("shading") && place.at("shading").has(key) && !sheet.frameShading().anyLit())
    {
      place.at("shading").at(key).refuse("means something where points are lit only");
    }
  }
  return sheet;
}

} // namespace

Result<LayerStyle> parseLayerStyle(std::string_view text)
{
  return readFrom(text, layerStyleAt);
}

Result<StyleSheet> parseStyleSheet(std::string_view text)
{
  return readFrom(text, sheetAt);
}

} // namespace pointfront
