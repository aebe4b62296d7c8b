#include "Camera.h"

#include "CameraJson.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pointfront
{

namespace
{
struct Axes
{
  glm::dvec3 toEye; ///< from the cloud to the camera, any length
  glm::dvec3 up;
};

Axes axesOf(ViewDirection view)
{
  const glm::dvec3 z(0.0, 0.0, 1.0);
  switch (view)
  {
    case ViewDirection::Top:
      return { z, { 0.0, 1.0, 0.0 } };
    case ViewDirection::Front:
      return { { 0.0, -1.0, 0.0 }, z };
    case ViewDirection::Back:
      return { { 0.0, 1.0, 0.0 }, z };
    case ViewDirection::Left:
      return { { -1.0, 0.0, 0.0 }, z };
    case ViewDirection::Right:
      return { { 1.0, 0.0, 0.0 }, z };
    case ViewDirection::Iso:
      break;
  }
  return { { 1.0, -1.0, 1.0 }, z };
}

/// Along one axis of the picture: the least distance from the box's centre at which the box lies
/// between two planes of the frustum, and where its eye then is.
struct Fit
{
  double distance = 0.0;
  double shift = 0.0; ///< way of the eye along the axis
};

/// A corner at (c, z) is inside if |c - shift| <= tangent (distance + z): near corners push the
/// planes apart more than far ones, so the best shift is not 0.
Fit fit(const glm::dvec3& half, const glm::dvec3& axis, const glm::dvec3& away, double tangent)
{
  double high = -std::numeric_limits<double>::infinity();
  double low = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 8; ++i)
  {
    const glm::dvec3 sign(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0);
    const double along = glm::dot(sign * half, axis);
    const double depth = glm::dot(sign * half, away);
    high = std::max(high, along - tangent * depth);
    low = std::min(low, along + tangent * depth);
  }
  return { (high - low) / (2.0 * tangent), 0.5 * (high + low) };
}

/// A cloud of one place, or one seen along its only axis, sets no distance of the eye. It must be
/// one that doubles tell from the cloud's place, and of which floats have the square.
double leastDistance(const Bounds& bounds)
{
  constexpr double ofOnePlace = 1.0e-3;
  constexpr double ofSmallest = 1.0e-12;
  const double told = std::ldexp(1.0, -44); // times the farthest coordinate: 8 bits of a direction
  if (bounds.empty())
  {
    return ofOnePlace;
  }
  const glm::dvec3 size = bounds.size();
  const glm::dvec3 reach = glm::max(glm::abs(bounds.low), glm::abs(bounds.high));
  return std::max({ told * std::max({ reach.x, reach.y, reach.z }), ofSmallest,
    size == glm::dvec3(0.0) ? ofOnePlace : 0.0 });
}
} // namespace

glm::dvec3 Camera::direction() const
{
  return glm::normalize(focalPoint - position);
}

std::optional<ViewDirection> namedView(const std::string& name)
{
  static const std::pair<const char*, ViewDirection> names[] = { { "iso", ViewDirection::Iso },
    { "top", ViewDirection::Top }, { "front", ViewDirection::Front },
    { "back", ViewDirection::Back }, { "left", ViewDirection::Left },
    { "right", ViewDirection::Right } };
  for (const auto& [known, view] : names)
  {
    if (name == known)
    {
      return view;
    }
  }
  return std::nullopt;
}

Camera cameraFitting(const Bounds& bounds, ViewDirection view, double aspect)
{
  const double margin = 1.04;
  Camera camera;
  const Axes axes = axesOf(view);
  const glm::dvec3 away = -glm::normalize(axes.toEye);
  const glm::dvec3 right = glm::normalize(glm::cross(away, axes.up));
  camera.viewUp = glm::cross(right, away);
  const double tangent = std::tan(0.5 * glm::radians(camera.viewAngleDegrees)) / margin;
  const glm::dvec3 half = bounds.empty() ? glm::dvec3(0.5) : 0.5 * bounds.size();
  const Fit sideways = fit(half, right, away, tangent * aspect);
  const Fit upwards = fit(half, camera.viewUp, away, tangent);
  const double distance = std::max({ sideways.distance, upwards.distance, leastDistance(bounds) });
  camera.focalPoint = bounds.empty() ? glm::dvec3(0.0) : bounds.centre();
  camera.focalPoint += sideways.shift * right + upwards.shift * camera.viewUp;
  camera.position = camera.focalPoint - distance * away;
  return camera;
}

Result<Camera> readCameraFile(const std::string& path)
{
  const Result<JSONText> json = readJsonFile(path);
  if (!json)
  {
    return json.error();
  }
  return cameraFromJson(json->value(), path, &*json);
}

} // namespace pointfront
