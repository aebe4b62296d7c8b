#include "DrawnStore.h"

#include "pointfront/Plan/LensWindows.h"
#include "pointfront/Residency/LoadScheduler.h"
#include "pointfront/Style/FilterPruning.h"
#include "pointfront/Tiles/StoredCloudFormats.h"
#include "pointfront/Views/SplatReach.h"
#include "pointfront/Views/WallReach.h"

#include <algorithm>
#include <utility>

namespace pointfront
{

Result<std::unique_ptr<DrawnStore>> DrawnStore::open(const std::string& path)
{
  Result<std::shared_ptr<const StoredCloud>> cloud = StoredCloudFormats::ofProcess().open(path);
  if (!cloud)
  {
    return cloud.error();
  }
  std::unique_ptr<DrawnStore> store(new DrawnStore);
  store->cloud_ = std::move(cloud).value();
  store->share_ =
    std::make_unique<ResidencyShare>(store->cloud_, store->cloud_->hierarchy()->nodeCount(),
      LoadScheduler::ofProcess(), store->cloud_->description().pointCount);
  return store;
}

Result<void> DrawnStore::setStyles(std::vector<LayerStyling> layers)
{
  const auto pruning = pruningOf(*cloud_, layers);
  if (!pruning)
  {
    return pruning.error();
  }
  styles_ = std::move(layers);
  tallestWall_ = tallestWall(cloud_->description(), styles_);
  columns_ = {};
  limits_.clear();
  for (const LayerStyling& layer : styles_)
  {
    LayerLimits limits;
    limits.visible = layer.visible();
    limits.errorFactor = layer.errorFactor;
    limits.share = layer.budgetShare;
    limits.pruning = (*pruning)[limits_.size()];
    limits_.push_back(limits);
    columns_.layers.push_back(layer.columns());
  }
  return {};
}

std::uint64_t DrawnStore::pointsShown() const
{
  std::uint64_t points = 0;
  const std::vector<Layer>& layers = cloud_->description().layers;
  for (std::size_t i = 0; i < layers.size(); ++i)
  {
    points += styles_[i].visible() ? layers[i].pointCount : 0;
  }
  return points;
}

void DrawnStore::enterWindow(std::shared_ptr<const WindowDemand> window)
{
  view_.open(
    std::make_unique<ViewFront>(std::make_shared<HierarchyPiece>(cloud_->hierarchy(), 0, 1),
      *share_, cloud_->description().schema, std::move(window)));
}

const FrontDelta& DrawnStore::update(
  FrameRequest request, const FrameCamera& camera, const FrameShading& shading)
{
  request.columns = columns_;
  request.layers = limits_;
  limitToLenses(styles_, shading, camera, std::max(request.targetErrorPx, last().thresholdPx),
    tallestWall_, request.layers);
  request.view =
    withSplatsFromAside(withWallsFromAbove(request.view, tallestWall_), largestSplat(styles_));
  return view_.update(std::move(request));
}

FramePlan DrawnStore::plan(
  const FrameCamera& camera, const FrameShading& shading, const GrowthMoment& moment)
{
  PlanRequest request;
  request.camera = camera;
  request.shading = shading;
  request.refines = true;
  request.moment = moment;
  for (const LayerStyling& layer : styles_)
  {
    request.styles.emplace_back();
    request.styles.back().assign(layer.styles.begin(), layer.styles.end());
  }
  return view_.plan(cloud_->description(), std::move(request));
}

void DrawnStore::noteFrame(std::uint64_t points, std::uint64_t keptPoints, double milliseconds)
{
  view_.drew(keptPoints);
  view_.took(points + keptPoints, last().moves, milliseconds);
}

bool DrawnStore::loads() const
{
  const ResidencyStatistics now = residency().statistics();
  // Nodes that have arrived and wait for the end of a pause are not in the picture either.
  return now.loading > 0 || (now.pending > 0 && !residency().exhausted()) || view_.hasNews();
}

Result<void> DrawnStore::outcome()
{
  std::vector<Error> errors = share_->residency().takeErrors();
  const std::vector<Error> faults = cloud_->hierarchy()->takeFaults();
  errors.insert(errors.end(), faults.begin(), faults.end());
  return errors.empty() ? Result<void>() : Result<void>(errors.front());
}

} // namespace pointfront
