#include "PointSize.h"

#include "pointfront/Front/ScreenError.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace pointfront
{

double closingPointSize(const Hierarchy& hierarchy, const View& view, double errorPx)
{
  std::vector<std::pair<double, double>> spacings; // pixels, points
  double points = 0.0;
  std::vector<NodeIndex> open(hierarchy.roots());
  while (!open.empty())
  {
    const NodeIndex index = open.back();
    open.pop_back();
    const Node node = hierarchy.node(index);
    if (sphereVisibility(view, node.centre, node.radius) == Visibility::Outside)
    {
      continue;
    }
    // Below a node that is fine enough every leaf is: their spacing is not larger.
    const double pixels = screenError(view, node);
    if (node.leaf() || pixels <= errorPx)
    {
      spacings.emplace_back(std::max(pixels, errorPx), double(node.pointsBelow));
      points += double(node.pointsBelow);
    }
    else
    {
      hierarchy.appendChildren(index, node, open);
    }
  }
  std::sort(spacings.begin(), spacings.end());
  double median = errorPx;
  double below = 0.0;
  for (const auto& [spacing, count] : spacings)
  {
    below += count;
    median = spacing;
    if (2.0 * below >= points)
    {
      break;
    }
  }
  return std::clamp(std::round(1.5 * median), 1.0, 16.0);
}

} // namespace pointfront
