#include "TriangleMesh.h"

#include "RandomStream.h"

namespace pointfront::truth
{
namespace
{
glm::dvec3 doubledAreaNormal(const TriangleMesh& mesh, std::size_t triangle)
{
  const glm::dvec3& a = mesh.corner(triangle, 0);
  return glm::cross(mesh.corner(triangle, 1) - a, mesh.corner(triangle, 2) - a);
}
} // namespace

glm::dvec3 TriangleMesh::faceNormal(std::size_t triangle) const
{
  return glm::normalize(doubledAreaNormal(*this, triangle));
}

double TriangleMesh::area(std::size_t triangle) const
{
  return 0.5 * glm::length(doubledAreaNormal(*this, triangle));
}

glm::dvec3 TriangleMesh::normalAt(std::size_t triangle, double b, double c) const
{
  if (vertexNormals.empty())
  {
    return faceNormal(triangle);
  }
  const std::array<std::uint32_t, 3>& corners = triangles[triangle];
  return glm::normalize((1.0 - b - c) * vertexNormals[corners[0]] + b * vertexNormals[corners[1]] +
    c * vertexNormals[corners[2]]);
}

Bounds TriangleMesh::bounds() const
{
  Bounds box;
  for (const glm::dvec3& vertex : vertices)
  {
    box.add(vertex);
  }
  return box;
}

void TriangleMesh::smoothNormals()
{
  vertexNormals.assign(vertices.size(), glm::dvec3(0.0));
  for (std::size_t t = 0; t < size(); ++t)
  {
    const glm::dvec3 normal = doubledAreaNormal(*this, t);
    for (std::uint32_t corner : triangles[t])
    {
      vertexNormals[corner] += normal;
    }
  }
  for (glm::dvec3& normal : vertexNormals)
  {
    normal = glm::normalize(normal);
  }
}

void MeshBuilder::triangle(
  const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, Material material)
{
  const auto first = std::uint32_t(mesh_.vertices.size());
  mesh_.vertices.insert(mesh_.vertices.end(), { a, b, c });
  mesh_.triangles.push_back({ first, first + 1, first + 2 });
  mesh_.materials.push_back(material);
}

void MeshBuilder::quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
  const glm::dvec3& d, Material material)
{
  triangle(a, b, c, material);
  triangle(a, c, d, material);
}

void MeshBuilder::tube(
  const glm::dvec3& from, const glm::dvec3& to, double radius, int sides, Material material)
{
  const glm::dvec3 axis = glm::normalize(to - from);
  const glm::dvec3 aside = std::abs(axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(axis, aside));
  const glm::dvec3 v = glm::cross(axis, u);
  const auto spoke = [&](int side)
  {
    const double angle = 2.0 * pi * side / sides;
    return radius * (std::cos(angle) * u + std::sin(angle) * v);
  };
  for (int side = 0; side < sides; ++side)
  {
    const glm::dvec3 p = spoke(side);
    const glm::dvec3 q = spoke(side + 1);
    quad(from + p, from + q, to + q, to + p, material);
  }
}

} // namespace pointfront::truth
