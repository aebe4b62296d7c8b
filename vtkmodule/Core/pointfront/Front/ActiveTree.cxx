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

bool usable(float spacing)
{
  return spacing > 0.0f && std::isfinite(spacing);
}

ActiveNode activeNode(const Node& entry, NodeIndex index)
{
  ActiveNode node;
  node.centre = entry.centre;
  node.radius = entry.radius;
  node.spacing = entry.spacing;
  node.storedPoints = entry.pointCount;
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
  slotOf_.clear();
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
    slotOf_.insert(root, slotCount());
    slots_.push_back(node);
  }
  rootCount_ = slotCount();
  frontLength_ = rootCount_;
}

void ActiveTree::applyLayer(ActiveNode& node) const
{
  const LayerLimits& limits = limitsOfLayer(layers_, node.layer);
  assert(limits.errorFactor > 0.0 && limits.share >= 0.0);
  const std::optional<std::uint32_t> points = drawablePoints(limits, node.node, node.storedPoints);
  node.hidden = !limits.visible || !points;
  node.pointCount = points.value_or(0);
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
    if (node.node != noNode)
    {
      applyLayer(node);
    }
  }
}

bool ActiveTree::childOf(const ActiveNode& parent, std::uint8_t child, ActiveNode& node) const
{
  Node parentRow;
  parentRow.firstChild = parent.firstChild;
  parentRow.level = parent.level;
  Node row;
  const RowState state = hierarchy_.peekChild(parent.node, parentRow, child, row);
  if (state == RowState::Coming)
  {
    return false;
  }
  const NodeIndex index = parent.firstChild + child;
  node = activeNode(row, index);
  if (state == RowState::Lost)
  {
    node.lost = true;
    node.layer = parent.layer;
    node.centre = parent.centre;
    node.radius = parent.radius;
    node.spacing = parent.spacing;
    node.level = static_cast<std::uint8_t>(parent.level + 1);
  }
  else if (!usable(node.spacing))
  {
    node.spacing = 0.5f * parent.spacing;
  }
  node.spacingRatio = node.spacing / parent.spacing;
  applyLayer(node);
  return true;
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

bool ActiveTree::expand(SlotIndex slot, std::uint32_t update)
{
  assert(!slots_[slot].expanded() && !slots_[slot].leaf());
  children_.resize(slots_[slot].childCount);
  bool here = true;
  for (std::uint8_t c = 0; c < slots_[slot].childCount; ++c)
  {
    here = childOf(slots_[slot], c, children_[c]) && here; // all of them are asked for
  }
  if (!here)
  {
    return false;
  }
  const SlotIndex first = takeBlock(slots_[slot].childCount);
  const ActiveNode& parent = slots_[slot];
  for (std::uint8_t c = 0; c < parent.childCount; ++c)
  {
    ActiveNode& child = slots_[first + c];
    child = children_[c];
    child.parent = slot;
    child.created = update;
    child.seen = update;
    slotOf_.insert(child.node, first + c);
  }
  slots_[slot].children = first;
  frontLength_ += parent.childCount - 1u;
  return true;
}

void ActiveTree::collapse(SlotIndex slot)
{
  ActiveNode& parent = slots_[slot];
  assert(parent.expanded());
  for (std::uint8_t c = 0; c < parent.childCount; ++c)
  {
    ActiveNode& child = slots_[parent.children + c];
    assert(!child.expanded());
    slotOf_.erase(child.node);
    child.node = noNode;
  }
  freeBlocks_[parent.childCount].push_back(parent.children);
  parent.children = noSlot;
  frontLength_ -= parent.childCount - 1u;
}

ActiveTree::Nearest ActiveTree::find(NodeIndex node) const
{
  Nearest nearest;
  NodeIndex above = node;
  while (above != noNode)
  {
    nearest.slot = slotOf_.find(above);
    Node row;
    if (nearest.slot != noSlot || hierarchy_.peek(above, row) != RowState::Here)
    {
      return nearest;
    }
    above = row.parent; // comes before it in the table: this ends
    ++nearest.levelsAbove;
  }
  return nearest;
}

void ActiveTree::evaluate(ActiveNode& node, const View& view, std::uint32_t update) const
{
  node.evaluated = update;
  node.visible = !node.hidden &&
    sphereVisibility(view, node.centre, node.radius) == Visibility::Inside &&
    (node.layer >= layers_.size() ||
      layers_[node.layer].sees(node.centre, node.radius, node.spacing));
  const double distance = distanceToSphere(view, node.centre, node.radius);
  node.distance = static_cast<float>(distance);
  node.errorPx =
    static_cast<float>(projectedSpacing(view, node.spacing, distance)) * node.errorWeight;
}

} // namespace pointfront
