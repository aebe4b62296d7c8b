#pragma once

#include "pointfront/Style/PointFilter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

namespace pointfront
{

/// From and to, both included, of stored integers.
template <typename T>
struct StoredInterval
{
  using Unsigned = std::make_unsigned_t<T>;
  T low{};
  Unsigned width{}; ///< high - low

  bool holds(T value) const
  {
    return static_cast<Unsigned>(static_cast<Unsigned>(value) - static_cast<Unsigned>(low)) <=
      width;
  }
};

/// The smallest integer of type T that meets a condition which all larger ones meet too.
template <typename T, typename Condition>
std::optional<T> firstThatMeets(Condition condition)
{
  using Unsigned = std::make_unsigned_t<T>;
  T low = std::numeric_limits<T>::min();
  T high = std::numeric_limits<T>::max();
  if (!condition(high))
  {
    return std::nullopt;
  }
  while (low < high)
  {
    const auto distance =
      static_cast<Unsigned>(static_cast<Unsigned>(high) - static_cast<Unsigned>(low));
    const T middle =
      static_cast<T>(static_cast<Unsigned>(static_cast<Unsigned>(low) + distance / 2));
    if (condition(middle))
    {
      high = middle;
    }
    else
    {
      low = static_cast<T>(middle + 1);
    }
  }
  return low;
}

/// Stored integers s whose world value s * scale + offset, as double arithmetic rounds it, lies in
/// [low, high]: by bisection of that same expression, so that no point at a bound is judged
/// otherwise than AttributeCondition::passes() does.
template <typename T>
std::optional<StoredInterval<T>> storedInterval(
  double low, double high, double scale, double offset)
{
  const auto value = [&](T stored) { return static_cast<double>(stored) * scale + offset; };
  const bool rising = scale >= 0.0;
  const std::optional<T> first = rising ? firstThatMeets<T>([&](T s) { return value(s) >= low; })
                                        : firstThatMeets<T>([&](T s) { return value(s) <= high; });
  const std::optional<T> beyond = rising ? firstThatMeets<T>([&](T s) { return value(s) > high; })
                                         : firstThatMeets<T>([&](T s) { return value(s) < low; });
  if (!first || (beyond && *beyond <= *first))
  {
    return std::nullopt;
  }
  using Unsigned = typename StoredInterval<T>::Unsigned;
  const T last = beyond ? static_cast<T>(*beyond - 1) : std::numeric_limits<T>::max();
  return StoredInterval<T>{ *first,
    static_cast<Unsigned>(static_cast<Unsigned>(last) - static_cast<Unsigned>(*first)) };
}

/// Integers of 64 bits that are the world values themselves, in the condition's range, without
/// rounding.
template <typename T>
std::optional<StoredInterval<T>> wholeInterval(
  ConditionNumber low, bool lowOpen, ConditionNumber high, bool highOpen)
{
  using Unsigned = typename StoredInterval<T>::Unsigned;
  const auto number = [](T stored) { return static_cast<ConditionNumber>(stored); };
  const std::optional<T> first =
    firstThatMeets<T>([&](T s) { return lowOpen ? number(s) > low : number(s) >= low; });
  const std::optional<T> beyond =
    firstThatMeets<T>([&](T s) { return highOpen ? number(s) >= high : number(s) > high; });
  if (!first || (beyond && *beyond <= *first))
  {
    return std::nullopt;
  }
  const T last = beyond ? static_cast<T>(*beyond - 1) : std::numeric_limits<T>::max();
  return StoredInterval<T>{ *first,
    static_cast<Unsigned>(static_cast<Unsigned>(last) - static_cast<Unsigned>(*first)) };
}

/// All stored integers that lie within the condition's range or are among its values (`inverted` is
/// not looked at), ascending and disjoint.
template <typename T>
std::vector<StoredInterval<T>> storedIntervals(
  const AttributeCondition& condition, double scale, double offset)
{
  const bool whole = sizeof(T) == 8 && scale == 1.0 && offset == 0.0;
  std::vector<StoredInterval<T>> intervals;
  if (condition.values.empty())
  {
    const std::array<double, 2> range = condition.closedRange();
    if (const auto interval = whole ? wholeInterval<T>(condition.range[0], condition.lowOpen,
                                        condition.range[1], condition.highOpen)
                                    : storedInterval<T>(range[0], range[1], scale, offset))
    {
      intervals.push_back(*interval);
    }
    return intervals;
  }
  for (const ConditionNumber number : condition.values)
  {
    const auto value = static_cast<double>(number);
    if (const auto interval = whole ? wholeInterval<T>(number, false, number, false)
                                    : storedInterval<T>(value, value, scale, offset))
    {
      intervals.push_back(*interval);
    }
  }
  std::sort(intervals.begin(), intervals.end(),
    [](const StoredInterval<T>& a, const StoredInterval<T>& b) { return a.low < b.low; });
  return intervals;
}

template <typename T>
using OrderedKey = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;

/// An integer that is larger for larger values; -0 comes right before 0, NaN after infinity, or
/// before -infinity by its sign.
template <typename T>
OrderedKey<T> orderedKey(T value)
{
  static_assert(std::numeric_limits<T>::is_iec559);
  using Key = OrderedKey<T>;
  Key bits;
  std::memcpy(&bits, &value, sizeof(T));
  const Key sign = static_cast<Key>(bits >> (8 * sizeof(Key) - 1)); // 0 or -1
  return static_cast<Key>(bits ^ (sign & std::numeric_limits<Key>::max()));
}

/// The keys of the values of type T that lie in [low, high].
template <typename T>
std::optional<StoredInterval<OrderedKey<T>>> floatingInterval(double low, double high)
{
  constexpr T infinity = std::numeric_limits<T>::infinity();
  auto first = static_cast<T>(low);
  auto last = static_cast<T>(high);
  first = static_cast<double>(first) < low ? std::nextafter(first, infinity) : first;
  last = static_cast<double>(last) > high ? std::nextafter(last, -infinity) : last;
  if (!(first <= last))
  {
    return std::nullopt;
  }
  // -0 equals 0.
  const OrderedKey<T> from = orderedKey(first == T(0) ? -T(0) : first);
  const OrderedKey<T> to = orderedKey(last == T(0) ? T(0) : last);
  using Interval = StoredInterval<OrderedKey<T>>;
  using Unsigned = typename Interval::Unsigned;
  return Interval{ from,
    static_cast<Unsigned>(static_cast<Unsigned>(to) - static_cast<Unsigned>(from)) };
}

/// Like storedIntervals(), as keys of values that have neither scale nor offset. With an inverted
/// condition, NaN is in them: what is in none of them passes.
template <typename T>
std::vector<StoredInterval<OrderedKey<T>>> floatingIntervals(const AttributeCondition& condition)
{
  using Key = OrderedKey<T>;
  using Interval = StoredInterval<Key>;
  using Unsigned = typename Interval::Unsigned;
  std::vector<Interval> intervals;
  const auto add = [&intervals](double low, double high)
  {
    if (const auto interval = floatingInterval<T>(low, high))
    {
      intervals.push_back(*interval);
    }
  };
  for (const ConditionNumber number : condition.values)
  {
    add(static_cast<double>(number), static_cast<double>(number));
  }
  if (condition.values.empty())
  {
    const std::array<double, 2> range = condition.closedRange();
    add(range[0], range[1]);
  }
  if (condition.inverted)
  {
    constexpr T infinity = std::numeric_limits<T>::infinity();
    const auto width = [](Key from, Key to)
    { return static_cast<Unsigned>(static_cast<Unsigned>(to) - static_cast<Unsigned>(from)); };
    const auto least = std::numeric_limits<Key>::min();
    const auto beyond = static_cast<Key>(orderedKey(infinity) + 1);
    intervals.insert(
      intervals.begin(), { least, width(least, static_cast<Key>(orderedKey(-infinity) - 1)) });
    intervals.push_back({ beyond, width(beyond, std::numeric_limits<Key>::max()) });
  }
  return intervals;
}

} // namespace pointfront
