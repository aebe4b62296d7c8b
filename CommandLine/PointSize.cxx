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
  for (NodeIndex index = 0; index < hierarchy.nodeCount(); ++index)
  {
    const Node& node = hierarchy.node(index);
    if (node.leaf() && sphereVisibility(view, node.centre, node.radius) == Visibility::Inside)
    {
      spacings.emplace_back(std::max(screenError(view, node), errorPx), node.pointCount);
      points += node.pointCount;
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
