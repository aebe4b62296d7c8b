#include "pointfront/Style/PointFilter.h"

#include "pointfront/Style/ClassHeights.h"
#include "pointfront/Style/StoredIntervals.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace pointfront
{
namespace
{

/// More values of a set than these are searched for by bisection.
constexpr std::size_t fewValues = 16;

/// Values of one component, one after the other; `stride` bytes from one to the next.
template <typename T>
struct Values
{
  const std::byte* at = nullptr;
  std::size_t stride = sizeof(T);

  T operator[](std::size_t i) const
  {
    T value;
    std::memcpy(&value, at + i * stride, sizeof(T));
    return value;
  }
};

/// The same where nothing lies between two: compilers make wide instructions of such loops.
template <typename T>
struct DenseValues
{
  const std::byte* at = nullptr;

  T operator[](std::size_t i) const
  {
    T value;
    std::memcpy(&value, at + i * sizeof(T), sizeof(T));
    return value;
  }
};

/// keep[i] &= test(from[i]). In blocks, because a store of bytes through `keep` might change any of
/// the values for all that a compiler knows.
template <typename From, typename Test>
void keepWhere(const From& from, std::uint32_t count, std::uint8_t* keep, const Test test)
{
  constexpr std::size_t block = 256;
  std::array<std::uint8_t, block> passes;
  for (std::size_t begin = 0; begin < count; begin += block)
  {
    const std::size_t size = std::min<std::size_t>(block, count - begin);
    for (std::size_t i = 0; i < size; ++i)
    {
      passes[i] = static_cast<std::uint8_t>(test(from[begin + i]));
    }
    for (std::size_t i = 0; i < size; ++i)
    {
      keep[begin + i] = static_cast<std::uint8_t>(keep[begin + i] & passes[i]);
    }
  }
}

/// Which integers of at most 16 bits lie in the intervals: one bit each.
template <typename T>
class IntegerSet
{
public:
  using Unsigned = std::make_unsigned_t<T>;

  explicit IntegerSet(const std::vector<StoredInterval<T>>& intervals)
  {
    for (const StoredInterval<T>& interval : intervals)
    {
      for (std::uint32_t step = 0; step <= interval.width; ++step)
      {
        const auto value = static_cast<Unsigned>(static_cast<Unsigned>(interval.low) + step);
        words_[value / 64u] |= std::uint64_t(1) << (value % 64u);
      }
    }
  }
  bool has(T value) const
  {
    const auto bits = static_cast<Unsigned>(value);
    return ((words_[bits / 64u] >> (bits % 64u)) & 1u) != 0;
  }

private:
  std::array<std::uint64_t, (std::size_t(1) << (8 * sizeof(T))) / 64> words_{};
};

/// At most `fewValues` intervals, tried one after the other without a branch.
template <typename From, typename T>
void keepInFewIntervals(const From& from, const std::vector<StoredInterval<T>>& intervals,
  bool inverted, std::uint32_t count, std::uint8_t* keep)
{
  std::array<StoredInterval<T>, fewValues> few{};
  const std::size_t size = intervals.size();
  std::copy(intervals.begin(), intervals.end(), few.begin());
  keepWhere(from, count, keep,
    [few, size, inverted](T value)
    {
      std::uint8_t inside = 0;
      for (std::size_t i = 0; i < size; ++i)
      {
        inside = static_cast<std::uint8_t>(inside | static_cast<std::uint8_t>(few[i].holds(value)));
      }
      return (inside != 0) != inverted;
    });
}

template <typename From, typename T>
void keepInIntervals(const From& from, const std::vector<StoredInterval<T>>& intervals,
  bool inverted, std::uint32_t count, std::uint8_t* keep)
{
  if (intervals.empty())
  {
    keepWhere(from, count, keep, [inverted](T) { return inverted; });
    return;
  }
  if (intervals.size() == 1)
  {
    const StoredInterval<T> only = intervals.front();
    keepWhere(
      from, count, keep, [only, inverted](T value) { return only.holds(value) != inverted; });
    return;
  }
  if constexpr (sizeof(T) <= 2)
  {
    const IntegerSet<T> set(intervals);
    keepWhere(from, count, keep, [&set, inverted](T value) { return set.has(value) != inverted; });
  }
  else if (intervals.size() <= fewValues)
  {
    keepInFewIntervals(from, intervals, inverted, count, keep);
  }
  else
  {
    keepWhere(from, count, keep,
      [&intervals, inverted](T value)
      {
        const auto after = std::upper_bound(intervals.begin(), intervals.end(), value,
          [](T v, const StoredInterval<T>& interval) { return v < interval.low; });
        return (after != intervals.begin() && (after - 1)->holds(value)) != inverted;
      });
  }
}

/// Floating values as integers of the same order: compared without branches, two or four at a time.
template <typename From, typename T>
struct OrderedKeys
{
  From from;
  OrderedKey<T> operator[](std::size_t i) const { return orderedKey(from[i]); }
};

template <typename T, typename From>
void keepPassing(const From& from, const Attribute& attribute, const AttributeCondition& condition,
  std::uint32_t count, std::uint8_t* keep)
{
  if (condition.absolute)
  {
    keepWhere(from, count, keep,
      [&attribute, &condition](T stored)
      {
        return condition.passes(
          std::abs(static_cast<double>(stored) * attribute.scale + attribute.offset));
      });
    return;
  }
  if constexpr (std::is_floating_point_v<T>)
  {
    if (attribute.scale == 1.0 && attribute.offset == 0.0)
    {
      keepInIntervals(OrderedKeys<From, T>{ from }, floatingIntervals<T>(condition),
        condition.inverted, count, keep);
      return;
    }
    keepWhere(from, count, keep,
      [&attribute, &condition](T stored) {
        return condition.passes(static_cast<double>(stored) * attribute.scale + attribute.offset);
      });
  }
  else
  {
    keepInIntervals(from, storedIntervals<T>(condition, attribute.scale, attribute.offset),
      condition.inverted, count, keep);
  }
}

void keepOfColumn(const NodeColumns& node, const AttributeSchema& schema,
  const AttributeCondition& condition, std::uint32_t first, std::uint32_t count, std::uint8_t* keep)
{
  const auto place = std::find(node.selection.begin(), node.selection.end(), condition.column);
  const Attribute& attribute = schema[condition.column];
  const std::byte* const column =
    node.columns[static_cast<std::size_t>(place - node.selection.begin())].data();
  const std::size_t stride = attribute.bytes();
  visitScalar(attribute.type,
    [&](auto zero)
    {
      using T = decltype(zero);
      const std::byte* const at =
        column + first * stride + static_cast<std::size_t>(condition.component) * sizeof(T);
      stride == sizeof(T)
        ? keepPassing<T>(DenseValues<T>{ at }, attribute, condition, count, keep)
        : keepPassing<T>(Values<T>{ at, stride }, attribute, condition, count, keep);
    });
}

void keepOfPositions(const NodeColumns& node, const AttributeCondition& condition,
  std::uint32_t first, std::uint32_t count, std::uint8_t* keep)
{
  const std::int64_t origin = node.origin[condition.axis];
  const glm::u32vec3* const positions = node.positions.data() + first;
  const auto steps =
    storedIntervals<std::int64_t>(condition, condition.axisScale, condition.axisOffset);
  struct Steps
  {
    const glm::u32vec3* positions;
    std::int64_t origin;
    int axis;
    std::int64_t operator[](std::size_t i) const { return origin + positions[i][axis]; }
  };
  keepInIntervals(
    Steps{ positions, origin, condition.axis }, steps, condition.inverted, count, keep);
}

void keepOfHeights(const NodeColumns& node, const AttributeCondition& condition,
  std::uint32_t first, std::uint32_t count, std::uint8_t* keep)
{
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const bool passes = condition.passes(condition.heights->at(node, first + i));
    keep[i] = static_cast<std::uint8_t>(keep[i] & static_cast<std::uint8_t>(passes));
  }
}

/// The nearest whole number of steps, if the difference is that of rounding alone.
ConditionNumber asSteps(ConditionNumber number, double scale, double offset)
{
  const auto written = static_cast<double>(number);
  const double steps = std::round((written - offset) / scale);
  const double value = steps * scale + offset;
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() *
    std::max({ std::abs(written), std::abs(offset), std::abs(steps * scale) });
  return std::abs(value - written) <= rounding ? value : number;
}

/// The nearest float, if its shortest decimal is the number.
ConditionNumber asFloat(ConditionNumber number)
{
  const auto nearest = static_cast<float>(number);
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), nearest).ptr;
  double written = 0.0;
  std::from_chars(text.data(), end, written);
  return written == static_cast<double>(number) ? static_cast<ConditionNumber>(nearest) : number;
}

ConditionNumber asWritten(
  ConditionNumber number, const AttributeCondition& condition, const Attribute* attribute)
{
  const double scale = attribute != nullptr ? attribute->scale : condition.axisScale;
  const double offset = attribute != nullptr ? attribute->offset : condition.axisOffset;
  const bool plain = scale == 1.0 && offset == 0.0;
  if (!std::isfinite(static_cast<double>(number)) || !(scale > 0.0))
  {
    return number;
  }
  if (attribute != nullptr && attribute->type == ScalarType::Float32 && plain)
  {
    return std::abs(static_cast<double>(number)) <= std::numeric_limits<float>::max()
      ? asFloat(number)
      : number;
  }
  const bool floating = attribute != nullptr &&
    (attribute->type == ScalarType::Float32 || attribute->type == ScalarType::Float64);
  return plain || floating ? number : asSteps(number, scale, offset);
}
} // namespace

void AttributeCondition::takeAsWritten(const Attribute* attribute)
{
  for (ConditionNumber& end : range)
  {
    end = asWritten(end, *this, attribute);
  }
  for (ConditionNumber& value : values)
  {
    value = asWritten(value, *this, attribute);
  }
}

std::array<double, 2> AttributeCondition::closedRange() const
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto low = static_cast<double>(range[0]);
  const auto high = static_cast<double>(range[1]);
  return { lowOpen ? std::nextafter(low, infinity) : low,
    highOpen ? std::nextafter(high, -infinity) : high };
}

bool AttributeCondition::passes(double value) const
{
  if (std::isnan(value))
  {
    return false;
  }
  const auto asDouble = [](ConditionNumber number) { return static_cast<double>(number); };
  if (!values.empty())
  {
    const auto least = std::partition_point(values.begin(), values.end(),
      [&](ConditionNumber number) { return asDouble(number) < value; });
    return (least != values.end() && asDouble(*least) == value) != inverted;
  }
  const double low = asDouble(range[0]);
  const double high = asDouble(range[1]);
  const bool inside =
    (lowOpen ? value > low : value >= low) && (highOpen ? value < high : value <= high);
  return inside != inverted;
}

bool AttributeCondition::mayPass(double low, double high) const
{
  // Beyond, a double stands for several whole numbers of the store: at an end it tells nothing.
  constexpr double wholeDoubles = 9007199254740992.0; // 2^53
  const bool vague = std::abs(low) >= wholeDoubles || std::abs(high) >= wholeDoubles;
  if (!values.empty())
  {
    const auto first = std::partition_point(values.begin(), values.end(),
      [low](ConditionNumber number) { return static_cast<double>(number) < low; });
    const bool some = first != values.end() && static_cast<double>(*first) <= high;
    // Inverted, only a range of one value that is excluded can be left out.
    return inverted ? !(some && low == high && !vague) : some;
  }
  const auto from = static_cast<double>(range[0]);
  const auto to = static_cast<double>(range[1]);
  if (inverted)
  {
    const bool lowInside = lowOpen || vague ? low > from : low >= from;
    const bool highInside = highOpen || vague ? high < to : high <= to;
    return !(lowInside && highInside);
  }
  return (lowOpen && !vague ? high > from : high >= from) &&
    (highOpen && !vague ? low < to : low <= to);
}

ColumnSelection PointFilter::columns() const
{
  ColumnSelection all;
  for (const AttributeCondition& condition : conditions)
  {
    if (condition.usesColumn())
    {
      all.push_back(condition.column);
    }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

void PointFilter::evaluate(const NodeColumns& node, const AttributeSchema& schema,
  std::uint32_t first, std::uint32_t count, std::uint8_t* keep) const
{
  std::fill(keep, keep + count, std::uint8_t(1));
  for (const AttributeCondition& condition : conditions)
  {
    if (condition.heights)
    {
      keepOfHeights(node, condition, first, count, keep);
    }
    else if (condition.usesColumn())
    {
      keepOfColumn(node, schema, condition, first, count, keep);
    }
    else
    {
      keepOfPositions(node, condition, first, count, keep);
    }
  }
}

} // namespace pointfront
