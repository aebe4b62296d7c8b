#include "pointfront/Neighbourhood/NeighbourCluster.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pointfront
{
namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
/// The places are looked up farther than the last neighbour of the middle, as points at the rim may
/// have theirs farther away: 4 % of the points of a survey still need a search of their own.
constexpr double widened = 1.15;
/// More than what is lost to rounding in a sum of distances.
constexpr double margin = 1.0 + 1e-9;
/// Share of the searched distance by which a distance between two places in float may be wrong.
constexpr double floatError = 1e-6;
/// Of squared distances up to the bound: that many places of a surface share one of them, or fewer.
constexpr std::size_t bins = 64;
/// The time of ranking grows with the square.
constexpr std::size_t mostRanked = 128;
} // namespace

NeighbourCluster::NeighbourCluster(
  const PositionSet& set, const NeighbourIndex& index, const NeighbourDemand& demand)
  : set_(set)
  , index_(index)
  , demand_(demand)
  , around_(demand.neighbours)
  , within_(0)
{
}

void NeighbourCluster::gather(const glm::dvec3& middle, double reach)
{
  middle_ = middle;
  double around = demand_.radius;
  if (demand_.neighbours > 0)
  {
    around_.begin(set_);
    index_.search(middle, around_);
    around = around_.full() ? widened * std::sqrt(around_.bound()) : infinity;
    keepLast(around_);
  }
  searched_ = around + reach;
  const double squared = searched_ * searched_ * margin;
  within_.begin(set_, squared);
  index_.search(middle, within_);
  const std::size_t count = within_.entries().size();
  candidates_.resize(count);
  x_.resize(count);
  y_.resize(count);
  z_.resize(count);
  squaredDistances_.resize(count);
  selected_.resize(count);
  sorted_.resize(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    candidates_[i] = within_.entries()[i].index;
    const glm::dvec3 place = set_.positions[candidates_[i]] - middle;
    x_[i] = static_cast<float>(place.x);
    y_[i] = static_cast<float>(place.y);
    z_[i] = demand_.axes > 2 ? static_cast<float>(place.z) : 0.0f;
  }
}

void NeighbourCluster::search(const glm::dvec3& from, NeighbourList& list)
{
  const double bound = squaredBound(from);
  list.begin(set_, bound);
  offerCandidates(from, bound, list);
  if (demand_.neighbours == 0 || std::isinf(searched_))
  {
    return;
  }
  const double known = searched_ - std::sqrt(squaredDistance(from, middle_));
  if (!list.full() || known <= 0.0 || list.bound() * margin >= known * known)
  {
    list.begin(set_);
    index_.search(from, list);
  }
  keepLast(list);
}

void NeighbourCluster::offerCandidates(
  const glm::dvec3& from, double squaredBound, NeighbourList& list)
{
  const glm::vec3 at(from - middle_);
  const float z = demand_.axes > 2 ? at.z : 0.0f;
  const std::size_t count = candidates_.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    const float dx = x_[i] - at.x;
    const float dy = y_[i] - at.y;
    const float dz = z_[i] - z;
    squaredDistances_[i] = dx * dx + dy * dy + dz * dz;
  }
  std::copy(candidates_.begin(), candidates_.end(), selected_.begin());
  const float limit = safely(squaredBound);
  std::size_t selected = select(count, limit);
  if (demand_.neighbours > 0 && selected > demand_.neighbours + demand_.neighbours / 4)
  {
    selected = select(selected, safely(enoughWithin(selected, limit)));
  }
  sortSelected(selected);
  for (std::size_t i = 0; i < selected; ++i)
  {
    const std::uint32_t index = sorted_[i];
    list.offer(squaredDistance(set_.positions[index], from), index);
  }
}

/// A bound for squared distances in float with which nothing is lost that is within the bound in
/// double. What is selected too much, the list refuses.
float NeighbourCluster::safely(double squaredBound) const
{
  const double bound = std::sqrt(squaredBound) + floatError * searched_;
  return static_cast<float>(std::min(bound * bound * (1.0 + 1e-6), 3e38));
}

/// Keeps those of the first `count` that are within the limit.
std::size_t NeighbourCluster::select(std::size_t count, float limit)
{
  std::size_t selected = 0;
  for (std::size_t i = 0; i < count; ++i) // without a branch: half of them would be mispredicted
  {
    const float distance = squaredDistances_[i];
    selected_[selected] = selected_[i];
    squaredDistances_[selected] = distance;
    selected += distance <= limit ? 1 : 0;
  }
  return selected;
}

/// A squared distance, at most the limit, within which enough of the first `count` lie: the end of
/// the bin of a histogram that holds the last neighbour.
double NeighbourCluster::enoughWithin(std::size_t count, float limit) const
{
  std::array<std::uint32_t, bins + 1> histogram{};
  const float scale = static_cast<float>(bins) / limit;
  if (!(limit > 0.0f) || !std::isfinite(scale))
  {
    return limit;
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    ++histogram[static_cast<std::size_t>(squaredDistances_[i] * scale)];
  }
  std::uint32_t within = 0;
  for (std::size_t bin = 0; bin < bins; ++bin)
  {
    within += histogram[bin];
    if (within >= demand_.neighbours)
    {
      return static_cast<double>(bin + 1) / static_cast<double>(scale) * (1.0 + 1e-6);
    }
  }
  return limit;
}

/// Nearest first but for rounding, so that hardly an offer has to be moved to its place. Each one's
/// rank is counted: for the thirty there usually are that is faster than a sort, as nothing in it
/// depends on a comparison.
void NeighbourCluster::sortSelected(std::size_t selected)
{
  if (selected > mostRanked)
  {
    std::copy_n(selected_.begin(), selected, sorted_.begin());
    return;
  }
  const float* const distances = squaredDistances_.data();
  for (std::size_t i = 0; i < selected; ++i)
  {
    const float mine = distances[i];
    std::uint32_t rank = 0;
    for (std::size_t other = 0; other < i; ++other)
    {
      rank += distances[other] <= mine ? 1u : 0u;
    }
    for (std::size_t other = i + 1; other < selected; ++other)
    {
      rank += distances[other] < mine ? 1u : 0u;
    }
    sorted_[rank] = selected_[i];
  }
}

/// So far at most, squared, are the neighbours: enough of those of the point before are no farther.
double NeighbourCluster::squaredBound(const glm::dvec3& from) const
{
  if (demand_.neighbours == 0)
  {
    return demand_.radius * demand_.radius;
  }
  double farthest = last_.empty() ? infinity : 0.0;
  for (const std::uint32_t index : last_)
  {
    farthest = std::max(farthest, squaredDistance(set_.positions[index], from));
  }
  return farthest;
}

double NeighbourCluster::squaredDistance(const glm::dvec3& a, const glm::dvec3& b) const
{
  // As the indices do: the same products in the same order.
  const glm::dvec3 d = a - b;
  return demand_.axes > 2 ? d.x * d.x + d.y * d.y + d.z * d.z : d.x * d.x + d.y * d.y;
}

void NeighbourCluster::keepLast(const NeighbourList& list)
{
  last_.clear();
  if (list.full())
  {
    for (const NeighbourList::Entry& entry : list.entries())
    {
      last_.push_back(entry.index);
    }
  }
}

} // namespace pointfront
