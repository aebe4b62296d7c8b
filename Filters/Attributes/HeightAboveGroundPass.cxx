#include "HeightAboveGroundPass.h"

#include "GroundSurface.h"
#include "LowestPoints.h"

#include "pointfront/Neighbourhood/PointReading.h"
#include "pointfront/Neighbourhood/TileSearch.h"
#include "pointfront/Points/KnownRegion.h"

#include <algorithm>

namespace pointfront
{
namespace
{
constexpr std::size_t groundClass = 2;
constexpr std::uint32_t groundNeighbours = 12;

Attribute heightAttribute()
{
  return { "height_above_ground", ScalarType::Float32, 1, 1.0, 0.0,
    "height above the ground below the point" };
}

/// Is any point of that class? Reads until it finds one.
Result<bool> hasGround(const PointSources& sources, const InputOrder& order, WorkCrew& crew)
{
  const bool classified = std::any_of(sources.begin(), sources.end(),
    [](const auto& source)
    { return source->description().schema.find("classification").has_value(); });
  if (!classified)
  {
    return false;
  }
  PointReading reading(sources, order, ClassSet().set(groundClass));
  std::atomic<bool> found{ false };
  crew.beginPhase("looking for ground", order.points(), 1.0);
  const auto work = [&]() -> Result<void>
  {
    PointReading::Chunk chunk;
    while (!found && !crew.stopped())
    {
      Result<bool> more = reading.next(chunk);
      if (!more || !*more)
      {
        return more ? Result<void>() : Result<void>(more.error());
      }
      found = found || !chunk.points.empty();
      crew.advance(chunk.read);
    }
    return {};
  };
  if (Result<void> done = crew.run(work); !done)
  {
    return done.error();
  }
  return found.load();
}

/// Lowest points and the tree over them.
struct Ground
{
  explicit Ground(PositionSet set)
    : places(std::move(set))
    , index(places, 2)
  {
  }
  PositionSet places;
  KdIndex index;
};
} // namespace

Result<PointSources> HeightAboveGroundPass::apply(
  PointSources sources, const PassResources& resources) const
{
  const InputOrder order(sources);
  cells_ = 0;
  WorkCrew crew(threadsOf(resources), resources.progress);
  const Result<bool> ground =
    options_.classified ? Result<bool>(*options_.classified) : hasGround(sources, order, crew);
  if (!ground)
  {
    return ground.error();
  }
  if (!*ground)
  {
    return aboveLowest(std::move(sources), resources);
  }
  NeighbourhoodOptions search;
  search.neighbours = groundNeighbours;
  search.axes = 2;
  search.participants.references = ClassSet().set(groundClass);
  search.tilePoints = options_.tilePoints;
  search.phase = "heights above ground";
  auto column = computeFromNeighbours(
    sources, order, search,
    [](const PositionSet& set) { return std::make_unique<KdIndex>(set, 2); }, HeightAboveGround(),
    resources);
  if (!column)
  {
    return column.error();
  }
  return withAttributes(
    std::move(sources), { heightAttribute() }, valuesOf(std::move(*column), order));
}

Result<PointSources> HeightAboveGroundPass::aboveLowest(
  PointSources sources, const PassResources& resources) const
{
  const InputOrder order(sources);
  WorkCrew crew(threadsOf(resources), resources.progress);
  Result<PositionSet> lowest =
    LowestPoints::of(sources, order, options_.cell, memoryOf(resources) / 4, crew);
  if (!lowest)
  {
    return lowest.error();
  }
  cells_ = lowest->positions.size();
  const auto ground = std::make_shared<const Ground>(std::move(*lowest));
  KnownRegion* const known = resources.known;
  const ValueSource heights = [ground, known](const SourceChunk&, const PointBatch& batch,
                                std::byte* values) -> Result<void>
  {
    NeighbourList list(groundNeighbours);
    std::vector<NearPoint> near;
    const HeightAboveGround feature;
    for (std::size_t i = 0; i < batch.size(); ++i)
    {
      near.clear();
      if (hasPlace(batch.positions[i]) && (known == nullptr || known->wants(batch.positions[i])))
      {
        list.begin(ground->places);
        ground->index.search(batch.positions[i], list);
        collectNear(ground->places, list, groundNeighbours, near);
        if (known != nullptr)
        {
          known->note(batch.positions[i], list.full() ? list.bound() : infinity);
        }
      }
      feature.compute(batch.positions[i], near, values + i * sizeof(float));
    }
    return {};
  };
  return withAttributes(std::move(sources), { heightAttribute() }, heights);
}

std::uint64_t HeightAboveGroundPass::heldBytes(const PassResources&) const
{
  return cells_ * LowestPoints::bytesOfCell;
}

std::vector<std::string> HeightAboveGroundPass::findings() const
{
  if (cells_ == 0)
  {
    return {};
  }
  return { "No point is classified as ground (class 2): heights above ground are above the lowest "
           "points of " +
    std::to_string(cells_) + " cells." };
}

} // namespace pointfront
