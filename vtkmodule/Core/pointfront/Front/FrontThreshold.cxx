#include "pointfront/Front/FrontThreshold.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace pointfront
{
namespace
{

/// Rungs that the threshold falls by an update: a factor of 0.8, from 60 px to 1 px in 19 frames.
constexpr int rungsPerFall = 20;

/// More room than when a threshold proved too low, by this share of it: it is tried again.
constexpr double moreRoom = 1.02;

} // namespace

int FrontThreshold::rungOf(std::uint16_t layer) const
{
  return layer < layers_.size() && layers_[layer].share > 0.0
    ? std::min(common_.rung, layers_[layer].own.rung)
    : common_.rung;
}

double FrontThreshold::lowestPx(std::uint16_t layer) const
{
  const bool own = layer < layers_.size() && layers_[layer].share > 0.0;
  return ladder_.at(own ? std::min(common_.goal, layers_[layer].own.goal) : common_.goal);
}

double FrontThreshold::largestPx(const ActiveTree& tree) const
{
  int rung = 0;
  for (SlotIndex root = 0; root < tree.rootCount(); ++root)
  {
    rung = tree[root].hidden ? rung : std::max(rung, rungOf(tree[root].layer));
  }
  return ladder_.at(rung);
}

void FrontThreshold::adoptLayers(const ActiveTree& tree)
{
  std::size_t count = 0;
  const bool shared = std::any_of(limits_.layers.begin(), limits_.layers.end(),
    [](const LayerLimits& layer) { return layer.visible && layer.share > 0.0; });
  for (SlotIndex root = 0; shared && root < tree.rootCount(); ++root)
  {
    count = std::max<std::size_t>(count, tree[root].layer + std::size_t(1));
  }
  layers_.resize(count);
  for (std::size_t l = 0; l < count; ++l)
  {
    const double share = shareOf(limits_.layers, l);
    if (layers_[l].share == 0.0)
    {
      layers_[l].own.rung = common_.rung;
    }
    layers_[l].share = share;
  }
}

void FrontThreshold::begin(
  const FrontLimits& limits, const ActiveTree& tree, bool inputChanged, bool mayFall)
{
  assert(limits.targetErrorPx > 0.0 && limits.movesPerFrame > 0);
  if (first_ || limits_.targetErrorPx != limits.targetErrorPx ||
    limits_.initialErrorPx != limits.initialErrorPx)
  {
    const double before = first_ ? limits.initialErrorPx : ladder_.at(common_.rung);
    ladder_ = ThresholdLadder(limits.targetErrorPx, limits.initialErrorPx);
    common_.rung = ladder_.rungFor(before);
    layers_.clear();
    first_ = false;
  }
  limits_ = limits;
  mayFall_ = mayFall;
  if (inputChanged)
  {
    adoptLayers(tree);
  }
  if (!inputChanged && common_.lowest > 0 && moreLeft())
  {
    common_.lowest = 0;
  }
  // FRONT-7: in motion the threshold rises to what holds the frame rate, at rest it falls.
  floor_ = limits.interacting ? ladder_.rungFor(limits.motionErrorPx) : 0;
  const auto start = [&](Rung& state)
  {
    state.lowest = inputChanged ? 0 : state.lowest;
    state.rung = std::max(state.rung, floor_);
    state.goal = mayFall ? std::max(floor_, state.rung - rungsPerFall) : state.rung;
  };
  start(common_);
  for (LayerRung& layer : layers_)
  {
    start(layer.own);
  }
}

bool FrontThreshold::limited() const
{
  return pointfront::limited(limits_);
}

FrontThreshold::Left FrontThreshold::sharedLeft(double px) const
{
  const auto leftOf = [&](const SharedLimit& shared)
  { return shared.most > 0 ? shared.leftAt(px) : 0; };
  return { leftOf(limits_.sharedDrawn), leftOf(limits_.sharedSlots), leftOf(limits_.sharedHeld) };
}

/// Whether any shared limit has more left since a threshold proved too low: others take less. Each
/// counts by itself: the memory's may be a thousand times the window's.
bool FrontThreshold::moreLeft() const
{
  const Left now = sharedLeft(ladder_.at(common_.lowest));
  for (std::size_t limit = 0; limit < now.size(); ++limit)
  {
    if (static_cast<double>(now[limit]) > moreRoom * static_cast<double>(leftAtLowest_[limit]))
    {
      return true;
    }
  }
  return false;
}

Demand FrontThreshold::totalAt(const ActiveTree& tree, const FrontDemand& demand, int common) const
{
  Demand sum;
  for (SlotIndex root = 0; root < tree.rootCount(); ++root)
  {
    const std::uint16_t layer = tree[root].layer;
    const bool own = layer < layers_.size() && layers_[layer].share > 0.0;
    const int rung = own ? std::min(common, layers_[layer].own.rung) : common;
    sum += demand.ofRoot(root, ladder_.at(rung));
  }
  return sum;
}

Demand FrontThreshold::layerAt(
  const ActiveTree& tree, const FrontDemand& demand, std::size_t layer, int rung) const
{
  Demand sum;
  for (SlotIndex root = 0; root < tree.rootCount(); ++root)
  {
    if (tree[root].layer == layer)
    {
      sum += demand.ofRoot(root, ladder_.at(rung));
    }
  }
  return sum;
}

/// Where nodes come whole nothing is won above the largest error of a root: the plan then cuts
/// what is too much. Where prefixes are drawn, a higher threshold draws fewer points.
int FrontThreshold::highestOf(const ActiveTree& tree) const
{
  double largestPx = 0.0;
  for (SlotIndex root = 0; root < tree.rootCount(); ++root)
  {
    largestPx = std::max<double>(largestPx, tree[root].visible ? tree[root].errorPx : 0.0f);
  }
  const double headroom = tree.refinement() == Refinement::Add ? 65536.0 : 1.0;
  return ladder_.rungFor(largestPx * headroom);
}

/// The lowest rung from the goal on that fits.
template <typename FitsAt>
void FrontThreshold::settle(Rung& state, int highest, FitsAt fitsAt)
{
  int unfit = state.rung;
  int fit = state.rung;
  const bool rises = !fitsAt(state.rung);
  if (rises)
  {
    fit = std::max(state.rung, highest);
    for (int stride = 1; unfit + stride < fit; stride *= 2)
    {
      if (fitsAt(unfit + stride))
      {
        fit = unfit + stride;
        break;
      }
      unfit += stride;
    }
  }
  else
  {
    const int lowest = std::min(state.rung, std::max(state.goal, state.lowest));
    if (lowest == state.rung || fitsAt(lowest))
    {
      state.rung = lowest;
      state.bound = mayFall_ && lowest > floor_ && lowest == state.lowest;
      return;
    }
    unfit = lowest;
  }
  // By bisection between a rung that does not fit and a higher one that does.
  while (fit - unfit > 1)
  {
    const int middle = unfit + (fit - unfit) / 2;
    (fitsAt(middle) ? fit : unfit) = middle;
  }
  state.rung = fit;
  state.bound = true;
  if (rises)
  {
    // Nodes that grew beyond the budget at a lower threshold will do so again.
    state.lowest = fit;
  }
}

void FrontThreshold::choose(const ActiveTree& tree, const FrontDemand& demand)
{
  const int before = common_.rung;
  changed_ = false;
  if (!limited())
  {
    common_.rung = common_.goal;
    common_.bound = false;
    for (LayerRung& layer : layers_)
    {
      layer.own.rung = common_.rung;
      layer.own.bound = false;
    }
  }
  else
  {
    chooseFitting(tree, demand);
  }
  changed_ = changed_ || common_.rung != before;
  commonPx_ = ladder_.at(common_.rung);
  for (std::size_t l = 0; l < layers_.size(); ++l)
  {
    layers_[l].px = ladder_.at(rungOf(static_cast<std::uint16_t>(l)));
  }
}

void FrontThreshold::chooseFitting(const ActiveTree& tree, const FrontDemand& demand)
{
  const int highest = highestOf(tree);
  for (std::size_t l = 0; l < layers_.size(); ++l)
  {
    LayerRung& layer = layers_[l];
    if (layer.share > 0.0)
    {
      const int ownBefore = layer.own.rung;
      const std::uint64_t least =
        slotsBeyond(limits_, layerAt(tree, demand, l, highest), layer.share, ladder_.at(highest));
      settle(layer.own, highest,
        [&](int rung)
        {
          const Demand wanted = layerAt(tree, demand, l, rung);
          return !brokenBudget(limits_, wanted, layer.share, ladder_.at(rung), least);
        });
      changed_ = changed_ || layer.own.rung != ownBefore;
    }
  }
  const int lowestBefore = common_.lowest;
  leastSlots_ = slotsBeyond(limits_, totalAt(tree, demand, highest), 1.0, ladder_.at(highest));
  int demandRung = -1;
  settle(common_, highest,
    [&](int rung)
    {
      const Demand wanted = totalAt(tree, demand, rung);
      const double px = ladder_.at(rung);
      const auto first = brokenBudget(limits_, wanted, 1.0, px, leastSlots_);
      if (!first)
      {
        demand_ = wanted;
        demandRung = rung;
      }
      boundBy_ = first.value_or(boundBy_);
      return !first;
    });
  if (common_.lowest > 0 && common_.lowest != lowestBefore)
  {
    leftAtLowest_ = sharedLeft(ladder_.at(common_.lowest));
  }
  if (demandRung != common_.rung)
  {
    demand_ = totalAt(tree, demand, common_.rung); // not even the highest fits
  }
}

bool FrontThreshold::admit(const Demand& more)
{
  Demand wanted = demand_;
  wanted += more;
  if (const auto first = brokenBudget(limits_, wanted, 1.0, commonPx_, leastSlots_))
  {
    boundBy_ = *first;
    return false;
  }
  demand_ = wanted;
  return true;
}

bool FrontThreshold::unmoved() const
{
  return !limited() ||
    (!common_.bound && !brokenBudget(limits_, demand_, 1.0, commonPx_, leastSlots_));
}

bool FrontThreshold::falling() const
{
  const auto falls = [&](const Rung& state) { return state.rung > floor_ && !state.bound; };
  return falls(common_) ||
    std::any_of(layers_.begin(), layers_.end(),
      [&](const LayerRung& layer) { return layer.share > 0.0 && falls(layer.own); });
}

} // namespace pointfront
