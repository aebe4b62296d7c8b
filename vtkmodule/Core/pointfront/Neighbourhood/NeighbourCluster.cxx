#include "pointfront/Neighbourhood/NeighbourCluster.h"

#include "pointfront/Base/Infinity.h"

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{
/// A group's places are looked up farther than the last neighbour of the middle, as points at the
/// rim may have theirs farther away; so are those of a few. A point for which they do not reach far
/// enough asks the group's, which are six times as many: one of 12 without, one of 35 with this.
constexpr double widenedGroup = 1.3;
constexpr double widenedFew = 1.15;
/// Share of the reach within which most points are.
constexpr double usualReach = 0.6;
/// More than what is lost to rounding in a sum of distances.
constexpr double margin = 1.0 + 1e-9;
/// Share of a ball's extent by which a distance between two places in float may be wrong.
constexpr double floatError = 1e-6;
/// A bound for squared distances in float with which nothing is lost that is within the bound in
/// double. What is selected too much is refused later.
float safely(double squaredBound, double extent)
{
  const double bound = std::sqrt(squaredBound) + floatError * extent;
  return static_cast<float>(std::min(bound * bound * (1.0 + 1e-6), 3e38));
}
} // namespace

NeighbourCluster::NeighbourCluster(
  const PositionSet& set, const NeighbourIndex& index, const NeighbourSearch& search)
  : set_(set)
  , index_(index)
  , search_(search)
  , nearest_(search.neighbours)
  , within_(0)
{
}

void NeighbourCluster::gather(const glm::dvec3& middle, double reach)
{
  lookUp(middle, reach, widenedGroup, group_);
  around_ = &group_;
}

void NeighbourCluster::lookUp(
  const glm::dvec3& middle, double reach, double widened, PlaceBall& ball)
{
  double around = search_.radius;
  if (search_.neighbours > 0)
  {
    nearest_.begin(set_);
    index_.search(middle, nearest_);
    around = nearest_.full() ? widened * std::sqrt(nearest_.bound()) : infinity;
    likely_ = float(std::min(nearest_.bound(), double(PlaceSelection::everything)));
  }
  ball.middle = middle;
  ball.searched = around + reach;
  ball.origin = middle;
  ball.extent = ball.searched;
  within_.begin(set_, ball.searched * ball.searched * margin);
  index_.search(middle, within_);
  const std::size_t count = within_.entries().size();
  ball.resize(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    ball.places[i] = within_.entries()[i].index;
    const glm::dvec3 place = set_.positions[ball.places[i]] - middle;
    ball.x[i] = static_cast<float>(place.x);
    ball.y[i] = static_cast<float>(place.y);
    ball.z[i] = search_.axes > 2 ? static_cast<float>(place.z) : 0.0f;
  }
}

void NeighbourCluster::focus(const glm::dvec3& middle, double reach)
{
  around_ = &group_;
  if (std::isinf(group_.searched))
  {
    return;
  }
  const double known = group_.searched - std::sqrt(squaredDistance(middle, group_.middle));
  double around = search_.radius;
  selection_.measure(group_, middle, search_.axes);
  if (search_.neighbours > 0)
  {
    likely_ = limitAmongAll(search_.neighbours, search_.neighbours + search_.neighbours / 8);
    around = std::sqrt(double(likely_)) + floatError * group_.extent;
    if (around + usualReach * reach > known)
    {
      lookUp(middle, reach, widenedFew, few_);
      around_ = &few_;
      return;
    }
    around *= widenedFew;
  }
  else if (around + reach > known) // some within the radius may lie outside
  {
    return;
  }
  few_.middle = middle;
  few_.searched = std::min(around + reach, known);
  few_.origin = group_.origin;
  few_.extent = group_.extent;
  selection_.select(safely(few_.searched * few_.searched * margin, group_.extent));
  pick();
  around_ = &few_;
}

/// Copies what is selected of the group.
void NeighbourCluster::pick()
{
  few_.resize(selection_.size());
  for (std::size_t i = 0; i < selection_.size(); ++i)
  {
    const std::uint32_t from = selection_[i];
    few_.places[i] = group_.places[from];
    few_.x[i] = group_.x[from];
    few_.y[i] = group_.y[from];
    few_.z[i] = group_.z[from];
  }
}

void NeighbourCluster::search(const glm::dvec3& from, NeighbourList& list)
{
  if (search_.neighbours == 0)
  {
    const double squared = search_.radius * search_.radius;
    list.begin(set_, squared);
    selection_.measure(*around_, from, search_.axes);
    selection_.select(safely(squared, around_->extent));
    for (std::size_t i = 0; i < selection_.size(); ++i)
    {
      const std::uint32_t place = around_->places[selection_[i]];
      list.offer(squaredDistance(set_.positions[place], from), place);
    }
    return;
  }
  if (searchBall(*around_, from, list) || (around_ == &few_ && searchBall(group_, from, list)))
  {
    return;
  }
  list.begin(set_, list.bound()); // the found ones are far enough away for all neighbours
  index_.search(from, list);
}

/// False if neighbours may lie outside of the ball.
bool NeighbourCluster::searchBall(
  const PlaceBall& ball, const glm::dvec3& from, NeighbourList& list)
{
  list.begin(set_);
  selection_.measure(ball, from, search_.axes);
  selection_.select(limitAmongAll(search_.neighbours, search_.neighbours + search_.neighbours / 4));
  chooseNearest(ball, from, list);
  if (list.full())
  {
    const float needed = safely(list.bound(), ball.extent);
    if (needed > selection_.limit()) // rounding: those between were not selected
    {
      selection_.select(needed);
      chooseNearest(ball, from, list);
    }
    likely_ = static_cast<float>(list.bound());
  }
  if (std::isinf(ball.searched))
  {
    return true;
  }
  const double known = ball.searched - std::sqrt(squaredDistance(from, ball.middle));
  return list.full() && known > 0.0 && list.bound() * margin < known * known;
}

/// Fills the list from those that are selected. As many places as points are wanted are enough.
void NeighbourCluster::chooseNearest(
  const PlaceBall& ball, const glm::dvec3& from, NeighbourList& list)
{
  selection_.sort();
  chosen_.clear();
  float cut = PlaceSelection::everything;
  for (std::size_t i = 0; i < selection_.size(); ++i)
  {
    const std::uint32_t next = selection_.nth(i);
    if (selection_.distances().squared[next] > cut)
    {
      break;
    }
    const std::uint32_t place = ball.places[selection_[next]];
    const NeighbourList::Entry entry{ squaredDistance(set_.positions[place], from), place,
      set_.counts[place] };
    const bool enough = chosen_.size() == search_.neighbours;
    if (enough && !list.less(entry, chosen_.back()))
    {
      continue;
    }
    if (enough)
    {
      chosen_.pop_back();
    }
    chosen_.push_back(entry);
    std::size_t at = chosen_.size() - 1;
    for (; at > 0 && list.less(entry, chosen_[at - 1]); --at)
    {
      chosen_[at] = chosen_[at - 1];
    }
    chosen_[at] = entry;
    if (chosen_.size() == search_.neighbours) // none farther than these can be among them
    {
      cut =
        safely(chosen_.back().squaredDistance, ball.extent) * (1.0f + PlaceSelection::orderError);
    }
  }
  list.assign(chosen_);
}

bool NeighbourCluster::searchUnordered(
  const glm::dvec3& from, std::vector<std::uint32_t>& places, double& squaredReach)
{
  return search_.neighbours > 0 &&
    (chooseExactly(*around_, from, places, squaredReach) ||
      (around_ == &few_ && chooseExactly(group_, from, places, squaredReach)));
}

/// With a limit within which there are as many places as are wanted, and none so close beyond it
/// that rounding could have put it there, nothing has to be sorted or measured in double.
bool NeighbourCluster::chooseExactly(const PlaceBall& ball, const glm::dvec3& from,
  std::vector<std::uint32_t>& places, double& squaredReach)
{
  const std::size_t wanted = search_.neighbours;
  selection_.measure(ball, from, search_.axes);
  const std::size_t most = wanted + std::max<std::size_t>(1, wanted / 2);
  // As places grow on a surface.
  const float more = 0.5f * float(wanted + 1 + most) / float(wanted);
  selection_.select(
    PlaceSelection::limitOf(selection_.measured(), wanted + 1, most, likely_ * more));
  const std::optional<PlaceSelection::Gap> gap = selection_.keepNearest(wanted);
  if (!gap)
  {
    return false;
  }
  std::uint32_t mostPoints = 1;
  places.resize(wanted);
  for (std::size_t i = 0; i < wanted; ++i)
  {
    places[i] = ball.places[selection_[i]];
    mostPoints = std::max(mostPoints, set_.counts[places[i]]);
  }
  squaredReach = safely(gap->last, ball.extent);
  likely_ = gap->last;
  const double known = ball.searched - std::sqrt(squaredDistance(from, ball.middle));
  const float unclear = safely(squaredReach, ball.extent);
  return mostPoints == 1 && std::min(gap->next, selection_.limit()) > unclear && known > 0.0 &&
    squaredReach * margin < known * known;
}

float NeighbourCluster::limitAmongAll(std::size_t fewest, std::size_t most) const
{
  return PlaceSelection::limitOf(selection_.measured(), fewest, most, likely_);
}

double NeighbourCluster::squaredDistance(const glm::dvec3& a, const glm::dvec3& b) const
{
  // As the indices do: the same products in the same order.
  const glm::dvec3 d = a - b;
  return search_.axes > 2 ? d.x * d.x + d.y * d.y + d.z * d.z : d.x * d.x + d.y * d.y;
}

} // namespace pointfront
