#include "Frustum.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace pointfront
{

namespace
{
constexpr double smallestNear = 0.001; // share of the farthest distance
constexpr double roundingRoom = 0.01;
constexpr double depthRoom = 0.5; // share of the box's depth, before and behind it
constexpr double thinnest = 0.2; // depth, of half the height of the picture where the box ends
} // namespace

std::array<double, 2> clippingRange(const Camera& camera, const Bounds& bounds)
{
  const glm::dvec3 sight = glm::normalize(camera.focalPoint - camera.position);
  const glm::dvec3 toMiddle = 0.5 * (bounds.low + bounds.high) - camera.position;
  const double middle = glm::dot(toMiddle, sight);
  const double half = glm::dot(0.5 * (bounds.high - bounds.low), glm::abs(sight));
  double nearest = middle - half;
  double farthest = std::max(middle + half, 1e-18);
  // A plane seen from above has no depth.
  const double gap = camera.parallelScale
    ? 0.5 * thinnest * *camera.parallelScale
    : thinnest * std::tan(0.5 * glm::radians(camera.viewAngleDegrees)) * farthest;
  const double missing = std::max(0.0, gap - (farthest - nearest));
  nearest = std::max(0.0, nearest - 0.5 * missing);
  farthest += 0.5 * missing;
  const double room = depthRoom * (farthest - nearest);
  farthest += roundingRoom * farthest + room;
  nearest -= roundingRoom * nearest + room;
  return { std::max(nearest, smallestNear * farthest), farthest };
}

FrameCamera frameCameraOf(const Camera& camera, const Bounds& bounds, int width, int height)
{
  const std::array<double, 2> range = clippingRange(camera, bounds);
  return camera.parallelScale
    ? FrameCamera::parallelView(camera.position, camera.focalPoint, camera.viewUp,
        *camera.parallelScale, range[0], range[1], width, height)
    : FrameCamera::perspective(camera.position, camera.focalPoint, camera.viewUp,
        glm::radians(camera.viewAngleDegrees), range[0], range[1], width, height);
}

View viewOf(const FrameCamera& camera)
{
  return View::fromMatrix(camera.storeToClip(), camera.width, camera.height);
}

View viewOfRows(const FrameCamera& camera, int bottom, int top)
{
  const double rows = top - bottom;
  const double scale = camera.height / rows;
  const double middle = (bottom + top) / static_cast<double>(camera.height) - 1.0;
  glm::dmat4 toRows(1.0); // clip y of the rows goes from -w to w
  toRows[1][1] = scale;
  toRows[3][1] = -middle * scale;
  return View::fromMatrix(toRows * camera.storeToClip(), camera.width, top - bottom);
}

} // namespace pointfront
