#include "pointfront/Plan/FrameCamera.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <cmath>

namespace pointfront
{
namespace
{

/// Rotation only: the reference point, and with it the translation, is kept apart.
glm::dmat4 rotationInto(const glm::dvec3& direction, const glm::dvec3& up)
{
  const glm::dvec3 back = -glm::normalize(direction);
  const glm::dvec3 right = glm::normalize(glm::cross(up, back));
  const glm::dvec3 upward = glm::cross(back, right);
  glm::dmat4 rotation(1.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    rotation[axis][0] = right[axis];
    rotation[axis][1] = upward[axis];
    rotation[axis][2] = back[axis];
  }
  return rotation;
}

FrameCamera looking(const glm::dvec3& position, const glm::dvec3& focalPoint, const glm::dvec3& up,
  int width, int height)
{
  FrameCamera camera;
  camera.storeToView = rotationInto(focalPoint - position, up);
  camera.storeToView[3] =
    glm::dvec4(-glm::dvec3(camera.storeToView * glm::dvec4(position, 0.0)), 1.0);
  camera.width = width;
  camera.height = height;
  return camera;
}

} // namespace

FrameCamera FrameCamera::perspective(const glm::dvec3& position, const glm::dvec3& focalPoint,
  const glm::dvec3& up, double verticalAngle, double nearDistance, double farDistance, int width,
  int height)
{
  FrameCamera camera = looking(position, focalPoint, up, width, height);
  const double cotangent = 1.0 / std::tan(0.5 * verticalAngle);
  const double depth = farDistance - nearDistance;
  camera.viewToClip = glm::dmat4(0.0);
  camera.viewToClip[0][0] = cotangent * height / width;
  camera.viewToClip[1][1] = cotangent;
  camera.viewToClip[2][2] = -(farDistance + nearDistance) / depth;
  camera.viewToClip[2][3] = -1.0;
  camera.viewToClip[3][2] = -2.0 * farDistance * nearDistance / depth;
  camera.reference = position;
  return camera;
}

FrameCamera FrameCamera::parallelView(const glm::dvec3& position, const glm::dvec3& focalPoint,
  const glm::dvec3& up, double halfHeight, double nearDistance, double farDistance, int width,
  int height)
{
  FrameCamera camera = looking(position, focalPoint, up, width, height);
  const double depth = farDistance - nearDistance;
  camera.viewToClip = glm::dmat4(1.0);
  camera.viewToClip[0][0] = static_cast<double>(height) / width / halfHeight;
  camera.viewToClip[1][1] = 1.0 / halfHeight;
  camera.viewToClip[2][2] = -2.0 / depth;
  camera.viewToClip[3][2] = -(farDistance + nearDistance) / depth;
  camera.reference = focalPoint;
  camera.referenceInView = { 0.0, 0.0, -glm::length(focalPoint - position) };
  camera.parallel = true;
  return camera;
}

void FrameCamera::setViewport(int viewportWidth, int viewportHeight, const ViewportMargin& around)
{
  // Without margins nothing is computed, so that nothing is rounded.
  if (!(margin.isNone() && around.isNone()))
  {
    const glm::dvec2 drawn(width, height);
    const glm::dvec2 low(margin.left, margin.bottom), high(margin.right, margin.top);
    const glm::dvec2 shown(viewportWidth, viewportHeight);
    const glm::dvec2 newLow(around.left, around.bottom), newHigh(around.right, around.top);
    for (int i = 0; i < 4; ++i)
    {
      glm::dvec4& column = viewToClip[i];
      const glm::dvec2 alone = (glm::dvec2(column) * drawn - column.w * (low - high)) /
        (drawn - low - high); // the column's place without a margin
      const glm::dvec2 wider =
        (alone * shown + column.w * (newLow - newHigh)) / (shown + newLow + newHigh);
      column.x = wider.x;
      column.y = wider.y;
    }
  }
  margin = around;
  width = viewportWidth + around.left + around.right;
  height = viewportHeight + around.bottom + around.top;
}

int FrameCamera::wholeHeight() const
{
  return pictureHeight > 0 ? pictureHeight : height - margin.bottom - margin.top;
}

double FrameCamera::wholeWorldHeight() const
{
  return 2.0 / viewToClip[1][1] * (static_cast<double>(wholeHeight()) / height);
}

} // namespace pointfront
