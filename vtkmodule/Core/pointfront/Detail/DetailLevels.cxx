#include "pointfront/Detail/DetailLevels.h"

#include "pointfront/Detail/DetailLevel.h"
#include "pointfront/Front/OverviewCount.h"

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{

/// Steps of a level when a budget keeps it down.
constexpr double levelsPerStep = 0.125;
constexpr double belowAnyLevel = -1e9;

} // namespace

double DetailLevels::errorAt(double level) const
{
  return targetErrorPx_ * std::exp2(0.5 * (wanted_ - level));
}

/// A point of the whole store: one of each layer, or its root where that comes whole.
DetailWalk::Shown DetailLevels::leastShown() const
{
  return { 1.0 / all_, 1.0 / all_ };
}

DetailWalk::Shown DetailLevels::shownAt(double level) const
{
  return { std::exp2(overview_) / all_, std::exp2(level) / all_ };
}

/// Steps from the overview up, so that a level depends on the view alone. False if not even the
/// overview's fits; the level is that then.
template <typename FitsAt>
bool DetailLevels::highestFitting(FitsAt fitsAt, double& level) const
{
  level = wanted_;
  if (fitsAt(level))
  {
    return true;
  }
  int low = 0;
  int high = static_cast<int>(std::ceil((wanted_ - overview_) / levelsPerStep));
  while (high - low > 1)
  {
    const int middle = low + (high - low) / 2;
    (fitsAt(overview_ + middle * levelsPerStep) ? low : high) = middle;
  }
  level = overview_ + low * levelsPerStep;
  return fitsAt(level);
}

void DetailLevels::chooseOwn(DetailWalk& walk, const FrontLimits& limits)
{
  for (std::size_t l = 0; l < layers_.size(); ++l)
  {
    LayerLevel& layer = layers_[l];
    layer.own = belowAnyLevel;
    const double share = shareOf(limits.layers, l);
    if (share > 0.0)
    {
      double highest = 0.0;
      const std::uint64_t least =
        slotsBeyond(limits, walk.demand(l, leastShown()), share, errorAt(0.0));
      const auto fits = [&](double level)
      {
        layer.demand = walk.demand(l, shownAt(level));
        return !brokenBudget(limits, layer.demand, share, errorAt(level), least);
      };
      layer.own = highestFitting(fits, highest) ? highest : belowAnyLevel;
    }
  }
}

/// All layers together, each at its own level or this one.
bool DetailLevels::fitsAt(DetailWalk& walk, const FrontLimits& limits, double level)
{
  Demand sum;
  for (std::size_t l = 0; l < layers_.size(); ++l)
  {
    if (walk.visible(l))
    {
      const LayerLevel& layer = layers_[l];
      sum += layer.own >= level ? layer.demand : walk.demand(l, shownAt(level));
    }
  }
  const auto broken = brokenBudget(limits, sum, 1.0, errorAt(level), leastSlots_);
  boundBy_ = broken.value_or(boundBy_);
  return !broken;
}

void DetailLevels::chooseCommon(DetailWalk& walk, const FrontLimits& limits)
{
  Demand least;
  for (std::size_t l = 0; l < layers_.size(); ++l)
  {
    least += walk.visible(l) ? walk.demand(l, leastShown()) : Demand();
  }
  leastSlots_ = slotsBeyond(limits, least, 1.0, errorAt(0.0));
  double common = 0.0;
  bool fitting = highestFitting([&](double level) { return fitsAt(walk, limits, level); }, common);
  while (!fitting && overview_ > 0.0)
  {
    overview_ -= 0.5;
    common = overview_;
    fitting = fitsAt(walk, limits, common);
  }
  adopt(walk, common);
}

void DetailLevels::adopt(const DetailWalk& walk, double common)
{
  lowest_ = wanted_;
  for (std::size_t l = 0; l < layers_.size(); ++l)
  {
    const double level = std::max(common, layers_[l].own);
    shown_[l] = shownAt(level);
    lowest_ = walk.visible(l) ? std::min(lowest_, level) : lowest_;
  }
}

void DetailLevels::choose(
  DetailWalk& walk, const Hierarchy& hierarchy, const View& view, const FrontLimits& limits)
{
  layers_.resize(walk.layerCount());
  shown_.resize(walk.layerCount());
  all_ = std::max(walk.points(), 1.0);
  targetErrorPx_ = limits.targetErrorPx;
  boundBy_ = FrontBudget::Points;
  std::uint64_t overview = std::min<std::uint64_t>(
    std::max<std::uint64_t>(limits.overviewPoints, 1), static_cast<std::uint64_t>(all_));
  if (limits.pointBudget > 0)
  {
    overview = std::min(overview, limits.pointBudget);
  }
  overview_ = overviewLevel(overview);
  const double pixels =
    static_cast<double>(view.width) * view.height / (limits.targetErrorPx * limits.targetErrorPx);
  const double inFrustum =
    overviewInFrustum(hierarchy, view, std::exp2(overview_) / all_, limits.layers);
  wanted_ = detailLevel(overview_, pixels, inFrustum, std::log2(all_));
  if (limited(limits))
  {
    chooseOwn(walk, limits);
    chooseCommon(walk, limits);
    return;
  }
  for (LayerLevel& layer : layers_)
  {
    layer.own = belowAnyLevel;
  }
  adopt(walk, wanted_);
}

} // namespace pointfront
