#include "LowestPoints.h"

#include "pointfront/Neighbourhood/PointReading.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace pointfront
{

void LowestPoints::offer(const Key& key, const glm::dvec3& p)
{
  const auto [place, isNew] = lowest_.try_emplace(key, p);
  const glm::dvec3& kept = place->second;
  if (!isNew && (p.z != kept.z ? p.z < kept.z : positionLess(p, kept)))
  {
    place->second = p;
  }
}

void LowestPoints::add(const glm::dvec3& p)
{
  offer({ static_cast<std::int64_t>(std::floor(p.x / cell_)),
          static_cast<std::int64_t>(std::floor(p.y / cell_)) },
    p);
}

void LowestPoints::add(const LowestPoints& other)
{
  for (const auto& [key, p] : other.lowest_)
  {
    offer(key, p);
  }
}

PositionSet LowestPoints::positions() const
{
  std::vector<std::pair<Key, glm::dvec3>> sorted(lowest_.begin(), lowest_.end());
  std::sort(
    sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  PositionSet set;
  for (const auto& [key, p] : sorted)
  {
    set.positions.push_back(p);
    set.counts.push_back(1);
  }
  return set;
}

Result<PositionSet> LowestPoints::of(const PointSources& sources, const InputOrder& order,
  double cell, std::uint64_t memoryBytes, WorkCrew& crew)
{
  PointReading reading(sources, order, ClassSet().set());
  LowestPoints all(cell);
  std::mutex adding;
  const std::uint64_t mostCells = memoryBytes / bytesOfCell / (crew.threads() + 1);
  const auto work = [&]() -> Result<void>
  {
    LowestPoints mine(cell);
    PointReading::Chunk chunk;
    while (!crew.stopped())
    {
      Result<bool> more = reading.next(chunk);
      if (!more)
      {
        return more.error();
      }
      if (!*more)
      {
        break;
      }
      for (const TilePoint& point : chunk.points)
      {
        mine.add(point.position);
      }
      if (mine.size() > mostCells)
      {
        return makeError(Error::Kind::NoMemory,
          "the lowest points of more than " + std::to_string(mostCells) +
            " cells do not fit in the memory limit; choose larger cells for the ground, or "
            "raise the limit");
      }
      crew.advance(chunk.read);
    }
    const std::lock_guard<std::mutex> lock(adding);
    all.add(mine);
    return {};
  };
  crew.beginPhase("ground", order.points(), 1.0);
  if (Result<void> done = crew.run(work); !done)
  {
    return done.error();
  }
  return all.positions();
}

} // namespace pointfront
