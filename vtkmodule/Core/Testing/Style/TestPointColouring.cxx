#include "pointfront/Base/Infinity.h"
#include "pointfront/Style/ClassHeights.h"
#include "pointfront/Style/PointColouring.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

using namespace pointfront;
using Kind = PointColouring::Kind;
using Mode = ColourRequest::Mode;

namespace
{

StoreDescription description()
{
  StoreDescription result;
  const auto add = [&](Attribute attribute, double low, double high)
  {
    ColumnRange range;
    range.components.assign(attribute.components, { low, high });
    result.ranges.push_back(range);
    result.schema.add(std::move(attribute));
  };
  add({ "rgb", ScalarType::UInt16, 3 }, 0.0, 65535.0);
  add({ "classification", ScalarType::UInt8, 1 }, 2.0, 9.0);
  add({ "gps_time", ScalarType::Float64, 1 }, 3e8, 3e8 + 10.0);
  add({ "normal", ScalarType::Float32, 3 }, -1.0, 1.0);
  add({ "scaled", ScalarType::Int16, 1, 0.1, 5.0 }, -10.0, 10.0);
  return result;
}

template <typename T>
NodeColumns nodeOf(std::uint32_t column, std::vector<T> values, std::size_t points)
{
  NodeColumns node;
  node.positions.resize(points);
  node.selection = { column };
  node.columns.emplace_back(values.size() * sizeof(T));
  std::memcpy(node.columns[0].data(), values.data(), node.columns[0].size());
  return node;
}

float number(std::uint32_t value)
{
  float result;
  std::memcpy(&result, &value, 4);
  return result;
}

TEST(PointColouring, KindsFollowVtksModes)
{
  const StoreDescription store = description();
  const auto kind = [&](const char* name, Mode mode)
  {
    ColourRequest request;
    request.name = name;
    request.mode = mode;
    return PointColouring::choose(store, request)->kind;
  };
  EXPECT_EQ(kind("", Mode::Default), Kind::Flat);
  EXPECT_EQ(kind("rgb", Mode::Default), Kind::Direct);
  EXPECT_EQ(kind("rgb", Mode::Table), Kind::Table);
  EXPECT_EQ(kind("normal", Mode::Default), Kind::Table);
  EXPECT_EQ(kind("normal", Mode::Direct), Kind::Direct);
  EXPECT_EQ(kind("classification", Mode::Direct), Kind::Table);
  EXPECT_EQ(kind("Elevation", Mode::Default), Kind::Elevation);
  ColourRequest unknown;
  unknown.name = "temperature";
  EXPECT_FALSE(PointColouring::choose(store, unknown));
}

/// As VTK's arrays of such a colour, whose ranges the table has.
TEST(PointColouring, OneChannelOfAWideColourCountsInBytesIfAskedTo)
{
  const NodeColumns node = nodeOf<std::uint16_t>(0, { 0x1234, 0x80ff, 0xffff }, 1);
  ColourRequest request;
  request.name = "rgb";
  request.mode = Mode::Table;
  for (const bool inBytes : { false, true })
  {
    request.coloursInBytes = inBytes;
    request.component = 1;
    const auto green = *PointColouring::choose(description(), request);
    std::vector<std::uint32_t> values;
    green.encode(node, description().schema, 0, 1, values);
    EXPECT_EQ(number(values[0]), inBytes ? 0x80 : 0x80ff);
    EXPECT_EQ(green.integers.has_value(), inBytes) << "few enough for an entry each";
    request.component = -1;
    values.clear();
    PointColouring::choose(description(), request)
      ->encode(node, description().schema, 0, 1, values);
    const double red = inBytes ? 0x12 : 0x1234, blue = inBytes ? 0xff : 0xffff;
    const double middle = inBytes ? 0x80 : 0x80ff;
    EXPECT_FLOAT_EQ(
      number(values[0]), static_cast<float>(std::sqrt(red * red + middle * middle + blue * blue)));
  }
}

TEST(PointColouring, NeedsOnlyItsColumn)
{
  ColourRequest request;
  request.name = "gps_time";
  const auto time = *PointColouring::choose(description(), request);
  EXPECT_EQ(time.columns(), ColumnSelection{ 2 });
  EXPECT_TRUE(time.coveredBy(nodeOf<double>(2, { 1.0 }, 1)));
  EXPECT_FALSE(time.coveredBy(nodeOf<double>(1, { 1.0 }, 1)));
  request.name = "elevation";
  EXPECT_TRUE(PointColouring::choose(description(), request)->columns().empty());
}

TEST(PointColouring, LargeValuesAreKeptRelativeToTheLowest)
{
  ColourRequest request;
  request.name = "gps_time";
  const StoreDescription store = description();
  const auto time = *PointColouring::choose(store, request);
  EXPECT_EQ(time.base, 3e8);
  std::vector<std::uint32_t> values;
  time.encode(nodeOf<double>(2, { 3e8, 3e8 + 0.25, 3e8 + 9.5 }, 3), store.schema, 1, 2, values);
  ASSERT_EQ(values.size(), 2u);
  EXPECT_EQ(number(values[0]), 0.25f);
  EXPECT_EQ(number(values[1]), 9.5f);
}

/// By how much the GPU's floats, added as ColourMapTexture adds them, miss `value`.
double lossOf(const PointColouring& colouring, double value, double low)
{
  const auto stored = static_cast<float>(value - colouring.base);
  const auto shift = static_cast<float>(colouring.base - low);
  return std::abs(static_cast<double>(stored + shift) - (value - low));
}

TEST(PointColouring, OneLowValueLeavesTheOthersTheirDigits)
{
  ColourRequest request;
  request.name = "gps_time";
  for (const double lowest : { 0.0, -1e10, -3.4e38, -infinity, infinity })
  {
    StoreDescription store = description();
    store.ranges[2].components[0] = { lowest, std::max(lowest, 3e8 + 40.0) };
    for (const std::size_t entries : { 1, 2, 256, 1000, 8192 })
    {
      for (const double width : { 1e-3, 1.0, 40.0 })
      {
        auto time = *PointColouring::choose(store, request);
        EXPECT_TRUE(std::isfinite(time.base));
        ColourMap map;
        map.entries.resize(entries);
        map.range = { 3e8 + 0.1, 3e8 + 0.1 + width };
        time.fitTo(map);
        for (double share = 0.0; share <= 1.0; share += 0.0625)
        {
          const double value = map.range[0] + share * (map.range[1] - map.range[0]);
          EXPECT_LE(lossOf(time, value, map.range[0]),
            width / 512.0 / std::min<double>(static_cast<double>(entries), 1024.0))
            << lowest << ' ' << entries << ' ' << width << ' ' << share;
        }
      }
    }
  }
}

/// Shares of the range are those of floats, and none of them is lost or infinite.
TEST(PointColouring, RangesBeyondFloatsHaveAUnit)
{
  constexpr double most = std::numeric_limits<double>::max();
  ColourRequest request;
  request.name = "gps_time";
  ColourMap map;
  map.entries.resize(256);
  for (const auto& [low, high] : { std::pair(-most, most), std::pair(-1e300, 1e300),
         std::pair(1e200, 2e200), std::pair(1e200, 1e200 * (1.0 + 1e-9)), std::pair(1e-300, 2e-300),
         std::pair(-1e-310, 1e-310), std::pair(1.0, 2.0) })
  {
    StoreDescription store = description();
    for (const double lowest : { low, -most, 0.0 })
    {
      SCOPED_TRACE(testing::Message() << low << " to " << high << ", lowest " << lowest);
      store.ranges[2].components[0] = { lowest, most };
      auto time = *PointColouring::choose(store, request);
      map.range = { low, high };
      time.fitTo(map);
      EXPECT_EQ(time.unit == 1.0, high == 2.0);
      const float first = time.floatOf(low);
      const float width = time.floatOf(high) - first;
      ASSERT_TRUE(std::isfinite(256.0f / width));
      for (double share = 0.0; share <= 1.0; share += 0.0625)
      {
        const float place = time.floatOf(low * (1.0 - share) + high * share) - first;
        EXPECT_NEAR(place / width, share, 1.0 / 256.0 / 256.0) << share;
      }
    }
  }
}

TEST(PointColouring, LogarithmsBeyondFloatsAreTakenBefore)
{
  ColourRequest request;
  request.name = "gps_time";
  auto time = *PointColouring::choose(description(), request);
  ColourMap map;
  map.logarithmic = true;
  map.range = { 1e-300, 1e200 };
  time.fitTo(map);
  EXPECT_FLOAT_EQ(time.floatOf(1e-150), -150.0f);
  EXPECT_EQ(time.floatOf(0.0), -infinity);
  EXPECT_EQ(time.floatOf(-1.0), -infinity);
  EXPECT_EQ(time.floatOf(infinity), infinity);
  EXPECT_TRUE(std::isnan(time.floatOf(std::nan(""))));
}

TEST(PointColouring, TheBaseStaysWhereFloatsAllowIt)
{
  StoreDescription store = description();
  ColourRequest request;
  request.name = "gps_time";
  ColourMap map;
  map.entries.resize(256);
  const auto placed = [&](double low, double high)
  {
    auto colouring = *PointColouring::choose(store, request);
    map.range = { low, high };
    colouring.fitTo(map);
    return colouring.base;
  };
  EXPECT_EQ(placed(3e8, 3e8 + 10.0), 3e8);
  EXPECT_EQ(placed(3e8 + 9.0, 3e8 + 9.5), 3e8) << "64 widths away at most";
  store.ranges[2].components[0][0] = 0.0;
  const double base = placed(3e8 + 0.5, 3e8 + 1.0);
  EXPECT_NEAR(base, 3e8, 16.0);
  for (double low = 0.5; low < 4.0; low += 0.1)
  {
    EXPECT_EQ(placed(3e8 + low, 3e8 + low + 0.5), base) << "is on a grid";
  }
  EXPECT_EQ(placed(1.0, 1.0), 0.0) << "no range";
  EXPECT_EQ(placed(-infinity, infinity), 0.0) << "no range";
}

TEST(PointColouring, LogarithmsOfValuesFarAboveTheLowestCountFromZero)
{
  StoreDescription store = description();
  ColourRequest request;
  request.name = "gps_time";
  ColourMap map;
  map.entries.resize(256);
  map.range = { 0.5, 5.0 };
  map.logarithmic = true;
  for (const auto& [lowest, base] :
    { std::pair(-1e10, 0.0), std::pair(-0.25, -0.25), std::pair(2.0, 2.0) })
  {
    store.ranges[2].components[0][0] = lowest;
    auto time = *PointColouring::choose(store, request);
    time.fitTo(map);
    EXPECT_EQ(time.base, base);
  }
}

/// Their values are what they are, however far a range is from them.
TEST(PointColouring, WholeNumbersThatFloatsHoldKeepTheirBase)
{
  StoreDescription store = description();
  ColourRequest request;
  request.name = "rgb";
  request.mode = Mode::Table;
  request.component = 0;
  ColourMap map;
  map.entries.resize(256);
  map.range = { 60000.0, 60001.0 };
  auto red = *PointColouring::choose(store, request);
  red.fitTo(map);
  EXPECT_EQ(red.base, 0.0);
}

TEST(PointColouring, ScaleAndOffsetAreApplied)
{
  ColourRequest request;
  request.name = "scaled";
  const StoreDescription store = description();
  const auto scaled = *PointColouring::choose(store, request);
  EXPECT_DOUBLE_EQ(scaled.base, 4.0);
  std::vector<std::uint32_t> values;
  scaled.encode(nodeOf<std::int16_t>(4, { -10, 10 }, 2), store.schema, 0, 2, values);
  EXPECT_FLOAT_EQ(number(values[0]), 0.0f);
  EXPECT_FLOAT_EQ(number(values[1]), 2.0f);
}

TEST(PointColouring, SixteenBitColoursAreReducedOnlyWhenTheyAreWide)
{
  StoreDescription store = description();
  ColourRequest request;
  request.name = "rgb";
  const auto bytes = [&](std::vector<std::uint16_t> rgb)
  {
    std::vector<std::uint32_t> values;
    PointColouring::choose(store, request)
      ->encode(nodeOf<std::uint16_t>(0, std::move(rgb), 1), store.schema, 0, 1, values);
    std::array<std::uint8_t, 4> result;
    std::memcpy(result.data(), values.data(), 4);
    return result;
  };
  EXPECT_EQ(bytes({ 0xffff, 0x8000, 0x00ff }), (std::array<std::uint8_t, 4>{ 255, 128, 0, 255 }));
  store.ranges[0].components.assign(3, { 0.0, 255.0 });
  EXPECT_EQ(bytes({ 255, 128, 7 }), (std::array<std::uint8_t, 4>{ 255, 128, 7, 255 }));
}

TEST(PointColouring, MagnitudeAndComponents)
{
  const StoreDescription store = description();
  ColourRequest request;
  request.name = "normal";
  const NodeColumns node = nodeOf<float>(3, { 3.0f, 0.0f, 4.0f }, 1);
  std::vector<std::uint32_t> values;
  PointColouring::choose(store, request)->encode(node, store.schema, 0, 1, values);
  request.component = 2;
  const auto z = *PointColouring::choose(store, request);
  z.encode(node, store.schema, 0, 1, values);
  EXPECT_FLOAT_EQ(number(values[0]), 5.0f);
  EXPECT_FLOAT_EQ(number(values[1]) + static_cast<float>(z.base), 4.0f);
}

TEST(PointColouring, AVectorOverARangeIsAColour)
{
  StoreDescription store = description();
  store.schema = {};
  store.ranges.resize(1);
  store.ranges[0].components.assign(3, { -100.0, 100.0 });
  store.schema.add({ "normal", ScalarType::Int16, 3, 0.01 });
  ColourRequest request;
  request.name = "normal";
  request.mode = Mode::Direct;
  request.colourRange = { -1.0, 1.0 };
  const auto colouring = *PointColouring::choose(store, request);
  EXPECT_EQ(colouring.kind, Kind::Direct);
  std::vector<std::uint32_t> values;
  colouring.encode(nodeOf<std::int16_t>(0, { -100, 0, 100 }, 1), store.schema, 0, 1, values);
  std::array<std::uint8_t, 4> rgba;
  std::memcpy(rgba.data(), values.data(), 4);
  EXPECT_EQ(rgba, (std::array<std::uint8_t, 4>{ 0, 127, 255, 255 }));
  request.colourRange = { 0.0, 1.0 };
  EXPECT_NE(colouring, *PointColouring::choose(store, request)); // values are uploaded again
}

TEST(PointColouring, HorizontalityIsOfTheNormal)
{
  StoreDescription store = description();
  ColourRequest request;
  request.name = "horizontality";
  const auto horizontality = *PointColouring::choose(store, request);
  EXPECT_EQ(horizontality.columns(), ColumnSelection{ 3 });
  std::vector<std::uint32_t> values;
  horizontality.encode(
    nodeOf<float>(3, { 0.6f, 0.0f, -0.8f, 1.0f, 0.0f, 0.0f }, 2), store.schema, 0, 2, values);
  EXPECT_FLOAT_EQ(number(values[0]), 0.8f); // a ceiling is as flat as a roof
  EXPECT_FLOAT_EQ(number(values[1]), 0.0f);
  store.schema.add({ "horizontality", ScalarType::Float32, 1 });
  store.ranges.push_back({ { { 0.0, 1.0 } } });
  EXPECT_EQ(PointColouring::choose(store, request)->columns(), ColumnSelection{ 5 }); // its own
  EXPECT_FALSE(PointColouring::choose(StoreDescription(), request));
}

/// Two layers: one from z = 0 to 10, one with the single height 4.
class TwoClasses final : public StoredCloud
{
public:
  TwoClasses()
  {
    description_.layers.resize(2);
    description_.grid.scale = { 0.1, 0.1, 0.5 };
    description_.grid.offset = { 0.0, 0.0, -1.0 };
    std::vector<Node> nodes(2);
    nodes[0].centre.z = 5.0;
    nodes[0].halfSize.z = 5.0f;
    nodes[0].pointsBelow = 7;
    nodes[1].centre.z = 4.0;
    nodes[1].pointsBelow = 1;
    nodes[1].layer = 1;
    hierarchy_ =
      std::make_shared<HierarchyTable>(nodes, std::vector<NodeIndex>{ 0, 1 }, Refinement::Add);
  }
  const StoreDescription& description() const override { return description_; }
  const std::shared_ptr<const Hierarchy>& hierarchy() const override { return hierarchy_; }
  Result<VerifyReport> verify(const ProgressFunction&) const override { return VerifyReport(); }
  Result<NodeColumns> decode(const FetchedNode&) const override { return NodeColumns(); }
  std::size_t decodedBytes(NodeIndex, std::uint32_t, const ColumnSelection&) const override
  {
    return 0;
  }
  std::size_t storedBytes(NodeIndex, const ColumnSelection&) const override { return 0; }

private:
  StoreDescription description_;
  std::shared_ptr<const Hierarchy> hierarchy_;
};

TEST(PointColouring, GlobalHeightIsAmongThePointsOfAClass)
{
  const auto store = std::make_shared<TwoClasses>();
  ColourRequest request;
  request.name = "global_height";
  ASSERT_TRUE(PointColouring::wantsHeights(store->description(), request));
  const auto heights = std::make_shared<ClassHeights>(store);
  const auto colouring = *PointColouring::choose(store->description(), request, heights);
  EXPECT_TRUE(colouring.columns().empty());
  EXPECT_TRUE(colouring.hasValues() && colouring.usesTable());
  NodeColumns node;
  node.node = 0;
  node.origin.z = 4; // z = 1
  node.positions = { { 9, 9, 0 }, { 9, 9, 8 }, { 9, 9, 18 }, { 9, 9, 40 } };
  EXPECT_TRUE(colouring.coveredBy(node));
  std::vector<std::uint32_t> values;
  colouring.encode(node, store->description().schema, 0, 2, values);
  colouring.encode(node, store->description().schema, 2, 2, values);
  EXPECT_FLOAT_EQ(number(values[0]), 0.1f);
  EXPECT_FLOAT_EQ(number(values[1]), 0.5f);
  EXPECT_FLOAT_EQ(number(values[2]), 1.0f);
  EXPECT_FLOAT_EQ(number(values[3]), 1.0f);
  node.node = 1;
  node.layer = 1;
  colouring.encode(node, store->description().schema, 0, 1, values);
  EXPECT_FLOAT_EQ(number(values[4]), 0.5f);
  StoreDescription own;
  own.schema.add({ "global_height", ScalarType::Float32, 1 });
  EXPECT_FALSE(PointColouring::wantsHeights(own, request));
  EXPECT_FALSE(PointColouring::choose(store->description(), request)); // no heights were given
}

TEST(PointColouring, FewIntegersGetATableOfTheirOwn)
{
  ColourRequest request;
  request.name = "classification";
  const auto classes = *PointColouring::choose(description(), request);
  ASSERT_TRUE(classes.integers);
  EXPECT_EQ((*classes.integers)[0], 2);
  EXPECT_EQ((*classes.integers)[1], 9);
  StoreDescription next = description(); // a time step: a mapper samples its table again
  next.ranges[1].components[0][1] = 12.0;
  EXPECT_NE(classes, *PointColouring::choose(next, request));
  request.name = "scaled";
  EXPECT_FALSE(PointColouring::choose(description(), request)->integers);
}

} // namespace
