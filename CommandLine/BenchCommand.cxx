#include "BenchCommand.h"

#include "CancelSignal.h"
#include "Percentiles.h"
#include "WholeFile.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <sstream>

namespace pointfront
{

namespace
{
nlohmann::ordered_json percentilesJson(const std::vector<double>& values)
{
  const Percentiles p = percentilesOf(values);
  return { { "p50", p.p50 }, { "p95", p.p95 }, { "p99", p.p99 }, { "max", p.max } };
}

/// `interactive`: frames whose camera moved are drawn as in motion, others as at rest; the first is
/// in motion if the second is.
Result<std::vector<FrameRecord>> replay(
  StoreScene& scene, const CameraPath& path, bool interactive)
{
  std::vector<FrameRecord> frames;
  frames.reserve(path.size());
  for (std::size_t i = 0; i < path.size(); ++i)
  {
    const Camera& camera = path[i];
    const Camera& other = i > 0 ? path[i - 1] : path[std::min<std::size_t>(1, path.size() - 1)];
    scene.setInteractive(interactive && !(camera == other));
    scene.setCamera(camera);
    const Result<FrameRecord> frame = scene.renderFrame();
    if (!frame)
    {
      return frame.error();
    }
    frames.push_back(frame.value());
  }
  return frames;
}
} // namespace

void BenchCommand::declare(CLI::App& program)
{
  app_ = program.add_subcommand("bench", "Replay a camera path offscreen and measure the frames");
  drawing_.declare(*app_);
  app_->add_option("--path", path_, "orbit, zoom, flight, or a file with a list of cameras (orbit)")
    ->type_name("PATH");
  app_->add_option("--frames", frames_, "Frames (100; of a file: as many as it says)")
    ->check(CLI::Range(1, 1000000))
    ->type_name("N");
  app_->add_flag("--interactive", interactive_,
    "While the camera moves the fronts hold VTK's frame time for a moving view");
  app_->add_option("--stats", statisticsPath_, "Write the result as JSON")
    ->required()
    ->type_name("FILE.json");
  app_->add_option("--frames-csv", framesPath_, "Write one row a frame")->type_name("FILE");
}

Result<CameraPath> BenchCommand::path(const StoreScene& scene) const
{
  const int defaultFrames = 100;
  const int frames = frames_ > 0 ? frames_ : defaultFrames;
  const PathSubject subject{ scene.bounds(), scene.ground(),
    static_cast<double>(drawing_.size[0]) / drawing_.size[1] };
  if (path_ == "orbit")
  {
    return orbitPath(subject, frames);
  }
  if (path_ == "zoom")
  {
    return zoomPath(subject, frames);
  }
  if (path_ == "flight")
  {
    return flightPath(subject, frames);
  }
  return readPathFile(path_, frames_);
}

Result<void> BenchCommand::run()
{
  const CancelSignal signal(CancelSignal::Mode::Leave);
  for (const std::string& file : { statisticsPath_, framesPath_ })
  {
    if (Result<void> writable = file.empty() ? Result<void>() : checkWritable(file); !writable)
    {
      return writable;
    }
  }
  Result<std::unique_ptr<StoreScene>> scene = StoreScene::open(drawing_);
  if (!scene)
  {
    return scene.error();
  }
  const Result<CameraPath> cameras = path(**scene);
  if (!cameras)
  {
    return cameras.error();
  }
  const Result<std::vector<FrameRecord>> frames =
    replay(**scene, cameras.value(), interactive_);
  if (!frames)
  {
    return frames.error();
  }
  const CancelSignal finishing(CancelSignal::Mode::Finish);
  const std::string statistics =
    benchStatistics(frames.value(), (*scene)->budgetBytes(), (*scene)->residentBytesMax());
  if (Result<void> written = writeWholeFile(statisticsPath_, statistics + "\n"); !written)
  {
    return written;
  }
  if (!framesPath_.empty())
  {
    if (Result<void> written = writeWholeFile(framesPath_, benchTable(frames.value())); !written)
    {
      return written;
    }
  }
  std::printf("%s: %zu frames\n", statisticsPath_.c_str(), frames->size());
  return {};
}

std::string benchStatistics(const std::vector<FrameRecord>& frames, std::uint64_t budgetBytes,
  std::uint64_t residentBytesMax)
{
  std::vector<double> milliseconds;
  std::vector<double> frontMilliseconds;
  std::vector<double> points;
  std::int64_t gpuBytes = 0;
  std::uint64_t bytesRead = 0;
  for (const FrameRecord& frame : frames)
  {
    milliseconds.push_back(frame.milliseconds);
    frontMilliseconds.push_back(frame.frontMilliseconds);
    points.push_back(static_cast<double>(frame.points));
    gpuBytes = std::max(gpuBytes, frame.gpuBytes);
    bytesRead = std::max(bytesRead, frame.bytesRead);
  }
  const Percentiles drawn = percentilesOf(points);
  nlohmann::ordered_json object;
  object["frames"] = frames.size();
  object["frame_ms"] = percentilesJson(milliseconds);
  object["front_update_ms"] = percentilesJson(frontMilliseconds);
  object["points_drawn"] = { { "p50", static_cast<std::int64_t>(drawn.p50) },
    { "max", static_cast<std::int64_t>(drawn.max) } };
  object["resident_bytes_max"] = residentBytesMax;
  object["gpu_bytes_max"] = gpuBytes;
  object["budget_bytes"] = budgetBytes;
  object["bytes_read"] = bytesRead;
  return object.dump(2);
}

std::string benchTable(const std::vector<FrameRecord>& frames)
{
  std::ostringstream table;
  table << "frame,ms,points,front_length,threshold_px,moves,requests,cancelled,resident_bytes,"
           "front_ms,error_px\n";
  std::uint64_t cancelledBefore = 0;
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    const FrameRecord& frame = frames[i];
    table << i << ',' << frame.milliseconds << ',' << frame.points << ',' << frame.frontLength
          << ',' << frame.thresholdPx << ',' << frame.moves << ',' << frame.requests << ','
          << frame.cancelled - cancelledBefore << ',' << frame.residentBytes << ','
          << frame.frontMilliseconds << ',' << frame.errorPx << '\n';
    cancelledBefore = frame.cancelled;
  }
  return table.str();
}

} // namespace pointfront
