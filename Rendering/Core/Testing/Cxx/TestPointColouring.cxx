#include "PointColouring.h"

#include <gtest/gtest.h>

#include <cstring>

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
    range.components.assign(attribute.components, {low, high});
    result.ranges.push_back(range);
    result.schema.add(std::move(attribute));
  };
  add({"rgb", ScalarType::UInt16, 3}, 0.0, 65535.0);
  add({"classification", ScalarType::UInt8, 1}, 2.0, 9.0);
  add({"gps_time", ScalarType::Float64, 1}, 3e8, 3e8 + 10.0);
  add({"normal", ScalarType::Float32, 3}, -1.0, 1.0);
  add({"scaled", ScalarType::Int16, 1, 0.1, 5.0}, -10.0, 10.0);
  return result;
}

template <typename T>
NodeColumns nodeOf(std::uint32_t column, std::vector<T> values, std::size_t points)
{
  NodeColumns node;
  node.positions.resize(points);
  node.selection = {column};
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

TEST(PointColouring, NeedsOnlyItsColumn)
{
  ColourRequest request;
  request.name = "gps_time";
  const auto time = *PointColouring::choose(description(), request);
  EXPECT_EQ(time.columns(), ColumnSelection{2});
  EXPECT_TRUE(time.coveredBy(nodeOf<double>(2, {1.0}, 1)));
  EXPECT_FALSE(time.coveredBy(nodeOf<double>(1, {1.0}, 1)));
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
  time.encode(nodeOf<double>(2, {3e8, 3e8 + 0.25, 3e8 + 9.5}, 3), store.schema[2], 1, 2, values);
  ASSERT_EQ(values.size(), 2u);
  EXPECT_EQ(number(values[0]), 0.25f);
  EXPECT_EQ(number(values[1]), 9.5f);
}

TEST(PointColouring, ScaleAndOffsetAreApplied)
{
  ColourRequest request;
  request.name = "scaled";
  const StoreDescription store = description();
  const auto scaled = *PointColouring::choose(store, request);
  EXPECT_DOUBLE_EQ(scaled.base, 4.0);
  std::vector<std::uint32_t> values;
  scaled.encode(nodeOf<std::int16_t>(4, {-10, 10}, 2), store.schema[4], 0, 2, values);
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
      ->encode(nodeOf<std::uint16_t>(0, std::move(rgb), 1), store.schema[0], 0, 1, values);
    std::array<std::uint8_t, 4> result;
    std::memcpy(result.data(), values.data(), 4);
    return result;
  };
  EXPECT_EQ(bytes({0xffff, 0x8000, 0x00ff}), (std::array<std::uint8_t, 4>{255, 128, 0, 255}));
  store.ranges[0].components.assign(3, {0.0, 255.0});
  EXPECT_EQ(bytes({255, 128, 7}), (std::array<std::uint8_t, 4>{255, 128, 7, 255}));
}

TEST(PointColouring, MagnitudeAndComponents)
{
  const StoreDescription store = description();
  ColourRequest request;
  request.name = "normal";
  const NodeColumns node = nodeOf<float>(3, {3.0f, 0.0f, 4.0f}, 1);
  std::vector<std::uint32_t> values;
  PointColouring::choose(store, request)->encode(node, store.schema[3], 0, 1, values);
  request.component = 2;
  const auto z = *PointColouring::choose(store, request);
  z.encode(node, store.schema[3], 0, 1, values);
  EXPECT_FLOAT_EQ(number(values[0]), 5.0f);
  EXPECT_FLOAT_EQ(number(values[1]) + static_cast<float>(z.base), 4.0f);
}

TEST(PointColouring, FewIntegersGetATableOfTheirOwn)
{
  ColourRequest request;
  request.name = "classification";
  const auto classes = *PointColouring::choose(description(), request);
  ASSERT_TRUE(classes.integers);
  EXPECT_EQ((*classes.integers)[0], 2);
  EXPECT_EQ((*classes.integers)[1], 9);
  request.name = "scaled";
  EXPECT_FALSE(PointColouring::choose(description(), request)->integers);
}

} // namespace
