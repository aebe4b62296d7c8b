#include "pointfront/Detail/ViewDetail.h"

#include "pointfront/Detail/DetailLevels.h"
#include "pointfront/Detail/DetailWalk.h"
#include "pointfront/Front/SeenResidency.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace pointfront
{

struct ViewDetail::State
{
  explicit State(std::shared_ptr<const Hierarchy> table)
    : hierarchy(std::move(table))
    , walk(*hierarchy)
  {
  }

  std::shared_ptr<const Hierarchy> hierarchy;
  DetailWalk walk;
  DetailLevels levels;
  FrontDelta delta;

  // State of the last update:
  View view;
  FrontLimits limits;
  SeenResidency residencySeen;
  std::uint64_t rowArrivals = 0;
  bool first = true;
  bool atRest = false;

  bool unchanged(const View& v, const ResidencySnapshot& from, const FrontLimits& l) const;
  void finish(const ResidencySnapshot& from, bool sameInput);
};

ViewDetail::ViewDetail(std::shared_ptr<const Hierarchy> hierarchy)
  : state_(std::make_unique<State>(std::move(hierarchy)))
{
}

ViewDetail::~ViewDetail() = default;

bool ViewDetail::State::unchanged(
  const View& v, const ResidencySnapshot& from, const FrontLimits& l) const
{
  return atRest && residencySeen.unchanged(from, walk.missing()) &&
    rowArrivals == hierarchy->arrivals() && limits.sharedRevision == l.sharedRevision &&
    view == v && limits == l;
}

void ViewDetail::State::finish(const ResidencySnapshot& from, bool sameInput)
{
  ++delta.number;
  delta.frontLength = static_cast<std::uint32_t>(walk.needed().size());
  // As an error: what the frustum's points come to, spread over its pixels.
  delta.thresholdPx = levels.errorAt(levels.lowest());
  residencySeen.finish(from, sameInput, walk.missing());
  const auto boundBy = [&](FrontBudget budget)
  { return levels.bound() && levels.boundBy() == budget; };
  delta.limitedByBudget = walk.cutByPoints() || boundBy(FrontBudget::Points);
  delta.limitedByGpu = walk.cutBySlots() || boundBy(FrontBudget::GpuMemory);
  delta.limitedByMemory = residencySeen.exhausted() || boundBy(FrontBudget::HostMemory);
  delta.complete = !delta.rowsComing && (walk.missing() == 0 || residencySeen.exhausted());
  atRest = !delta.rowsComing;
}

const FrontDelta& ViewDetail::update(
  const View& view, const ResidencySnapshot& residency, const FrontLimits& limits)
{
  State& s = *state_;
  assert(limits.targetErrorPx > 0.0);
  if (s.unchanged(view, residency, limits))
  {
    return s.delta;
  }
  const std::uint64_t rows = s.hierarchy->arrivals();
  const bool sameInput = !s.first && s.view == view && s.limits == limits &&
    s.limits.sharedRevision == limits.sharedRevision;
  const bool sameRows = s.rowArrivals == rows && !s.delta.rowsComing;
  s.residencySeen.begin(residency);
  s.rowArrivals = rows;
  s.first = false;
  s.view = view;
  s.limits = limits;
  s.walk.begin(s.view, s.limits);
  if (!sameInput || !sameRows)
  {
    s.levels.choose(s.walk, *s.hierarchy, s.view, s.limits);
  }
  s.walk.plan(residency, s.levels.shown(), s.delta);
  s.finish(residency, sameInput);
  return s.delta;
}

void ViewDetail::demandCurves(DemandCurves& curves) const
{
  const State& s = *state_;
  const double px = s.levels.errorAt(s.levels.lowest());
  for (std::size_t step = 0; step < DemandCurve::size; ++step)
  {
    const double ratio = px / std::max(px, DemandCurve::pxOf(step));
    const double share = ratio * ratio;
    curves.drawn[step] = static_cast<std::uint64_t>(double(s.delta.pointsDrawn) * share);
    curves.slots[step] = static_cast<std::uint64_t>(std::ceil(double(s.delta.slotsDrawn) * share));
    curves.held[step] = static_cast<std::uint64_t>(double(s.walk.held()) * share);
  }
}

std::uint32_t ViewDetail::distanceUnderFront(NodeIndex node) const
{
  const State& s = *state_;
  std::uint32_t distance = 0;
  for (NodeIndex above = node; above != noNode; ++distance)
  {
    if (s.walk.needed().find(above) != NodeSlots::none)
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

void ViewDetail::reset()
{
  state_ = std::make_unique<State>(state_->hierarchy);
}

double ViewDetail::level() const
{
  return state_->levels.lowest();
}

} // namespace pointfront
