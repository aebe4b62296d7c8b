#pragma once

#include "pointfront/Plan/StoreView.h"
#include "pointfront/Residency/ResidencyShare.h"
#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Style/StyleSheet.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// One store of a scene that is drawn without VTK. It has the store's nodes in memory, the one view
/// of the store, and the style of each layer. Threads  one thread.
class DrawnStore
{
public:
  /// Errors  of the store.
  static Result<std::unique_ptr<DrawnStore>> open(const std::string& path);

  const std::shared_ptr<const StoredCloud>& cloud() const { return cloud_; }
  /// One for each layer of the store. Errors of reading which nodes their filters leave out.
  Result<void> setStyles(std::vector<LayerStyling> layers);
  const std::vector<LayerStyling>& styles() const { return styles_; }
  /// Number of points in the layers that their styles show.
  std::uint64_t pointsShown() const;
  /// From then on it is drawn, beside others of the same window. Styles first.
  void enterWindow(std::shared_ptr<const WindowDemand> window);

  /// Moves the front on; `request` lacks what is the store's own: its columns and layers.
  /// `camera`, `shading`: of the frame; what is seen in lenses only is loaded for these.
  const FrontDelta& update(
    FrameRequest request, const FrameCamera& camera, const FrameShading& shading);
  const FrontDelta& last() const { return view_.front()->last(); }
  /// Plans the drawing of the last update; `moment` says how detail grows in it.
  FramePlan plan(
    const FrameCamera& camera, const FrameShading& shading, const GrowthMoment& moment);
  /// Whether the last plan showed everything that the front draws at full size.
  bool isGrown() const { return view_.isGrown(); }
  /// Ends a frame: it drew so many points of this store, and it took that time for this store
  /// alone.
  void noteFrame(std::uint64_t points, std::uint64_t keptPoints, double milliseconds);

  /// Whether a frame is due, by StoreView's rhythm.
  bool needsFrame() { return view_.needsFrame(); }
  /// Whether another update would differ from the last one.
  bool wantsUpdate() const { return view_.front()->wantsUpdate(); }
  /// Whether nodes are on their way, or wait for the next frame.
  bool loads() const;
  /// The faults since the last call: nodes and rows that could not be read.
  Result<void> outcome();

  const Residency& residency() const { return share_->residency(); }

private:
  DrawnStore() = default;

  std::shared_ptr<const StoredCloud> cloud_;
  std::unique_ptr<ResidencyShare> share_; // before the view, which refers to it
  StoreView view_;
  std::vector<LayerStyling> styles_;
  double tallestWall_ = 0.0; ///< the tallest wall of all styles
  LayerColumns columns_; ///< that the styles read
  std::vector<LayerLimits> limits_; ///< that they set
};

} // namespace pointfront
