#pragma once

#include "TriangleMesh.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <vector>

namespace pointfront::truth
{

struct Hit
{
  static constexpr std::uint32_t none = 0xffffffffu;

  std::uint32_t triangle = none;
  double distance = std::numeric_limits<double>::infinity(); ///< in lengths of the direction
  double b = 0.0; ///< at corner0 + b (corner1 - corner0) + c (corner2 - corner0)
  double c = 0.0;

  explicit operator bool() const { return triangle != none; }
};

/// The triangle with both sides as the ray meets it, if it does so before `hit`; then sets `hit`.
/// Of two at the same distance the one with the lower number counts.
/// Source  Moeller & Trumbore 1997.
void intersect(const TriangleMesh& mesh, std::uint32_t triangle, const glm::dvec3& origin,
  const glm::dvec3& direction, double leastDistance, Hit& hit);

/// Finds the first triangle that a ray meets, by a bounding volume hierarchy.
/// Exact    the same hit as intersect() of all triangles, one after the other, to the last bit.
/// Threads  cast() from any; the mesh must live as long and not change.
/// Source   binned surface area heuristic: Wald 2007.
class RayCaster
{
public:
  explicit RayCaster(const TriangleMesh& mesh);

  const TriangleMesh& mesh() const { return mesh_; }
  /// `direction` of any length but 0. What is nearer than leastDistance is not met.
  Hit cast(const glm::dvec3& origin, const glm::dvec3& direction, double leastDistance = 0.0) const;

private:
  struct Node
  {
    Bounds box;
    std::uint32_t first = 0; ///< a leaf: in order_; else the second child (the first follows)
    std::uint32_t count = 0; ///< triangles of a leaf; 0: an inner node
  };

  void divide(std::vector<Bounds>& boxes, std::uint32_t begin, std::uint32_t end);

  const TriangleMesh& mesh_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

} // namespace pointfront::truth
