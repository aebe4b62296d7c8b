#include "BenchCommand.h"

#include "CancelSignal.h"
#include "DrawnFiles.h"
#include "FarOptions.h"
#include "PeakMemory.h"
#include "Percentiles.h"
#include "QualityReport.h"
#include "Settling.h"
#include "Values.h"
#include "WholeFile.h"

#include "pointfront/Base/NearestName.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <sstream>
#include <thread>

namespace pointfront
{

namespace
{
nlohmann::ordered_json percentilesJson(const std::vector<double>& values)
{
  const Percentiles p = percentilesOf(values);
  return { { "p50", p.p50 }, { "p95", p.p95 }, { "p99", p.p99 }, { "max", p.max } };
}

std::int64_t gpuBytesMax(const std::vector<FrameRecord>& frames)
{
  std::int64_t most = 0;
  for (const FrameRecord& frame : frames)
  {
    most = std::max(most, frame.gpuBytes);
  }
  return most;
}

/// `interactive`: frames whose camera moved are drawn as in motion, others as at rest; the first is
/// in motion if the second is. A path that lasts some seconds gives each frame a time before which
/// it does not begin; after a frame that took longer the next one begins at once.
Result<std::vector<FrameRecord>> replay(
  StoreScene& scene, const CameraPath& path, bool interactive, double seconds)
{
  std::vector<FrameRecord> frames;
  frames.reserve(path.size());
  const auto begin = std::chrono::steady_clock::now();
  const std::chrono::duration<double> pace(seconds / static_cast<double>(path.size()));
  for (std::size_t i = 0; i < path.size(); ++i)
  {
    std::this_thread::sleep_until(begin + static_cast<double>(i) * pace);
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
    ->transform(wholeNumber())
    ->check(CLI::Range(1, 1000000))
    ->type_name("N");
  CLI::Option* interactive = app_->add_flag("--interactive", interactive_,
    "While the camera moves the fronts hold the frame time of a moving view");
  app_
    ->add_option("--frame-ms", drawing_.frameMs,
      "--interactive: time that a frame may take (66.7, VTK's for a moving view)")
    ->check(numberBetween(1.0, 10000.0))
    ->type_name("MS")
    ->needs(interactive);
  app_
    ->add_option("--grow-ms", drawing_.growthMs,
      "Time in which detail that comes or goes grows or shrinks; 0: it is there at once (250)")
    ->check(numberBetween(0.0, 10000.0))
    ->type_name("MS");
  app_
    ->add_option("--seconds", seconds_,
      "The path lasts that long: a frame waits for its time (0: frames follow each other at once)")
    ->check(numberBetween(0.0, 86400.0))
    ->type_name("S");
  app_->add_flag("--settle", settles_,
    "After the path: frames at rest until the view is complete; --stats tells what that took");
  app_->add_option("--picture", picturePath_, "Write the last frame")->type_name("FILE.png");
  app_->add_option("--stats", statisticsPath_, "Write the result as JSON")
    ->required()
    ->type_name("FILE.json");
  app_->add_option("--frames-csv", framesPath_, "Write one row a frame")->type_name("FILE");
}

Result<CameraPath> BenchCommand::path(const StoreScene& scene) const
{
  const int defaultFrames = 100;
  const int frames = frames_ > 0 ? frames_ : defaultFrames;
  const Result<double> ground = scene.ground();
  if (!ground)
  {
    return ground.error();
  }
  const PathSubject subject{ scene.bounds(), *ground,
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
  Result<CameraPath> path = readPathFile(path_, frames_);
  return path || path.error().kind != Error::Kind::Unreadable
    ? std::move(path)
    : makeError(Error::Kind::Unreadable,
        path.error().what + didYouMean(path_, { "orbit", "zoom", "flight" }));
}

Result<void> BenchCommand::run()
{
  const CancelSignal signal(CancelSignal::Mode::Leave);
  Result<void> free =
    checkDrawnFiles({ { statisticsPath_, FileKind::Statistics },
                      { framesPath_, FileKind::FrameTable }, { picturePath_, FileKind::Picture } },
      drawing_.stores, { path_ });
  if (!free)
  {
    return free;
  }
  tellQuality(name(), drawing_);
  drawing_.measureEmptyScene = true;
  Result<std::unique_ptr<StoreScene>> scene = StoreScene::open(drawing_);
  if (!scene)
  {
    return scene.error();
  }
  for (const std::string& warning : (*scene)->warnings())
  {
    warn(name(), warning);
  }
  const Result<CameraPath> cameras = path(**scene);
  auto frames = cameras ? replay(**scene, cameras.value(), interactive_, seconds_)
                        : Result<std::vector<FrameRecord>>(cameras.error());
  if (!frames)
  {
    return frames.error();
  }
  nlohmann::ordered_json statistics = benchStatistics(frames.value());
  statistics["backend"] = (*scene)->backend();
  addQuality(statistics, drawing_, frames->empty() ? FrameRecord() : frames->back());
  if (settles_)
  {
    (*scene)->setInteractive(false);
    Settling settling(**scene);
    const auto keep = [&](const FrameRecord& frame) { frames->push_back(frame); };
    if (Result<void> settled = settling.run(**scene, keep); !settled)
    {
      return settled;
    }
    statistics["settle"] = settling.json();
  }
  const LoadingRecord loading = (*scene)->loading();
  statistics["loading"] = { { "bytes_read", loading.fetchedBytes },
    { "bytes_decoded", loading.decodedBytes }, { "read_seconds", loading.fetchSeconds },
    { "decode_cpu_seconds", loading.decodeSeconds } };
  statistics["resident_bytes_max"] = (*scene)->residentBytesMax();
  statistics["gpu_bytes_max"] = gpuBytesMax(frames.value());
  statistics["budget_bytes"] = (*scene)->budgetBytes();
  statistics["gpu_budget_bytes"] = drawing_.gpuBytes;
  statistics["picture_bytes"] = (*scene)->pictureBytes();
  statistics["bytes_read"] = frames->empty() ? 0 : frames->back().bytesRead;
  statistics["empty_scene_rss_bytes"] = (*scene)->emptySceneBytes();
  statistics["peak_rss_bytes"] = peakResidentBytes();
  addTraffic(statistics);
  return write(**scene, statistics.dump(2), frames.value());
}

Result<void> BenchCommand::write(
  StoreScene& scene, const std::string& statistics, const std::vector<FrameRecord>& frames) const
{
  const CancelSignal finishing(CancelSignal::Mode::Finish);
  if (Result<void> written = writeWholeFile(statisticsPath_, statistics + "\n"); !written)
  {
    return written;
  }
  if (!framesPath_.empty())
  {
    if (Result<void> written = writeWholeFile(framesPath_, benchTable(frames)); !written)
    {
      return written;
    }
  }
  if (!picturePath_.empty())
  {
    if (Result<void> written = scene.writePicture(picturePath_); !written)
    {
      return written;
    }
  }
  std::printf("%s: %zu frames\n", statisticsPath_.c_str(), frames.size());
  return {};
}

nlohmann::ordered_json benchStatistics(const std::vector<FrameRecord>& frames)
{
  std::vector<double> milliseconds;
  std::vector<double> frontMilliseconds;
  std::vector<double> rasteriseMilliseconds;
  std::vector<double> points;
  int reading = 0;
  for (const FrameRecord& frame : frames)
  {
    milliseconds.push_back(frame.milliseconds);
    frontMilliseconds.push_back(frame.frontMilliseconds);
    if (frame.rasteriseMilliseconds)
    {
      rasteriseMilliseconds.push_back(*frame.rasteriseMilliseconds);
    }
    points.push_back(static_cast<double>(frame.points));
    // The first frame waits for the roots.
    reading += &frame != &frames.front() && frame.threadReadBytes > 0 ? 1 : 0;
  }
  const Percentiles drawn = percentilesOf(points);
  nlohmann::ordered_json object;
  object["frames"] = frames.size();
  object["frame_ms"] = percentilesJson(milliseconds);
  object["front_update_ms"] = percentilesJson(frontMilliseconds);
  object["rasterise_ms"] = rasteriseMilliseconds.empty() ? nlohmann::ordered_json()
                                                         : percentilesJson(rasteriseMilliseconds);
  object["points_drawn"] = { { "p50", static_cast<std::int64_t>(drawn.p50) },
    { "max", static_cast<std::int64_t>(drawn.max) } };
  object["frames_that_read_files"] = reading;
  return object;
}

std::string benchTable(const std::vector<FrameRecord>& frames)
{
  std::ostringstream table;
  table << "frame,ms,points,front_length,threshold_px,moves,requests,cancelled,resident_bytes,"
           "front_ms,error_px,gpu_bytes,thread_read_bytes,rasterise_ms\n";
  std::uint64_t cancelledBefore = 0;
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    const FrameRecord& frame = frames[i];
    table << i << ',' << frame.milliseconds << ',' << frame.points << ',' << frame.frontLength
          << ',' << frame.thresholdPx << ',' << frame.moves << ',' << frame.requests << ','
          << frame.cancelled - cancelledBefore << ',' << frame.residentBytes << ','
          << frame.frontMilliseconds << ',' << frame.errorPx << ',' << frame.gpuBytes << ','
          << frame.threadReadBytes << ',';
    if (frame.rasteriseMilliseconds)
    {
      table << *frame.rasteriseMilliseconds;
    }
    table << '\n';
    cancelledBefore = frame.cancelled;
  }
  return table.str();
}

} // namespace pointfront
