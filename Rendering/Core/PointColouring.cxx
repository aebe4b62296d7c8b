#include "PointColouring.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <cmath>
#include <cstring>
#include <limits>

namespace pointfront
{
namespace
{

/// Longest table of one entry for each integer; longer ones are sampled.
constexpr std::int64_t mostIntegers = 8192;

bool sameName(const std::string& a, const char* b)
{
  return a.size() == std::strlen(b) &&
         std::equal(a.begin(), a.end(), b,
           [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

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
  switch (type)
  {
  case ScalarType::Int8:
    return as<std::int8_t>;
  case ScalarType::UInt8:
    return as<std::uint8_t>;
  case ScalarType::Int16:
    return as<std::int16_t>;
  case ScalarType::UInt16:
    return as<std::uint16_t>;
  case ScalarType::Int32:
    return as<std::int32_t>;
  case ScalarType::UInt32:
    return as<std::uint32_t>;
  case ScalarType::Int64:
    return as<std::int64_t>;
  case ScalarType::UInt64:
    return as<std::uint64_t>;
  case ScalarType::Float32:
    return as<float>;
  case ScalarType::Float64:
    break;
  }
  return as<double>;
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

/// Factor from a component to 0..255.
double toByte(const Attribute& attribute, bool wide)
{
  if (!isInteger(attribute.type))
  {
    return 255.0; // VTK's convention: floating colours are 0 to 1
  }
  const double most = std::ldexp(1.0, static_cast<int>(8 * sizeOf(attribute.type)));
  return wide ? 256.0 / most : 1.0;
}

bool isColour(const Attribute& attribute, ColourRequest::Mode mode)
{
  if (mode == ColourRequest::Mode::Table ||
      (attribute.components != 3 && attribute.components != 4))
  {
    return false;
  }
  return mode == ColourRequest::Mode::Direct || attribute.type == ScalarType::UInt8 ||
         (sameName(attribute.name, "rgb") && attribute.type == ScalarType::UInt16);
}

} // namespace

std::optional<PointColouring> PointColouring::choose(
  const StoreDescription& description, const ColourRequest& request)
{
  PointColouring colouring;
  if (request.name.empty())
  {
    return colouring;
  }
  const auto column = description.schema.find(request.name);
  if (!column)
  {
    if (!sameName(request.name, "elevation"))
    {
      return std::nullopt;
    }
    colouring.kind = Kind::Elevation;
    return colouring;
  }
  const Attribute& attribute = description.schema[*column];
  const auto& ranges = description.ranges[*column].components;
  colouring.column = static_cast<std::uint32_t>(*column);
  if (isColour(attribute, request.mode))
  {
    colouring.kind = Kind::Direct;
    for (const auto& range : ranges)
    {
      colouring.wide = colouring.wide || range[1] > 255.0;
    }
    return colouring;
  }
  colouring.kind = Kind::Table;
  colouring.component =
    attribute.components == 1 ? 0 : std::min<int>(request.component, attribute.components - 1);
  if (colouring.component >= 0)
  {
    const auto& range = ranges[static_cast<std::size_t>(colouring.component)];
    const bool known = range[0] <= range[1];
    const double low = range[0] * attribute.scale + attribute.offset;
    const double high = range[1] * attribute.scale + attribute.offset;
    colouring.base = known ? std::min(low, high) : 0.0;
    if (known && isInteger(attribute.type) && attribute.scale == 1.0 && attribute.offset == 0.0 &&
        range[1] - range[0] < static_cast<double>(mostIntegers))
    {
      colouring.integers = std::array<std::int64_t, 2>{
        static_cast<std::int64_t>(range[0]), static_cast<std::int64_t>(range[1])};
    }
  }
  return colouring;
}

ColumnSelection PointColouring::columns() const
{
  return usesColumn() ? ColumnSelection{column} : ColumnSelection{};
}

bool PointColouring::coveredBy(const NodeColumns& node) const
{
  return !usesColumn() ||
         std::find(node.selection.begin(), node.selection.end(), column) != node.selection.end();
}

void PointColouring::encode(const NodeColumns& node, const Attribute& attribute,
  std::uint32_t first, std::uint32_t count, std::vector<std::uint32_t>& values) const
{
  const auto place = std::find(node.selection.begin(), node.selection.end(), column);
  assert(usesColumn() && place != node.selection.end() && first + count <= node.size());
  const std::size_t stride = attribute.bytes();
  const std::size_t width = sizeOf(attribute.type);
  const std::byte* point =
    node.columns[static_cast<std::size_t>(place - node.selection.begin())].data() + first * stride;
  const Reading reading = readingOf(attribute.type);
  values.reserve(values.size() + count);
  if (kind == Kind::Direct)
  {
    const double factor = toByte(attribute, wide);
    for (std::uint32_t i = 0; i < count; ++i, point += stride)
    {
      std::array<std::uint8_t, 4> rgba{255, 255, 255, 255};
      for (std::size_t c = 0; c < attribute.components; ++c)
      {
        rgba[c] =
          static_cast<std::uint8_t>(std::clamp(reading(point + c * width) * factor, 0.0, 255.0));
      }
      values.push_back(packed(rgba));
    }
    return;
  }
  for (std::uint32_t i = 0; i < count; ++i, point += stride)
  {
    double value = 0.0;
    if (component >= 0)
    {
      value = reading(point + static_cast<std::size_t>(component) * width) * attribute.scale +
              attribute.offset;
    }
    else
    {
      for (std::size_t c = 0; c < attribute.components; ++c)
      {
        const double x = reading(point + c * width) * attribute.scale + attribute.offset;
        value += x * x;
      }
      value = std::sqrt(value);
    }
    values.push_back(packed(static_cast<float>(value - base)));
  }
}

} // namespace pointfront
