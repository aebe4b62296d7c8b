#include "pointfront/Front/RenderFront.h"

#include "pointfront/Front/ActiveTree.h"
#include "pointfront/Front/FrontDemand.h"
#include "pointfront/Front/FrontPlan.h"
#include "pointfront/Front/FrontThreshold.h"
#include "pointfront/Front/SeenResidency.h"

#include <algorithm>
#include <cassert>

namespace pointfront
{
namespace
{

/// A node collapses when its error is this much below the threshold: it must not flip.
constexpr double collapseBelow = 0.8;
/// Updates that a branch stays in the cut after it was last in sight.
constexpr std::uint32_t updatesUnseen = 30;

} // namespace

struct RenderFront::State
{
  explicit State(std::shared_ptr<const Hierarchy> table)
    : hierarchy(std::move(table))
    , tree(*hierarchy)
  {
  }

  std::shared_ptr<const Hierarchy> hierarchy;
  ActiveTree tree;
  FrontPlan plan;
  FrontDelta delta;
  FrontThreshold threshold;
  std::uint32_t update = 0; ///< number of this update; 0 before the first

  // The view of the last update.
  View view;
  FrontLimits limits;
  SeenResidency residencySeen;
  bool inputChanged = true; ///< other view or limits than in the update before

  // The state that the last update left behind.
  bool atRest = false; ///< the same input would give the same output
  bool movesUsedUp = false; ///< FRONT-6: expansions are left for the next update
  std::uint32_t expansions = 0;
  bool rowsComing = false; ///< expansions wait for rows of a paged table
  bool growthHeldBack = false; ///< an expansion would have broken a budget
  SlotIndex nextSlot = 0; ///< FRONT-6: where the next update goes on

  Refinement refinement() const { return hierarchy->refinement(); }
  double thresholdOf(const ActiveNode& node) const { return threshold.px(node.layer); }

  void adopt(const View& newView, const FrontLimits& newLimits);
  void evaluateBranch(SlotIndex slot, double lowestPx);
  void chooseThreshold();
  void markLive(SlotIndex slot);
  void moveFront();
  bool wantsExpansion(const ActiveNode& node) const;
  bool wantsCollapse(const ActiveNode& node) const;
  void expand(SlotIndex slot);
  void collapse(SlotIndex slot);
  void finish(const ResidencySnapshot& residency);
};

/// The part of a shared limit that others take is no input: each update of theirs may change it.
void RenderFront::State::adopt(const View& newView, const FrontLimits& newLimits)
{
  inputChanged = update == 0 || view != newView || !(limits == newLimits);
  view = newView;
  limits = newLimits;
  tree.setLayers(limits.layers);
  ++update;
}

void RenderFront::State::evaluateBranch(SlotIndex slot, double lowestPx)
{
  ActiveNode& node = tree[slot];
  tree.evaluate(node, view, update);
  if (node.visible && node.errorPx > lowestPx && node.expanded())
  {
    for (std::uint8_t c = 0; c < node.childCount; ++c)
    {
      evaluateBranch(node.children + c, lowestPx);
    }
  }
}

void RenderFront::State::chooseThreshold()
{
  const bool mayFall = !movesUsedUp && !rowsComing && plan.missing() <= limits.requestLimit;
  threshold.begin(limits, tree, inputChanged, mayFall);
  for (SlotIndex root = 0; root < tree.rootCount(); ++root)
  {
    evaluateBranch(root, threshold.lowestPx(tree[root].layer));
  }
  growthHeldBack = false;
  threshold.choose(tree, FrontDemand(tree, refinement(), view));
}

void RenderFront::State::markLive(SlotIndex slot)
{
  ActiveNode& node = tree[slot];
  node.live = update;
  if (!node.visible)
  {
    return;
  }
  node.seen = update;
  if (node.expanded() && node.errorPx > thresholdOf(node))
  {
    for (std::uint8_t c = 0; c < node.childCount; ++c)
    {
      markLive(node.children + c);
    }
  }
}

bool RenderFront::State::wantsExpansion(const ActiveNode& node) const
{
  return !node.expanded() && !node.leaf() && node.live == update && node.visible &&
    node.errorPx > thresholdOf(node);
}

bool RenderFront::State::wantsCollapse(const ActiveNode& node) const
{
  if (!node.expanded())
  {
    return false;
  }
  const bool fineEnough =
    node.live == update && node.visible && node.errorPx <= collapseBelow * thresholdOf(node);
  return fineEnough || update - node.seen > updatesUnseen;
}

/// Unless it would break a budget. The demand already counts the children of nodes that were on
/// the front when the threshold was chosen; those of nodes that came since are new to it.
void RenderFront::State::expand(SlotIndex slot)
{
  if (threshold.limited() && tree[slot].created == update)
  {
    const FrontDemand estimate(tree, refinement(), view);
    if (!threshold.admit(estimate.ofChildren(tree[slot], thresholdOf(tree[slot]))))
    {
      growthHeldBack = true;
      return;
    }
  }
  if (!tree.expand(slot, update))
  {
    rowsComing = true;
    return;
  }
  const ActiveNode& parent = tree[slot];
  for (std::uint8_t c = 0; c < parent.childCount; ++c)
  {
    ActiveNode& child = tree[parent.children + c];
    tree.evaluate(child, view, update);
    child.live = update;
  }
  ++expansions;
  ++delta.moves;
}

/// The branch below, deepest first, as far as the moves go.
void RenderFront::State::collapse(SlotIndex slot)
{
  for (std::uint8_t c = 0; c < tree[slot].childCount; ++c)
  {
    const SlotIndex child = tree[slot].children + c;
    if (tree[child].expanded())
    {
      collapse(child);
    }
  }
  // A child that was not collapsed has used the moves up.
  if (delta.moves < limits.movesPerFrame)
  {
    tree.collapse(slot);
    ++delta.moves;
  }
}

/// FRONT-6: round the slots from where the last update stopped, until the moves are used up.
/// Collapses that are left over wait: they save memory and change nothing on screen, where
/// branches below the threshold are passed over. Expansions that are left over keep the threshold.
void RenderFront::State::moveFront()
{
  movesUsedUp = false;
  rowsComing = false;
  expansions = 0;
  delta.moves = 0;
  SlotIndex slot = nextSlot < tree.slotCount() ? nextSlot : 0;
  bool stopped = false;
  for (SlotIndex seen = 0; seen < tree.slotCount() && !movesUsedUp; ++seen)
  {
    const ActiveNode& node = tree[slot];
    const bool expansion = node.node != noNode && wantsExpansion(node);
    const bool collapsing = node.node != noNode && wantsCollapse(node);
    if (delta.moves >= limits.movesPerFrame)
    {
      movesUsedUp = expansion;
      if ((expansion || collapsing) && !stopped)
      {
        nextSlot = slot;
        stopped = true;
      }
    }
    else if (expansion)
    {
      expand(slot);
    }
    else if (collapsing)
    {
      collapse(slot);
    }
    slot = slot + 1 < tree.slotCount() ? slot + 1 : 0;
  }
}

void RenderFront::State::finish(const ResidencySnapshot& residency)
{
  const bool settled = expansions == 0 && !movesUsedUp && !growthHeldBack && !rowsComing;
  const bool steady = !threshold.changed();
  const bool bound = threshold.bound();
  residencySeen.finish(residency, !inputChanged && steady, plan.missing());
  const bool exhausted = residencySeen.exhausted();
  const bool held = bound && !threshold.atTarget();
  const auto heldBy = [&](FrontBudget budget) { return held && threshold.boundBy() == budget; };
  delta.number = update;
  delta.frontLength = tree.frontLength();
  delta.rowsComing = rowsComing;
  delta.thresholdPx = threshold.largestPx(tree);
  delta.limitedByBudget = plan.cutByPoints() || heldBy(FrontBudget::Points);
  delta.limitedByGpu = plan.cutBySlots() || heldBy(FrontBudget::GpuMemory);
  delta.limitedByMemory = exhausted || heldBy(FrontBudget::HostMemory);
  delta.complete =
    settled && steady && (exhausted || ((threshold.atTarget() || bound) && plan.missing() == 0));
  const bool falls = threshold.falling() && plan.missing() <= limits.requestLimit;
  atRest = settled && delta.moves == 0 && steady && !falls;
}

RenderFront::RenderFront(std::shared_ptr<const Hierarchy> hierarchy)
  : state_(std::make_unique<State>(std::move(hierarchy)))
{
}

RenderFront::~RenderFront() = default;

const FrontDelta& RenderFront::update(
  const View& view, const ResidencySnapshot& residency, const FrontLimits& limits)
{
  State& s = *state_;
  const bool sameResidency = s.residencySeen.unchanged(residency, s.plan.missing());
  if (s.atRest && sameResidency && s.view == view && s.limits == limits &&
    (s.limits.sharedRevision == limits.sharedRevision || s.threshold.unmoved()))
  {
    return s.delta;
  }
  s.residencySeen.begin(residency);
  s.adopt(view, limits);
  s.chooseThreshold();
  for (SlotIndex root = 0; root < s.tree.rootCount(); ++root)
  {
    s.markLive(root);
  }
  s.moveFront();
  s.plan.make(s.tree, s.threshold, residency, s.limits, s.update, s.delta);
  s.finish(residency);
  return s.delta;
}

void RenderFront::demandCurves(DemandCurves& curves) const
{
  const State& s = *state_;
  FrontDemand(s.tree, s.refinement(), s.view).curves(curves);
  double lowestPx = s.threshold.largestPx(s.tree);
  for (SlotIndex root = 0; root < s.tree.rootCount(); ++root)
  {
    lowestPx = std::min(lowestPx, s.threshold.px(s.tree[root].layer));
  }
  curves.drawn.levelOff(lowestPx);
  curves.slots.levelOff(lowestPx);
  curves.held.levelOff(lowestPx);
  curves.drawn[0] = s.delta.pointsDrawn;
  curves.slots[0] = s.delta.slotsDrawn;
}

std::uint32_t RenderFront::distanceUnderFront(NodeIndex node) const
{
  const ActiveTree& tree = state_->tree;
  auto [slot, distance] = tree.find(node);
  if (slot == noSlot)
  {
    return farBelow;
  }
  while (tree[slot].parent != noSlot && tree[slot].needed != state_->update)
  {
    slot = tree[slot].parent;
    ++distance;
  }
  const std::uint32_t above = tree[slot].needed == state_->update ? 0 : 1; // a hidden root
  return distance + above;
}

void RenderFront::reset()
{
  state_ = std::make_unique<State>(state_->hierarchy);
}

} // namespace pointfront
