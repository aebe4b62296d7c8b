#include "pointfront/Front/RenderFront.h"

#include "pointfront/Front/ActiveTree.h"
#include "pointfront/Front/FrontDemand.h"
#include "pointfront/Front/FrontPlan.h"
#include "pointfront/Front/ThresholdLadder.h"

#include <algorithm>
#include <cassert>

namespace pointfront
{
namespace
{

/// Rungs that the threshold falls by an update: a factor of 0.8, from 60 px to 1 px in 19 frames.
constexpr int rungsPerFall = 20;
/// A node collapses when its error is this much below the threshold: it must not flip.
constexpr double collapseBelow = 0.8;
/// Updates that a branch stays in the cut after it was last in sight.
constexpr std::uint32_t updatesUnseen = 30;

bool operator==(const FrontLimits& a, const FrontLimits& b)
{
  return a.targetErrorPx == b.targetErrorPx && a.initialErrorPx == b.initialErrorPx &&
    a.movesPerFrame == b.movesPerFrame && a.pointBudget == b.pointBudget &&
    a.heldPointBudget == b.heldPointBudget && a.requestLimit == b.requestLimit &&
    a.interacting == b.interacting && a.motionErrorPx == b.motionErrorPx &&
    a.prefetchSiblings == b.prefetchSiblings;
}

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
  ThresholdLadder ladder;
  int rung = 0;
  std::uint32_t update = 0; ///< number of this update; 0 before the first

  // What the last update saw.
  View view;
  FrontLimits limits;
  std::uint64_t revision = 0;  ///< of the residency, before the update asked it anything
  bool sameRevision = true;    ///< as in the update before
  bool exhausted = false;      ///< of these requests: nothing more can come
  bool inputChanged = true;    ///< other view or limits than in the update before

  // What the last update left behind.
  bool atRest = false;         ///< the same input would give the same output
  bool movesUsedUp = false;    ///< FRONT-6: expansions are left for the next update
  std::uint32_t expansions = 0;
  bool growthHeldBack = false; ///< an expansion would have broken a budget
  bool budgetBound = false;    ///< the next lower threshold does not fit
  bool boundByMemory = false;  ///< ... because of heldPointBudget
  int floorRung = 0;           ///< FRONT-7: of the motion
  int lowestRung = 0;          ///< proved too low for this view and these limits: not tried again
  SlotIndex nextSlot = 0;      ///< FRONT-6: where the next update goes on
  Demand demand;               ///< the last one that fits: of the threshold in force

  Refinement refinement() const { return hierarchy->refinement(); }
  double thresholdPx() const { return ladder.at(rung); }

  void adopt(const View& newView, const FrontLimits& newLimits);
  void evaluateBranch(SlotIndex slot, double lowestPx);
  bool fits(const Demand& wanted);
  bool fitsAt(int candidate);
  int lowestFitting(int unfit, int fit);
  int risenRung();
  void chooseThreshold();
  void markLive(SlotIndex slot);
  void moveFront();
  bool wantsExpansion(const ActiveNode& node) const;
  bool wantsCollapse(const ActiveNode& node) const;
  void expand(SlotIndex slot);
  void collapse(SlotIndex slot);
  void finish(int rungBefore, const ResidencyView& residency);
};

void RenderFront::State::adopt(const View& newView, const FrontLimits& newLimits)
{
  assert(newLimits.targetErrorPx > 0.0 && newLimits.movesPerFrame > 0);
  const bool first = update == 0;
  if (first || limits.targetErrorPx != newLimits.targetErrorPx ||
    limits.initialErrorPx != newLimits.initialErrorPx)
  {
    const double before = first ? newLimits.initialErrorPx : thresholdPx();
    ladder = ThresholdLadder(newLimits.targetErrorPx, newLimits.initialErrorPx);
    rung = ladder.rungFor(before);
  }
  inputChanged = first || view != newView || !(limits == newLimits);
  if (inputChanged)
  {
    lowestRung = 0;
  }
  view = newView;
  limits = newLimits;
  ++update;
}

void RenderFront::State::evaluateBranch(SlotIndex slot, double lowestPx)
{
  ActiveNode& node = tree[slot];
  evaluate(node, view, update);
  if (node.visible && node.errorPx > lowestPx && node.expanded())
  {
    for (std::uint8_t c = 0; c < node.childCount; ++c)
    {
      evaluateBranch(node.children + c, lowestPx);
    }
  }
}

bool RenderFront::State::fits(const Demand& wanted)
{
  const bool heldFits = limits.heldPointBudget == 0 || wanted.held <= limits.heldPointBudget;
  const bool drawnFits = limits.pointBudget == 0 || wanted.drawn <= limits.pointBudget;
  if (heldFits && drawnFits)
  {
    demand = wanted;
    return true;
  }
  boundByMemory = drawnFits;
  return false;
}

bool RenderFront::State::fitsAt(int candidate)
{
  return fits(FrontDemand(tree, refinement(), view).at(ladder.at(candidate)));
}

/// By bisection between a rung that does not fit and a higher one that does.
int RenderFront::State::lowestFitting(int unfit, int fit)
{
  while (fit - unfit > 1)
  {
    const int middle = unfit + (fit - unfit) / 2;
    (fitsAt(middle) ? fit : unfit) = middle;
  }
  return fit;
}

/// The lowest rung above the present one that fits. Where nodes come whole nothing is won above
/// the largest error of a root: the plan then cuts what is too much.
int RenderFront::State::risenRung()
{
  double largestPx = 0.0;
  for (SlotIndex root = 0; root < tree.rootCount(); ++root)
  {
    largestPx = std::max<double>(largestPx, tree[root].visible ? tree[root].errorPx : 0.0f);
  }
  const double headroom = refinement() == Refinement::Add ? 65536.0 : 1.0;
  const int highest = std::max(rung, ladder.rungFor(largestPx * headroom));
  int unfit = rung;
  for (int stride = 1; unfit < highest; stride *= 2)
  {
    const int candidate = std::min(unfit + stride, highest);
    if (fitsAt(candidate))
    {
      return lowestFitting(unfit, candidate);
    }
    unfit = candidate;
  }
  demand = FrontDemand(tree, refinement(), view).at(ladder.at(highest));
  return highest;
}

void RenderFront::State::chooseThreshold()
{
  // FRONT-7: in motion the threshold rises to what holds the frame rate, at rest it falls.
  floorRung = limits.interacting ? ladder.rungFor(limits.motionErrorPx) : 0;
  rung = std::max(rung, floorRung);
  const bool mayFall = !movesUsedUp && plan.missing() <= limits.requestLimit;
  const int goal = mayFall ? std::max(floorRung, rung - rungsPerFall) : rung;
  for (SlotIndex root = 0; root < tree.rootCount(); ++root)
  {
    evaluateBranch(root, ladder.at(goal));
  }

  budgetBound = false;
  growthHeldBack = false;
  if (limits.pointBudget == 0 && limits.heldPointBudget == 0)
  {
    rung = goal;
    return;
  }
  if (!fitsAt(rung))
  {
    rung = risenRung();
    // What grew beyond the budget at a lower threshold will do so again.
    lowestRung = rung;
    budgetBound = true;
  }
  else
  {
    const int lowest = std::min(rung, std::max(goal, lowestRung));
    const bool free = lowest == rung || fitsAt(lowest);
    rung = free ? lowest : lowestFitting(lowest, rung);
    budgetBound = !free || (mayFall && rung > floorRung && rung == lowestRung);
  }
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
  if (node.expanded() && node.errorPx > thresholdPx())
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
    node.errorPx > thresholdPx();
}

bool RenderFront::State::wantsCollapse(const ActiveNode& node) const
{
  if (!node.expanded())
  {
    return false;
  }
  const bool fineEnough = node.live == update && node.visible &&
    node.errorPx <= collapseBelow * thresholdPx();
  return fineEnough || update - node.seen > updatesUnseen;
}

/// Unless it would break a budget. The demand already counts the children of nodes that were on
/// the front when the threshold was chosen; those of nodes that came since are new to it.
void RenderFront::State::expand(SlotIndex slot)
{
  const bool limited = limits.pointBudget > 0 || limits.heldPointBudget > 0;
  if (limited && tree[slot].created == update)
  {
    const FrontDemand estimate(tree, refinement(), view);
    const Demand children = estimate.ofChildren(tree[slot], thresholdPx());
    if (!fits({ demand.drawn + children.drawn, demand.held + children.held }))
    {
      growthHeldBack = true;
      return;
    }
  }
  tree.expand(slot, update);
  const ActiveNode& parent = tree[slot];
  for (std::uint8_t c = 0; c < parent.childCount; ++c)
  {
    ActiveNode& child = tree[parent.children + c];
    evaluate(child, view, update);
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

void RenderFront::State::finish(int rungBefore, const ResidencyView& residency)
{
  const bool settled = expansions == 0 && !movesUsedUp && !growthHeldBack;
  const bool arrived = rung == 0 || budgetBound;
  // The residency speaks of what it was asked for after an earlier update: of the same view?
  // And nothing came since that one looked: the requests are the same.
  exhausted = !inputChanged && rung == rungBefore && plan.missing() > 0 && sameRevision &&
    residency.exhausted() && residency.revision() == revision;
  delta.frontLength = tree.frontLength();
  delta.thresholdPx = thresholdPx();
  delta.limitedByBudget = plan.clipped() || (budgetBound && !boundByMemory && rung > 0);
  delta.limitedByMemory = exhausted || (budgetBound && boundByMemory && rung > 0);
  delta.complete =
    settled && rung == rungBefore && (exhausted || (arrived && plan.missing() == 0));
  const bool falls = rung > floorRung && !budgetBound && plan.missing() <= limits.requestLimit;
  atRest = settled && delta.moves == 0 && rung == rungBefore && !falls;
}

RenderFront::RenderFront(std::shared_ptr<const Hierarchy> hierarchy)
  : state_(std::make_unique<State>(std::move(hierarchy)))
{
}

RenderFront::~RenderFront() = default;

const FrontDelta& RenderFront::update(
  const View& view, const ResidencyView& residency, const FrontLimits& limits)
{
  State& s = *state_;
  const bool sameResidency = s.revision != 0 && s.revision == residency.revision() &&
    s.exhausted == (s.plan.missing() > 0 && residency.exhausted());
  if (s.atRest && sameResidency && s.view == view && s.limits == limits)
  {
    return s.delta;
  }
  // Before anything is asked: what arrives while this update looks is news to the next one.
  const std::uint64_t revision = residency.revision();
  s.sameRevision = s.revision == revision;
  s.revision = revision;
  s.adopt(view, limits);
  const int rungBefore = s.rung;
  s.chooseThreshold();
  for (SlotIndex root = 0; root < s.tree.rootCount(); ++root)
  {
    s.markLive(root);
  }
  s.moveFront();
  s.plan.make(s.tree, s.refinement(), s.thresholdPx(), residency, s.limits, s.update, s.delta);
  s.finish(rungBefore, residency);
  return s.delta;
}

std::uint32_t RenderFront::distanceUnderFront(NodeIndex node) const
{
  const ActiveTree& tree = state_->tree;
  SlotIndex slot = tree.find(node);
  while (tree[slot].parent != noSlot && tree[slot].needed != state_->update)
  {
    slot = tree[slot].parent;
  }
  return state_->hierarchy->node(node).level - tree[slot].level;
}

void RenderFront::reset()
{
  state_ = std::make_unique<State>(state_->hierarchy);
}

} // namespace pointfront
