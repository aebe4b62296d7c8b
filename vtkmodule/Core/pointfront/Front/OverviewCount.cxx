#include "pointfront/Front/OverviewCount.h"

#include "pointfront/Front/ScreenError.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace pointfront
{
namespace
{

/// A cut node with fewer points of the overview is not divided further.
constexpr double fewPoints = 64.0;
constexpr int placesPerAxis = 4;

bool inside(const glm::dvec3& point, const View& view)
{
  return std::all_of(view.planes.begin(), view.planes.end(),
    [&](const glm::dvec4& plane) { return glm::dot(glm::dvec3(plane), point) + plane.w >= 0.0; });
}

bool whollyInside(const Node& node, const View& view)
{
  return std::all_of(view.planes.begin(), view.planes.end(),
    [&](const glm::dvec4& plane)
    { return glm::dot(glm::dvec3(plane), node.centre) + plane.w >= node.radius; });
}

double countBelow(
  const Hierarchy& hierarchy, const View& view, double shown, NodeIndex index, const Node& row)
{
  const double points = static_cast<double>(row.pointsBelow) * shown;
  if (sphereVisibility(view, row.centre, row.radius) == Visibility::Outside)
  {
    return 0.0;
  }
  if (whollyInside(row, view))
  {
    return points;
  }
  if (row.leaf() || points <= fewPoints)
  {
    return points * shareInFrustum(row.box(), view);
  }
  double sum = 0.0;
  double counted = 0.0;
  for (std::uint8_t c = 0; c < row.childCount; ++c)
  {
    Node child;
    if (hierarchy.peekChild(index, row, c, child) == RowState::Here)
    {
      sum += countBelow(hierarchy, view, shown, row.firstChild + c, child);
      counted += static_cast<double>(child.pointsBelow) * shown;
    }
  }
  // The node's own points, and the children that are not here.
  return sum + std::max(0.0, points - counted) * shareInFrustum(row.box(), view);
}

} // namespace

double shareInFrustum(const Bounds& box, const View& view)
{
  const glm::dvec3 step = (box.high - box.low) / double(placesPerAxis);
  int count = 0;
  for (int x = 0; x < placesPerAxis; ++x)
  {
    for (int y = 0; y < placesPerAxis; ++y)
    {
      for (int z = 0; z < placesPerAxis; ++z)
      {
        const glm::dvec3 place = box.low + step * (glm::dvec3(x, y, z) + 0.5);
        count += inside(place, view) ? 1 : 0;
      }
    }
  }
  return double(count) / (placesPerAxis * placesPerAxis * placesPerAxis);
}

double overviewInFrustum(const Hierarchy& hierarchy, const View& view, double shown,
  const std::vector<LayerLimits>& layers)
{
  double sum = 0.0;
  for (const NodeIndex root : hierarchy.roots())
  {
    const Node row = hierarchy.node(root);
    if (row.layer >= layers.size() || layers[row.layer].visible)
    {
      sum += countBelow(hierarchy, view, shown, root, row);
    }
  }
  return sum;
}

} // namespace pointfront
