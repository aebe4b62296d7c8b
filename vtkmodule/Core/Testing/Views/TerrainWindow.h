// Clouds of a terrain in one window, without a window.

#pragma once

#include "TerrainReader.h"

#include "pointfront/Residency/LoadScheduler.h"
#include "pointfront/Views/ViewFront.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront::test
{

inline View overview()
{
  const double s = Terrain::sizeMetres;
  return View::perspective(
    { 0.5 * s, 0.5 * s, s }, { 0.5 * s, 0.51 * s, 0 }, { 0, 0, 1 }, 0.9, 1.0, 1e7, 800, 600);
}

/// 13.6 million points, all of which the view wants.
inline FrameRequest everything()
{
  FrameRequest request;
  request.view = overview();
  request.targetErrorPx = 0.01;
  return request;
}

/// A cloud in a window whose machine takes the same for each point.
struct TerrainCloud
{
  TerrainCloud(const std::shared_ptr<LoadScheduler>& scheduler,
    const std::shared_ptr<const WindowDemand>& window, std::uint64_t disk = 0)
    : reader(std::make_shared<TerrainReader>(std::make_shared<Traffic>(), disk))
    , share(reader, reader->table->nodeCount(), scheduler, Terrain::pointsOfNode)
    , front(std::make_shared<HierarchyPiece>(reader->table, 0, 1), share, schema, window)
  {
  }
  void frame(const FrameRequest& request)
  {
    const FrontDelta& delta = front.update(request);
    front.recordFrame(
      delta.pointsDrawn, delta.moves, millisecondsPerPoint * double(delta.pointsDrawn));
  }
  std::uint64_t drawn() const { return front.last().pointsDrawn; }

  static constexpr double millisecondsPerPoint = 1e-4;
  std::shared_ptr<TerrainReader> reader;
  AttributeSchema schema;
  ResidencyShare share;
  ViewFront front;
};

struct TerrainWindow
{
  explicit TerrainWindow(int clouds)
  {
    for (int c = 0; c < clouds; ++c)
    {
      all.push_back(std::make_unique<TerrainCloud>(scheduler, demand, std::uint64_t(c)));
    }
    FrameRequest complete = everything();
    complete.complete = true;
    frames(1, complete);
  }
  void frames(int count, const FrameRequest& wanted)
  {
    for (int frame = 0; frame < count; ++frame)
    {
      for (const auto& cloud : all)
      {
        cloud->frame(wanted);
      }
    }
  }
  std::uint64_t drawn() const
  {
    std::uint64_t sum = 0;
    for (const auto& cloud : all)
    {
      sum += cloud->drawn();
    }
    return sum;
  }

  std::shared_ptr<LoadScheduler> scheduler =
    std::make_shared<LoadScheduler>(LoadSchedulerOptions());
  std::shared_ptr<WindowDemand> demand = std::make_shared<WindowDemand>();
  std::vector<std::unique_ptr<TerrainCloud>> all;
};

inline constexpr std::uint64_t wholeTerrain = 13650000;

} // namespace pointfront::test
