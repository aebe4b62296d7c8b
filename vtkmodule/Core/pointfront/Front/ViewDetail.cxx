#include "pointfront/Front/ViewDetail.h"

#include "pointfront/Front/DetailLevel.h"
#include "pointfront/Front/NodeSlots.h"
#include "pointfront/Front/OverviewCount.h"
#include "pointfront/Front/PointPrefix.h"
#include "pointfront/Front/ScreenError.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pointfront
{
namespace
{

/// Steps of the level when a budget keeps it down.
constexpr double levelsPerStep = 0.125;
/// Below that a subtree falls on one pixel.
constexpr double onePixel = 1.0;
constexpr double overviewPriority = 1e15;
constexpr double firstSlicePriority = 1e12;
constexpr std::uint32_t farBelow = 0xffff;

/// What a subtree shows at a level: points of the whole level that fall to it, less those that its
/// ancestors draw.
struct Quota
{
  double overview = 0.0;
  double detail = 0.0;

  double most() const { return std::max(overview, detail); }
};

struct Visit
{
  NodeIndex index = noNode;
  Node row;
  Quota quota;
  double ratio = 0.0;           ///< of its spacing to its parent's
  double errorWeight = 1.0;     ///< of its layer
  bool inSight = true;          ///< its parent is
  bool drawable = true;         ///< all that must be there before it is
  bool standIn = true;          ///< Replace: it is resident and may be drawn for its branch
};

/// What children take over from their parent.
struct Descent
{
  bool inSight;
  bool drawable;
  bool standIn;
};

std::uint32_t prefixOf(double quota, std::uint32_t count)
{
  return quota >= count ? count : static_cast<std::uint32_t>(std::max(0.0, quota + 0.5));
}

bool nearer(const DrawItem& a, const DrawItem& b)
{
  return a.distance != b.distance ? a.distance < b.distance : a.node < b.node;
}

bool sooner(const LoadRequest& a, const LoadRequest& b)
{
  return a.priority != b.priority ? a.priority > b.priority : a.node < b.node;
}

} // namespace

struct ViewDetail::State
{
  explicit State(std::shared_ptr<const Hierarchy> table)
    : hierarchy(std::move(table))
  {
  }

  std::shared_ptr<const Hierarchy> hierarchy;
  FrontDelta delta;
  double level = 0.0;
  double wantedLevel = 0.0; ///< of the view, without budgets
  NodeSlots needed;         ///< by the last update

  // What the last update saw and left.
  View view;
  FrontLimits limits;
  std::uint64_t revision = 0;
  std::uint64_t rowArrivals = 0;
  bool first = true;
  bool atRest = false;
  bool exhausted = false;

  // The walk under way.
  const ResidencyView* residency = nullptr; ///< null: the walk only counts
  double overviewShown = 0.0; ///< share of the points that the overview shows
  double detailShown = 0.0;
  bool boundByMemory = false; ///< if a budget keeps the level down
  std::uint64_t drawn = 0;
  std::uint64_t held = 0;
  std::uint64_t mostDrawn = 0;
  std::uint32_t missing = 0;
  std::vector<LoadRequest> wanted;

  double points() const;
  double errorAt(double candidate) const;
  void choose();
  void walk(const ResidencyView* from);
  bool fits();
  void visit(const Visit& at);
  void visitAdd(const Visit& at, bool inSight, double distance, bool onPixel);
  void visitReplace(const Visit& at, bool inSight, double distance, bool onPixel);
  void descend(const Visit& at, const Quota& left, const Descent& descent);
  bool childrenReady(const Visit& at, double priority);
  ResidencyView::State require(NodeIndex node, std::uint32_t count, double priority);
  void draw(const Visit& at, std::uint32_t count, double distance);
  void noteError(const Visit& at, std::uint32_t shown, double distance, bool refined);
  double errorOf(const Visit& at, double distance) const;
  double priorityOf(const Visit& at, double distance) const;
  bool unchanged(const View& v, const ResidencyView& from, const FrontLimits& l) const;
  void finish(const ResidencyView& from, bool sameInput, bool sameRevision);
};

double ViewDetail::State::points() const
{
  double sum = 0.0;
  for (const NodeIndex root : hierarchy->roots())
  {
    sum += static_cast<double>(hierarchy->node(root).pointsBelow);
  }
  return sum;
}

/// A level as a threshold: four times fewer points than the pixels ask for are twice the error.
double ViewDetail::State::errorAt(double candidate) const
{
  return limits.targetErrorPx * std::exp2(0.5 * (wantedLevel - candidate));
}

/// The level of the view, and the highest at or below it that fits the budgets.
void ViewDetail::State::choose()
{
  const double all = std::max(points(), 1.0);
  const double deepest = std::log2(all);
  std::uint64_t overview = std::min<std::uint64_t>(
    std::max<std::uint64_t>(limits.overviewPoints, 1), static_cast<std::uint64_t>(all));
  if (limits.pointBudget > 0)
  {
    overview = std::min(overview, limits.pointBudget);
  }
  const double pixels = static_cast<double>(view.width) * view.height /
    (limits.targetErrorPx * limits.targetErrorPx);
  double overviewAt = overviewLevel(overview);
  overviewShown = std::exp2(overviewAt) / all;
  const double inFrustum = overviewInFrustum(*hierarchy, view, overviewShown);
  wantedLevel = detailLevel(overviewAt, pixels, inFrustum, deepest);
  const auto fitsAt = [&](double candidate)
  {
    level = candidate;
    detailShown = std::exp2(level) / all;
    return fits();
  };
  if (fitsAt(wantedLevel))
  {
    return;
  }
  // Steps from the overview up, so that a level depends on the view alone.
  int low = 0;
  int high = static_cast<int>(std::ceil((wantedLevel - overviewAt) / levelsPerStep));
  while (high - low > 1)
  {
    const int middle = low + (high - low) / 2;
    (fitsAt(overviewAt + middle * levelsPerStep) ? low : high) = middle;
  }
  bool fitting = fitsAt(overviewAt + low * levelsPerStep);
  while (!fitting && overviewAt > 0.0)
  {
    overviewAt -= 0.5;
    overviewShown = std::exp2(overviewAt) / all;
    fitting = fitsAt(overviewAt);
  }
}

bool ViewDetail::State::fits()
{
  const SharedLimit& window = limits.sharedDrawn;
  const SharedLimit& memory = limits.sharedHeld;
  if (limits.pointBudget == 0 && limits.heldPointBudget == 0 && window.points == 0 &&
    memory.points == 0)
  {
    return true;
  }
  walk(nullptr);
  const double px = errorAt(level);
  const bool drawnFits = (limits.pointBudget == 0 || drawn <= limits.pointBudget) &&
    (window.points == 0 || drawn <= window.leftAt(px));
  const bool heldFits = (limits.heldPointBudget == 0 || held <= limits.heldPointBudget) &&
    (memory.points == 0 || held <= memory.leftAt(px));
  boundByMemory = drawnFits && heldFits ? boundByMemory : drawnFits;
  return drawnFits && heldFits;
}

void ViewDetail::State::walk(const ResidencyView* from)
{
  residency = from;
  drawn = held = 0;
  mostDrawn = limits.pointBudget > 0 ? limits.pointBudget : UINT64_MAX;
  if (limits.sharedDrawn.points > 0) // step 0: what the others have on screen now
  {
    mostDrawn = std::min(mostDrawn, limits.sharedDrawn.leftAt(DemandCurve::pxOf(0)));
  }
  missing = 0;
  delta.rowsComing = false;
  for (const NodeIndex root : hierarchy->roots())
  {
    Visit at;
    at.index = root;
    at.row = hierarchy->node(root);
    const LayerLimits layer =
      at.row.layer < limits.layers.size() ? limits.layers[at.row.layer] : LayerLimits();
    if (!layer.visible)
    {
      continue;
    }
    const double below = static_cast<double>(at.row.pointsBelow);
    const double factor = layer.errorFactor * layer.errorFactor;
    at.errorWeight = 1.0 / layer.errorFactor;
    at.quota = { std::max(1.0, below * overviewShown / factor),
      std::min(below, below * detailShown / factor) };
    if (hierarchy->refinement() == Refinement::Replace)
    {
      const auto state = require(root, at.row.pointCount, overviewPriority);
      at.drawable = state != ResidencyView::State::Absent;
      at.standIn = state == ResidencyView::State::Resident;
    }
    visit(at);
  }
}

void ViewDetail::State::visit(const Visit& at)
{
  const Node& row = at.row;
  // As its parent: a sphere may stick out of its parent's.
  const bool inSight = at.inSight &&
    sphereVisibility(view, row.centre, row.radius) == Visibility::Inside;
  const double distance = distanceToNode(view, row);
  const bool onPixel = projectedSpacing(view, 2.0 * row.radius, distance) < onePixel;
  if (hierarchy->refinement() == Refinement::Add)
  {
    visitAdd(at, inSight, distance, onPixel);
  }
  else
  {
    visitReplace(at, inSight, distance, onPixel);
  }
}

void ViewDetail::State::visitAdd(const Visit& at, bool inSight, double distance, bool onPixel)
{
  const Node& row = at.row;
  const bool detailed = inSight && !onPixel;
  const Quota quota{ at.quota.overview, detailed ? at.quota.detail : 0.0 };
  const std::uint32_t wantedPoints = prefixOf(quota.most(), row.pointCount);
  auto state = ResidencyView::State::Resident;
  if (wantedPoints > 0)
  {
    const bool overview = prefixOf(quota.overview, row.pointCount) > 0;
    state = require(
      at.index, row.pointCount, overview ? overviewPriority : priorityOf(at, distance));
  }
  const bool here = at.drawable && state == ResidencyView::State::Resident;
  if (inSight && here)
  {
    draw(at, wantedPoints, distance);
  }
  const Quota left{ quota.overview - row.pointCount, quota.detail - row.pointCount };
  const bool deeper = left.most() >= 0.5 && !row.leaf();
  if (inSight && residency)
  {
    noteError(at, here ? wantedPoints : 0, distance, deeper && here);
  }
  if (deeper)
  {
    // Below a node that failed the others go on: they are stored apart from it.
    const bool drawable = at.drawable && state != ResidencyView::State::Absent;
    descend(at, left, { inSight, drawable, true });
  }
}

void ViewDetail::State::visitReplace(const Visit& at, bool inSight, double distance, bool onPixel)
{
  const Node& row = at.row;
  const double most = inSight && !onPixel ? at.quota.most() : at.quota.overview;
  const bool refine = !row.leaf() && most > row.pointCount;
  const bool overview = at.quota.overview > row.pointCount;
  const bool ready =
    refine && childrenReady(at, overview ? overviewPriority : priorityOf(at, distance));
  if (inSight && at.drawable && at.standIn && !ready)
  {
    draw(at, row.pointCount, distance);
    noteError(at, row.pointCount, distance, false);
  }
  if (refine)
  {
    descend(at, at.quota, { inSight, at.drawable && ready, ready });
  }
}

/// Replace: the children are asked for; true when all of them can be drawn in the parent's place.
bool ViewDetail::State::childrenReady(const Visit& at, double priority)
{
  bool ready = true;
  for (std::uint8_t c = 0; c < at.row.childCount; ++c)
  {
    Node child;
    const RowState state = hierarchy->peekChild(at.index, at.row, c, child);
    delta.rowsComing = delta.rowsComing || state == RowState::Coming;
    delta.failedNodes += state == RowState::Lost ? 1 : 0;
    ready = state == RowState::Here &&
      require(at.row.firstChild + c, child.pointCount, priority) ==
        ResidencyView::State::Resident &&
      ready;
  }
  return ready;
}

/// What is left goes to the children in proportion to their points.
void ViewDetail::State::descend(const Visit& at, const Quota& left, const Descent& descent)
{
  const std::uint64_t own = originalPoints(at.row, hierarchy->refinement());
  const double below = static_cast<double>(at.row.pointsBelow - std::min(own, at.row.pointsBelow));
  for (std::uint8_t c = 0; c < at.row.childCount && below > 0.0; ++c)
  {
    Visit child;
    child.index = at.row.firstChild + c;
    const RowState state = hierarchy->peekChild(at.index, at.row, c, child.row);
    if (state != RowState::Here)
    {
      delta.rowsComing = delta.rowsComing || state == RowState::Coming;
      const bool counted = hierarchy->refinement() == Refinement::Replace; // by childrenReady()
      delta.failedNodes += state == RowState::Lost && !counted ? 1 : 0;
      continue;
    }
    const double share = static_cast<double>(child.row.pointsBelow) / below;
    child.quota = { left.overview * share, left.detail * share };
    child.ratio = at.row.spacing > 0.0f ? double(child.row.spacing) / at.row.spacing : 0.5;
    child.errorWeight = at.errorWeight;
    child.inSight = descent.inSight;
    child.drawable = descent.drawable;
    child.standIn = descent.standIn;
    visit(child);
  }
}

ResidencyView::State ViewDetail::State::require(
  NodeIndex node, std::uint32_t count, double priority)
{
  if (count == 0)
  {
    return ResidencyView::State::Resident;
  }
  held += count;
  if (!residency)
  {
    return ResidencyView::State::Resident;
  }
  needed.insert(node, 0);
  const ResidencyView::State state = residency->state(node);
  if (state == ResidencyView::State::Failed)
  {
    ++delta.failedNodes;
  }
  else if (state == ResidencyView::State::Absent)
  {
    ++missing;
    wanted.push_back({ node, priority, false });
  }
  return state;
}

void ViewDetail::State::draw(const Visit& at, std::uint32_t count, double distance)
{
  if (residency)
  {
    count = static_cast<std::uint32_t>(std::min<std::uint64_t>(count, mostDrawn - drawn));
  }
  drawn += count;
  if (residency && count > 0)
  {
    delta.draw.push_back({ at.index, count, static_cast<float>(errorOf(at, distance)),
      static_cast<float>(distance) });
  }
}

double ViewDetail::State::errorOf(const Visit& at, double distance) const
{
  return at.errorWeight * projectedSpacing(view, at.row.spacing, distance);
}

/// Near to far by slices, within one the largest errors first.
double ViewDetail::State::priorityOf(const Visit& at, double distance) const
{
  const int slice = frustumSlice(distance, view.nearDistance);
  const double within = errorOf(at, distance);
  return firstSlicePriority * std::exp2(-slice) * (1.0 + within / (1.0 + within));
}

void ViewDetail::State::noteError(
  const Visit& at, std::uint32_t shown, double distance, bool refined)
{
  const bool everything = at.row.leaf() && shown == at.row.pointCount;
  if (residency && !refined && !everything)
  {
    const double ratio = std::clamp(at.ratio, 0.0, 1.0);
    delta.errorPx = std::max(delta.errorPx,
      prefixErrorPx(at.row.pointCount, shown, errorOf(at, distance), ratio));
  }
}

ViewDetail::ViewDetail(std::shared_ptr<const Hierarchy> hierarchy)
  : state_(std::make_unique<State>(std::move(hierarchy)))
{
}

ViewDetail::~ViewDetail() = default;

bool ViewDetail::State::unchanged(
  const View& v, const ResidencyView& from, const FrontLimits& l) const
{
  return atRest && revision != 0 && revision == from.revision() &&
    exhausted == (missing > 0 && from.exhausted()) && rowArrivals == hierarchy->arrivals() &&
    limits.sharedRevision == l.sharedRevision && view == v && limits == l;
}

void ViewDetail::State::finish(const ResidencyView& from, bool sameInput, bool sameRevision)
{
  std::sort(delta.draw.begin(), delta.draw.end(), nearer);
  std::sort(wanted.begin(), wanted.end(), sooner);
  if (wanted.size() > limits.requestLimit)
  {
    wanted.resize(limits.requestLimit);
  }
  delta.requests.assign(wanted.begin(), wanted.end());
  delta.pointsDrawn = drawn;
  delta.frontLength = static_cast<std::uint32_t>(needed.size());
  // As an error: what the frustum's points come to, spread over its pixels.
  delta.thresholdPx = errorAt(level);
  exhausted = sameInput && sameRevision && missing > 0 && from.exhausted() &&
    from.revision() == revision;
  const bool bound = level < wantedLevel;
  delta.limitedByBudget = bound && !boundByMemory;
  delta.limitedByMemory = exhausted || (bound && boundByMemory);
  delta.complete = !delta.rowsComing && (missing == 0 || exhausted);
  atRest = !delta.rowsComing;
}

const FrontDelta& ViewDetail::update(
  const View& view, const ResidencyView& residency, const FrontLimits& limits)
{
  State& s = *state_;
  assert(limits.targetErrorPx > 0.0);
  if (s.unchanged(view, residency, limits))
  {
    return s.delta;
  }
  const std::uint64_t revision = residency.revision();
  const std::uint64_t rows = s.hierarchy->arrivals();
  const bool sameRevision = s.revision == revision;
  const bool sameInput = !s.first && s.view == view && s.limits == limits &&
    s.limits.sharedRevision == limits.sharedRevision;
  const bool sameRows = s.rowArrivals == rows && !s.delta.rowsComing;
  s.revision = revision;
  s.rowArrivals = rows;
  s.first = false;
  s.view = view;
  s.limits = limits;
  if (!sameInput || !sameRows)
  {
    s.choose();
  }
  s.needed.clear();
  s.wanted.clear();
  s.delta.draw.clear();
  s.delta.errorPx = 0.0;
  s.delta.failedNodes = 0;
  s.walk(&residency);
  s.finish(residency, sameInput, sameRevision);
  return s.delta;
}

void ViewDetail::demandCurves(DemandCurve& drawn, DemandCurve& held) const
{
  const State& s = *state_;
  const double px = s.errorAt(s.level);
  for (std::size_t step = 0; step < DemandCurve::size; ++step)
  {
    const double ratio = px / std::max(px, DemandCurve::pxOf(step));
    drawn[step] = static_cast<std::uint64_t>(double(s.drawn) * ratio * ratio);
    held[step] = static_cast<std::uint64_t>(double(s.held) * ratio * ratio);
  }
  drawn[0] = s.delta.pointsDrawn;
}

std::uint32_t ViewDetail::distanceUnderFront(NodeIndex node) const
{
  const State& s = *state_;
  std::uint32_t distance = 0;
  for (NodeIndex above = node; above != noNode; ++distance)
  {
    if (s.needed.find(above) != NodeSlots::none)
    {
      return distance;
    }
    Node row;
    if (s.hierarchy->peek(above, row) != RowState::Here)
    {
      return farBelow;
    }
    above = row.parent; // comes before it in the table: this ends
  }
  return farBelow;
}

void ViewDetail::reset() { state_ = std::make_unique<State>(state_->hierarchy); }

double ViewDetail::level() const { return state_->level; }

} // namespace pointfront
