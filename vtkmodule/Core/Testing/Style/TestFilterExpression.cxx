#include "StyledStore.h"

#include "pointfront/Base/Infinity.h"
#include "pointfront/Style/ClassHeights.h"
#include "pointfront/Style/FilterExpression.h"

#include <gtest/gtest.h>

#include <memory>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

AttributeCondition only(const std::string& text)
{
  const auto filter = FilterExpression::parse(text);
  EXPECT_TRUE(filter) << text << ": " << (filter ? "" : filter.error().what);
  if (!filter || filter->terms.size() != 1)
  {
    ADD_FAILURE() << text;
    return {};
  }
  return filter->terms.front().passing;
}

std::string failure(const std::string& text)
{
  const auto filter = FilterExpression::parse(text);
  EXPECT_FALSE(filter) << text;
  return filter ? "" : filter.error().what;
}

} // namespace

TEST(FilterExpression, RangesHaveOpenAndClosedEnds)
{
  const AttributeCondition closed = only("gps_time in [1.5, 2e3]");
  EXPECT_EQ(closed.range, (std::array<ConditionNumber, 2>{ 1.5, 2000.0 }));
  EXPECT_FALSE(closed.lowOpen || closed.highOpen || closed.inverted);
  const AttributeCondition halfOpen = only("t in [-1,+2)");
  EXPECT_EQ(halfOpen.range, (std::array<ConditionNumber, 2>{ -1.0, 2.0 }));
  EXPECT_TRUE(!halfOpen.lowOpen && halfOpen.highOpen);
  const AttributeCondition open = only("t in(-inf , 3]");
  EXPECT_EQ(open.range, (std::array<ConditionNumber, 2>{ -infinity, 3.0 }));
  EXPECT_TRUE(open.lowOpen && !open.highOpen);
}

TEST(FilterExpression, WholeNumbersOf64BitsAreTakenExactly)
{
  EXPECT_EQ(only("a == 4611686018427387905").values.front(),
    static_cast<ConditionNumber>(4611686018427387905));
  EXPECT_EQ(
    only("a > -9223372036854775807").range[0], static_cast<ConditionNumber>(-9223372036854775807));
  EXPECT_EQ(
    only("a < 18446744073709551615").range[1], static_cast<ConditionNumber>(18446744073709551615u));
  EXPECT_EQ(only("a in {9007199254740993, 9007199254740992}").values.size(), 2u);
  EXPECT_EQ(only("a < 18446744073709551616").range[1], 18446744073709551616.0L); // a double
  EXPECT_EQ(only("a == 0.1").values.front(), static_cast<ConditionNumber>(0.1)); // a double
  EXPECT_EQ(only("a == 4611686018427387905.0").values.front(),
    static_cast<ConditionNumber>(4611686018427387905));
  EXPECT_EQ(only("a == -9007199254740993.").values.front(),
    static_cast<ConditionNumber>(-9007199254740993));
}

TEST(FilterExpression, FractionsThatNoDoubleHoldsAreRefused)
{
  EXPECT_EQ(failure("a > -1152921504606846975.5"),
    "'a > -1152921504606846975.5', character 5: expected a whole number, as a double of that size "
    "has no fraction, not '-115292150460684'");
  EXPECT_NE(failure("a in {1, 4503599627370496.25}").find("character 10"), std::string::npos);
  EXPECT_EQ(only("a > -4503599627370495.5").range[0], -4503599627370495.5L);
  EXPECT_EQ(only("a < 1.5e300").range[1], static_cast<ConditionNumber>(1.5e300));
  EXPECT_EQ(
    only("a < 1.1529215046068472e+18").range[1], static_cast<ConditionNumber>(1152921504606847232));
}

TEST(FilterExpression, SetsAreSortedAndComparisonsAreRanges)
{
  EXPECT_EQ(only("a in {7, 3,3}").values, (std::vector<ConditionNumber>{ 3.0, 7.0 }));
  EXPECT_TRUE(only("a not in {7}").inverted);
  EXPECT_EQ(only("a==1").values, std::vector<ConditionNumber>{ 1.0 });
  EXPECT_TRUE(only("a != 1").inverted);
  EXPECT_EQ(only("a < 1").range, (std::array<ConditionNumber, 2>{ -infinity, 1.0 }));
  EXPECT_TRUE(only("a < 1").highOpen);
  EXPECT_FALSE(only("a <= 1").highOpen);
  EXPECT_EQ(only("a > 1").range, (std::array<ConditionNumber, 2>{ 1.0, infinity }));
  EXPECT_TRUE(only("a > 1").lowOpen);
  EXPECT_FALSE(only("a >= 1").lowOpen);
}

TEST(FilterExpression, ConditionsAreJoinedByAnd)
{
  const auto filter =
    FilterExpression::parse("return_number == 1 AND \"my value\" in [0, 1] and android < 3");
  ASSERT_TRUE(filter) << filter.error().what;
  ASSERT_EQ(filter->terms.size(), 3u);
  EXPECT_EQ(filter->terms[1].name, "my value");
  EXPECT_EQ(filter->terms[2].name, "android");
  EXPECT_TRUE(FilterExpression::parse("  ")->empty());
}

TEST(FilterExpression, AQuotedNameIsNoKeyWord)
{
  const auto filter =
    FilterExpression::parse(R"("and" > 5 and "in" in {1} and "not" not in {2} and "AND"==3)");
  ASSERT_TRUE(filter) << filter.error().what;
  ASSERT_EQ(filter->terms.size(), 4u);
  EXPECT_EQ(filter->terms[0].name, "and");
  EXPECT_EQ(filter->terms[1].name, "in");
  EXPECT_EQ(filter->terms[3].name, "AND");
  EXPECT_EQ(failure("in > 5"),
    "'in > 5', character 1: expected the name of an attribute, or \"in\" in quotes, not 'in > 5'");
  EXPECT_NE(failure(R"("" > 5)").find("character 1: expected the name"), std::string::npos);
}

TEST(FilterExpression, MistakesAreNamedWithTheirPlace)
{
  EXPECT_EQ(failure("intensity = 3"),
    "'intensity = 3', character 11: expected 'in', ==, !=, <, <=, > or >=, not '= 3'");
  EXPECT_EQ(failure("a in [1, 2"), "'a in [1, 2', character 11: expected ']' or ')', not the end");
  EXPECT_EQ(failure("a in [2, 1]"),
    "'a in [2, 1]', character 7: expected a range that holds a number, not '2, 1]'");
  EXPECT_EQ(failure("a == 1 or b == 2"),
    "'a == 1 or b == 2', character 8: expected 'and' or the end, not 'or b == 2'");
  EXPECT_EQ(failure("a in {}"), "'a in {}', character 7: expected a number, not '}'");
  for (const char* text : { "== 3", "a", "a in", "a in 3", "a in {1;2}", "a < x", "a < nan",
         "a < 1 and", "a not 3", "a < 3m", "a in (1, 1]", "\"a < 3", "and and == 3" })
  {
    EXPECT_NE(failure(text).find("character"), std::string::npos) << text;
  }
}

TEST(FilterExpression, NamesMeanAttributesComponentsOrCoordinates)
{
  const StoreDescription store = styledStore({});
  const auto filter = FilterExpression::parse(
    "GPS-Time > 1 and rgb[1] > 2 and normal.z > 0 and rgb.b < 9 and X > 1000 and elevation < 80");
  ASSERT_TRUE(filter) << filter.error().what;
  const auto resolved = filter->resolve(store);
  ASSERT_TRUE(resolved) << resolved.error().what;
  const auto& c = resolved->conditions;
  ASSERT_EQ(c.size(), 6u);
  EXPECT_EQ(c[0].column, timeColumn);
  EXPECT_EQ(c[1].column, rgbColumn);
  EXPECT_EQ(c[1].component, 1);
  EXPECT_EQ(c[2].column, normalsColumn);
  EXPECT_EQ(c[2].component, 2);
  EXPECT_EQ(c[3].component, 2);
  EXPECT_EQ(c[4].axis, 0);
  EXPECT_EQ(c[4].axisOffset, 1000.0);
  EXPECT_EQ(c[5].axis, 2);
  EXPECT_EQ(resolved->columns(), (ColumnSelection{ rgbColumn, timeColumn, normalsColumn }));
}

TEST(FilterExpression, AnAttributeGoesBeforeACoordinateOfItsName)
{
  StoreDescription store = styledStore({});
  addColumn(store, { "x", ScalarType::Float32, 1 }, 0.0, 1.0);
  const auto resolved = FilterExpression::parse("x > 0.5")->resolve(store);
  ASSERT_TRUE(resolved);
  EXPECT_EQ(resolved->conditions.front().axis, -1);
  EXPECT_EQ(resolved->conditions.front().column, store.schema.size() - 1);
}

TEST(FilterExpression, WhatNoStoreHoldsIsDerived)
{
  const StoreDescription store = styledStore({});
  const auto level = FilterExpression::parse("Horizontality > 0.9");
  ASSERT_TRUE(level);
  EXPECT_FALSE(level->wantsHeights(store));
  const auto ofNormals = level->resolve(store);
  ASSERT_TRUE(ofNormals) << ofNormals.error().what;
  EXPECT_EQ(ofNormals->conditions[0].column, normalsColumn);
  EXPECT_EQ(ofNormals->conditions[0].component, 2);
  EXPECT_TRUE(ofNormals->conditions[0].absolute);

  const auto high = FilterExpression::parse("x > 3 and global-height in [0.5, 1]");
  ASSERT_TRUE(high);
  ASSERT_TRUE(high->wantsHeights(store));
  const HierarchyTable table({}, {}, Refinement::Add);
  const auto heights = std::make_shared<const ClassHeights>(store, table);
  const auto ofHeights = high->resolve(store, heights);
  ASSERT_TRUE(ofHeights) << ofHeights.error().what;
  EXPECT_EQ(ofHeights->conditions[1].heights, heights);
  EXPECT_TRUE(ofHeights->columns().empty());
  EXPECT_EQ(ofHeights->conditions[0].heights, nullptr);
}

TEST(FilterExpression, AnAttributeGoesBeforeWhatIsDerived)
{
  StoreDescription store = styledStore({});
  addColumn(store, { "global_height", ScalarType::Float32, 1 }, 0.0, 1.0);
  addColumn(store, { "horizontality", ScalarType::Float32, 1 }, 0.0, 1.0);
  const auto filter = FilterExpression::parse("global-height > 0.5 and horizontality > 0.5");
  EXPECT_FALSE(filter->wantsHeights(store));
  const auto resolved = filter->resolve(store);
  ASSERT_TRUE(resolved);
  EXPECT_EQ(resolved->conditions[0].column, store.schema.size() - 2);
  EXPECT_EQ(resolved->conditions[1].column, store.schema.size() - 1);
  EXPECT_FALSE(resolved->conditions[1].absolute);
}

TEST(FilterExpression, HorizontalityNeedsNormals)
{
  StoreDescription store;
  store.path = "plain.pfront";
  const auto resolved = FilterExpression::parse("horizontality > 0.5")->resolve(store);
  ASSERT_FALSE(resolved);
  EXPECT_EQ(resolved.error().what,
    "'horizontality > 0.5', character 1: plain.pfront has no attribute 'normal', which "
    "horizontality needs: build it with --normals pca");
}

TEST(FilterExpression, ANumberIsTheValueThatIsWrittenSo)
{
  StoreDescription store = styledStore({});
  store.grid = { glm::dvec3(0.001), glm::dvec3(400000.0, 0.0, 0.0) };
  addColumn(store, { "angle", ScalarType::Float32, 1 }, -1.0, 1.0);
  addColumn(store, { "slope", ScalarType::Int16, 1, 0.0001 }, -1.0, 1.0);
  const auto range = [&store](const char* text)
  { return FilterExpression::parse(text)->resolve(store)->conditions[0].range; };
  using Range = std::array<ConditionNumber, 2>;
  EXPECT_EQ(range("angle >= 0.1")[0], ConditionNumber(0.1f));
  EXPECT_EQ(range("angle >= 0.1000000001")[0], ConditionNumber(0.1000000001));
  ASSERT_NE(9900 * 0.0001, 0.99);
  EXPECT_EQ(range("slope > 0.99")[0], ConditionNumber(9900 * 0.0001));
  EXPECT_EQ(range("slope in [-0.99, 0.99005]"),
    (Range{ ConditionNumber(-9900 * 0.0001), ConditionNumber(0.99005) }));
  EXPECT_EQ(range("x >= 400000.123")[0], ConditionNumber(123 * 0.001 + 400000.0));
  EXPECT_EQ(range("angle in (-inf, inf)"), (Range{ -infinity, infinity }));
  const auto set = FilterExpression::parse("slope in {0.99, 0.5}")->resolve(store);
  EXPECT_EQ(set->conditions[0].values.back(), ConditionNumber(9900 * 0.0001));
}

TEST(FilterExpression, WhatAStoreHasNotIsRefused)
{
  const StoreDescription store = styledStore({});
  const auto resolve = [&](const char* text)
  {
    const auto resolved = FilterExpression::parse(text)->resolve(store);
    EXPECT_FALSE(resolved) << text;
    return resolved ? std::string() : resolved.error().what;
  };
  EXPECT_EQ(resolve("x > 1 and weight < 3"),
    "'x > 1 and weight < 3', character 11: town.pfront has no attribute 'weight' (info lists "
    "them)");
  EXPECT_NE(resolve("rgb > 3").find("write one of them, rgb[0]"), std::string::npos);
  EXPECT_NE(resolve("rgb[3] > 3").find("no attribute 'rgb[3]'"), std::string::npos);
}
