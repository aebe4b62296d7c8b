#pragma once

#include "Camera.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace pointfront
{

/// How a hand moves a camera. Each function gives the camera after the movement; z is up in the
/// world.
/// Units  lengths of the world; angles in radians; pixels from the lower left corner of the view.

/// Turns the camera around `pivot`: by `yaw` about the vertical through it, counterclockwise seen
/// from above, and by `pitch` about the picture's horizontal, up. It stops where it looks straight
/// up or down, so that the horizon stays level.
Camera orbited(const Camera& camera, const glm::dvec3& pivot, double yaw, double pitch);
/// Turns the head: as orbited(), about the eye.
Camera turned(const Camera& camera, double yaw, double pitch);
/// Moves the eye so that a point at the depth of `anchor` follows the mouse by that many pixels.
Camera panned(
  const Camera& camera, const glm::dvec3& anchor, const glm::dvec2& pixels, int heightPx);
/// Brings the eye to `factor` times its distance from `anchor`, which stays where it is in the
/// picture.
Camera zoomed(const Camera& camera, const glm::dvec3& anchor, double factor);
/// Moves the eye along its own axes: x to the right, y up in the picture, z forward.
Camera flown(const Camera& camera, const glm::dvec3& way);
/// A parallel view for a perspective one and the other way round: what lies at the focal point
/// keeps its size.
Camera otherProjection(const Camera& camera);

/// World position of a pixel at the depth of `anchor`.
glm::dvec3 underPixel(
  const Camera& camera, const glm::dvec3& anchor, const glm::dvec2& pixel, const glm::ivec2& size);

} // namespace pointfront
