#pragma once

#include "FrontScene.h"

#include <cmath>
#include <memory>
#include <set>
#include <vector>

namespace pointfront::test
{

//        0          spacing 8     x = 0
//      /   \ .
//     1     2       spacing 4     x = -100, +100
//    / \   / \ .
//   3   4 5   6     spacing 2     x = -150, -50, 50, 150
inline std::shared_ptr<const HierarchyTable> sevenNodes(Refinement refinement = Refinement::Add)
{
  const double x[] = { 0, -100, 100, -150, -50, 50, 150 };
  const float radius[] = { 200, 100, 100, 50, 50, 50, 50 };
  const float spacing[] = { 8, 4, 4, 2, 2, 2, 2 };
  std::vector<Node> nodes(7);
  for (NodeIndex n = 0; n < 7; ++n)
  {
    nodes[n].centre = { x[n], 0, 0 };
    nodes[n].radius = radius[n];
    nodes[n].spacing = spacing[n];
    nodes[n].pointCount = 100;
    nodes[n].level = std::uint8_t(n == 0 ? 0 : n < 3 ? 1 : 2);
    nodes[n].parent = n == 0 ? noNode : (n - 1) / 2;
    nodes[n].firstChild = n < 3 ? 2 * n + 1 : noNode;
    nodes[n].childCount = n < 3 ? 2 : 0;
  }
  return std::make_shared<HierarchyTable>(nodes, std::vector<NodeIndex>{ 0 }, refinement);
}

/// Looking down from `height`, everything in sight; 1000 pixels a unit at depth 1.
inline View fromAbove(double height, double x = 0.0)
{
  return View::perspective(
    { x, 0, height }, { x, 0, 0 }, { 0, 1, 0 }, 2.0 * std::atan(0.5), 0.1, 1e5, 1000, 1000);
}

/// Straight to an error, without the fall from 60 px.
inline FrontLimits settleAt(double targetPx)
{
  FrontLimits limits;
  limits.targetErrorPx = targetPx;
  limits.initialErrorPx = targetPx;
  return limits;
}

inline const FrontDelta& settle(RenderFront& front, const View& view, ScriptedResidency& residency,
  const FrontLimits& limits, int updates = 200)
{
  const FrontDelta* delta = &front.update(view, residency, limits);
  for (int u = 1; u < updates && !delta->complete; ++u)
  {
    residency.load(delta->requests);
    delta = &front.update(view, residency, limits);
  }
  return *delta;
}

inline std::set<NodeIndex> drawn(const FrontDelta& delta)
{
  std::set<NodeIndex> nodes;
  for (const DrawItem& item : delta.draw)
  {
    nodes.insert(item.node);
  }
  return nodes;
}

inline std::vector<NodeIndex> requested(const FrontDelta& delta)
{
  std::vector<NodeIndex> nodes;
  for (const LoadRequest& request : delta.requests)
  {
    nodes.push_back(request.node);
  }
  return nodes;
}

using Nodes = std::set<NodeIndex>;

} // namespace pointfront::test
