#pragma once

#include "pointfront/Plan/FramePlanner.h"
#include "pointfront/Residency/ResidencyShare.h"
#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Style/StyleSheet.h"
#include "pointfront/Views/ViewFront.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// One store of a scene that is drawn without VTK: what is in memory of it, the front of the one
/// view, and how its points look.
/// Threads  one thread.
class DrawnStore
{
public:
  /// Errors  of the store.
  static Result<std::unique_ptr<DrawnStore>> open(const std::string& path);

  const std::shared_ptr<const StoredCloud>& cloud() const { return cloud_; }
  /// One for each layer of the store. Errors of reading which nodes their filters leave out.
  Result<void> setStyles(std::vector<LayerStyling> layers);
  const std::vector<LayerStyling>& styles() const { return styles_; }
  /// Of the layers that their styles show.
  std::uint64_t pointsShown() const;
  /// From then on it is drawn, beside others of the same window. Styles first.
  void enterWindow(std::shared_ptr<const WindowDemand> window);

  /// Moves the front on; `demand` lacks what is the store's own: its columns and layers.
  /// `camera`, `shading`: of the frame; what is seen in lenses only is loaded for these.
  const FrontDelta& update(
    FrameRequest demand, const FrameCamera& camera, const FrameShading& shading);
  const FrontDelta& last() const { return front_->last(); }
  /// What the last update draws; `moment`: how it grows. A view that is to be complete at once does
  /// not.
  FramePlan plan(
    const FrameCamera& camera, const FrameShading& shading, const GrowthMoment& moment);
  /// The last plan had all that its front draws as it will be.
  bool isGrown() const { return growth_.whole(); }
  /// The frame with that plan took so long, of what it has to itself.
  void noteFrame(std::uint64_t points, std::uint64_t keptPoints, double milliseconds);

  /// A frame is due: something is there that the last one did not have. While a view at rest is
  /// being loaded it is drawn a quarter of the time at most; until the next frame is due its front
  /// is moved here, so that what it asks for next does not wait for a drawing.
  bool needsFrame();
  /// Another update would come to something else.
  bool wantsUpdate() const { return front_->wantsUpdate(); }
  /// Something is on its way, or is here and waits for the next frame.
  bool loads() const;
  /// What went wrong since the last call: nodes and rows that could not be read.
  Result<void> outcome();

  const Residency& residency() const { return share_->residency(); }

private:
  using Clock = std::chrono::steady_clock;
  DrawnStore() = default;

  std::shared_ptr<const StoredCloud> cloud_;
  std::unique_ptr<ResidencyShare> share_; // before the front, which refers to it
  std::unique_ptr<ViewFront> front_;
  DetailGrowth growth_;
  std::vector<LayerStyling> styles_;
  double tallestWall_ = 0.0; ///< of the styles
  LayerColumns columns_; ///< that the styles read
  std::vector<LayerLimits> limits_; ///< that they set
  FrameRequest demand_; ///< of the last update
  Clock::time_point drawnAt_; ///< end of the last frame
  double frameMs_ = 0.0; ///< what it took
  bool ahead_ = false; ///< the front was moved since
  bool due_ = true; ///< needsFrame() said so, and no frame was drawn since
};

} // namespace pointfront
