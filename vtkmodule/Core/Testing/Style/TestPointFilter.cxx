#include "pointfront/Style/PointFilter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>

using namespace pointfront;

namespace
{

constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr ScalarType allTypes[] = { ScalarType::Int8, ScalarType::UInt8, ScalarType::Int16,
  ScalarType::UInt16, ScalarType::Int32, ScalarType::UInt32, ScalarType::Int64, ScalarType::UInt64,
  ScalarType::Float32, ScalarType::Float64 };

/// Two points in three are small numbers, which conditions meet; the others are any bits.
template <typename T>
std::vector<T> someValues(std::mt19937_64& random, std::size_t count)
{
  std::vector<T> values(count);
  for (T& value : values)
  {
    const std::uint64_t bits = random();
    if (bits % 3 == 0)
    {
      const std::uint64_t any = random();
      std::memcpy(&value, &any, sizeof(T));
    }
    else
    {
      value = static_cast<T>(bits % 40);
    }
  }
  return values;
}

std::vector<AttributeCondition> someConditions()
{
  std::vector<AttributeCondition> conditions;
  const auto range = [&](double low, double high, bool lowOpen, bool highOpen)
  {
    AttributeCondition condition;
    condition.range = { low, high };
    condition.lowOpen = lowOpen;
    condition.highOpen = highOpen;
    conditions.push_back(condition);
  };
  range(3.0, 17.0, false, false);
  range(3.0, 17.0, true, true);
  range(-unbounded, 5.0, false, true);
  range(5.25, unbounded, true, false);
  range(1e30, 1e31, false, false);
  range(-unbounded, unbounded, false, false);
  const auto set = [&](std::vector<ConditionNumber> values)
  {
    AttributeCondition condition;
    condition.values = std::move(values);
    conditions.push_back(condition);
  };
  set({ 7.0 });
  set({ -3.0, 2.0, 4.5, 9.0, 30.0 });
  std::vector<ConditionNumber> many;
  for (int value = 0; value < 40; value += 2)
  {
    many.push_back(value);
  }
  set(many); // more than are tried one after the other
  const std::size_t plain = conditions.size();
  for (std::size_t i = 0; i < plain; ++i)
  {
    conditions.push_back(conditions[i]);
    conditions.back().inverted = true;
  }
  return conditions;
}

} // namespace

TEST(PointFilter, EveryTypeIsJudgedAsItsWorldValueIs)
{
  constexpr std::uint32_t count = 400;
  constexpr unsigned seed = 7;
  std::mt19937_64 random(seed);
  const std::array<std::array<double, 2>, 4> scales{ { { 1.0, 0.0 }, { 0.1, 0.0 }, { -0.5, 12.0 },
    { 0.0, 7.0 } } };
  for (const ScalarType type : allTypes)
  {
    for (const std::uint8_t components : { std::uint8_t(1), std::uint8_t(3) })
    {
      for (const auto& [scale, offset] : scales)
      {
        AttributeSchema schema;
        schema.add({ "value", type, components, scale, offset });
        visitScalar(type,
          [&, scale = scale, offset = offset](auto zero)
          {
            using T = decltype(zero);
            const std::vector<T> values = someValues<T>(random, count * components);
            NodeColumns node;
            node.positions.resize(count);
            node.selection = { 0 };
            node.columns.emplace_back(values.size() * sizeof(T));
            std::memcpy(node.columns[0].data(), values.data(), node.columns[0].size());
            for (AttributeCondition condition : someConditions())
            {
              condition.component = components - 1;
              std::vector<std::uint8_t> keep(count - 5, 2);
              PointFilter{ { condition } }.evaluate(node, schema, 5, count - 5, keep.data());
              for (std::uint32_t i = 5; i < count; ++i)
              {
                const auto stored = static_cast<double>(
                  values[i * components + static_cast<std::size_t>(condition.component)]);
                ASSERT_EQ(keep[i - 5] == 1, condition.passes(stored * scale + offset))
                  << nameOf(type) << ' ' << stored << " * " << scale << " seed " << seed;
              }
            }
          });
      }
    }
  }
}

TEST(PointFilter, ValuesWithoutTheirSignAreJudgedSo)
{
  AttributeSchema schema;
  schema.add({ "normal", ScalarType::Int8, 3, 1.0 / 127.0, 0.0 });
  NodeColumns node;
  node.positions.resize(255);
  node.selection = { 0 };
  node.columns.resize(1);
  for (int z = -127; z <= 127; ++z)
  {
    for (const int component : { 9, 9, z })
    {
      node.columns[0].push_back(static_cast<std::byte>(component));
    }
  }
  for (AttributeCondition condition : someConditions())
  {
    condition.component = 2;
    condition.absolute = true;
    std::vector<std::uint8_t> keep(255, 2);
    PointFilter{ { condition } }.evaluate(node, schema, 0, 255, keep.data());
    for (int z = -127; z <= 127; ++z)
    {
      EXPECT_EQ(
        keep[static_cast<std::size_t>(z + 127)] == 1, condition.passes(std::abs(z * (1.0 / 127.0))))
        << z;
    }
  }
}

TEST(PointFilter, ConditionsOnCoordinatesNeedNoColumn)
{
  QuantisationGrid grid;
  grid.scale = { 0.01, 0.01, 0.001 };
  grid.offset = { 5e5, 6e6, 100.0 };
  NodeColumns node;
  node.origin = { 10, 20, -30000 };
  for (std::uint32_t i = 0; i < 100; ++i)
  {
    node.positions.push_back({ i, 2 * i, 1000 * i });
  }
  AttributeCondition height;
  height.axis = 2;
  height.axisScale = grid.scale.z;
  height.axisOffset = grid.offset.z;
  height.range = { 90.0, 120.0 };
  const PointFilter filter{ { height } };
  EXPECT_TRUE(filter.columns().empty());
  std::vector<std::uint8_t> keep(100);
  filter.evaluate(node, AttributeSchema(), 0, 100, keep.data());
  int passing = 0;
  for (std::size_t i = 0; i < keep.size(); ++i)
  {
    const double z = grid.toWorld(node.origin + GridPosition(node.positions[i])).z;
    EXPECT_EQ(keep[i] == 1, z >= 90.0 && z <= 120.0) << i << ' ' << z;
    passing += keep[i];
  }
  EXPECT_EQ(passing, 31); // 90, 91 ... 120
}

TEST(PointFilter, AllConditionsHaveToHold)
{
  AttributeSchema schema;
  schema.add({ "a", ScalarType::UInt8, 1 });
  schema.add({ "b", ScalarType::Float32, 1 });
  NodeColumns node;
  node.positions.resize(4);
  node.selection = { 0, 1 };
  const std::uint8_t a[] = { 1, 2, 3, 4 };
  const float b[] = { 0.0f, 1.0f, std::numeric_limits<float>::quiet_NaN(), 3.0f };
  node.columns = { std::vector<std::byte>(4), std::vector<std::byte>(16) };
  std::memcpy(node.columns[0].data(), a, 4);
  std::memcpy(node.columns[1].data(), b, 16);
  AttributeCondition least;
  least.range[0] = 2.0;
  AttributeCondition notOne;
  notOne.column = 1;
  notOne.values = { 1.0 };
  notOne.inverted = true;
  std::uint8_t keep[4];
  PointFilter{ { least, notOne } }.evaluate(node, schema, 0, 4, keep);
  EXPECT_EQ(std::vector<std::uint8_t>(keep, keep + 4), (std::vector<std::uint8_t>{ 0, 0, 0, 1 }));
}

template <typename T>
void expectKept(const std::vector<T>& values, const AttributeCondition& condition,
  const std::function<bool(T)>& truth)
{
  AttributeSchema schema;
  schema.add({ "k", T(-1) < T(0) ? ScalarType::Int64 : ScalarType::UInt64, 1 });
  NodeColumns node;
  node.positions.resize(values.size());
  node.selection = { 0 };
  node.columns.emplace_back(values.size() * sizeof(T));
  std::memcpy(node.columns[0].data(), values.data(), values.size() * sizeof(T));
  std::vector<std::uint8_t> keep(values.size());
  PointFilter{ { condition } }.evaluate(
    node, schema, 0, static_cast<std::uint32_t>(values.size()), keep.data());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    EXPECT_EQ(keep[i] != 0, truth(values[i])) << values[i];
    // A node that holds nothing but this point is not left out if the point passes.
    const auto rounded = static_cast<double>(values[i]);
    EXPECT_TRUE(!truth(values[i]) || condition.mayPass(rounded, rounded)) << values[i];
  }
}

template <typename T>
void expectExactComparisons(T around)
{
  std::vector<T> values;
  for (int step = -3; step <= 3; ++step)
  {
    values.push_back(static_cast<T>(around + static_cast<T>(step)));
  }
  for (const T bound : values)
  {
    for (const bool inverted : { false, true })
    {
      AttributeCondition equal;
      equal.values.push_back(static_cast<ConditionNumber>(bound));
      equal.inverted = inverted;
      expectKept<T>(values, equal, [=](T value) { return (value == bound) != inverted; });
      for (const bool open : { false, true })
      {
        AttributeCondition least;
        least.range[0] = static_cast<ConditionNumber>(bound);
        least.lowOpen = open;
        least.inverted = inverted;
        expectKept<T>(values, least,
          [=](T value) { return (open ? value > bound : value >= bound) != inverted; });
        AttributeCondition most;
        most.range[1] = static_cast<ConditionNumber>(bound);
        most.highOpen = open;
        most.inverted = inverted;
        expectKept<T>(values, most,
          [=](T value) { return (open ? value < bound : value <= bound) != inverted; });
      }
    }
  }
}

/// Whole numbers around 2^53, 2^62, 2^63 and 2^64, of which no double has every one.
TEST(PointFilter, IntegersOf64BitsAreComparedExactly)
{
  expectExactComparisons<std::int64_t>(std::int64_t(1) << 53);
  expectExactComparisons<std::int64_t>(std::int64_t(1) << 62);
  expectExactComparisons<std::int64_t>(std::numeric_limits<std::int64_t>::max() - 3);
  expectExactComparisons<std::int64_t>(std::numeric_limits<std::int64_t>::min() + 3);
  expectExactComparisons<std::uint64_t>(std::uint64_t(1) << 63);
  expectExactComparisons<std::uint64_t>(std::numeric_limits<std::uint64_t>::max() - 3);
}

/// A node of that range is left out only if no value in it could pass: tried value by value.
TEST(PointFilter, RangesThatMayPassHaveAValueThatDoes)
{
  for (const AttributeCondition& condition : someConditions())
  {
    for (int low = -2; low <= 20; ++low)
    {
      for (int high = low; high <= 20; ++high)
      {
        bool some = false;
        for (double value = low; value <= high; value += 0.25)
        {
          some = some || condition.passes(value);
        }
        if (some)
        {
          EXPECT_TRUE(condition.mayPass(low, high)) << low << ' ' << high;
        }
        else if (condition.values.empty())
        {
          EXPECT_FALSE(condition.mayPass(low, high)) << low << ' ' << high;
        }
      }
    }
  }
}
