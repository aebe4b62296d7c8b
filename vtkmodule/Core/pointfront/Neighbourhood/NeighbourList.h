#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace pointfront
{

/// The places of points, each once, with the number of points there (counted up to the number of
/// wanted neighbours). So duplicates cost nothing in a search.
struct PositionSet
{
  std::vector<glm::dvec3> positions;
  std::vector<std::uint32_t> counts;
  void clear()
  {
    positions.clear();
    counts.clear();
  }
};

/// Order of places at the same distance, so that the choice among them does not depend on the order
/// in which a search meets them.
inline bool positionLess(const glm::dvec3& a, const glm::dvec3& b)
{
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

/// The nearest places that a search has found so far, nearest first, ties by positionLess().
/// Holds the fewest places that have `wanted` points together; the last one may have more.
/// Threads  one a thread; begin() keeps the memory.
class NeighbourList
{
public:
  struct Entry
  {
    double squaredDistance = 0.0;
    std::uint32_t index = 0; ///< into the set
    std::uint32_t count = 0; ///< points there
  };

  /// `wanted` points, or 0: all within the radius given to begin().
  explicit NeighbourList(std::uint32_t wanted)
    : wanted_(wanted)
  {
  }

  void begin(
    const PositionSet& among, double squaredRadius = std::numeric_limits<double>::infinity())
  {
    among_ = &among;
    entries_.clear();
    total_ = 0;
    bound_ = squaredRadius;
  }

  /// Squared distances above this need not be offered. Larger than the last entry's by more than
  /// rounding, so that a search that prunes with it does not lose ties.
  double bound() const { return bound_; }
  bool full() const { return wanted_ > 0 && total_ >= wanted_; }
  const std::vector<Entry>& entries() const { return entries_; }

  void offer(double squaredDistance, std::uint32_t index)
  {
    if (squaredDistance > bound_)
    {
      return;
    }
    const Entry entry{ squaredDistance, index, among_->counts[index] };
    if (wanted_ == 0)
    {
      entries_.push_back(entry);
      return;
    }
    if (full() && !less(entry, entries_.back()))
    {
      return;
    }
    entries_.push_back(entry);
    std::size_t at = entries_.size() - 1;
    for (; at > 0 && less(entry, entries_[at - 1]); --at)
    {
      entries_[at] = entries_[at - 1];
    }
    entries_[at] = entry;
    total_ += entry.count;
    while (total_ - entries_.back().count >= wanted_)
    {
      total_ -= entries_.back().count;
      entries_.pop_back();
    }
    if (full())
    {
      bound_ = boundOf(entries_.back().squaredDistance);
    }
  }

  /// In the place of all that was offered: places nearest first, each once. Keeps the fewest that
  /// have `wanted` points together, of those within the bound.
  void assign(const std::vector<Entry>& sorted)
  {
    entries_.clear();
    total_ = 0;
    for (const Entry& entry : sorted)
    {
      if (entry.squaredDistance > bound_ || full())
      {
        break;
      }
      entries_.push_back(entry);
      total_ += entry.count;
    }
    if (full())
    {
      bound_ = boundOf(entries_.back().squaredDistance);
    }
  }

  bool less(const Entry& a, const Entry& b) const
  {
    return a.squaredDistance != b.squaredDistance
      ? a.squaredDistance < b.squaredDistance
      : positionLess(among_->positions[a.index], among_->positions[b.index]);
  }

private:
  static double boundOf(double squaredDistance)
  {
    return squaredDistance * (1.0 + 1e-12) + std::numeric_limits<double>::min();
  }

  std::uint32_t wanted_;
  std::uint64_t total_ = 0;
  double bound_ = 0.0;
  const PositionSet* among_ = nullptr;
  std::vector<Entry> entries_;
};

/// A search structure over a set of places.
/// Threads  search() from any thread.
class NeighbourIndex
{
public:
  virtual ~NeighbourIndex() = default;
  /// Offers to `list` at least the places that are nearer than its bound (in an approximate search:
  /// most of them). The list has begun on the set of this index.
  virtual void search(const glm::dvec3& from, NeighbourList& list) const = 0;
};

} // namespace pointfront
