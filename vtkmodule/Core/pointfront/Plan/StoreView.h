#pragma once

#include "pointfront/Plan/DetailGrowth.h"
#include "pointfront/Plan/FramePlan.h"
#include "pointfront/Plan/FramePlanner.h"
#include "pointfront/Views/ViewFront.h"

#include <chrono>
#include <cstdint>
#include <memory>

namespace pointfront
{

/// One view of a store from frame to frame: its front, which part of the front it shows, and when
/// its next frame is due. A frame calls update(), plan(), drew(), and took() as soon as it knows
/// its time. Rhythm   a view at rest that is being loaded is drawn a quarter of the time at most.
/// Until its
///          next frame is due, needsFrame() moves the front, so that the front's next requests do
///          not wait for a slow drawing. A due frame stays due until it is drawn.
/// Time     tests may give `now`.
/// Threads  one (the renderer's).
class StoreView
{
public:
  using Clock = std::chrono::steady_clock;

  /// Null until open().
  ViewFront* front() const { return front_.get(); }
  /// Takes the front of a store: the first one, or one of the next version of the store. The first
  /// frame shows everything that it draws at full size.
  void open(std::unique_ptr<ViewFront> front);

  /// Moves the front towards the view; the delta is valid until the next update.
  const FrontDelta& update(FrameRequest request);
  const FrameRequest& request() const { return request_; } ///< the one of the last update()

  /// Plans the drawing of the last update. The caller fills in camera, shading, styles, and the
  /// moment's seconds and duration; this view adds what it knows of its own state. Nothing grows in
  /// a view that waits until it is complete.
  FramePlan plan(const StoreDescription& description, PlanRequest request);
  /// Whether the last plan showed everything that the front draws at full size.
  bool isGrown() const { return growth_.whole(); }

  /// Ends a frame that drew `keptPoints` points beside those of the front.
  void drew(std::uint64_t keptPoints, Clock::time_point now = Clock::now());
  /// Records the time that a frame took for this view alone; see ViewFront::recordFrame().
  void took(std::uint64_t points, std::uint32_t moves, double milliseconds);

  /// Whether a frame is due. `begun`: the renderer began a frame, which moves the front itself.
  bool needsFrame(bool begun = false, Clock::time_point now = Clock::now());
  /// Whether needsFrame() moved the front since the last frame.
  bool isAhead() const { return ahead_; }
  /// Whether another frame would differ from the last one.
  bool hasNews() const { return ahead_ || front_->wantsUpdate() || growth_.growing(); }

private:
  std::unique_ptr<ViewFront> front_;
  DetailGrowth growth_;
  FrameRequest request_;
  Clock::time_point drawnAt_;
  double frameMs_ = 0.0; ///< the time of the last frame
  bool ahead_ = false;
  bool due_ = false; ///< needsFrame() said so, and no frame was drawn since
};

} // namespace pointfront
