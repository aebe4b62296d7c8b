#pragma once

#include "pointfront/Residency/ResidencyShare.h"
#include "pointfront/Views/ExpectedNodes.h"
#include "pointfront/Views/HierarchyPiece.h"
#include "pointfront/Views/OtherPieces.h"
#include "pointfront/Views/SteadyPoints.h"
#include "pointfront/Views/WindowDemand.h"

#include "pointfront/Front/DetailSelection.h"
#include "pointfront/Front/View.h"
#include "pointfront/Front/ViewMargin.h"
#include "pointfront/Points/AttributeSchema.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace pointfront
{

/// How the detail of a view is chosen.
enum class DetailMethod
{
  RenderingFront, ///< RenderFront
  ViewSpecific ///< ViewDetail
};

/// A frame of one view asks its front for this.
struct FrameRequest
{
  DetailMethod method = DetailMethod::RenderingFront;
  std::uint64_t overviewPoints = 0; ///< ViewSpecific: this store's share of the overview
  View view; ///< in the store's coordinates
  LayerColumns columns; ///< that the points are drawn with
  double targetErrorPx = 1.0;
  std::uint64_t pointBudget = 0; ///< 0: no limit; over all clouds of the window
  std::int64_t gpuBytes = 0; ///< likewise, of GPU memory
  int gpuStreams = 1; ///< that a point has there beside its position (GpuStreams.h)
  bool interacting = false;
  double frameMs = 0.0; ///< interacting: that a frame may take, with all clouds of the window
  double cloudMs = 0.0; ///< where frameMs is 0: that this cloud may take
  bool complete = false; ///< wait until nothing is missing
  /// Asked some times a second while a complete frame waits: true ends the wait, and the frame
  /// shows what is there. May be empty.
  std::function<bool()> aborted;
  std::vector<LayerLimits> layers; ///< by number of the store's layer (LAYERS-11)
};

/// The front of one view of a store, with its share of the residency. Several views of one cloud
/// have one of these each.
/// Guarantees  update() waits for the disk only when the request is `complete`, and on the first
///             update for the roots (one node a layer), so that no first frame is empty unless the
///             disk hangs: half a second at most, and all new clouds of a window together a second
///             (RootWait). A complete update that is aborted is not complete, and can be repeated.
/// Threads     one thread (the renderer's).
class ViewFront
{
public:
  /// `schema` outlives the front: the store's. `window`: all clouds that are drawn in the same one.
  ViewFront(std::shared_ptr<const HierarchyPiece> piece, ResidencyShare& share,
    const AttributeSchema& schema, std::shared_ptr<const WindowDemand> window);
  ~ViewFront();

  /// Moves the front towards the view. The delta is valid until the next update.
  const FrontDelta& update(const FrameRequest& request);
  const FrontDelta& last() const { return delta_; }

  /// The nodes that other processes draw of the last update's view beside this piece; empty for a
  /// whole hierarchy, and with DetailMethod::ViewSpecific, whose pieces choose levels of their own.
  const std::vector<OtherPieces::Drawn>& drawnElsewhere() const;

  /// The nodes of the complete view, while a view at rest is being loaded and as long as it rests;
  /// null: it is in motion, was complete from the first, or they are not known. Not known are those
  /// of pieces of a hierarchy.
  const ExpectedNodes* expected() const { return expected_.get(); }

  /// Tells that nobody sees the view until the next update. Its part of all shared budgets goes to
  /// the others; its loaded nodes stay as long as nobody wants the memory.
  void leave();

  /// Moves the view to a window: it is drawn among the clouds with that demand.
  void enterWindow(std::shared_ptr<const WindowDemand> window);

  /// The part of a window's budget of points (0: no limit) that this view may have on the GPU: the
  /// points that it draws, and its part of those that nobody draws.
  std::uint64_t pointsOnGpu(std::uint64_t windowBudget) const;

  /// The refinement of the store's tree.
  Refinement refinement() const { return piece_->hierarchy()->refinement(); }

  /// The node's points, or null.
  std::shared_ptr<const NodeColumns> find(NodeIndex node) const;

  /// Tells the window's cost the time that an earlier frame took for this cloud (CPU + GPU), and
  /// what the frame drew.
  void recordFrame(std::uint64_t points, std::uint32_t moves, double milliseconds)
  {
    window_->window->cost->record(this, window_->points.claims(),
      { points, beside_, moves, milliseconds, fillPx_, viewportPx_ });
  }

  /// Tells how many points the last frame drew beside the front's: they may take two fifths of a
  /// frame's time. The count for recordFrame() includes them.
  void drewBeside(std::uint64_t points) { beside_ = points; }

  /// Tells how much the splats of the next frame fill (FramePlan::fillPx), of how large a viewport.
  void fills(double pixels, double viewportPixels)
  {
    fillPx_ = pixels;
    viewportPx_ = viewportPixels;
  }

  /// True if nodes arrived since the last update, if that update left moves for the next one, or if
  /// other clouds took or left memory since.
  bool wantsUpdate() const;
  /// True while nodes that the last update misses are being read or wait to be read.
  bool expectsMore() const;

private:
  static constexpr std::uint32_t mostRequests = 1024; ///< at once

  void choose(DetailMethod method);
  void step(const FrameRequest& request);
  void expect(const FrameRequest& request);
  void addMargin(const FrameRequest& request);
  bool marginGoesOn() const;
  bool allCovered() const;
  void noteColumns(const FrameRequest& request);
  bool isSettled() const;
  std::size_t largestPoint(const LayerColumns& columns) const;
  bool movedOn() const;
  void complete(const FrameRequest& request);
  bool waitForNews(const FrameRequest& request);
  void loadRoots();
  void setLimits(const FrameRequest& request);
  std::uint64_t sharedRevision() const { return memory_.revision() + window_->revision(); }
  void readShares(const FrameRequest& request);
  void tellDemand(const FrameRequest& request);

  std::shared_ptr<const HierarchyPiece> piece_;
  ResidencyShare& share_;
  const AttributeSchema& schema_;
  std::unique_ptr<ResidencyShare::Wish> wish_;
  DetailMethod method_ = DetailMethod::RenderingFront;
  std::unique_ptr<DetailSelection> selection_;
  std::unique_ptr<OtherPieces> others_; ///< null for a whole hierarchy
  std::unique_ptr<ExpectedNodes> expected_;
  ViewMargin margin_;
  std::uint32_t marginWalks_ = 0; ///< at rest, of the present delta
  std::uint64_t beside_ = 0;
  double fillPx_ = 0.0;
  double viewportPx_ = 0.0;
  FrontDelta delta_;
  FrontLimits limits_;
  SteadyPoints motionPoints_; ///< for frames in motion whose time is limited
  View motionView_; ///< the last view of these
  double motionMs_ = 0.0; ///< that it was allowed; 0: the last frame was none of these
  // Claims on budgets that this view shares with others: memory (in bytes), and the window's.
  SharedDemand::Claim memory_;
  std::unique_ptr<WindowClaims> window_;
  DemandCurves elsewhere_; ///< in points of this store and slots
  std::uint64_t sharedSeen_ = 0;
  std::uint64_t pointBudgetSeen_ = 0;
  std::int64_t gpuBytesSeen_ = 0;
  std::uint64_t told_ = 0; ///< number of the delta that was told and asked for; 0: none
  LayerColumns columns_;
  std::size_t pointBytes_ = 0; ///< size of a decoded point with columns_
  std::uint64_t arrivalsSeen_ = 0;
  std::uint64_t rowsSeen_ = 0; ///< arrivals of the table's rows
  double thresholdBefore_ = 0.0;
  bool begun_ = false;
  bool covered_ = false; ///< all nodes that delta_ draws have all of columns_
};

} // namespace pointfront
