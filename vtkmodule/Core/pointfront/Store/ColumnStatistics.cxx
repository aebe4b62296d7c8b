#include "pointfront/Store/ColumnStatistics.h"

#include "pointfront/Base/Infinity.h"
#include "pointfront/Codec/ByteStream.h"

#include <algorithm>
#include <limits>

namespace pointfront
{
namespace
{
template <typename T>
constexpr T lowest = std::numeric_limits<T>::has_infinity ? -std::numeric_limits<T>::infinity()
                                                          : std::numeric_limits<T>::lowest();
template <typename T>
constexpr T highest = std::numeric_limits<T>::has_infinity ? std::numeric_limits<T>::infinity()
                                                           : std::numeric_limits<T>::max();

/// Smallest and largest values of lanes: value i belongs to lane i % lanes. Of a multiple of the
/// components and a length the compiler knows: the inner loop is a few vectors.
template <typename T, std::size_t lanes>
class LaneRange
{
public:
  LaneRange()
  {
    low_.fill(highest<T>);
    high_.fill(lowest<T>);
  }
  void add(const std::byte* values, std::size_t count = lanes)
  {
    std::array<T, lanes> block; // NOLINT: filled as far as it is read
    std::memcpy(block.data(), values, count * sizeof(T));
    for (std::size_t lane = 0; lane < count; ++lane)
    {
      const T value = block[lane];
      low_[lane] = value < low_[lane] ? value : low_[lane]; // false for NaN
      high_[lane] = value > high_[lane] ? value : high_[lane];
    }
  }
  std::array<double, 2> component(std::size_t c, std::size_t components) const
  {
    T low = highest<T>;
    T high = lowest<T>;
    for (std::size_t lane = c; lane < lanes; lane += components)
    {
      low = std::min(low, low_[lane]);
      high = std::max(high, high_[lane]);
    }
    return { static_cast<double>(low), static_cast<double>(high) };
  }

private:
  std::array<T, lanes> low_;
  std::array<T, lanes> high_;
};

/// `components` divides `lanes`.
template <typename T, std::size_t lanes>
ColumnRange rangeOfValues(const std::byte* values, std::size_t points, std::size_t components)
{
  LaneRange<T, lanes> sum;
  const std::size_t count = points * components;
  std::size_t done = 0;
  for (; done + lanes <= count; done += lanes)
  {
    sum.add(values + done * sizeof(T));
  }
  sum.add(values + done * sizeof(T), count - done);
  ColumnRange range;
  for (std::size_t c = 0; c < components; ++c)
  {
    range.components.push_back(sum.component(c, components));
  }
  return range;
}

template <typename T>
ColumnRange rangeOfValues(const std::byte* values, std::size_t points, std::size_t components)
{
  if (components == 3)
  {
    return rangeOfValues<T, 48>(values, points, components);
  }
  if (32 % components == 0)
  {
    return rangeOfValues<T, 32>(values, points, components);
  }
  ColumnRange range;
  for (std::size_t c = 0; c < components; ++c)
  {
    LaneRange<T, 1> own;
    for (std::size_t i = 0; i < points; ++i)
    {
      own.add(values + (i * components + c) * sizeof(T));
    }
    range.components.push_back(own.component(0, 1));
  }
  return range;
}
} // namespace

BlockShape positionShape(std::size_t points)
{
  return { points, 3, 4 };
}

BlockShape columnShape(const Attribute& attribute, std::size_t points)
{
  return { points, attribute.components, static_cast<unsigned>(sizeOf(attribute.type)) };
}

NodeColumns emptyColumns(
  NodeIndex node, std::size_t points, const ColumnSelection& columns, const AttributeSchema& schema)
{
  NodeColumns result;
  result.node = node;
  result.selection = columns;
  result.positions.resize(points);
  for (const std::uint32_t column : columns)
  {
    result.columns.emplace_back(columnShape(schema[column], points).bytes());
  }
  return result;
}

std::size_t decodedBytesOf(
  std::size_t points, const ColumnSelection& columns, const AttributeSchema& schema)
{
  std::size_t sum = sizeof(NodeColumns) + positionShape(points).bytes();
  for (const std::uint32_t column : columns)
  {
    sum += columnShape(schema[column], points).bytes() + sizeof(std::vector<std::byte>);
  }
  return sum;
}

ColumnRange emptyRange(const Attribute& attribute)
{
  ColumnRange range;
  range.components.assign(attribute.components, { infinity, -infinity });
  return range;
}

ColumnRange rangeOf(const std::byte* values, const Attribute& attribute, std::size_t points)
{
  const std::size_t components = attribute.components;
  if (points == 0)
  {
    return emptyRange(attribute);
  }
  return visitScalar(attribute.type,
    [&](auto zero) { return rangeOfValues<decltype(zero)>(values, points, components); });
}

ColumnRange certainRange(const StoreDescription& store, std::size_t column)
{
  if (!store.rangesAreSampled)
  {
    return store.ranges[column];
  }
  const Attribute& attribute = store.schema[column];
  ColumnRange range;
  visitScalar(attribute.type,
    [&](auto zero)
    {
      using Limits = std::numeric_limits<decltype(zero)>;
      const bool whole = Limits::is_integer;
      range.components.assign(attribute.components,
        { whole ? static_cast<double>(Limits::lowest()) : -infinity,
          whole ? static_cast<double>(Limits::max()) : infinity });
    });
  return range;
}

void addRange(ColumnRange& range, const ColumnRange& other)
{
  for (std::size_t c = 0; c < range.components.size(); ++c)
  {
    range.components[c][0] = std::min(range.components[c][0], other.components[c][0]);
    range.components[c][1] = std::max(range.components[c][1], other.components[c][1]);
  }
}

bool encloses(const ColumnRange& outer, const ColumnRange& inner)
{
  for (std::size_t c = 0; c < outer.components.size(); ++c)
  {
    if (inner.components[c][0] < outer.components[c][0] ||
      inner.components[c][1] > outer.components[c][1])
    {
      return false;
    }
  }
  return true;
}

} // namespace pointfront
