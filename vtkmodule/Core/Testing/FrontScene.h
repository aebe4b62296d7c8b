#pragma once

#include "pointfront/Front/RenderFront.h"
#include "pointfront/Store/Hierarchy.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <random>
#include <unordered_map>
#include <vector>

namespace pointfront::test
{

/// Made-up node tables for tests and benchmarks of the front and of residency: no payload.
struct TreeShape
{
  std::uint32_t seed = 1;
  int levels = 5; ///< the deepest possible; roots are level 0
  int roots = 1;
  double rootSize = 1000.0; ///< edge of a root's cube, world units
  std::uint32_t pointsMax = 1000;
  double childChance = 0.7; ///< chance of each of the eight cells to be occupied
  double emptyChance = 0.05; ///< chance of an inner node to have no points of its own
  Refinement refinement = Refinement::Add;
};

/// Random octrees, breadth first, children neighbours; the same for the same shape.
inline std::shared_ptr<const HierarchyTable> randomTree(const TreeShape& shape)
{
  std::mt19937 random(shape.seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Node> nodes;
  std::vector<NodeIndex> roots;
  const auto add = [&](const glm::dvec3& centre, double size, int level, NodeIndex parent)
  {
    Node node;
    node.centre = centre;
    node.halfSize = glm::vec3(float(0.5 * size));
    node.radius = float(0.5 * size * std::sqrt(3.0) * 1.0001);
    node.spacing = float(size / 32.0);
    node.pointCount = std::uint32_t(1 + unit(random) * shape.pointsMax);
    node.parent = parent;
    node.level = std::uint8_t(level);
    nodes.push_back(node);
  };
  for (int r = 0; r < shape.roots; ++r)
  {
    roots.push_back(NodeIndex(nodes.size()));
    add(glm::dvec3(r * shape.rootSize, 0.0, 0.0), shape.rootSize, 0, noNode);
  }
  for (NodeIndex n = 0; n < nodes.size(); ++n)
  {
    if (nodes[n].level + 1 >= shape.levels)
    {
      continue;
    }
    const double size = 2.0 * nodes[n].halfSize.x;
    nodes[n].firstChild = NodeIndex(nodes.size());
    for (int cell = 0; cell < 8; ++cell)
    {
      if (unit(random) < shape.childChance)
      {
        const glm::dvec3 corner((cell & 1) - 0.5, (cell >> 1 & 1) - 0.5, (cell >> 2 & 1) - 0.5);
        add(nodes[n].centre + 0.5 * size * corner, 0.5 * size, nodes[n].level + 1, n);
        ++nodes[n].childCount;
      }
    }
    if (nodes[n].childCount > 0 && n >= roots.size() && unit(random) < shape.emptyChance)
    {
      nodes[n].pointCount = 0;
    }
  }
  for (NodeIndex n = NodeIndex(nodes.size()); n-- > 0;)
  {
    nodes[n].pointsBelow += nodes[n].pointCount;
    if (nodes[n].parent != noNode)
    {
      nodes[nodes[n].parent].pointsBelow += nodes[n].pointsBelow;
    }
  }
  return std::make_shared<HierarchyTable>(std::move(nodes), std::move(roots), shape.refinement);
}

/// A residency without threads or bytes: what a test says is there, is there.
class ScriptedResidency final : public ResidencySnapshot
{
public:
  State state(NodeIndex node) const override
  {
    ++asked;
    const auto found = states_.find(node);
    const State state = found != states_.end() ? found->second : otherwise;
    if (const auto meanwhile = afterAsked) // a copy: it may put itself away
    {
      meanwhile(node);
    }
    return state;
  }
  std::uint64_t revision() const override { return revision_; }
  bool exhausted() const override { return full; }

  void set(NodeIndex node, State state)
  {
    states_[node] = state;
    revision_ += revision_ > 0;
  }
  /// Everything that was asked for arrives.
  void load(const std::vector<LoadRequest>& requests, std::size_t most = SIZE_MAX)
  {
    for (std::size_t r = 0; r < requests.size() && r < most; ++r)
    {
      set(requests[r].node, State::Resident);
    }
  }
  /// Without it every update asks for every node anew.
  void tellRevisions() { revision_ = 1; }

  State otherwise = State::Absent;
  bool full = false;
  mutable std::uint64_t asked = 0;
  std::function<void(NodeIndex)> afterAsked; ///< work of other threads in the middle of an update

private:
  std::unordered_map<NodeIndex, State> states_;
  std::uint64_t revision_ = 0;
};

} // namespace pointfront::test
