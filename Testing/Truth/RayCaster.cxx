#include "RayCaster.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>

namespace pointfront::truth
{
namespace
{
constexpr std::uint32_t leafTriangles = 4;
constexpr int bins = 16;
constexpr std::size_t stackDepth = 128;
/// Boxes are grown by this much of the scene, so that rounding never puts a hit outside of one, not
/// even on the side of a flat box.
constexpr double padding = 1e-10;

double halfArea(const Bounds& box)
{
  const glm::dvec3 size = box.size();
  return box.empty() ? 0.0 : size.x * size.y + size.y * size.z + size.z * size.x;
}

/// A ray that is ready to be tested against many boxes.
struct BoxRay
{
  BoxRay(const glm::dvec3& from, const glm::dvec3& direction)
    : origin(from)
  {
    for (int axis = 0; axis < 3; ++axis)
    { // no zeros: infinity times zero would be no number
      const double d = direction[axis];
      inverse[axis] = 1.0 / (std::abs(d) > 1e-300 ? d : std::copysign(1e-300, d));
    }
  }
  /// Where the ray enters, or infinity where it does not before `limit`.
  double entry(const Bounds& box, double limit) const
  {
    double near = 0.0;
    double far = limit;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double a = (box.low[axis] - origin[axis]) * inverse[axis];
      const double b = (box.high[axis] - origin[axis]) * inverse[axis];
      near = std::max(near, std::min(a, b));
      far = std::min(far, std::max(a, b));
    }
    return near <= far ? near : std::numeric_limits<double>::infinity();
  }

  glm::dvec3 origin;
  glm::dvec3 inverse{ 0.0 };
};

/// The cheapest plane between two of the bins of an axis.
struct Cut
{
  double cost = std::numeric_limits<double>::infinity();
  int axis = -1;
  int bin = 0; ///< the last one below
};

int binOf(double centre, double low, double size)
{
  return std::clamp(int(bins * (centre - low) / size), 0, bins - 1);
}

void improveCut(Cut& best, int axis, const std::array<Bounds, bins>& boxes,
  const std::array<std::uint32_t, bins>& counts)
{
  std::array<double, bins> above{}; // cost of all bins beyond
  Bounds box;
  double count = 0.0;
  for (int bin = bins - 1; bin > 0; --bin)
  {
    box.add(boxes[std::size_t(bin)]);
    count += counts[std::size_t(bin)];
    above[std::size_t(bin - 1)] = count * halfArea(box);
  }
  box = Bounds();
  count = 0.0;
  for (int bin = 0; bin < bins - 1; ++bin)
  {
    box.add(boxes[std::size_t(bin)]);
    count += counts[std::size_t(bin)];
    const double cost = count * halfArea(box) + above[std::size_t(bin)];
    if (cost < best.cost)
    {
      best = { cost, axis, bin };
    }
  }
}
} // namespace

void intersect(const TriangleMesh& mesh, std::uint32_t triangle, const glm::dvec3& origin,
  const glm::dvec3& direction, double leastDistance, Hit& hit)
{
  const glm::dvec3& corner = mesh.corner(triangle, 0);
  const glm::dvec3 e1 = mesh.corner(triangle, 1) - corner;
  const glm::dvec3 e2 = mesh.corner(triangle, 2) - corner;
  const glm::dvec3 p = glm::cross(direction, e2);
  const double determinant = glm::dot(e1, p);
  if (determinant == 0.0)
  {
    return; // along the triangle, or one without area
  }
  const double inverse = 1.0 / determinant;
  const glm::dvec3 s = origin - corner;
  const double b = glm::dot(s, p) * inverse;
  if (b < 0.0 || b > 1.0)
  {
    return;
  }
  const glm::dvec3 q = glm::cross(s, e1);
  const double c = glm::dot(direction, q) * inverse;
  const double distance = glm::dot(e2, q) * inverse;
  if (c < 0.0 || b + c > 1.0 || !(distance >= leastDistance) || distance > hit.distance ||
    (distance == hit.distance && triangle > hit.triangle))
  {
    return;
  }
  hit = { triangle, distance, b, c };
}

RayCaster::RayCaster(const TriangleMesh& mesh)
  : mesh_(mesh)
  , order_(mesh.size())
{
  std::vector<Bounds> boxes(mesh.size());
  const glm::dvec3 grow(padding * glm::length(mesh.bounds().size()));
  for (std::size_t t = 0; t < mesh.size(); ++t)
  {
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      boxes[t].add(mesh.corner(t, corner) - grow);
      boxes[t].add(mesh.corner(t, corner) + grow);
    }
  }
  std::iota(order_.begin(), order_.end(), 0u);
  divide(boxes, 0, std::uint32_t(order_.size()));
}

void RayCaster::divide(std::vector<Bounds>& boxes, std::uint32_t begin, std::uint32_t end)
{
  const std::size_t self = nodes_.size();
  nodes_.emplace_back();
  Bounds box;
  Bounds centres;
  for (std::uint32_t i = begin; i < end; ++i)
  {
    box.add(boxes[order_[i]]);
    centres.add(boxes[order_[i]].centre());
  }
  nodes_[self].box = box;
  Cut cut;
  for (int axis = 0; axis < 3 && end - begin > leafTriangles; ++axis)
  {
    if (centres.size()[axis] > 0.0)
    {
      std::array<Bounds, bins> binBoxes;
      std::array<std::uint32_t, bins> counts{};
      for (std::uint32_t i = begin; i < end; ++i)
      {
        const Bounds& one = boxes[order_[i]];
        const auto bin =
          std::size_t(binOf(one.centre()[axis], centres.low[axis], centres.size()[axis]));
        binBoxes[bin].add(one);
        ++counts[bin];
      }
      improveCut(cut, axis, binBoxes, counts);
    }
  }
  if (cut.axis < 0)
  {
    nodes_[self].first = begin;
    nodes_[self].count = end - begin;
    return;
  }
  const auto below = [&](std::uint32_t triangle)
  {
    return binOf(boxes[triangle].centre()[cut.axis], centres.low[cut.axis],
             centres.size()[cut.axis]) <= cut.bin;
  };
  const auto middle = std::partition(order_.begin() + begin, order_.begin() + end, below);
  const auto split = std::uint32_t(middle - order_.begin());
  divide(boxes, begin, split);
  nodes_[self].first = std::uint32_t(nodes_.size());
  divide(boxes, split, end);
}

Hit RayCaster::cast(
  const glm::dvec3& origin, const glm::dvec3& direction, double leastDistance) const
{
  struct Visit
  {
    std::uint32_t node;
    double entry;
  };
  const BoxRay ray(origin, direction);
  Hit hit;
  std::array<Visit, stackDepth> stack;
  std::size_t waiting = 0;
  Visit current = { 0, ray.entry(nodes_[0].box, hit.distance) };
  for (;;)
  {
    const Node& node = nodes_[current.node];
    // At the same distance another triangle may have a lower number.
    const bool reached = std::isfinite(current.entry) && current.entry <= hit.distance;
    if (reached && node.count == 0)
    {
      Visit near = { current.node + 1, ray.entry(nodes_[current.node + 1].box, hit.distance) };
      Visit far = { node.first, ray.entry(nodes_[node.first].box, hit.distance) };
      if (far.entry < near.entry)
      {
        std::swap(near, far);
      }
      if (std::isfinite(far.entry))
      {
        assert(waiting < stackDepth);
        stack[waiting++] = far;
      }
      current = near;
      continue;
    }
    for (std::uint32_t i = 0; reached && i < node.count; ++i)
    {
      intersect(mesh_, order_[node.first + i], origin, direction, leastDistance, hit);
    }
    if (waiting == 0)
    {
      return hit;
    }
    current = stack[--waiting];
  }
}

} // namespace pointfront::truth
