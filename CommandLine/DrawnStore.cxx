#include "DrawnStore.h"

#include "ShownClasses.h"

#include "pointfront/Residency/LoadScheduler.h"
#include "pointfront/Store/StoredCloudFormats.h"

#include <utility>

namespace pointfront
{

namespace
{
/// From one frame to the next of a view that is being loaded, in times of a frame.
constexpr double pauseOfFrames = 3.0;
} // namespace

Result<std::unique_ptr<DrawnStore>> DrawnStore::open(
  const std::string& path, const std::vector<std::uint8_t>& classes)
{
  Result<std::shared_ptr<const StoredCloud>> cloud = StoredCloudFormats::ofProcess().open(path);
  if (!cloud)
  {
    return cloud.error();
  }
  Result<ShownClasses> shown = ShownClasses::choose(classes, cloud.value()->description());
  if (!shown)
  {
    return shown.error();
  }
  std::unique_ptr<DrawnStore> store(new DrawnStore);
  store->cloud_ = std::move(cloud).value();
  store->share_ = std::make_unique<ResidencyShare>(store->cloud_,
    store->cloud_->hierarchy()->nodeCount(), LoadScheduler::ofProcess(),
    store->cloud_->description().pointCount);
  store->layers_ = std::move(shown->layers);
  store->pointsShown_ = shown->points;
  return store;
}

void DrawnStore::setStyle(std::shared_ptr<const ResolvedStyle> style)
{
  style_ = std::move(style);
}

void DrawnStore::setPointSize(double pixels)
{
  const SplatSize size{ SplatSize::Mode::Pixels, pixels, 0 };
  if (!(style_->size == size))
  {
    auto style = std::make_shared<ResolvedStyle>(*style_);
    style->size = size;
    style_ = std::move(style);
  }
}

void DrawnStore::enterWindow(std::shared_ptr<const WindowDemand> window)
{
  front_ = std::make_unique<ViewFront>(
    std::make_shared<HierarchyPiece>(cloud_->hierarchy(), 0, 1), *share_,
    cloud_->description().schema, std::move(window));
}

const FrontDelta& DrawnStore::update(FrameDemand demand)
{
  demand.columns = style_->columns();
  demand.layers = layers_;
  demand_ = std::move(demand);
  return front_->update(demand_);
}

FramePlan DrawnStore::plan(const FrameCamera& camera, const FrameShading& shading) const
{
  PlanRequest request;
  request.camera = camera;
  request.shading = shading;
  for (const LayerLimits& layer : layers_)
  {
    request.styles.push_back(layer.visible ? style_ : nullptr);
  }
  return planFrame(*front_, cloud_->description(), std::move(request));
}

void DrawnStore::noteFrame(std::uint64_t points, double milliseconds)
{
  front_->recordFrame(points, front_->last().moves, milliseconds);
  frameMs_ = milliseconds;
  drawnAt_ = Clock::now();
  ahead_ = false;
  due_ = false;
}

bool DrawnStore::needsFrame()
{
  if (due_)
  {
    return true;
  }
  const std::chrono::duration<double, std::milli> passed = Clock::now() - drawnAt_;
  const bool pauses =
    !demand_.interacting && !demand_.complete && passed.count() < pauseOfFrames * frameMs_;
  if (pauses && front_->wantsUpdate())
  {
    front_->update(demand_);
    ahead_ = true;
  }
  due_ = (ahead_ || front_->wantsUpdate()) && !(pauses && front_->expectsMore());
  return due_;
}

bool DrawnStore::loads() const
{
  const ResidencyStatistics now = residency().statistics();
  return now.loading > 0 || (now.pending > 0 && !residency().exhausted());
}

Result<void> DrawnStore::outcome()
{
  std::vector<Error> errors = share_->residency().takeErrors();
  const std::vector<Error> faults = cloud_->hierarchy()->takeFaults();
  errors.insert(errors.end(), faults.begin(), faults.end());
  return errors.empty() ? Result<void>() : Result<void>(errors.front());
}

} // namespace pointfront
