#include "LocalHeightPass.h"

#include "LocalMean.h"

#include "pointfront/Neighbourhood/PointColumn.h"

#include <algorithm>
#include <atomic>
#include <cstring>

namespace pointfront
{
namespace
{
constexpr double readShare = 0.25; // twice
constexpr double heightShare = 0.5;
/// A point, its place, its cell, its order, its value.
constexpr std::uint64_t tilePointBytes = sizeof(TilePoint) + 100;

Result<void> writeHeights(
  const PointTiles& tiles, std::size_t tile, double radius, PointColumn& column)
{
  const Result<GatheredPoints> gathered = tiles.gathered(tile);
  if (!gathered)
  {
    return gathered.error();
  }
  std::vector<float> heights;
  LocalMean(gathered->points, radius).heightsAbove(gathered->own, heights);
  std::vector<std::uint32_t> order(gathered->own);
  for (std::uint32_t i = 0; i < order.size(); ++i)
  {
    order[i] = i;
  }
  const std::vector<TilePoint>& points = gathered->points;
  std::sort(order.begin(), order.end(),
    [&](std::uint32_t a, std::uint32_t b) { return points[a].number() < points[b].number(); });
  std::vector<std::uint64_t> numbers;
  std::vector<std::byte> values(order.size() * sizeof(float));
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    numbers.push_back(points[order[i]].number());
    std::memcpy(values.data() + i * sizeof(float), &heights[order[i]], sizeof(float));
  }
  return column.write(numbers, values);
}
} // namespace

double LocalHeightPass::reach() const
{
  return LocalMean::reach(radius_);
}

Result<PointSources> LocalHeightPass::apply(
  PointSources sources, const PassResources& resources) const
{
  const InputOrder order(sources);
  TilingOptions tiling;
  tiling.axes = 2;
  tiling.halo = LocalMean::reach(radius_);
  tiling.tilePoints = tilePoints_;
  WorkCrew reading(threadsOf(resources), resources.progress);
  const auto tiles =
    PointTiles::make(sources, order, tiling, Participants(), resources, reading, readShare);
  auto column = PointColumn::create(resources, order.points(), sizeof(float));
  if (!tiles || !column)
  {
    return tiles ? column.error() : tiles.error();
  }
  const Result<unsigned> threads = (*tiles)->threadsFor(tilePointBytes, resources);
  if (!threads)
  {
    return threads.error();
  }
  WorkCrew crew(*threads, resources.progress);
  crew.beginPhase("local heights", 0, 2 * readShare);
  crew.beginPhase("local heights", order.points(), heightShare);
  std::atomic<std::size_t> next{ 0 };
  const auto work = [&]() -> Result<void>
  {
    for (std::size_t t = next++; t < (*tiles)->count() && !crew.stopped(); t = next++)
    {
      if (Result<void> done = writeHeights(**tiles, t, radius_, **column); !done)
      {
        return done;
      }
      crew.advance((*tiles)->layout().tiles()[t].points);
    }
    return {};
  };
  if (Result<void> done = crew.run(work); !done)
  {
    return done.error();
  }
  return withAttributes(std::move(sources),
    { { "local_height", ScalarType::Float32, 1, 1.0, 0.0,
      "height above the mean of the same class nearby" } },
    valuesOf(std::move(*column), order));
}

} // namespace pointfront
