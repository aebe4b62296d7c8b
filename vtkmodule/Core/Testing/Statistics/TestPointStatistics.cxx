#include "pointfront/Statistics/GroundCells.h"
#include "pointfront/Statistics/PointStatistics.h"
#include "pointfront/Threads/ThreadCrew.h"

#include "TestBuildClouds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>

namespace pointfront::test
{
namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

/// A cloud of one attribute "v", at (i, 0, 0).
template <typename T>
CloudSource cloudOf(ScalarType type, const std::vector<T>& values, double scale = 1.0)
{
  AttributeSchema schema;
  schema.add({ "v", type, 1, scale });
  CloudSource source("cloud", schema, std::nullopt, 7);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    source.addPosition({ double(i), 0.0, 0.0 });
    source.addValue(0, values[i]);
  }
  return source;
}

PointStatistics gathered(const PointSource& source, std::size_t bins = 32, unsigned threads = 2)
{
  ThreadCrew crew(threads);
  StatisticsOptions options;
  options.bins = bins;
  options.scan.crew = &crew;
  Result<PointStatistics> result = gatherStatistics(source, options);
  EXPECT_TRUE(result.ok());
  return *result;
}

template <typename T>
ComponentStatistics valuesOf(ScalarType type, const std::vector<T>& values, std::size_t bins = 32)
{
  return gathered(cloudOf(type, values), bins).all.components[3];
}

TEST(PointStatistics, NoPointHasNoNumbers)
{
  const PointStatistics none = gathered(cloudOf<float>(ScalarType::Float32, {}));
  EXPECT_EQ(none.counted.read, 0u);
  EXPECT_TRUE(none.all.bounds.empty());
  EXPECT_FALSE(none.density());
  const ComponentStatistics& v = none.all.components[3];
  EXPECT_EQ(v.count, 0u);
  EXPECT_FALSE(v.low);
  EXPECT_TRUE(std::isnan(v.moments.mean));
  EXPECT_TRUE(v.histogram.empty());
}

TEST(PointStatistics, OnePointAndAllEqual)
{
  for (const std::size_t count : { 1, 100 })
  {
    const auto v = valuesOf(ScalarType::Float64, std::vector<double>(count, 0.1));
    EXPECT_EQ(v.low, ExactValue(0.1));
    EXPECT_EQ(v.high, ExactValue(0.1));
    EXPECT_EQ(v.moments.mean, 0.1);
    EXPECT_EQ(v.moments.deviation, 0.0);
    EXPECT_EQ(v.histogram, std::vector<std::uint64_t>{ count });
  }
}

TEST(PointStatistics, WhatIsNotFiniteIsCountedApart)
{
  const auto v = valuesOf<float>(ScalarType::Float32,
    { 1.0f, float(notANumber), 3.0f, float(infinity), -float(infinity), float(notANumber) }, 2);
  EXPECT_EQ(v.count, 2u);
  EXPECT_EQ(v.notANumber, 2u);
  EXPECT_EQ(v.infinite, 2u);
  EXPECT_EQ(v.low, ExactValue(1.0));
  EXPECT_EQ(v.high, ExactValue(3.0));
  EXPECT_EQ(v.moments.mean, 2.0);
  EXPECT_EQ(v.moments.deviation, 1.0);
  EXPECT_EQ(v.histogram, (std::vector<std::uint64_t>{ 1, 1 }));
}

TEST(PointStatistics, PointsWithoutAPositionAreLeftOut)
{
  CloudSource source = cloudOf<float>(ScalarType::Float32, { 5.0f, 6.0f });
  const float far = 1000.0f;
  for (const glm::dvec3& p : { glm::dvec3(notANumber, 0.0, 0.0), glm::dvec3(0.0, infinity, 0.0),
         glm::dvec3(0.0, 0.0, 1e16) })
  {
    source.addPosition(p);
    source.addValue(0, far);
  }
  const PointStatistics s = gathered(source);
  EXPECT_EQ(s.counted.read, 5u);
  EXPECT_EQ(s.all.points, 2u);
  EXPECT_EQ(s.counted.rejected,
    (std::map<std::string, std::uint64_t>{
      { "infinite", 1 }, { "not a number", 1 }, { "outside the grid's range", 1 } }));
  EXPECT_EQ(s.all.components[3].high, ExactValue(6.0));
}

TEST(PointStatistics, WholeNumbersOf64BitsAreExact)
{
  constexpr std::uint64_t top = UINT64_MAX;
  const auto u = valuesOf<std::uint64_t>(ScalarType::UInt64, { 0, top, top - 1, 1 }, 4);
  EXPECT_EQ(u.low, ExactValue(std::uint64_t(0)));
  EXPECT_EQ(u.high, ExactValue(top));
  EXPECT_EQ(u.moments.mean, std::ldexp(1.0, 63));
  EXPECT_NEAR(u.moments.deviation / std::ldexp(1.0, 63), 1.0, 1e-12);
  EXPECT_EQ(u.histogram, (std::vector<std::uint64_t>{ 2, 0, 0, 2 }));
  const auto near = valuesOf<std::uint64_t>(ScalarType::UInt64, { top, top - 2 }, 8);
  EXPECT_EQ(near.low, ExactValue(top - 2));
  EXPECT_EQ(near.moments.deviation, 1.0); // as doubles both are 2^64
  EXPECT_EQ(near.histogram, (std::vector<std::uint64_t>{ 1, 0, 1 }));
  const auto i = valuesOf<std::int64_t>(ScalarType::Int64, { INT64_MIN, INT64_MAX, -1 });
  EXPECT_EQ(i.low, ExactValue(std::int64_t(INT64_MIN)));
  EXPECT_EQ(i.high, ExactValue(std::int64_t(INT64_MAX)));
}

TEST(PointStatistics, MillimetresAtTenMillion)
{
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i)
  {
    values.push_back(1e7 + 0.001 * i);
  }
  const auto v = valuesOf(ScalarType::Float64, values);
  EXPECT_NEAR(v.moments.mean, 1e7 + 0.4995, 2e-9);
  EXPECT_NEAR(v.moments.deviation, 0.001 * std::sqrt((1000.0 * 1000.0 - 1.0) / 12.0), 1e-9);
}

TEST(PointStatistics, AFarValueDoesNotDrownTheOthers)
{
  std::vector<double> values(9999, 1.0);
  values.push_back(1e9);
  const auto v = valuesOf(ScalarType::Float64, values);
  const double share = 1e-4;
  EXPECT_NEAR(v.moments.mean, 1.0 + share * (1e9 - 1.0), 1e-4);
  EXPECT_NEAR(v.moments.deviation, (1e9 - 1.0) * std::sqrt(share * (1.0 - share)), 1e-3);
}

TEST(PointStatistics, TheWholeRangeOfDoubles)
{
  constexpr double most = std::numeric_limits<double>::max();
  const auto v = valuesOf<double>(ScalarType::Float64, { -most, most }, 2);
  EXPECT_NEAR(v.moments.mean / most, 0.0, 1e-12);
  EXPECT_NEAR(v.moments.deviation / most, 1.0, 1e-12);
  EXPECT_EQ(v.histogram, (std::vector<std::uint64_t>{ 1, 1 }));
}

TEST(PointStatistics, ScaledValuesAreInWorldUnits)
{
  const auto source = cloudOf<std::int16_t>(ScalarType::Int16, { -100, 300 }, 0.01);
  const ComponentStatistics v = gathered(source).all.components[3];
  EXPECT_EQ(v.low, ExactValue(-1.0));
  EXPECT_EQ(v.high, ExactValue(3.0));
  EXPECT_NEAR(v.moments.mean, 1.0, 1e-12);
}

TEST(PointStatistics, HistogramOfWholeNumbers)
{
  std::vector<std::uint16_t> values(100);
  std::iota(values.begin(), values.end(), std::uint16_t(50));
  const auto wide = valuesOf(ScalarType::UInt16, values, 10);
  std::vector<std::uint64_t> expected(10);
  for (std::uint64_t i = 0; i < 100; ++i)
  {
    ++expected[std::min<std::uint64_t>(9, i * 10 / 99)];
  }
  EXPECT_EQ(wide.histogram, expected);
  EXPECT_EQ(valuesOf(ScalarType::UInt16, values, 100).histogram,
    std::vector<std::uint64_t>(100, 1)); // a bin for each value
}

/// Every number that a report shows.
std::vector<double> numbersOf(const PointStatistics& s)
{
  std::vector<double> numbers{ s.density().value_or(-1.0), s.all.bounds.low.x };
  const auto add = [&numbers](const GroupStatistics& group)
  {
    numbers.push_back(double(group.points));
    for (const ComponentStatistics& c : group.components)
    {
      numbers.insert(numbers.end(), { c.moments.mean, c.moments.deviation });
      numbers.insert(numbers.end(), c.histogram.begin(), c.histogram.end());
    }
  };
  add(s.all);
  for (const auto& [number, group] : s.classes)
  {
    numbers.push_back(number);
    add(group);
  }
  return numbers;
}

TEST(PointStatistics, SameForAnyNumberOfThreadsAndClassesAddUp)
{
  AttributeSchema schema;
  schema.add({ "classification", ScalarType::UInt8, 1 });
  schema.add({ "v", ScalarType::Float32, 2 });
  CloudSource source("cloud", schema, std::nullopt, 50);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 5000; ++i)
  {
    source.addPosition({ 1e6 * unit(random), 1e6 * unit(random), unit(random) });
    source.addValue(0, std::uint8_t(i % 3 == 0 ? 2 : 255));
    source.addValue(1, float(unit(random)));
    source.addValue(1, float(-unit(random)));
  }
  const PointStatistics one = gathered(source, 32, 1);
  ASSERT_EQ(one.classes.size(), 2u);
  EXPECT_EQ(one.classes.at(2).points, 1667u);
  EXPECT_EQ(one.classes.at(255).points, 3333u);
  EXPECT_EQ(one.names.back().component, 1u);
  for (const unsigned threads : { 2u, 7u })
  {
    EXPECT_EQ(numbersOf(gathered(source, 32, threads)), numbersOf(one));
  }
  for (std::size_t b = 0; b < 32; ++b)
  {
    EXPECT_EQ(
      one.classes.at(2).components[4].histogram[b] + one.classes.at(255).components[4].histogram[b],
      one.all.components[4].histogram[b]);
  }
}

TEST(PointStatistics, TheFirstErrorComesOut)
{
  CloudSource source = cloudOf(ScalarType::UInt8, std::vector<std::uint8_t>(100));
  source.failAt(3);
  ThreadCrew crew(3);
  StatisticsOptions options;
  options.scan.crew = &crew;
  const auto failed = gatherStatistics(source, options);
  ASSERT_FALSE(failed.ok());
  EXPECT_EQ(failed.error().kind, Error::Kind::Truncated);
  EXPECT_FALSE(countPoints(source, options.scan).ok());
}

TEST(GroundCells, DensityLeavesOutTheGap)
{
  // Two squares of 100 x 100 points at 1 m, far apart: their box is mostly empty.
  CloudSource source("cloud", {}, std::nullopt, 1000);
  for (int i = 0; i < 20000; ++i)
  {
    const double away = i < 10000 ? 0.0 : 900.0;
    source.addPosition({ i % 100 + away, i / 100 % 100 + away, 0.0 });
  }
  const PointStatistics s = gathered(source);
  ASSERT_TRUE(s.density());
  EXPECT_NEAR(*s.density(), 1.0, 0.5);
  EXPECT_NEAR(s.cellSize, std::sqrt(16.0 * 999.0 * 999.0 / 20000.0), 1e-9);
}

TEST(GroundCells, ALineHasNoGround)
{
  Bounds line;
  line.add({ 0.0, 0.0, 0.0 });
  line.add({ 9.0, 0.0, 5.0 });
  GroundCells cells(line, 10);
  cells.add({ 3.0, 0.0, 1.0 });
  EXPECT_EQ(cells.cellSize(), 0.0);
  EXPECT_EQ(cells.occupied(), 0u);
}

TEST(GroundCells, NoMoreCellsThanTheMemoryIsFor)
{
  Bounds thin;
  thin.add({ 0.0, 0.0, 0.0 });
  thin.add({ 1e12, 1e-3, 0.0 });
  GroundCells cells(thin, 1'000'000'000);
  cells.add(thin.low);
  cells.add(thin.high);
  EXPECT_EQ(cells.occupied(), 2u);
  EXPECT_LE(std::floor(1e12 / cells.cellSize()), double(GroundCells::mostCells));
}

} // namespace
} // namespace pointfront::test
