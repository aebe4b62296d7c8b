#pragma once

#include "pointfront/Base/Bounds.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pointfront::truth
{

enum class Material : std::uint8_t
{
  Ground,
  Wall,
  Roof,
  Metal,
  Leaf,
  Trunk,
  Marble ///< single objects
};

/// A surface of triangles: the scene whose picture is known.
struct TriangleMesh
{
  std::vector<glm::dvec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles; ///< anticlockwise from outside
  std::vector<Material> materials; ///< material of each triangle
  std::vector<glm::dvec3> vertexNormals; ///< empty: each triangle is flat to the eye as well

  std::size_t size() const { return triangles.size(); }
  const glm::dvec3& corner(std::size_t triangle, std::size_t which) const
  {
    return vertices[triangles[triangle][which]];
  }
  glm::dvec3 faceNormal(std::size_t triangle) const; ///< unit
  double area(std::size_t triangle) const;
  /// At corner0 + b (corner1 - corner0) + c (corner2 - corner0); unit.
  glm::dvec3 normalAt(std::size_t triangle, double b, double c) const;
  Bounds bounds() const;

  /// Sets vertexNormals to the means of the triangles around, weighted by area.
  void smoothNormals();
};

/// Puts triangles, quads and tubes together. Corners are not shared.
class MeshBuilder
{
public:
  void triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, Material material);
  void quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d,
    Material material);
  /// The side of a prism of so many sides from one end to the other.
  void tube(
    const glm::dvec3& from, const glm::dvec3& to, double radius, int sides, Material material);
  TriangleMesh take() { return std::move(mesh_); }

private:
  TriangleMesh mesh_;
};

} // namespace pointfront::truth
