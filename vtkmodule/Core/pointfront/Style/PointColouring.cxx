#include "pointfront/Style/PointColouring.h"

#include "pointfront/Base/Infinity.h"
#include "pointfront/Base/LetterCase.h"
#include "pointfront/Store/ColumnStatistics.h"
#include "pointfront/Style/ClassHeights.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>

namespace pointfront
{
namespace
{

/// Longest table of one entry for each integer; longer ones are sampled.
constexpr std::int64_t mostIntegers = 8192;
/// Floats hold all whole numbers up to this one.
constexpr double mostExact = 1 << 24;
/// Entries of a longer map differ by less than colours of 8 bits tell apart.
constexpr double mostEntries = 1024.0;
/// How far from the base the ends of a range of one entry may lie. Two floats so far are rounded,
/// the value and the range's low end, by 2^-24 of it each: together 1/512 of an entry, by which
/// entries begin early (ColourMap.cxx).
constexpr double mostFromBase = 1 << 14;
/// Floats hold 2 to this power and its inverse, and as many of them as a map has entries.
constexpr int mostExponent = 100;
constexpr double mostInFloats = 0x1p100;
constexpr double largest = std::numeric_limits<double>::max();
constexpr int leastUnit = -1000; ///< exponent; doubles hold its inverse

bool isInteger(ScalarType type)
{
  return type != ScalarType::Float32 && type != ScalarType::Float64;
}

template <typename T>
double as(const std::byte* bytes)
{
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

/// One component as a number; the type is resolved once for a run of points.
using Reading = double (*)(const std::byte*);
Reading readingOf(ScalarType type)
{
  return visitScalar(type, [](auto zero) -> Reading { return as<decltype(zero)>; });
}

double farthestOf(const std::array<double, 2>& range, double from)
{
  return std::max(std::abs(range[0] - from), std::abs(range[1] - from));
}

std::uint32_t packed(const std::array<std::uint8_t, 4>& rgba)
{
  std::uint32_t value;
  std::memcpy(&value, rgba.data(), 4);
  return value;
}

std::uint32_t packed(float number)
{
  std::uint32_t value;
  std::memcpy(&value, &number, 4);
  return value;
}

bool isWideColour(const Attribute& attribute)
{
  return sameWithoutCase(attribute.name, "rgb") && attribute.type == ScalarType::UInt16;
}

bool isColour(const Attribute& attribute, ColourRequest::Mode mode)
{
  if (mode == ColourRequest::Mode::Table ||
    (attribute.components != 3 && attribute.components != 4))
  {
    return false;
  }
  return mode == ColourRequest::Mode::Direct || attribute.type == ScalarType::UInt8 ||
    isWideColour(attribute);
}

} // namespace

ColourScale::ColourScale(const Attribute& attribute, bool wide, const std::array<double, 2>& range)
{
  if (isInteger(attribute.type) && attribute.scale == 1.0 && attribute.offset == 0.0)
  {
    const double most = std::ldexp(1.0, static_cast<int>(8 * sizeOf(attribute.type)));
    factor = wide ? 256.0 / most : 1.0;
    return;
  }
  // VTK's convention: what is no integer is a colour from 0 to 1, or over the table's range.
  const double width = range[1] - range[0];
  const double full = width != 0.0 ? 255.0 / width : 0.0;
  factor = attribute.scale * full;
  offset = (attribute.offset - range[0]) * full;
}

bool PointColouring::wantsHeights(const StoreDescription& description, const ColourRequest& request)
{
  return sameWithoutCase(request.name, "global_height") && !description.schema.find(request.name);
}

/// An attribute that the store has not, made of what it has.
std::optional<PointColouring> PointColouring::derived(const StoreDescription& description,
  const ColourRequest& request, std::shared_ptr<const ClassHeights> heights)
{
  PointColouring colouring;
  if (sameWithoutCase(request.name, "elevation"))
  {
    colouring.kind = Kind::Elevation;
    return colouring;
  }
  colouring.kind = Kind::Table;
  if (heights && wantsHeights(description, request))
  {
    colouring.heights = std::move(heights);
    return colouring;
  }
  const auto normal = description.schema.find("normal");
  if (sameWithoutCase(request.name, "horizontality") && normal &&
    description.schema[*normal].components == 3)
  {
    colouring.column = static_cast<std::uint32_t>(*normal);
    colouring.component = 2;
    colouring.absolute = true;
    return colouring;
  }
  return std::nullopt;
}

std::optional<PointColouring> PointColouring::choose(const StoreDescription& description,
  const ColourRequest& request, std::shared_ptr<const ClassHeights> heights)
{
  PointColouring colouring;
  if (request.name.empty())
  {
    return colouring;
  }
  const auto column = description.schema.find(request.name);
  if (!column)
  {
    return derived(description, request, std::move(heights));
  }
  const Attribute& attribute = description.schema[*column];
  const auto& ranges = description.ranges[*column].components;
  colouring.column = static_cast<std::uint32_t>(*column);
  const bool wide =
    std::any_of(ranges.begin(), ranges.end(), [](const auto& range) { return range[1] > 255.0; });
  if (isColour(attribute, request.mode))
  {
    colouring.kind = Kind::Direct;
    colouring.colourRange = request.colourRange;
    colouring.wide = wide;
    return colouring;
  }
  colouring.kind = Kind::Table;
  colouring.wide = wide && request.coloursInBytes && isWideColour(attribute);
  colouring.component =
    attribute.components == 1 ? 0 : std::min<int>(request.component, attribute.components - 1);
  if (colouring.component >= 0)
  {
    const auto component = static_cast<std::size_t>(colouring.component);
    const auto& range = ranges[component];
    const auto certain = certainRange(description, *column).components[component];
    const bool known = range[0] <= range[1];
    const auto world = [&](double stored)
    { return colouring.inBytes(stored * attribute.scale + attribute.offset); };
    const double lowest = known ? std::min(world(range[0]), world(range[1])) : 0.0;
    colouring.base = std::isfinite(lowest) ? lowest : 0.0;
    const double width = colouring.inBytes(certain[1]) - colouring.inBytes(certain[0]);
    const bool whole =
      isInteger(attribute.type) && attribute.scale == 1.0 && attribute.offset == 0.0;
    colouring.exact = known && whole && width <= mostExact;
    if (known && whole && width < static_cast<double>(mostIntegers))
    {
      colouring.integers =
        std::array<std::int64_t, 2>{ static_cast<std::int64_t>(colouring.inBytes(certain[0])),
          static_cast<std::int64_t>(colouring.inBytes(certain[1])) };
    }
  }
  return colouring;
}

void PointColouring::moveBase(const ColourMap& map)
{
  const double entries = static_cast<double>(map.entries.size());
  const double width = map.range[1] - map.range[0];
  const double most = mostFromBase / std::min(entries, mostEntries) * width;
  if (farthestOf(map.range, base) > most)
  {
    const double step = std::exp2(std::floor(std::log2(most / 2.0)));
    base = std::round(map.range[0] / step) * step;
  }
}

void PointColouring::fitTo(const ColourMap& map)
{
  const auto [low, high] = map.range;
  if (!usesTable() || !(low < high) || !std::isfinite(low) || !std::isfinite(high))
  {
    return;
  }
  const bool fixed = kind == Kind::Elevation || heights || exact;
  if (map.logarithmic)
  {
    // Logarithms need the same share of small values as of large ones, as floats of values have.
    decades = kind == Kind::Table && (low < 1.0 / mostInFloats || high > mostInFloats);
    base = decades || (!fixed && base < -low) ? 0.0 : base;
    return;
  }
  fixed ? void() : moveBase(map);
  int exponent = 0;
  std::frexp(std::min(farthestOf(map.range, base), largest), &exponent);
  const bool narrow = exponent < -mostExponent && kind == Kind::Table;
  if (exponent > mostExponent || narrow)
  {
    unit = std::ldexp(1.0, std::max(exponent - mostExponent, leastUnit));
  }
}

float PointColouring::floatOf(double value) const
{
  if (decades)
  {
    return static_cast<float>(value > 0.0 ? std::log10(value) : value - infinity);
  }
  return static_cast<float>(value / unit - base / unit);
}

ColumnSelection PointColouring::columns() const
{
  return usesColumn() ? ColumnSelection{ column } : ColumnSelection{};
}

bool PointColouring::coveredBy(const NodeColumns& node) const
{
  return !usesColumn() ||
    std::find(node.selection.begin(), node.selection.end(), column) != node.selection.end();
}

void PointColouring::encode(const NodeColumns& node, const AttributeSchema& schema,
  std::uint32_t first, std::uint32_t count, std::vector<std::uint32_t>& values) const
{
  assert(hasValues() && coveredBy(node) && first + count <= node.size());
  values.reserve(values.size() + count);
  if (heights)
  {
    std::vector<float> numbers;
    heights->append(node, first, count, numbers);
    std::transform(numbers.begin(), numbers.end(), std::back_inserter(values),
      [this](float height) { return packed(floatOf(height)); });
    return;
  }
  const auto place = std::find(node.selection.begin(), node.selection.end(), column);
  const Attribute& attribute = schema[column];
  const std::byte* point =
    node.columns[static_cast<std::size_t>(place - node.selection.begin())].data() +
    first * attribute.bytes();
  kind == Kind::Direct ? encodeColours(point, attribute, count, values)
                       : encodeNumbers(point, attribute, count, values);
}

void PointColouring::encodeColours(const std::byte* point, const Attribute& attribute,
  std::uint32_t count, std::vector<std::uint32_t>& values) const
{
  const Reading reading = readingOf(attribute.type);
  const std::size_t width = sizeOf(attribute.type);
  const ColourScale toByte(attribute, wide, colourRange);
  for (std::uint32_t i = 0; i < count; ++i, point += attribute.bytes())
  {
    std::array<std::uint8_t, 4> rgba{ 255, 255, 255, 255 };
    for (std::size_t c = 0; c < attribute.components; ++c)
    {
      const double byte = reading(point + c * width) * toByte.factor + toByte.offset;
      rgba[c] = static_cast<std::uint8_t>(std::clamp(byte, 0.0, 255.0));
    }
    values.push_back(packed(rgba));
  }
}

double PointColouring::inBytes(double value) const
{
  return kind == Kind::Table && wide ? std::floor(value / 256.0) : value;
}

double PointColouring::valueOf(const Attribute& attribute, const std::byte* point) const
{
  const Reading reading = readingOf(attribute.type);
  const std::size_t width = sizeOf(attribute.type);
  const auto number = [&](std::size_t c)
  { return inBytes(reading(point + c * width) * attribute.scale + attribute.offset); };
  if (component >= 0)
  {
    const double value = number(static_cast<std::size_t>(component));
    return absolute ? std::abs(value) : value;
  }
  double sum = 0.0;
  for (std::size_t c = 0; c < attribute.components; ++c)
  {
    sum += number(c) * number(c);
  }
  return std::sqrt(sum);
}

void PointColouring::encodeNumbers(const std::byte* point, const Attribute& attribute,
  std::uint32_t count, std::vector<std::uint32_t>& values) const
{
  for (std::uint32_t i = 0; i < count; ++i, point += attribute.bytes())
  {
    values.push_back(packed(floatOf(valueOf(attribute, point))));
  }
}

} // namespace pointfront
