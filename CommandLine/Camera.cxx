#include "Camera.h"

#include "CameraJson.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
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

Axes axesOf(NamedView view)
{
  const glm::dvec3 z(0.0, 0.0, 1.0);
  switch (view)
  {
    case NamedView::Top:
      return { z, { 0.0, 1.0, 0.0 } };
    case NamedView::Front:
      return { { 0.0, -1.0, 0.0 }, z };
    case NamedView::Back:
      return { { 0.0, 1.0, 0.0 }, z };
    case NamedView::Left:
      return { { -1.0, 0.0, 0.0 }, z };
    case NamedView::Right:
      return { { 1.0, 0.0, 0.0 }, z };
    case NamedView::Iso:
      break;
  }
  return { { 1.0, -1.0, 1.0 }, z };
}
} // namespace

glm::dvec3 Camera::direction() const
{
  return glm::normalize(focalPoint - position);
}

std::optional<NamedView> namedView(const std::string& name)
{
  static const std::pair<const char*, NamedView> names[] = { { "iso", NamedView::Iso },
    { "top", NamedView::Top }, { "front", NamedView::Front }, { "back", NamedView::Back },
    { "left", NamedView::Left }, { "right", NamedView::Right } };
  for (const auto& [known, view] : names)
  {
    if (name == known)
    {
      return view;
    }
  }
  return std::nullopt;
}

Camera cameraFitting(const Bounds& bounds, NamedView view, double aspect)
{
  const double margin = 1.04;
  Camera camera;
  const Axes axes = axesOf(view);
  const glm::dvec3 away = -glm::normalize(axes.toEye);
  const glm::dvec3 right = glm::normalize(glm::cross(away, axes.up));
  camera.viewUp = glm::cross(right, away);
  camera.focalPoint = bounds.empty() ? glm::dvec3(0.0) : bounds.centre();
  const double tangentY = std::tan(0.5 * glm::radians(camera.viewAngleDegrees));
  const double tangentX = tangentY * aspect;

  // Each corner asks for the distance at which it just touches the frustum's side.
  const glm::dvec3 half = bounds.empty() ? glm::dvec3(0.5) : 0.5 * bounds.size();
  double distance = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec3 sign(
      corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0);
    const glm::dvec3 c = sign * half;
    const double sideways = margin * std::abs(glm::dot(c, right)) / tangentX;
    const double upwards = margin * std::abs(glm::dot(c, camera.viewUp)) / tangentY;
    distance = std::max(distance, std::max(sideways, upwards) - glm::dot(c, away));
  }
  const double leastDistance = 1.0e-3; // a cloud of one point, or one seen along its only axis
  camera.position = camera.focalPoint - std::max(distance, leastDistance) * away;
  return camera;
}

Result<Camera> readCameraFile(const std::string& path)
{
  const Result<nlohmann::json> json = readJsonFile(path);
  if (!json)
  {
    return json.error();
  }
  return cameraFromJson(json.value(), path);
}

} // namespace pointfront
