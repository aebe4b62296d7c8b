#pragma once

#include "SoftwareRasteriser.h"

#include "pointfront/Plan/FramePlan.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <random>
#include <vector>

namespace pointfront::test
{

/// A point as a test thinks of it.
struct TestPoint
{
  glm::dvec3 position{ 0.0 };
  std::array<std::uint8_t, 3> rgb{ 255, 255, 255 };
  glm::vec3 normal{ 0.0f }; ///< unit, or 0
  float height = 0.0f; ///< above the ground
};

/// Plans of made-up nodes: columns 0 rgb (u8 x 3), 1 normal (f32 x 3), 2 splat_radius, 3 class
/// (u8), 4 height_above_ground (f32).
class PlanOfPoints
{
public:
  PlanOfPoints()
  {
    auto schema = std::make_shared<AttributeSchema>();
    schema->add({ "rgb", ScalarType::UInt8, 3 });
    schema->add({ "normal", ScalarType::Float32, 3 });
    schema->add({ "splat_radius", ScalarType::UInt8, 1 });
    schema->add({ "classification", ScalarType::UInt8, 1 });
    schema->add({ "height_above_ground", ScalarType::Float32, 1 });
    plan.schema = schema;
    plan.grid.scale = glm::dvec3(std::ldexp(1.0, -12));
    plan.batches.resize(1);
    style = std::make_shared<ResolvedStyle>();
    style->colouring.kind = PointColouring::Kind::Direct;
    plan.batches[0].style = style;
  }

  PlanItem& add(
    const std::vector<TestPoint>& points, double radius = 0.0, std::uint8_t objectClass = 0)
  {
    auto node = std::make_shared<NodeColumns>();
    node->node = next++;
    node->leaf = true;
    node->firstPoint = nextPoint;
    nextPoint += points.size();
    GridPosition low(INT64_MAX), high(INT64_MIN);
    std::vector<GridPosition> places;
    for (const TestPoint& point : points)
    {
      places.push_back(plan.grid.toGrid(point.position));
      low = glm::min(low, places.back());
      high = glm::max(high, places.back());
    }
    node->origin = points.empty() ? GridPosition(0) : low;
    if (!points.empty())
    {
      node->halfSize = glm::vec3(0.5 * glm::dvec3(high - low) * plan.grid.scale);
    }
    node->selection = { 0, 1, 2, 3, 4 };
    node->columns.resize(5);
    const auto append = [&](std::size_t column, const void* data, std::size_t size)
    {
      const auto* bytes = static_cast<const std::byte*>(data);
      node->columns[column].insert(node->columns[column].end(), bytes, bytes + size);
    };
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      node->positions.push_back(glm::u32vec3(places[i] - low));
      append(0, points[i].rgb.data(), 3);
      append(1, &points[i].normal, 12);
      const std::uint8_t code = 0;
      append(2, &code, 1);
      append(3, &objectClass, 1);
      append(4, &points[i].height, 4);
    }
    PlanItem item;
    item.last = static_cast<std::uint32_t>(points.size());
    item.node = node;
    item.closingRadius = static_cast<float>(radius);
    plan.batches[0].items.push_back(item);
    return plan.batches[0].items.back();
  }

  void look(const glm::dvec3& from, const glm::dvec3& at, double angle, int width, int height,
    double nearDepth = 0.01, double farDepth = 1e7)
  {
    plan.camera = FrameCamera::perspective(
      from, at, { 0.0, 0.0, 1.0 }, angle, nearDepth, farDepth, width, height);
  }

  SoftwareTarget draw(SoftwareRasteriser& rasteriser, bool points = false) const
  {
    SoftwareTarget target;
    target.keepPoints = points;
    target.reset(plan.camera.width, plan.camera.height);
    rasteriser.draw(plan, target);
    return target;
  }
  SoftwareTarget draw(bool points = false) const
  {
    SoftwareRasteriser rasteriser;
    return draw(rasteriser, points);
  }

  FramePlan plan;
  std::shared_ptr<ResolvedStyle> style;
  NodeIndex next = 0;
  std::uint64_t nextPoint = 0;
};

/// Points on a wavy surface over [-1, 1]^2.
inline std::vector<TestPoint> wavySurface(int count, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  std::vector<TestPoint> points(static_cast<std::size_t>(count));
  for (TestPoint& point : points)
  {
    const double x = place(random), y = place(random);
    point.position = { x, y, 0.2 * std::sin(5.0 * x) * std::cos(4.0 * y) };
    point.normal = glm::normalize(glm::vec3(
      -std::cos(5.0 * x) * std::cos(4.0 * y), 0.8 * std::sin(5.0 * x) * std::sin(4.0 * y), 1.0));
    point.height = static_cast<float>(0.4 + point.position.z);
    point.rgb = { static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(random()),
      static_cast<std::uint8_t>(random()) };
  }
  return points;
}

} // namespace pointfront::test
