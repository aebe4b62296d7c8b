#pragma once

#include "pointfront/Store/StoredCloud.h"

#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace pointfront::test
{

/// Adds a column to the description of a store without points.
inline void addColumn(StoreDescription& store, Attribute attribute, double low, double high)
{
  ColumnRange range;
  range.components.assign(attribute.components, { low, high });
  store.ranges.push_back(range);
  store.schema.add(std::move(attribute));
}

inline StoreDescription styledStore(const std::vector<std::uint16_t>& classes)
{
  StoreDescription store;
  store.path = "town.pfront";
  addColumn(store, { "rgb", ScalarType::UInt16, 3 }, 0.0, 65535.0);
  addColumn(store, { "classification", ScalarType::UInt8, 1 }, 2.0, 9.0);
  addColumn(store, { "intensity", ScalarType::UInt16, 1 }, 10.0, 210.0);
  addColumn(store, { "gps_time", ScalarType::Float64, 1 }, 3e8, 3e8 + 10.0);
  addColumn(store, { "normal", ScalarType::Int16, 3, 1e-4, 0.0 }, -10000.0, 10000.0);
  addColumn(store, { "splat_radius", ScalarType::UInt8, 1 }, 1.0, 200.0);
  addColumn(store, { "enclosing_radius", ScalarType::Float32, 1 }, 0.0, 2.0);
  addColumn(store, { "local_height", ScalarType::Float32, 1 }, 0.0, 20.0);
  store.grid.scale = { 0.01, 0.01, 0.01 };
  store.grid.offset = { 1000.0, 2000.0, 50.0 };
  store.bounds.add({ 1000.0, 2000.0, 40.0 });
  store.bounds.add({ 1100.0, 2100.0, 90.0 });
  for (const std::uint16_t objectClass : classes)
  {
    store.layers.push_back({ objectClass, "class " + std::to_string(objectClass), 100, 1 });
  }
  if (classes.empty())
  {
    store.layers.push_back({ 0, "all", 100, 1 });
  }
  return store;
}

constexpr std::uint32_t rgbColumn = 0;
constexpr std::uint32_t classColumn = 1;
constexpr std::uint32_t intensityColumn = 2;
constexpr std::uint32_t timeColumn = 3;
constexpr std::uint32_t normalsColumn = 4;
constexpr std::uint32_t splatRadiusColumn = 5;
constexpr std::uint32_t enclosingColumn = 6;

} // namespace pointfront::test
