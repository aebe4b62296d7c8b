#include "pointfront/Style/ColourSource.h"

#include "pointfront/Base/Infinity.h"

#include "pointfront/Base/LetterCase.h"
#include "pointfront/Points/AttributeNames.h"
#include "pointfront/Style/ComponentName.h"
#include "pointfront/Style/StandardColours.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace pointfront
{
namespace
{

/// Smallest and largest stored value over all components; {0, 0} if it is not known.
std::array<double, 2> storedRange(const StoreDescription& store, std::size_t column)
{
  std::array<double, 2> range{ infinity, -infinity };
  if (column < store.ranges.size())
  {
    for (const std::array<double, 2>& component : store.ranges[column].components)
    {
      range = { std::min(range[0], component[0]), std::max(range[1], component[1]) };
    }
  }
  return range[0] <= range[1] ? range : std::array<double, 2>{ 0.0, 0.0 };
}

bool varies(const StoreDescription& store, const char* attribute)
{
  const std::optional<std::size_t> column = store.schema.find(attribute);
  return column && storedRange(store, *column)[0] < storedRange(store, *column)[1];
}

Error missing(const StoreDescription& store, const std::string& name)
{
  std::string hint = " (info lists them)" + meantAttribute(store.schema, name);
  const std::string plain = withUnderscores(name);
  if (sameWithoutCase(plain, "horizontality") || sameWithoutCase(plain, "normal"))
  {
    hint = ": build it with --normals pca";
  }
  else if (sameWithoutCase(plain, "local_height"))
  {
    hint = ": build it with --local-height";
  }
  const bool ofNormals = sameWithoutCase(plain, "horizontality");
  return makeError(Error::Kind::BadArgument,
    (store.path.empty() ? "the store" : store.path) + " has no attribute '" +
      (ofNormals ? "normal" : name) + "'" + (ofNormals ? ", which horizontality needs" : "") +
      hint);
}

/// How one name is met: the request, and what a map is made of.
struct Meaning
{
  ColourRequest request;
  bool derived = false; ///< horizontality, global_height: from 0 to 1
  const Attribute* attribute = nullptr;
};

Result<Meaning> meaningOf(const ColourSource& source, const StoreDescription& store)
{
  Meaning meaning;
  const auto part = findComponent(store.schema, source.attribute);
  if (!part)
  {
    meaning.request.name = withUnderscores(source.attribute);
    meaning.derived = !sameWithoutCase(meaning.request.name, "elevation");
    return meaning;
  }
  const Attribute& attribute = store.schema[part->column];
  meaning.attribute = &attribute;
  meaning.request.name = attribute.name;
  const ColourMapChoice::Kind map = source.map.kind;
  const bool automatic = map == ColourMapChoice::Kind::Automatic;
  if (part->component || attribute.components == 1)
  {
    meaning.request.mode = ColourRequest::Mode::Table;
    meaning.request.component = part->component.value_or(0);
    if (map == ColourMapChoice::Kind::Direct)
    {
      return makeError(Error::Kind::BadArgument,
        "'" + source.attribute + "' is one number and cannot be a colour by itself");
    }
    return meaning;
  }
  const bool normal = automatic && attribute.name == "normal" && attribute.components == 3;
  if (map == ColourMapChoice::Kind::Direct || normal)
  {
    meaning.request.mode = ColourRequest::Mode::Direct;
    meaning.request.colourRange = source.map.range.value_or(
      normal ? std::array<double, 2>{ -1.0, 1.0 } : std::array<double, 2>{ 0.0, 1.0 });
  }
  const auto colouring = PointColouring::choose(store, meaning.request);
  if ((!automatic && map != ColourMapChoice::Kind::Direct) || !colouring ||
    colouring->kind != PointColouring::Kind::Direct)
  {
    return makeError(Error::Kind::BadArgument,
      "'" + source.attribute + "' has " + std::to_string(attribute.components) +
        " components and cannot be mapped to colours: name one of them, " + source.attribute +
        "[0]");
  }
  return meaning;
}

std::vector<Rgba8> entriesOf(const ColourMapChoice& choice, bool grey)
{
  switch (choice.kind)
  {
    case ColourMapChoice::Kind::Grey:
      return greyColours();
    case ColourMapChoice::Kind::Colours:
      return coloursBetween(choice.colours);
    default:
      break;
  }
  return grey && choice.kind == ColourMapChoice::Kind::Automatic ? greyColours() : viridisColours();
}

Result<std::shared_ptr<const ColourMap>> makeMap(const ColourSource& source,
  const StoreDescription& store, const Meaning& meaning, const AttributeRanges* ranges)
{
  const ColourMapChoice& choice = source.map;
  auto map = std::make_shared<ColourMap>();
  const bool classes = choice.kind == ColourMapChoice::Kind::Classification ||
    (choice.kind == ColourMapChoice::Kind::Automatic && !choice.range && meaning.attribute &&
      meaning.attribute->name == "classification");
  if (classes)
  {
    map->entries = classificationColours();
    map->range = { 0.0, 255.0 };
    map->indexed = true;
    map->missing = map->entries.back();
    return std::shared_ptr<const ColourMap>(map);
  }
  map->entries = entriesOf(choice, meaning.attribute && meaning.attribute->name == "intensity");
  map->logarithmic = choice.logarithmic;
  if (choice.range)
  {
    map->range = *choice.range;
  }
  else if (!meaning.derived)
  {
    map->range = AttributeRanges::whole(store, source.attribute);
    if (ranges)
    {
      const Result<std::array<double, 2>> sampled = ranges->of(source.attribute);
      if (!sampled)
      {
        return sampled.error();
      }
      map->range = *sampled;
    }
  }
  if (map->logarithmic && !(map->range[0] > 0.0))
  {
    return makeError(Error::Kind::BadArgument,
      "a logarithmic map needs values above 0, and those of '" + source.attribute + "' begin at " +
        std::to_string(map->range[0]));
  }
  return std::shared_ptr<const ColourMap>(map);
}

} // namespace

ColourSource ColourSource::ofAttribute(std::string name, ColourMapChoice map)
{
  ColourSource source;
  source.kind = Kind::Attribute;
  source.attribute = std::move(name);
  source.map = std::move(map);
  return source;
}

ColourSource ColourSource::ofConstant(const Rgba8& colour)
{
  ColourSource source;
  source.kind = Kind::Constant;
  source.constant = colour;
  return source;
}

ColourSource ColourSource::ofTwo(
  ColourCombination combination, ColourSource first, ColourSource second, double share)
{
  ColourSource source;
  source.kind = Kind::Combination;
  source.combination = combination;
  source.share = share;
  source.parts = { std::move(first), std::move(second) };
  return source;
}

Result<ResolvedColour> resolveColour(
  const ColourSource& source, const StoreDescription& store, const StoreSurroundings& surroundings)
{
  assert(source.kind != ColourSource::Kind::Combination);
  if (source.kind == ColourSource::Kind::Automatic)
  {
    return resolveColour(
      ColourSource::ofAttribute(defaultColourAttribute(store)), store, surroundings);
  }
  ResolvedColour colour;
  if (source.kind == ColourSource::Kind::Constant)
  {
    colour.flat = source.constant;
    return colour;
  }
  const Result<Meaning> meaning = meaningOf(source, store);
  if (!meaning)
  {
    return meaning.error();
  }
  const bool heightsMissing =
    PointColouring::wantsHeights(store, meaning->request) && !surroundings.heights;
  assert(!heightsMissing);
  const auto colouring = PointColouring::choose(store, meaning->request, surroundings.heights);
  if (!colouring || heightsMissing)
  {
    const AttributeRanges* const others = surroundings.ranges;
    const bool elsewhere = others &&
      (others->has(source.attribute) ||
        (sameWithoutCase(source.attribute, "horizontality") && others->has("normal")));
    return elsewhere ? Result<ResolvedColour>(colour) : missing(store, source.attribute);
  }
  colour.colouring = *colouring;
  if (colouring->usesTable())
  {
    const auto map = makeMap(source, store, *meaning, surroundings.ranges);
    if (!map)
    {
      return map.error();
    }
    colour.map = *map;
    colour.colouring.fitTo(**map);
  }
  return colour;
}

std::string defaultColourAttribute(const StoreDescription& store)
{
  const std::optional<std::size_t> rgb = store.schema.find("rgb");
  if (rgb && storedRange(store, *rgb)[1] > 0.0)
  {
    return "rgb";
  }
  for (const char* attribute : { "classification", "intensity" })
  {
    if (varies(store, attribute))
    {
      return attribute;
    }
  }
  return "elevation";
}

std::optional<Rgba8> parseColourCode(const std::string& text)
{
  if (text.size() != 7 || text[0] != '#')
  {
    return std::nullopt;
  }
  Rgba8 colour{ 0, 0, 0, 255 };
  for (std::size_t i = 1; i < text.size(); ++i)
  {
    const std::size_t digit = std::string("0123456789abcdef0123456789ABCDEF").find(text[i]);
    if (digit == std::string::npos)
    {
      return std::nullopt;
    }
    std::uint8_t& channel = colour[(i - 1) / 2];
    channel = static_cast<std::uint8_t>(16 * channel + digit % 16);
  }
  return colour;
}

std::string colourCode(const Rgba8& colour)
{
  std::string text = "#";
  for (std::size_t channel = 0; channel < 3; ++channel)
  {
    text += "0123456789abcdef"[colour[channel] / 16];
    text += "0123456789abcdef"[colour[channel] % 16];
  }
  return text;
}

} // namespace pointfront
