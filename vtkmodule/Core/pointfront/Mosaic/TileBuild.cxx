#include "pointfront/Mosaic/TileBuild.h"

#include "pointfront/Neighbourhood/PointTiles.h"
#include "pointfront/Points/KnownRegion.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace pointfront
{
namespace
{
/// A little more than what was measured: what lies exactly there must not fall to rounding.
constexpr double rounding = 1.0 + 1e-6;

double widened(const TileTask& task, double margin, double squaredMissing)
{
  const double wider = std::isfinite(squaredMissing)
    ? std::max(std::sqrt(squaredMissing) * rounding, margin)
    : std::max(4.0 * margin, 0.25 * task.grid.edge);
  return wider >= task.cloudExtent ? infinity : wider;
}

/// Passes in the order they run in: first those that need no other chunk and may change places,
/// then those whose values depend on points nearby.
AttributePasses::const_iterator firstWithReach(const AttributePasses& passes)
{
  return std::find_if(
    passes.begin(), passes.end(), [](const auto& pass) { return pass->reach() > 0.0; });
}

/// One try with a margin.
class TileTry
{
public:
  TileTry(const TileTask& task, double margin, const ProgressFunction& progress)
    : task_(task)
    , margin_(margin)
    , progress_(progress)
    , options_(task.options)
    , region_(task.grid.ownBox(task.tile), task.grid.box(task.tile, margin))
  {
    resources_.memoryBytes = options_.memoryBytes;
    resources_.threads = options_.threads;
    resources_.temporaryFolder = options_.temporaryFolder.empty()
      ? std::filesystem::absolute(options_.outputPath).parent_path().string()
      : options_.temporaryFolder;
    resources_.progress = progress;
    resources_.known = &region_;
  }

  /// Nothing is built if the margin is found too small before.
  Result<BuildReport> run()
  {
    Result<TilePieces> pieces = cut();
    if (!pieces)
    {
      return pieces.error();
    }
    held_ += pieces->heldBytes;
    resources_.memoryBytes -= pieces->heldBytes;
    Result<PointSources> sources =
      apply(std::move(pieces->sources), firstWithReach(*task_.passes), task_.passes->end());
    if (!sources)
    {
      return sources.error();
    }
    if (region_.squaredMissing() > 0.0)
    {
      return BuildReport();
    }
    if (options_.memoryBytes > 0)
    {
      options_.memoryBytes -= std::min(held_, options_.memoryBytes - 1);
    }
    const PointSources own =
      ownPoints(std::move(*sources), std::move(pieces->own), task_.grid, task_.tile);
    Result<BuildReport> report = buildStore(own, options_, progress_);
    return report;
  }
  double squaredMissing() const { return region_.squaredMissing(); }

private:
  Result<TilePieces> cut()
  {
    Result<TileInputs> inputs = task_.inputs(margin_ + task_.rim);
    if (!inputs)
    {
      return inputs.error();
    }
    Result<PointSources> prepared =
      apply(std::move(inputs->sources), task_.passes->begin(), firstWithReach(*task_.passes));
    if (!prepared)
    {
      return prepared.error();
    }
    inputs->sources = std::move(*prepared);
    std::uint64_t points = 0;
    for (std::size_t s = 0; s < inputs->sources.size(); ++s)
    {
      for (const std::uint64_t chunk : inputs->chunks[s])
      {
        points += inputs->sources[s]->chunkPoints(chunk);
      }
    }
    WorkCrew crew(threadsOf(resources_), progress_);
    crew.beginPhase("cutting out", points, 1.0);
    Result<TilePieces> pieces = TilePieces::of(*inputs, task_.grid, task_.tile,
      task_.grid.box(task_.tile, margin_ + task_.rim), resources_, crew);
    return pieces;
  }

  Result<PointSources> apply(PointSources sources, AttributePasses::const_iterator begin,
    AttributePasses::const_iterator end)
  {
    for (auto pass = begin; pass != end; ++pass)
    {
      Result<PointSources> next = (*pass)->apply(std::move(sources), resources_);
      if (!next)
      {
        return next;
      }
      sources = std::move(*next);
      held_ += (*pass)->heldBytes(resources_);
    }
    return sources;
  }

  const TileTask& task_;
  double margin_;
  const ProgressFunction& progress_;
  BuildOptions options_; // memory: what is left
  KnownRegion region_;
  PassResources resources_;
  std::uint64_t held_ = 0;
};
} // namespace

double firstMargin(const AttributePasses& passes, double edge, std::uint64_t points)
{
  constexpr double spacings = 32.0;
  double margin = 0.0;
  for (const std::unique_ptr<AttributePass>& pass : passes)
  {
    const double reach = pass->reach();
    const double spacing =
      edge / std::sqrt(static_cast<double>(std::max<std::uint64_t>(1, points)));
    margin = std::max(margin, std::isfinite(reach) ? reach * rounding : spacings * spacing);
  }
  return std::min(margin, 1e15);
}

Result<TileOutcome> buildTile(const TileTask& task, const ProgressFunction& progress)
{
  TileOutcome outcome;
  outcome.margin = task.margin >= task.cloudExtent && task.margin > 0.0 ? infinity : task.margin;
  for (;;)
  {
    TileTry attempt(task, outcome.margin, progress);
    Result<BuildReport> report = attempt.run();
    if (!report)
    {
      return report.error();
    }
    if (attempt.squaredMissing() == 0.0)
    {
      outcome.report = std::move(*report);
      return outcome;
    }
    outcome.margin = widened(task, outcome.margin, attempt.squaredMissing());
  }
}

} // namespace pointfront
