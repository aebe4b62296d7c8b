#include "CameraPath.h"

#include "CameraJson.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace pointfront
{

namespace
{
constexpr double fullTurn = 6.283185307179586;

/// 0 at the first frame, 1 at the last.
double shareOf(int frame, int frames)
{
  return frames > 1 ? static_cast<double>(frame) / (frames - 1) : 0.0;
}

Camera between(const Camera& a, const Camera& b, double share)
{
  if (a == b)
  {
    return a; // a rest is one to the last bit
  }
  Camera camera;
  camera.position = glm::mix(a.position, b.position, share);
  camera.focalPoint = glm::mix(a.focalPoint, b.focalPoint, share);
  camera.viewUp = glm::mix(a.viewUp, b.viewUp, share);
  camera.viewAngleDegrees = glm::mix(a.viewAngleDegrees, b.viewAngleDegrees, share);
  if (a.parallelScale)
  {
    camera.parallelScale =
      glm::mix(*a.parallelScale, b.parallelScale.value_or(*a.parallelScale), share);
  }
  return camera;
}

CameraPath resampled(const CameraPath& path, int frames)
{
  CameraPath result;
  for (int frame = 0; frame < frames; ++frame)
  {
    const double position = shareOf(frame, frames) * static_cast<double>(path.size() - 1);
    const auto first = static_cast<std::size_t>(position);
    const std::size_t second = std::min(first + 1, path.size() - 1);
    result.push_back(between(path[first], path[second], position - static_cast<double>(first)));
  }
  return result;
}

struct KeyCamera
{
  Camera camera;
  int frames = 1;
};

Result<KeyCamera> keyCameraFromJson(
  const nlohmann::json& entry, const std::string& where, const JSONText& text)
{
  const Result<Camera> camera = cameraFromJson(entry, where, &text);
  if (!camera)
  {
    return camera.error();
  }
  KeyCamera key{ camera.value(), 1 };
  const auto frames = entry.find("frames");
  if (frames != entry.end())
  {
    const bool positive = frames->is_number_unsigned() && frames->get<std::uint64_t>() >= 1 &&
      frames->get<std::uint64_t>() <= 1000000;
    if (!positive)
    {
      return makeError(Error::Kind::BadFormat,
        where + ": " + text.lineOf(*frames) + "\"frames\" must be a count from 1 to 1000000");
    }
    key.frames = frames->get<int>();
  }
  return key;
}
} // namespace

CameraPath orbitPath(const PathSubject& subject, int frames)
{
  Camera start = cameraFitting(subject.bounds, ViewDirection::Iso, subject.aspect);
  const glm::dvec3 arm = start.position - start.focalPoint;
  start.focalPoint = subject.bounds.empty() ? glm::dvec3(0.0) : subject.bounds.centre();
  CameraPath path;
  for (int frame = 0; frame < frames; ++frame)
  {
    const double turn = fullTurn * frame / frames;
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    Camera camera = start;
    camera.position =
      start.focalPoint + glm::dvec3(c * arm.x - s * arm.y, s * arm.x + c * arm.y, arm.z);
    camera.viewUp = glm::dvec3(0.0, 0.0, 1.0);
    path.push_back(camera);
  }
  return path;
}

CameraPath zoomPath(const PathSubject& subject, int frames)
{
  const double nearest = 0.02;
  Camera camera = cameraFitting(subject.bounds, ViewDirection::Iso, subject.aspect);
  const glm::dvec3 arm = camera.position - camera.focalPoint;
  camera.focalPoint = subject.bounds.empty() ? glm::dvec3(0.0) : subject.bounds.centre();
  camera.focalPoint.z = subject.ground;
  CameraPath path;
  for (int frame = 0; frame < frames; ++frame)
  {
    camera.position = camera.focalPoint + std::pow(nearest, shareOf(frame, frames)) * arm;
    path.push_back(camera);
  }
  return path;
}

CameraPath flightPath(const PathSubject& subject, int frames)
{
  const glm::dvec3 size = subject.bounds.empty() ? glm::dvec3(1.0) : subject.bounds.size();
  const int along = size.x >= size.y ? 0 : 1;
  const double length = std::max(size[along], 1.0e-3);
  const double height = 0.05 * length;
  glm::dvec3 ahead(0.0);
  ahead[along] = std::cos(glm::radians(20.0));
  ahead.z = -std::sin(glm::radians(20.0));
  CameraPath path;
  for (int frame = 0; frame < frames; ++frame)
  {
    Camera camera;
    camera.position = subject.bounds.empty() ? glm::dvec3(0.0) : subject.bounds.centre();
    camera.position[along] += (shareOf(frame, frames) - 0.5) * length;
    camera.position.z = subject.ground + height;
    camera.focalPoint = camera.position + length * ahead;
    camera.viewUp = glm::dvec3(0.0, 0.0, 1.0);
    path.push_back(camera);
  }
  return path;
}

Result<CameraPath> readPathFile(const std::string& path, int frames)
{
  const Result<JSONText> json = readJsonFile(path);
  if (!json)
  {
    return json.error();
  }
  const nlohmann::json& list = json->value();
  if (!list.is_array() || list.empty())
  {
    return makeError(Error::Kind::BadFormat, path + ": a camera path is a list of cameras");
  }
  std::vector<KeyCamera> keys;
  for (std::size_t i = 0; i < list.size(); ++i)
  {
    const Result<KeyCamera> key =
      keyCameraFromJson(list[i], path + ": camera " + std::to_string(i), *json);
    if (!key)
    {
      return key.error();
    }
    keys.push_back(key.value());
  }
  CameraPath cameras;
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    const Camera& next = keys[std::min(i + 1, keys.size() - 1)].camera;
    for (int frame = 0; frame < keys[i].frames; ++frame)
    {
      cameras.push_back(between(keys[i].camera, next, static_cast<double>(frame) / keys[i].frames));
    }
  }
  return frames > 0 ? resampled(cameras, frames) : cameras;
}

} // namespace pointfront
