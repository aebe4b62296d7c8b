#include "RenderCommand.h"

#include "CancelSignal.h"
#include "DrawnFiles.h"
#include "FarOptions.h"
#include "KnownWords.h"
#include "PeakMemory.h"
#include "QualityReport.h"
#include "StoreCompany.h"
#include "Values.h"
#include "WholeFile.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace pointfront
{

namespace
{
std::string checkPng(std::string& path)
{
  const std::string::size_type dot = path.rfind('.');
  const std::string extension = dot == std::string::npos ? "" : path.substr(dot);
  return extension == ".png" || extension == ".PNG" ? "" : "'" + path + "' must end in .png";
}
} // namespace

void RenderCommand::declare(CLI::App& program)
{
  app_ = program.add_subcommand("render", "Draw a picture of stores, offscreen");
  drawing_.declare(*app_);
  drawing_.growthMs = 0.0; // a still shows all that is there, however fast its frames were drawn
  app_->add_option("-o,--output", outputPath_, "The picture; replaced if it is there")
    ->required()
    ->check(CLI::Validator(checkPng, "OUT.png"));
  CLI::Option* const view =
    app_->add_option("--view", view_, "Where from, showing all (iso)")
      ->check(knownWords({ "iso", "top", "front", "back", "left", "right" }));
  app_->add_option("--camera", cameraPath_, "Camera file")->type_name("FILE.json")->excludes(view);
  CLI::Option* const complete = app_->add_flag(
    "--complete", "Wait for all that the error and the budgets allow (this is the default)");
  app_->add_option("--frames", frames_, "Instead: what a user sees after N frames")
    ->transform(wholeNumber())
    ->check(CLI::Range(1, 1000000))
    ->type_name("N")
    ->excludes(complete);
  app_->add_option("--stats", statisticsPath_, "Write what was done as JSON")
    ->type_name("FILE.json");
}

Result<Camera> RenderCommand::camera(const StoreScene& scene) const
{
  if (!cameraPath_.empty())
  {
    return readCameraFile(cameraPath_);
  }
  const double aspect = static_cast<double>(drawing_.size[0]) / drawing_.size[1];
  return cameraFitting(scene.bounds(), *namedView(view_), aspect);
}

void RenderCommand::note(const FrameRecord& frame)
{
  const std::chrono::duration<double, std::milli> now = Clock::now() - begin_;
  if (!firstImageMs_ && frame.points > 0)
  {
    firstImageMs_ = now.count();
  }
  if (!completeMs_ && frame.complete)
  {
    completeMs_ = now.count();
  }
}

Result<FrameRecord> RenderCommand::drawFrames(StoreScene& scene)
{
  Result<FrameRecord> frame = scene.renderFrame();
  for (int i = 1; i < frames_ && frame; ++i)
  {
    note(*frame);
    frame = scene.renderFrame();
  }
  return frame;
}

Result<FrameRecord> RenderCommand::drawComplete(StoreScene& scene)
{
  // First the frame that a user sees first, for the time it takes; then all the rest.
  Result<FrameRecord> frame = scene.renderFrame();
  while (frame && frame->points == 0 && scene.waitForArrival())
  {
    frame = scene.renderFrame();
  }
  if (!frame)
  {
    return frame;
  }
  note(*frame);
  return scene.renderComplete();
}

Result<FrameRecord> RenderCommand::draw(StoreScene& scene)
{
  const bool inBands = frames_ == 0 && scene.needsBands();
  Result<FrameRecord> frame = frames_ > 0 ? drawFrames(scene)
    : inBands                             ? scene.renderInBands(outputPath_)
                                          : drawComplete(scene);
  if (frame)
  {
    note(*frame);
    written_ = inBands;
  }
  return frame;
}

/// Says why the last frame is incomplete; one without a point is no picture of a cloud.
Result<void> RenderCommand::judge(const FrameRecord& last) const
{
  if (frames_ == 0 && last.complete && !last.showsPoints)
  {
    return last.points == 0 && last.limitedByGpu ? noNodeOnGpu() : noPointShown();
  }
  if (frames_ == 0 && !last.complete)
  {
    return makeError(Error::Kind::NoMemory,
      "not all points of the picture could be loaded, and it is not written: memory is short; "
      "close other programs, raise the limit, or ask for less (--memory, --size)");
  }
  std::string raise;
  const auto add = [&raise](bool limited, const char* option)
  { raise += limited ? (raise.empty() ? "" : " and ") + std::string(option) : ""; };
  add(last.limitedByMemory, "--memory");
  add(last.limitedByGpu, "--gpu-memory");
  add(last.limitedByPoints, "--point-budget");
  if (frames_ == 0 && !raise.empty())
  {
    const std::string lacks =
      last.leftOut.empty() ? "" : ", and lacks " + leftOutText(last.leftOut);
    warn(name(), "the picture is coarser than --error asks" + lacks + "; raise " + raise);
  }
  if (frames_ == 0 && limitedByDetail(last))
  {
    char text[256];
    std::snprintf(text, sizeof text,
      "the picture is coarser than --error asks (%.3g px): --detail view gives its pixels a point "
      "each on average; use --detail front",
      last.errorPx);
    warn(name(), text);
  }
  if (frames_ == 0 && last.failedNodes > 0)
  {
    warn(name(), std::to_string(last.failedNodes) + " nodes could not be read: points are missing");
  }
  return {};
}

/// View-specific detail counts points and pixels of the whole picture: where points lie close
/// together, the others are farther apart than --error asks.
bool RenderCommand::limitedByDetail(const FrameRecord& last) const
{
  return drawing_.detail == "view" && last.errorPx > drawing_.errorPx;
}

Result<void> RenderCommand::run()
{
  const CancelSignal signal(CancelSignal::Mode::Leave);
  begin_ = Clock::now();
  Result<void> free = checkDrawnFiles(
    { { outputPath_, FileKind::Picture }, { statisticsPath_, FileKind::Statistics } },
    drawing_.stores, { cameraPath_ });
  if (!free)
  {
    return free;
  }
  for (const std::string& doubt : doubtsOfCompany(drawing_.stores))
  {
    warn(name(), doubt);
  }
  tellQuality(name(), drawing_);
  Result<std::unique_ptr<StoreScene>> scene = StoreScene::open(drawing_);
  if (!scene)
  {
    return scene.error();
  }
  for (const std::string& warning : (*scene)->warnings())
  {
    warn(name(), warning);
  }
  const Result<Camera> from = camera(**scene);
  if (!from)
  {
    return from.error();
  }
  (*scene)->setCamera(from.value());
  const Result<FrameRecord> last = draw(**scene);
  if (!last)
  {
    return last.error();
  }
  if (Result<void> told = judge(*last); !told)
  {
    return told;
  }
  // From here on there are files to finish: a signal is seen when they are whole.
  const CancelSignal finishing(CancelSignal::Mode::Finish);
  if (Result<void> written = written_ ? Result<void>() : (*scene)->writePicture(outputPath_);
      !written)
  {
    return written;
  }
  if (!statisticsPath_.empty())
  {
    if (Result<void> written = writeWholeFile(statisticsPath_, statistics(**scene, *last) + "\n");
        !written)
    {
      return written;
    }
  }
  std::printf("%s: %lld points in %lld nodes\n", outputPath_.c_str(),
    static_cast<long long>(last->points), static_cast<long long>(last->nodes));
  return {};
}

std::string RenderCommand::statistics(const StoreScene& scene, const FrameRecord& last) const
{
  const auto orNull = [](const std::optional<double>& ms)
  { return ms ? nlohmann::ordered_json(*ms) : nlohmann::ordered_json(); };
  nlohmann::ordered_json object;
  object["backend"] = scene.backend();
  object["complete"] = last.complete;
  object["time_to_first_image_ms"] = orNull(firstImageMs_);
  object["time_to_complete_ms"] = orNull(completeMs_);
  object["points_drawn"] = last.points;
  object["nodes_drawn"] = last.nodes;
  object["classes"] = nlohmann::ordered_json::array();
  for (const auto& [code, points] : last.classPoints)
  {
    object["classes"].push_back({ { "class", code }, { "points_drawn", points },
      { "budget_share", *drawing_.style.styleOf(code).budgetShare } });
  }
  object["error_px"] = last.errorPx;
  addQuality(object, drawing_, last);
  object["limited_by"] = nlohmann::ordered_json::array();
  if (last.limitedByPoints)
  {
    object["limited_by"].push_back("points");
  }
  if (last.limitedByGpu)
  {
    object["limited_by"].push_back("gpu-memory");
  }
  if (last.limitedByMemory)
  {
    object["limited_by"].push_back("memory");
  }
  if (limitedByDetail(last))
  {
    object["limited_by"].push_back("detail");
  }
  object["left_out"] = last.leftOut;
  object["failed_nodes"] = last.failedNodes;
  object["peak_rss_bytes"] = peakResidentBytes();
  object["resident_bytes"] = last.residentBytes;
  object["gpu_bytes"] = last.gpuBytes;
  object["picture_bytes"] = scene.pictureBytes();
  object["bytes_read"] = last.bytesRead;
  object["attributes_read"] = scene.attributesRead();
  addTraffic(object);
  return object.dump(2);
}

} // namespace pointfront
