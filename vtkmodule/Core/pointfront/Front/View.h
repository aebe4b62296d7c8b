#pragma once

#include "pointfront/Base/Bounds.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>

namespace pointfront
{

/// A camera and a viewport, in double, as the front sees them. A snapshot: copy it freely.
/// Units  world units; pixels of the render target.
struct View
{
  glm::dvec3 position{ 0.0 };  ///< of the eye; for a parallel view, a point on the near side
  glm::dvec3 direction{ 0.0, 0.0, -1.0 }; ///< unit, away from the eye
  bool parallel = false;
  /// perspective: pixels that one world unit covers at distance 1; parallel: at any distance
  double pixelsPerUnit = 1.0;
  double nearDistance = 0.1;   ///< along `direction`, > 0
  int width = 1;               ///< of the viewport, pixels
  int height = 1;
  /// Left, right, bottom, top, near, far: (n, d) with n unit length and n.p + d >= 0 inside.
  std::array<glm::dvec4, 6> planes{};

  /// From a world-to-clip matrix (column vectors, clip z in [-w, w], any off-axis frustum) and the
  /// viewport. Everything else is derived from it; `position` from the matrix' null space for a
  /// perspective view.
  static View fromMatrix(const glm::dmat4& worldToClip, int width, int height);

  /// A symmetric view for tools and tests; `verticalAngle` in radians.
  static View perspective(const glm::dvec3& position, const glm::dvec3& focalPoint,
    const glm::dvec3& up, double verticalAngle, double nearDistance, double farDistance, int width,
    int height);
};

} // namespace pointfront
