#pragma once

#include "pointfront/Neighbourhood/InputOrder.h"
#include "pointfront/Neighbourhood/KdIndex.h"
#include "pointfront/Threads/WorkCrew.h"

#include <cstdint>
#include <unordered_map>
#include <utility>

namespace pointfront
{

/// The lowest point of each square cell of a horizontal grid aligned to the world's origin; of
/// points at the same height the first by positionLess(). The order of the points plays no part.
/// Threads  one each; several are added up.
class LowestPoints
{
public:
  explicit LowestPoints(double cell)
    : cell_(cell)
  {
  }
  void add(const glm::dvec3& p);
  void add(const LowestPoints& other);
  std::size_t size() const { return lowest_.size(); } ///< cells
  static constexpr std::uint64_t bytesOfCell = 200; ///< with the index that is made of it
  PositionSet positions() const; ///< by cell

  /// Finds them for all sources, by all threads of the crew. Error NoMemory when there are more
  /// cells than fit in `memoryBytes`.
  static Result<PositionSet> of(const PointSources& sources, const InputOrder& order, double cell,
    std::uint64_t memoryBytes, WorkCrew& crew);

private:
  using Key = std::pair<std::int64_t, std::int64_t>;
  struct Hash
  {
    std::size_t operator()(const Key& key) const
    {
      const std::uint64_t mixed = static_cast<std::uint64_t>(key.first) * 0x9e3779b97f4a7c15ull ^
        static_cast<std::uint64_t>(key.second);
      return static_cast<std::size_t>((mixed ^ mixed >> 31) * 0xbf58476d1ce4e5b9ull);
    }
  };
  void offer(const Key& key, const glm::dvec3& p);

  double cell_;
  std::unordered_map<Key, glm::dvec3, Hash> lowest_;
};

} // namespace pointfront
