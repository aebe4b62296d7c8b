#include "pointfront/Front/ActiveTree.h"

#include "pointfront/Front/ScreenError.h"

#include <cassert>
#include <cmath>

namespace pointfront
{
namespace
{

/// A root without a spacing is refined and drawn whole at any threshold.
constexpr float alwaysTooCoarse = 1e30f;

bool usable(float spacing) { return spacing > 0.0f && std::isfinite(spacing); }

ActiveNode activeNode(const Node& entry, NodeIndex index)
{
  ActiveNode node;
  node.centre = entry.centre;
  node.radius = entry.radius;
  node.spacing = entry.spacing;
  node.pointCount = entry.pointCount;
  node.node = index;
  node.firstChild = entry.firstChild;
  node.childCount = entry.childCount;
  node.level = entry.level;
  node.layer = entry.layer;
  return node;
}

} // namespace

ActiveTree::ActiveTree(const Hierarchy& hierarchy)
  : hierarchy_(hierarchy)
{
  reset();
}

void ActiveTree::reset()
{
  slots_.clear();
  for (auto& blocks : freeBlocks_)
  {
    blocks.clear();
  }
  for (const NodeIndex root : hierarchy_.roots())
  {
    ActiveNode node = activeNode(hierarchy_.node(root), root);
    if (!usable(node.spacing))
    {
      node.spacing = alwaysTooCoarse;
    }
    applyLayer(node);
    slots_.push_back(node);
  }
  rootCount_ = slotCount();
  frontLength_ = rootCount_;
}

void ActiveTree::applyLayer(ActiveNode& node) const
{
  const LayerLimits limits = node.layer < layers_.size() ? layers_[node.layer] : LayerLimits();
  assert(limits.errorFactor > 0.0 && limits.share >= 0.0);
  node.hidden = !limits.visible;
  node.errorWeight = static_cast<float>(1.0 / limits.errorFactor);
}

void ActiveTree::setLayers(const std::vector<LayerLimits>& layers)
{
  if (layers == layers_)
  {
    return;
  }
  layers_ = layers;
  for (ActiveNode& node : slots_)
  {
    applyLayer(node);
  }
}

ActiveNode ActiveTree::childOf(const ActiveNode& parent, std::uint8_t child) const
{
  const NodeIndex index = parent.firstChild + child;
  ActiveNode node = activeNode(hierarchy_.node(index), index);
  if (!usable(node.spacing))
  {
    node.spacing = 0.5f * parent.spacing;
  }
  node.spacingRatio = node.spacing / parent.spacing;
  node.hidden = parent.hidden;
  node.errorWeight = parent.errorWeight;
  return node;
}

SlotIndex ActiveTree::takeBlock(std::uint8_t length)
{
  std::vector<SlotIndex>& blocks = freeBlocks_[length];
  if (!blocks.empty())
  {
    const SlotIndex first = blocks.back();
    blocks.pop_back();
    return first;
  }
  const SlotIndex first = slotCount();
  slots_.resize(slots_.size() + length);
  return first;
}

void ActiveTree::expand(SlotIndex slot, std::uint32_t update)
{
  assert(!slots_[slot].expanded() && !slots_[slot].leaf());
  const SlotIndex first = takeBlock(slots_[slot].childCount);
  const ActiveNode& parent = slots_[slot];
  for (std::uint8_t c = 0; c < parent.childCount; ++c)
  {
    ActiveNode& child = slots_[first + c];
    child = childOf(parent, c);
    child.parent = slot;
    child.created = update;
    child.seen = update;
  }
  slots_[slot].children = first;
  frontLength_ += parent.childCount - 1u;
}

void ActiveTree::collapse(SlotIndex slot)
{
  ActiveNode& parent = slots_[slot];
  assert(parent.expanded());
  for (std::uint8_t c = 0; c < parent.childCount; ++c)
  {
    assert(!slots_[parent.children + c].expanded());
    slots_[parent.children + c].node = noNode;
  }
  freeBlocks_[parent.childCount].push_back(parent.children);
  parent.children = noSlot;
  frontLength_ -= parent.childCount - 1u;
}

SlotIndex ActiveTree::find(NodeIndex node) const
{
  // Up by the table to the root, then down by the slots: a path, not a map of all active nodes.
  std::array<NodeIndex, 256> path;
  std::size_t length = 0;
  NodeIndex parent = node;
  while (parent != noNode && length < path.size())
  {
    path[length++] = parent;
    parent = hierarchy_.node(parent).parent;
  }
  SlotIndex slot = 0;
  while (slot < rootCount_ && slots_[slot].node != path[length - 1])
  {
    ++slot;
  }
  assert(slot < rootCount_);
  for (std::size_t step = length - 1; step > 0 && slots_[slot].expanded(); --step)
  {
    slot = slots_[slot].children + (path[step - 1] - slots_[slot].firstChild);
  }
  return slot;
}

void evaluate(ActiveNode& node, const View& view, std::uint32_t update)
{
  node.evaluated = update;
  node.visible = !node.hidden &&
    sphereVisibility(view, node.centre, node.radius) == Visibility::Inside;
  const double distance = distanceToSphere(view, node.centre, node.radius);
  node.distance = static_cast<float>(distance);
  node.errorPx =
    static_cast<float>(projectedSpacing(view, node.spacing, distance)) * node.errorWeight;
}

} // namespace pointfront
