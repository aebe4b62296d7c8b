#include "pointfront/Front/ScreenError.h"

namespace pointfront
{

double screenError(const View& view, const Node& node)
{
  return projectedSpacing(view, node.spacing, distanceToNode(view, node));
}

double distanceToNode(const View& view, const Node& node)
{
  return distanceToSphere(view, node.centre, node.radius);
}

} // namespace pointfront
