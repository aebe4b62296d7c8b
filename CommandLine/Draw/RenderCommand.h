#pragma once

#include "Command.h"
#include "DrawingOptions.h"
#include "StoreScene.h"

#include <chrono>
#include <optional>
#include <string>

namespace pointfront
{

/// `pointfront render`: a picture of stores, offscreen.
class RenderCommand final : public Command
{
public:
  void declare(CLI::App& program) override;
  Result<void> run() override;

private:
  using Clock = std::chrono::steady_clock;

  Result<Camera> camera(const StoreScene& scene) const;
  /// The frames that were asked for; notes the times. A picture in bands is written as well.
  Result<FrameRecord> draw(StoreScene& scene);
  Result<FrameRecord> drawComplete(StoreScene& scene);
  Result<FrameRecord> drawFrames(StoreScene& scene);
  void note(const FrameRecord& frame);
  Result<void> judge(const FrameRecord& last) const;
  bool limitedByDetail(const FrameRecord& last) const;
  std::string statistics(const StoreScene& scene, const FrameRecord& last) const;

  DrawingOptions drawing_;
  std::string outputPath_;
  std::string view_ = "iso";
  std::string cameraPath_;
  std::string statisticsPath_;
  int frames_ = 0; ///< 0: complete
  bool written_ = false; ///< the picture is
  Clock::time_point begin_;
  std::optional<double> firstImageMs_; ///< since begin_: the first frame with a point in it
  std::optional<double> completeMs_;
};

} // namespace pointfront
