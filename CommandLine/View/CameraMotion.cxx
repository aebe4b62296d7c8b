#include "CameraMotion.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace pointfront
{

namespace
{
const glm::dvec3 vertical(0.0, 0.0, 1.0);

/// The picture's axes in the world, unit.
struct Axes
{
  glm::dvec3 right;
  glm::dvec3 up;
  glm::dvec3 forward;
};

Axes axesOf(const Camera& camera)
{
  const glm::dvec3 forward = camera.direction();
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.viewUp));
  return { right, glm::cross(right, forward), forward };
}

/// Length of the world that a pixel shows at the depth of `anchor`.
double pixelLength(const Camera& camera, const glm::dvec3& anchor, int heightPx)
{
  if (camera.parallelScale)
  {
    return 2.0 * *camera.parallelScale / heightPx;
  }
  const double depth = std::abs(glm::dot(anchor - camera.position, camera.direction()));
  return 2.0 * depth * std::tan(0.5 * glm::radians(camera.viewAngleDegrees)) / heightPx;
}

Camera shifted(Camera camera, const glm::dvec3& by)
{
  camera.position += by;
  camera.focalPoint += by;
  return camera;
}

/// How far the camera looks up, from -pi/2 to pi/2.
double elevation(const Camera& camera)
{
  return std::asin(std::clamp(camera.direction().z, -1.0, 1.0));
}
} // namespace

Camera orbited(const Camera& camera, const glm::dvec3& pivot, double yaw, double pitch)
{
  const Axes axes = axesOf(camera);
  const double now = elevation(camera);
  const double steepest = glm::half_pi<double>();
  // A camera whose top is down would turn the other way before it is straight.
  const double up = axes.up.z < 0.0 ? -1.0 : 1.0;
  const double bounded = up * (std::clamp(now + up * pitch, -steepest, steepest) - now);
  const glm::dquat turn = glm::angleAxis(yaw, vertical) * glm::angleAxis(bounded, axes.right);
  Camera moved = camera;
  moved.position = pivot + turn * (camera.position - pivot);
  moved.focalPoint = pivot + turn * (camera.focalPoint - pivot);
  moved.viewUp = glm::normalize(turn * axes.up);
  return moved;
}

Camera turned(const Camera& camera, double yaw, double pitch)
{
  return orbited(camera, camera.position, yaw, pitch);
}

Camera panned(
  const Camera& camera, const glm::dvec3& anchor, const glm::dvec2& pixels, int heightPx)
{
  const Axes axes = axesOf(camera);
  const double length = pixelLength(camera, anchor, heightPx);
  return shifted(camera, -length * (pixels.x * axes.right + pixels.y * axes.up));
}

Camera zoomed(const Camera& camera, const glm::dvec3& anchor, double factor)
{
  if (!camera.parallelScale)
  {
    Camera moved = camera;
    moved.position = anchor + factor * (camera.position - anchor);
    moved.focalPoint = anchor + factor * (camera.focalPoint - anchor);
    return moved;
  }
  const Axes axes = axesOf(camera);
  const glm::dvec3 aside = anchor - camera.position;
  Camera moved = shifted(camera,
    (1.0 - factor) *
      (glm::dot(aside, axes.right) * axes.right + glm::dot(aside, axes.up) * axes.up));
  moved.parallelScale = factor * *camera.parallelScale;
  return moved;
}

Camera flown(const Camera& camera, const glm::dvec3& way)
{
  const Axes axes = axesOf(camera);
  return shifted(camera, way.x * axes.right + way.y * axes.up + way.z * axes.forward);
}

Camera otherProjection(const Camera& camera)
{
  Camera other = camera;
  const double tangent = std::tan(0.5 * glm::radians(camera.viewAngleDegrees));
  const glm::dvec3 sight = camera.focalPoint - camera.position;
  if (camera.parallelScale)
  {
    other.parallelScale.reset();
    other.position = camera.focalPoint - glm::normalize(sight) * (*camera.parallelScale / tangent);
    return other;
  }
  other.parallelScale = glm::length(sight) * tangent;
  return other;
}

glm::dvec3 underPixel(
  const Camera& camera, const glm::dvec3& anchor, const glm::dvec2& pixel, const glm::ivec2& size)
{
  const Axes axes = axesOf(camera);
  const double depth = glm::dot(anchor - camera.position, axes.forward);
  const double length = pixelLength(camera, anchor, size.y);
  const glm::dvec2 fromMiddle = pixel + 0.5 - 0.5 * glm::dvec2(size);
  return camera.position + depth * axes.forward +
    length * (fromMiddle.x * axes.right + fromMiddle.y * axes.up);
}

} // namespace pointfront
