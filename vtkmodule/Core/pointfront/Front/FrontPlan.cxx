#include "pointfront/Front/FrontPlan.h"

#include "pointfront/Front/FrontDemand.h"
#include "pointfront/Front/PointPrefix.h"

#include <algorithm>

namespace pointfront
{
namespace
{

/// On screen while a root is missing: nothing at all.
constexpr double nothingDrawnPx = 1e30;

} // namespace

void FrontPlan::make(ActiveTree& tree, const FrontThreshold& threshold,
  const ResidencySnapshot& residency, const FrontLimits& limits, std::uint32_t update,
  FrontDelta& delta)
{
  tree_ = &tree;
  limits_ = &limits;
  delta_ = &delta;
  update_ = update;
  allowance_.begin(limits);
  requests_.begin(residency);
  delta.draw.clear();
  delta.pointsDrawn = 0;
  delta.slotsDrawn = 0;
  delta.errorPx = 0.0;

  listRoots(threshold);
  for (const SlotIndex root : roots_)
  {
    // The first levels are wanted from the beginning, in sight or not.
    tree[root].needed = update;
    thresholdPx_ = threshold.px(tree[root].layer);
    if (tree.refinement() == Refinement::Add)
    {
      visitAdd(root, { nothingDrawnPx, true, true });
    }
    else
    {
      const Presence presence = require(tree[root], nothingDrawnPx);
      visitReplace(
        root, { nothingDrawnPx, presence != Presence::Absent, presence == Presence::Resident });
    }
  }
  order_.sort(delta.draw);
  allowance_.listLeftOut(delta.layersLeftOut);
  requests_.finish(limits.requestLimit, delta);
}

/// Where there is not a slot for each of them those come first that have most to show.
void FrontPlan::listRoots(const FrontThreshold& threshold)
{
  ActiveTree& tree = *tree_;
  roots_.clear();
  for (SlotIndex root = 0; root < tree.rootCount(); ++root)
  {
    tree[root].hidden ? void() : roots_.push_back(root);
  }
  if (allowance_.slots() < roots_.size())
  {
    const auto shown = [&](SlotIndex root)
    {
      const double px = threshold.px(tree[root].layer);
      return tree[root].visible ? FrontDemand::pointsOf(tree[root], tree.refinement(), px) : 0u;
    };
    std::stable_sort(
      roots_.begin(), roots_.end(), [&](SlotIndex a, SlotIndex b) { return shown(a) > shown(b); });
  }
}

void FrontPlan::visitAdd(SlotIndex slot, Visit visit)
{
  ActiveNode& node = (*tree_)[slot];
  if (!node.visible)
  {
    return;
  }
  const std::uint32_t points = FrontDemand::pointsOf(node, Refinement::Add, thresholdPx_);
  Presence presence = Presence::Resident;
  if (points > 0 || node.lost)
  {
    presence = require(node, visit.errorAbovePx);
  }
  if (points > 0 || node.storedPoints == 0)
  {
    node.needed = update_;
  }
  const bool here = visit.drawable && presence == Presence::Resident;
  const std::uint32_t drawn = here ? draw(node, points) : 0;
  const bool descend = node.expanded() && node.errorPx > thresholdPx_;
  noteError(node, drawn, descend && drawn == points && presence == Presence::Resident);
  if (!descend)
  {
    return;
  }
  const double errorPx = std::min<double>(visit.errorAbovePx, node.errorPx);
  for (std::uint8_t c = 0; c < node.childCount; ++c)
  {
    const SlotIndex child = node.children + c;
    if (!(*tree_)[child].visible && limits_->prefetchSiblings)
    {
      prefetch((*tree_)[child], errorPx);
    }
    // Below a node that failed the others go on: they are stored apart from it.
    visitAdd(child, { errorPx, visit.drawable && presence != Presence::Absent, true });
  }
}

bool FrontPlan::childrenReady(const ActiveNode& node, double errorPx)
{
  bool ready = true;
  for (std::uint8_t c = 0; c < node.childCount; ++c)
  {
    // All siblings, in sight or not: the parent cannot be drawn beside them (FRONT-9).
    ActiveNode& child = (*tree_)[node.children + c];
    child.needed = update_;
    ready = require(child, errorPx) == Presence::Resident && ready;
  }
  return ready;
}

void FrontPlan::visitReplace(SlotIndex slot, Visit visit)
{
  ActiveNode& node = (*tree_)[slot];
  if (!node.visible)
  {
    return;
  }
  const double errorPx = std::min<double>(visit.errorAbovePx, node.errorPx);
  const bool refine = node.expanded() && node.errorPx > thresholdPx_;
  const bool ready = refine && childrenReady(node, errorPx);
  if (visit.drawable && visit.itself && !ready)
  {
    noteError(node, draw(node, node.pointCount), false);
  }
  if (refine)
  {
    for (std::uint8_t c = 0; c < node.childCount; ++c)
    {
      visitReplace(node.children + c, { errorPx, visit.drawable && ready, ready });
    }
  }
}

FrontPlan::Presence FrontPlan::require(ActiveNode& node, double priority)
{
  if (node.lost)
  {
    requests_.countFailed();
    return Presence::Failed;
  }
  if (node.pointCount == 0)
  {
    return Presence::Resident;
  }
  return requests_.require({ node.node, priority, false, node.pointCount, node.layer });
}

void FrontPlan::prefetch(const ActiveNode& node, double priority)
{
  if (node.pointCount > 0)
  {
    requests_.prefetch({ node.node, priority, true, node.pointCount, node.layer });
  }
}

/// As many of them as the budgets allow.
std::uint32_t FrontPlan::draw(const ActiveNode& node, std::uint32_t points)
{
  points = allowance_.take(points, node.layer);
  if (points > 0)
  {
    const float projectedPx = node.errorPx / node.errorWeight;
    delta_->draw.push_back({ node.node, points, projectedPx, node.distance, node.spacingRatio });
    delta_->pointsDrawn += points;
    delta_->slotsDrawn += gpuSlotsOf(points);
  }
  return points;
}

void FrontPlan::noteError(const ActiveNode& node, std::uint32_t drawn, bool refined)
{
  const bool everything = node.leaf() && drawn == node.pointCount && !node.lost;
  if (!refined && !everything)
  {
    // Among 2,000 nodes a dozen are the largest so far: no root for the others.
    drawn = leastForError(drawn, node.spacingRatio);
    const double density = prefixDensity(node.pointCount, drawn, node.spacingRatio);
    const double errorPx = node.errorPx;
    if (errorPx * errorPx > delta_->errorPx * delta_->errorPx * density)
    {
      const double shown = prefixErrorPx(node.pointCount, drawn, node.errorPx, node.spacingRatio);
      delta_->errorPx = std::max(delta_->errorPx, shown);
    }
  }
}

} // namespace pointfront
