#pragma once

#include "CameraPath.h"
#include "Command.h"
#include "DrawingOptions.h"
#include "StoreScene.h"

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

  DrawingOptions drawing_;
  std::string path_ = "orbit";
  std::string statisticsPath_;
  std::string framesPath_;
  int frames_ = 0;
  bool interactive_ = false;
};

/// The keys of `bench --stats`.
std::string benchStatistics(const std::vector<FrameRecord>& frames, std::uint64_t budgetBytes,
  std::uint64_t residentBytesMax);
/// The table of `bench --frames-csv`, with its head line.
std::string benchTable(const std::vector<FrameRecord>& frames);

} // namespace pointfront
