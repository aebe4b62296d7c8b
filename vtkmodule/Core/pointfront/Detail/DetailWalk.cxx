#include "pointfront/Detail/DetailWalk.h"

#include "pointfront/Detail/DetailLevel.h"
#include "pointfront/Front/PointPrefix.h"
#include "pointfront/Front/ScreenError.h"

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{

/// Below that a subtree falls on one pixel.
constexpr double onePixel = 1.0;
constexpr double overviewPriority = 1e15;
constexpr double firstSlicePriority = 1e12;

std::uint32_t prefixOf(double quota, std::uint32_t count)
{
  return quota >= count ? count : static_cast<std::uint32_t>(std::max(0.0, quota + 0.5));
}

} // namespace

/// The points that a subtree shows: those of its layer's share that fall to it, less those that its
/// ancestors draw.
struct DetailWalk::Quota
{
  double overview = 0.0;
  double detail = 0.0;

  double most() const { return std::max(overview, detail); }
};

struct DetailWalk::Visit
{
  NodeIndex index = noNode;
  Node row;
  std::uint32_t points = 0; ///< its own points, 0 where none would be drawn (NodePruning)
  Quota quota;
  double ratio = 0.0; ///< its spacing divided by its parent's
  double errorWeight = 1.0; ///< weight of its layer's errors
  bool inSight = true; ///< its parent is
  bool drawable = true; ///< all that must be there before it is
  bool standIn = true; ///< Replace: it is resident and may be drawn for its branch
};

/// The values that children take over from their parent.
struct DetailWalk::Descent
{
  bool inSight;
  bool drawable;
  bool standIn;
};

DetailWalk::DetailWalk(const Hierarchy& hierarchy)
  : hierarchy_(hierarchy)
{
  for (const NodeIndex root : hierarchy.roots())
  {
    rootRows_.push_back(hierarchy.node(root));
    points_ += static_cast<double>(rootRows_.back().pointsBelow);
    layerCount_ = std::max(layerCount_, rootRows_.back().layer + std::size_t(1));
  }
}

void DetailWalk::begin(const View& view, const FrontLimits& limits)
{
  view_ = &view;
  limits_ = &limits;
}

/// Own points of a node that may be drawn; nothing where the whole subtree has none.
std::optional<std::uint32_t> DetailWalk::drawableOf(NodeIndex node, const Node& row) const
{
  return drawablePoints(limitsOf(row.layer), node, row.pointCount);
}

Demand DetailWalk::demandOfRoot(std::size_t root, const Shown& shown)
{
  residency_ = nullptr;
  delta_ = nullptr;
  sum_ = {};
  enter(root, shown);
  return sum_;
}

Demand DetailWalk::demand(std::size_t layer, const Shown& shown)
{
  Demand sum;
  for (std::size_t root = 0; root < rootRows_.size(); ++root)
  {
    sum += rootRows_[root].layer == layer ? demandOfRoot(root, shown) : Demand();
  }
  return sum;
}

/// As FrontPlan: where there is not a slot for each of them those come first that have most to
/// show.
void DetailWalk::listRoots(const std::vector<Shown>& shown)
{
  roots_.clear();
  for (std::size_t root = 0; root < rootRows_.size(); ++root)
  {
    visible(rootRows_[root].layer) ? roots_.push_back(root) : void();
  }
  if (allowance_.slots() < roots_.size())
  {
    std::vector<std::uint64_t> drawn(rootRows_.size());
    for (const std::size_t root : roots_)
    {
      drawn[root] = demandOfRoot(root, shown[rootRows_[root].layer]).drawn;
    }
    std::stable_sort(roots_.begin(), roots_.end(),
      [&](std::size_t a, std::size_t b) { return drawn[a] > drawn[b]; });
  }
}

void DetailWalk::plan(
  const ResidencySnapshot& residency, const std::vector<Shown>& shown, FrontDelta& delta)
{
  allowance_.begin(*limits_);
  listRoots(shown);
  residency_ = &residency;
  delta_ = &delta;
  sum_ = {};
  rowsComing_ = false;
  needed_.clear();
  requests_.begin(residency);
  delta.draw.clear();
  delta.errorPx = 0.0;
  for (const std::size_t root : roots_)
  {
    enter(root, shown[rootRows_[root].layer]);
  }
  order_.sort(delta.draw);
  allowance_.listLeftOut(delta.layersLeftOut);
  requests_.finish(limits_->requestLimit, delta);
  delta.pointsDrawn = sum_.drawn;
  delta.slotsDrawn = sum_.slots;
  delta.rowsComing = rowsComing_;
}

void DetailWalk::enter(std::size_t root, const Shown& shown)
{
  Visit at;
  at.index = hierarchy_.roots()[root];
  at.row = rootRows_[root];
  const std::optional<std::uint32_t> points = drawableOf(at.index, at.row);
  if (!points)
  {
    return;
  }
  at.points = *points;
  const LayerLimits& layer = limitsOf(at.row.layer);
  const double below = static_cast<double>(at.row.pointsBelow);
  const double factor = layer.errorFactor * layer.errorFactor;
  at.errorWeight = 1.0 / layer.errorFactor;
  at.quota = { std::max(1.0, below * shown.overview / factor),
    std::min(below, below * shown.detail / factor) };
  if (hierarchy_.refinement() == Refinement::Replace)
  {
    const auto state = require(at.index, at.row, overviewPriority);
    at.drawable = state != ResidencySnapshot::State::Absent;
    at.standIn = state == ResidencySnapshot::State::Resident;
  }
  visit(at);
}

/// `counted`: a row that cannot be read counts here.
void DetailWalk::noteRow(RowState state, bool counted)
{
  rowsComing_ = rowsComing_ || state == RowState::Coming;
  if (delta_ && counted && state == RowState::Lost)
  {
    requests_.countFailed();
  }
}

void DetailWalk::visit(const Visit& at)
{
  const Node& row = at.row;
  // As its parent: a sphere may stick out of its parent's.
  const bool inSight = at.inSight &&
    sphereVisibility(*view_, row.centre, row.radius) == Visibility::Inside &&
    limitsOf(row.layer).sees(row.centre, row.radius, row.spacing);
  const double distance = distanceToNode(*view_, row);
  const bool onPixel = projectedSpacing(*view_, 2.0 * row.radius, distance) < onePixel;
  if (hierarchy_.refinement() == Refinement::Add)
  {
    visitAdd(at, inSight, distance, onPixel);
  }
  else
  {
    visitReplace(at, inSight, distance, onPixel);
  }
}

void DetailWalk::visitAdd(const Visit& at, bool inSight, double distance, bool onPixel)
{
  const Node& row = at.row;
  const bool detailed = inSight && !onPixel;
  const Quota quota{ at.quota.overview, detailed ? at.quota.detail : 0.0 };
  const std::uint32_t wantedPoints = prefixOf(quota.most(), at.points);
  auto state = ResidencySnapshot::State::Resident;
  if (wantedPoints > 0)
  {
    const bool overview = prefixOf(quota.overview, row.pointCount) > 0;
    state = require(at.index, row, overview ? overviewPriority : priorityOf(at, distance));
  }
  const bool here = at.drawable && state == ResidencySnapshot::State::Resident;
  const std::uint32_t drawn = inSight && here ? draw(at, wantedPoints, distance) : 0;
  const Quota left{ quota.overview - row.pointCount, quota.detail - row.pointCount };
  const bool deeper = left.most() >= 0.5 && !row.leaf();
  if (inSight && residency_)
  {
    noteError(at, drawn, distance, deeper && here && drawn == wantedPoints);
  }
  if (deeper)
  {
    // Below a node that failed the others go on: they are stored apart from it.
    const bool drawable = at.drawable && state != ResidencySnapshot::State::Absent;
    descend(at, left, { inSight, drawable, true });
  }
}

void DetailWalk::visitReplace(const Visit& at, bool inSight, double distance, bool onPixel)
{
  const Node& row = at.row;
  const double most = inSight && !onPixel ? at.quota.most() : at.quota.overview;
  const bool refine = !row.leaf() && most > row.pointCount;
  const bool overview = at.quota.overview > row.pointCount;
  const bool ready =
    refine && childrenReady(at, overview ? overviewPriority : priorityOf(at, distance));
  if (inSight && at.drawable && at.standIn && !ready)
  {
    noteError(at, draw(at, at.points, distance), distance, false);
  }
  if (refine)
  {
    descend(at, at.quota, { inSight, at.drawable && ready, ready });
  }
}

/// Replace: the children are asked for; true when all of them can be drawn in the parent's place.
bool DetailWalk::childrenReady(const Visit& at, double priority)
{
  bool ready = true;
  for (std::uint8_t c = 0; c < at.row.childCount; ++c)
  {
    Node child;
    const RowState state = hierarchy_.peekChild(at.index, at.row, c, child);
    noteRow(state, true);
    ready = state == RowState::Here &&
      require(at.row.firstChild + c, child, priority) == ResidencySnapshot::State::Resident &&
      ready;
  }
  return ready;
}

/// The rest goes to the children in proportion to their points.
void DetailWalk::descend(const Visit& at, const Quota& left, const Descent& descent)
{
  const std::uint64_t own = originalPoints(at.row, hierarchy_.refinement());
  const double below = static_cast<double>(at.row.pointsBelow - std::min(own, at.row.pointsBelow));
  for (std::uint8_t c = 0; c < at.row.childCount && below > 0.0; ++c)
  {
    Visit child;
    child.index = at.row.firstChild + c;
    const RowState state = hierarchy_.peekChild(at.index, at.row, c, child.row);
    if (state != RowState::Here)
    {
      noteRow(state, hierarchy_.refinement() == Refinement::Add); // else by childrenReady()
      continue;
    }
    const std::optional<std::uint32_t> points = drawableOf(child.index, child.row);
    if (!points)
    {
      continue;
    }
    child.points = *points;
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

ResidencySnapshot::State DetailWalk::require(NodeIndex node, const Node& row, double priority)
{
  const std::uint32_t points = drawableOf(node, row).value_or(0);
  if (points == 0)
  {
    return ResidencySnapshot::State::Resident;
  }
  sum_.held += points;
  if (!residency_)
  {
    return ResidencySnapshot::State::Resident;
  }
  needed_.insert(node, 0);
  return requests_.require({ node, priority, false, points, row.layer });
}

/// As many of them as the budgets allow.
std::uint32_t DetailWalk::draw(const Visit& at, std::uint32_t count, double distance)
{
  if (residency_)
  {
    count = allowance_.take(count, at.row.layer);
  }
  sum_.drawn += count;
  sum_.slots += gpuSlotsOf(count);
  if (residency_ && count > 0)
  {
    const double projectedPx = projectedSpacing(*view_, at.row.spacing, distance);
    delta_->draw.push_back({ at.index, count, static_cast<float>(projectedPx),
      static_cast<float>(distance), static_cast<float>(std::clamp(at.ratio, 0.0, 1.0)) });
  }
  return count;
}

double DetailWalk::errorOf(const Visit& at, double distance) const
{
  return at.errorWeight * projectedSpacing(*view_, at.row.spacing, distance);
}

/// Near to far by slices, within one the largest errors first.
double DetailWalk::priorityOf(const Visit& at, double distance) const
{
  const int slice = frustumSlice(distance, view_->nearDistance);
  const double within = errorOf(at, distance);
  return firstSlicePriority * std::exp2(-slice) * (1.0 + within / (1.0 + within));
}

void DetailWalk::noteError(const Visit& at, std::uint32_t shown, double distance, bool refined)
{
  const bool everything = at.row.leaf() && shown == at.points;
  if (residency_ && !refined && !everything)
  {
    const double ratio = std::clamp(at.ratio, 0.0, 1.0);
    delta_->errorPx = std::max(delta_->errorPx,
      prefixErrorPx(at.points, leastForError(shown, ratio), errorOf(at, distance), ratio));
  }
}

} // namespace pointfront
