#pragma once

#include "StoreScene.h"

#include <nlohmann/json_fwd.hpp>

#include <chrono>

namespace pointfront
{

/// How a view becomes complete once its camera stands still: frames at rest, each when something
/// new has arrived, as an application draws them that asks vtkPointFrontMapper::NeedsRender().
/// Threads  that of the scene.
class Settling
{
public:
  using Clock = std::chrono::steady_clock;

  /// The camera has just stopped.
  explicit Settling(const StoreScene& scene);
  /// Draws until the view is complete, or nothing more is on its way; `drawn` is called after each
  /// frame.
  template <typename Drawn>
  Result<void> run(StoreScene& scene, const Drawn& drawn)
  {
    while (true)
    {
      const Result<FrameRecord> frame = scene.renderFrame();
      if (!frame)
      {
        return frame.error();
      }
      drawn(*frame);
      note(scene, *frame);
      if (frame->complete || !scene.waitForArrival())
      {
        return {};
      }
    }
  }

  /// `ms`: from the stop to the end of the first complete frame; `loaded_ms`: to the last byte that
  /// it needed, decoded; `drawing_ms`: of `ms`, in frames.
  nlohmann::ordered_json json() const;

private:
  void note(const StoreScene& scene, const FrameRecord& frame);

  Clock::time_point begin_;
  LoadingRecord before_;
  LoadingRecord after_;
  FrameRecord last_;
  double completeMs_ = 0.0;
  double drawingMs_ = 0.0; ///< the part of it that was spent in frames
  int frames_ = 0;
};

} // namespace pointfront
