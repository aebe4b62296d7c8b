#include "TruthPoints.h"

#include "SolidTexture.h"

namespace pointfront::truth
{

void TruthPoints::add(const TriangleMesh& mesh, std::size_t triangle, double b, double c,
  const glm::dvec3& place, const glm::dvec3& normal)
{
  // The colour is that of the surface, even where noise moved the point off it.
  const glm::dvec3& corner = mesh.corner(triangle, 0);
  const glm::dvec3 surface =
    corner + b * (mesh.corner(triangle, 1) - corner) + c * (mesh.corner(triangle, 2) - corner);
  positions.push_back(place);
  normals.push_back(glm::vec3(normal));
  colours.push_back(toBytes(
    surfaceColour(mesh.materials[triangle], surface, mesh.normalAt(triangle, b, c), triangle)));
}

void TruthPoints::append(const TruthPoints& more)
{
  positions.insert(positions.end(), more.positions.begin(), more.positions.end());
  colours.insert(colours.end(), more.colours.begin(), more.colours.end());
  normals.insert(normals.end(), more.normals.begin(), more.normals.end());
}

bool SamplingRegion::contains(const glm::dvec3& place) const
{
  const glm::dvec3 seen = pixels.project(place);
  const double margin = marginPx();
  return seen.z >= grade.nearest() && seen.x > -margin && seen.x < pixels.width() + margin &&
    seen.y > -margin && seen.y < pixels.height() + margin;
}

} // namespace pointfront::truth
