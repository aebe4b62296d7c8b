#pragma once

#include "BuiltStore.h"
#include "SoftwareRasteriser.h"

#include "pointfront/Generate/TerrainSource.h"
#include "pointfront/Plan/DetailGrowth.h"
#include "pointfront/Plan/FramePlanner.h"
#include "pointfront/Residency/ResidencyShare.h"
#include "pointfront/Store/PointStore.h"
#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Style/StyleSheet.h"
#include "pointfront/Views/ViewFront.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <utility>

namespace pointfront::test
{

/// A store on a disk that takes a millisecond for each node and gives no more than those granted:
/// frames see it load, however long they take.
class SlowStore final : public StoredCloud
{
public:
  static constexpr int allNodes = 1 << 30;

  explicit SlowStore(std::shared_ptr<const PointStore> store)
    : store_(std::move(store))
  {
  }
  Result<FetchedNode> fetch(NodeIndex node, const ColumnSelection& columns) const override
  {
    do
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    } while (granted_.load() <= 0);
    --granted_;
    return store_->fetch(node, columns);
  }
  void grant(int nodes)
  {
    if (granted_.load() < allNodes / 2) // or all are granted
    {
      granted_ += nodes;
    }
  }
  /// No node more, until further ones are granted.
  void hold() { granted_ = 0; }
  bool isUsedUp() const { return granted_ <= 0; } ///< all that was granted has been asked for
  Result<NodeColumns> decode(const FetchedNode& fetched) const override
  {
    return store_->decode(fetched);
  }
  std::size_t decodedBytes(
    NodeIndex node, std::uint32_t points, const ColumnSelection& columns) const override
  {
    return store_->decodedBytes(node, points, columns);
  }
  std::size_t storedBytes(NodeIndex node, const ColumnSelection& columns) const override
  {
    return store_->storedBytes(node, columns);
  }
  MissingRows* missingRows() const override { return store_->missingRows(); }
  const StoreDescription& description() const override { return store_->description(); }
  const std::shared_ptr<const Hierarchy>& hierarchy() const override { return store_->hierarchy(); }
  Result<VerifyReport> verify(const ProgressFunction& progress) const override
  {
    return store_->verify(progress);
  }

private:
  std::shared_ptr<const PointStore> store_;
  mutable std::atomic<int> granted_{ 0 };
};

inline std::shared_ptr<const PointStore> openedStore(const std::string& path)
{
  auto store = PointStore::open(path);
  EXPECT_TRUE(store.ok()) << (store.ok() ? "" : store.error().what);
  return store.ok() ? std::move(store).value() : nullptr;
}

/// A view that is at rest while a store is being loaded, frame by frame, as DrawnStore and
/// vtkPointFrontMapper do it: front, plan, rasteriser.
class SlowView
{
public:
  static constexpr int width = 480;
  static constexpr int height = 320;
  static constexpr int usualNodesAFrame = 8;

  SlowView(const std::shared_ptr<const PointStore>& store, const StyleSheet& sheet)
    : store_(store)
    , disk_(std::make_shared<SlowStore>(store))
    , share_(disk_, store->hierarchy()->nodeCount(), ResidencyOptions{ std::size_t(1) << 30, 1 })
    , front_(std::make_shared<HierarchyPiece>(store->hierarchy(), 0, 1), share_,
        store->description().schema, std::make_shared<WindowDemand>())
  {
    const auto layers = sheet.resolveAll(store->description());
    EXPECT_TRUE(layers.ok()) << (layers.ok() ? "" : layers.error().what);
    for (const LayerStyling& layer : *layers)
    {
      request_.styles.emplace_back();
      request_.styles.back().assign(layer.styles.begin(), layer.styles.end());
      frameRequest.columns.layers.push_back(layer.columns());
      LayerLimits limits;
      limits.visible = layer.visible(); // or hidden nodes count as points of the complete view
      limits.errorFactor = layer.errorFactor;
      limits.share = layer.budgetShare;
      frameRequest.layers.push_back(limits);
    }
    request_.shading = sheet.frameShading();
    const Bounds box = store->description().bounds;
    const glm::dvec3 middle = 0.5 * (box.low + box.high);
    const double across = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
    lookAt(middle, across);
  }

  ~SlowView() { disk_->grant(SlowStore::allNodes); } // no read waits for ever
  SlowView(const SlowView&) = delete;
  SlowView& operator=(const SlowView&) = delete;

  /// From the south, from above; about `across` is seen.
  void lookAt(const glm::dvec3& at, double across)
  {
    camera = FrameCamera::perspective(at + across * glm::dvec3(0.1, -0.5, 0.6), at, { 0, 0, 1 },
      0.8, 1e-3 * across, 10.0 * across, width, height);
  }

  /// One frame. `complete`: at one go.
  RasterStatistics frame(bool complete = false)
  {
    planNext(complete);
    target.keepDecided = composited;
    target.reset(width, height);
    return rasteriser_.draw(plan, target);
  }
  /// The plan of the next frame alone.
  void planNext(bool complete = false)
  {
    frameRequest.view = View::fromMatrix(camera.storeToClip(), width, height);
    frameRequest.complete = complete;
    disk_->grant(complete ? SlowStore::allNodes : nodesAFrame);
    front_.update(frameRequest);
    PlanRequest request = request_;
    request.camera = camera;
    request.keepsVisible = leavesOut(front_.last(), frameRequest);
    request.refines = refines;
    request.composited = composited;
    request.growth = growthStep > 0.0 ? &growth_ : nullptr;
    clock_ += growthStep;
    request.moment = { clock_, 0.25, moving, {} };
    plan = planFrame(front_, store_->description(), std::move(request));
  }
  /// Whether no further frame of the view differs.
  bool isComplete() const { return front_.last().complete && growth_.whole(); }
  /// Until something is there that the last frame did not have, or a little while.
  void waitForNews()
  {
    const auto hasNews = [&] { return front_.wantsUpdate() || growth_.growing(); };
    for (int waits = 0; waits < 2000 && !hasNews(); ++waits)
    {
      std::this_thread::sleep_for(std::chrono::microseconds(500));
      if (waits % 16 == 15) // the arrivals were of no use for the picture
      {
        disk_->grant(nodesAFrame);
      }
    }
  }

  int nodesAFrame = usualNodesAFrame; ///< that its disk gives at most
  bool refines = true; ///< as PlanRequest's
  bool composited = false; ///< likewise: it is one of several clouds
  double growthStep = 0.0; ///< seconds from a frame to the next; 0: nothing grows
  bool moving = false; ///< as GrowthMoment's
  FrameRequest frameRequest;
  FrameCamera camera;
  FramePlan plan; ///< plan of the last frame
  SoftwareTarget target;

private:
  std::shared_ptr<const PointStore> store_;
  std::shared_ptr<SlowStore> disk_;
  ResidencyShare share_;
  ViewFront front_;
  DetailGrowth growth_;
  double clock_ = 0.0;
  PlanRequest request_;
  SoftwareRasteriser rasteriser_;
};

} // namespace pointfront::test
