#include "StreamCommand.h"

#include "CameraJson.h"
#include "CancelSignal.h"
#include "ColourLegend.h"
#include "PickedPoint.h"
#include "StoreCompany.h"
#include "Values.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <set>
#include <thread>

namespace pointfront
{

namespace
{
using Clock = std::chrono::steady_clock;

constexpr int largestEdge = 8192; // a screen; more would be a mistake of the asking program
constexpr std::size_t longestRequest = 65536; // bytes; a camera has some 300
constexpr std::chrono::milliseconds pause{ 2 }; // between two looks at what has arrived
constexpr int pickReach = 6; // pixels: points that are one pixel large are hard to meet
const char* const requestName = "request";

Error badRequest(const std::string& what)
{
  return makeError(Error::Kind::BadFormat, std::string(requestName) + ": " + what);
}

/// The next line of stdin; false when there is none.
Result<bool> readRequest(std::string& line)
{
  line.clear();
  std::streambuf& input = *std::cin.rdbuf();
  for (int c = input.sbumpc(); c != '\n'; c = input.sbumpc())
  {
    if (c == std::char_traits<char>::eof())
    {
      return !line.empty();
    }
    if (line.size() == longestRequest)
    {
      return badRequest(
        "a line must not be longer than " + std::to_string(longestRequest) + " bytes");
    }
    line += static_cast<char>(c);
  }
  return true;
}

/// Keys that nobody knows would be ignored: whoever misspelt one would never learn why.
Result<void> checkKeys(const nlohmann::json& request)
{
  const std::set<std::string> known{ "camera", "legend", "moving", "pick", "size", "view",
    "wait_ms" };
  for (const auto& [key, value] : request.items())
  {
    if (known.count(key) == 0)
    {
      return badRequest("there is no key \"" + key +
        "\"; there are camera, legend, moving, pick, size, view and wait_ms");
    }
    if ((key == "legend" || key == "moving") && !value.is_boolean())
    {
      return badRequest("\"" + key + "\" must be true or false");
    }
    if (key == "wait_ms" && !(value.is_number() && value.get<double>() >= 0.0))
    {
      return badRequest("\"wait_ms\" must be a number, 0 or more");
    }
  }
  return {};
}

nlohmann::ordered_json boundsJson(const Bounds& bounds)
{
  if (bounds.empty())
  {
    return nullptr;
  }
  const glm::dvec3 low = bounds.centre() - 0.5 * bounds.size();
  const glm::dvec3 high = low + bounds.size();
  return { low.x, low.y, low.z, high.x, high.y, high.z };
}
} // namespace

void StreamCommand::declare(CLI::App& program)
{
  app_ = program.add_subcommand("stream",
    "Draw frames for another program: requests on stdin, "
    "pixels on stdout");
  drawing_.declare(*app_);
  app_
    ->add_option("--frame-ms", drawing_.frameMs,
      "Time that a frame in motion may take (66.7, VTK's for a moving view)")
    ->check(numberBetween(1.0, 10000.0))
    ->type_name("MS");
}

Result<void> StreamCommand::resize(const nlohmann::json& request)
{
  const auto size = request.find("size");
  if (size == request.end())
  {
    return {};
  }
  std::array<int, 2> edges{};
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    const bool right =
      size->is_array() && size->size() == edges.size() && (*size)[i].is_number_integer();
    const std::int64_t edge = right ? (*size)[i].get<std::int64_t>() : 0;
    if (edge < 1 || edge > largestEdge)
    {
      return badRequest("\"size\" must be two numbers from 1 to " + std::to_string(largestEdge));
    }
    edges[i] = static_cast<int>(edge);
  }
  if (edges == drawing_.size)
  {
    return {};
  }
  drawing_.size = edges;
  return scene_->resize(edges);
}

Result<void> StreamCommand::move(const nlohmann::json& request)
{
  const auto camera = request.find("camera");
  const auto view = request.find("view");
  if (camera != request.end())
  {
    Result<Camera> given = cameraFromJson(*camera, requestName);
    if (!given)
    {
      return given.error();
    }
    camera_ = *given;
  }
  else if (view != request.end())
  {
    const auto direction = view->is_string() ? namedView(view->get<std::string>()) : std::nullopt;
    if (!direction)
    {
      return badRequest("\"view\" must be iso, top, front, back, left or right");
    }
    const double aspect = static_cast<double>(drawing_.size[0]) / drawing_.size[1];
    camera_ = cameraFitting(scene_->bounds(), *direction, aspect);
  }
  scene_->setCamera(camera_);
  scene_->setInteractive(request.value("moving", false));
  return {};
}

bool StreamCommand::waitForNews(double waitMs)
{
  const auto begin = Clock::now();
  while (true)
  {
    const bool loads = scene_->loads(); // asked first: what arrives in between needs a frame
    if (scene_->needsFrame())
    {
      return true;
    }
    const std::chrono::duration<double, std::milli> waited = Clock::now() - begin;
    if (waited.count() >= waitMs || !loads)
    {
      settled_ = !loads;
      return false;
    }
    std::this_thread::sleep_for(pause);
  }
}

/// Null where nothing is seen.
Result<nlohmann::ordered_json> StreamCommand::pick(const nlohmann::json& place)
{
  if (!place.is_array() || place.size() != 2 || !place[0].is_number() || !place[1].is_number())
  {
    return badRequest("\"pick\" must be two numbers: a column and a row of the picture");
  }
  const auto within = [](double number, int edge)
  { return static_cast<int>(std::clamp(std::floor(number), -1.0, static_cast<double>(edge))); };
  const int column = within(place[0].get<double>(), drawing_.size[0]);
  const int row = within(place[1].get<double>(), drawing_.size[1]);
  const auto seen = scene_->pick({ column, drawing_.size[1] - 1 - row }, pickReach);
  if (!seen)
  {
    return seen.error();
  }
  if (!*seen)
  {
    return nlohmann::ordered_json();
  }
  const auto point = readPoint(*scene_->store((**seen).store).cloud(), (**seen).id);
  if (!point)
  {
    return point.error();
  }
  const glm::dvec3& at = point->position;
  return nlohmann::ordered_json{ { "store", point->store }, { "id", point->id },
    { "position", { at.x, at.y, at.z } }, { "attributes", point->attributes } };
}

/// The legend of the first store, and there of the first class that is drawn.
nlohmann::ordered_json StreamCommand::legend() const
{
  const DrawnStore& store = scene_->store(0);
  for (const LayerStyling& layer : store.styles())
  {
    if (layer.visible())
    {
      return colourLegend(store.cloud()->description(), *layer.styles.front());
    }
  }
  return nullptr;
}

Result<void> StreamCommand::answer(const FrameRecord* frame, const nlohmann::ordered_json& further)
{
  const SoftwareTarget& picture = scene_->picture();
  const auto rowBytes = static_cast<std::size_t>(picture.width) * sizeof(std::uint32_t);
  nlohmann::ordered_json head;
  head["bytes"] = 0;
  if (frame != nullptr)
  {
    head["bytes"] = rowBytes * static_cast<std::size_t>(picture.height);
    head["width"] = picture.width;
    head["height"] = picture.height;
    head["complete"] = frame->complete;
    head["milliseconds"] = frame->milliseconds;
    head["points"] = frame->points;
    head["error_px"] = frame->errorPx;
    head["failed_nodes"] = frame->failedNodes;
  }
  // At rest, and nothing to come: a view may end short of its error where a budget holds it.
  head["settled"] = frame != nullptr ? frame->complete : settled_;
  head["camera"] = jsonOf(camera_);
  head["bounds"] = boundsJson(scene_->bounds());
  head.update(further);
  // A path may be any bytes.
  const std::string line =
    head.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  bool written = std::fwrite(line.data(), 1, line.size(), stdout) == line.size();
  for (int y = picture.height - 1; frame != nullptr && written && y >= 0; --y)
  {
    const std::uint32_t* const row =
      picture.rgba.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width);
    written = std::fwrite(row, 1, rowBytes, stdout) == rowBytes;
  }
  if (!written || std::fflush(stdout) != 0)
  {
    return makeError(Error::Kind::Unwritable, "stdout: the frame cannot be written");
  }
  return {};
}

Result<void> StreamCommand::obey(const std::string& line)
{
  const nlohmann::json request = nlohmann::json::parse(line, nullptr, false);
  if (!request.is_object())
  {
    return badRequest("a line must be a JSON object");
  }
  if (Result<void> known = checkKeys(request); !known)
  {
    return known;
  }
  for (const auto step : { &StreamCommand::resize, &StreamCommand::move })
  {
    if (Result<void> done = (this->*step)(request); !done)
    {
      return done;
    }
  }
  nlohmann::ordered_json further = nlohmann::ordered_json::object();
  if (request.value("legend", false))
  {
    further["legend"] = legend();
  }
  if (const auto place = request.find("pick"); place != request.end())
  {
    const Result<nlohmann::ordered_json> picked = pick(*place);
    if (!picked)
    {
      return picked.error();
    }
    further["picked"] = *picked;
    return answer(nullptr, further);
  }
  const Shown asked{ camera_, drawing_.size, request.value("moving", false) };
  if (const auto wait = request.find("wait_ms");
      wait != request.end() && shown_ == asked && !waitForNews(wait->get<double>()))
  {
    return answer(nullptr, further);
  }
  shown_ = asked;
  const Result<FrameRecord> frame = scene_->renderFrame();
  return frame ? answer(&*frame, further) : frame.error();
}

Result<void> StreamCommand::run()
{
  const CancelSignal signal(CancelSignal::Mode::Leave);
  if (drawing_.backend == DrawingBackend::OpenGL)
  {
    return makeError(Error::Kind::Unsupported, "frames are drawn in software: leave --backend out");
  }
  for (const std::string& doubt : doubtsOfCompany(drawing_.stores))
  {
    warn(name(), doubt);
  }
  Result<std::unique_ptr<SoftwareScene>> scene = SoftwareScene::open(drawing_);
  if (!scene)
  {
    return scene.error();
  }
  scene_ = std::move(scene).value();
  for (const std::string& warning : scene_->warnings())
  {
    warn(name(), warning);
  }
  const double aspect = static_cast<double>(drawing_.size[0]) / drawing_.size[1];
  camera_ = cameraFitting(scene_->bounds(), ViewDirection::Iso, aspect);
  for (std::string line; true;)
  {
    const Result<bool> more = readRequest(line);
    if (!more || !*more)
    {
      return more ? Result<void>() : Result<void>(more.error());
    }
    if (Result<void> done = obey(line); !done)
    {
      return done;
    }
  }
}

} // namespace pointfront
