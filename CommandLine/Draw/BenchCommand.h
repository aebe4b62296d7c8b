#pragma once

#include "CameraPath.h"
#include "Command.h"
#include "DrawingOptions.h"
#include "StoreScene.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace pointfront
{

/// `pointfront bench`: replays a camera path offscreen and measures each frame.
class BenchCommand final : public Command
{
public:
  void declare(CLI::App& program) override;
  Result<void> run() override;

private:
  Result<CameraPath> path(const StoreScene& scene) const;
  Result<void> write(
    StoreScene& scene, const std::string& statistics, const std::vector<FrameRecord>& frames) const;

  DrawingOptions drawing_;
  std::string path_ = "orbit";
  std::string statisticsPath_;
  std::string framesPath_;
  std::string picturePath_;
  int frames_ = 0;
  double seconds_ = 0.0;
  bool interactive_ = false;
  bool settles_ = false;
};

/// The keys of `bench --stats` that come from the frames of the path.
nlohmann::ordered_json benchStatistics(const std::vector<FrameRecord>& frames);
/// The table of `bench --frames-csv`, with its head line.
std::string benchTable(const std::vector<FrameRecord>& frames);

} // namespace pointfront
