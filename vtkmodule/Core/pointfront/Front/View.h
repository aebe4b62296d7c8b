#pragma once

#include "pointfront/Base/Bounds.h"

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <optional>

namespace pointfront
{

/// How a model's matrix shows lengths in the world where it stretches some directions more than
/// others, as an exaggeration of heights does.
struct ModelStretch
{
  glm::dmat3 toWorld{ 1.0 }; ///< the linear part of the matrix
  glm::dmat3 squares{ 1.0 }; ///< toWorld times its transpose
  glm::dmat3 adjugate{ 1.0 }; ///< that of `squares`
  glm::dvec3 direction{ 0.0 }; ///< the view's, in the world

  /// Nothing if the matrix shows all directions alike.
  static std::optional<ModelStretch> of(const glm::dmat4& modelToWorld);
  /// Length in the world, along `ray` (unit), of what has the length 1 in the model at most.
  double along(const glm::dvec3& ray) const;
  /// The same across `ray`.
  double across(const glm::dvec3& ray) const;
};
bool operator==(const ModelStretch& a, const ModelStretch& b);

/// A camera and a viewport, in double, as the front sees them. A snapshot: copy it freely.
/// Units  world units; pixels of the render target.
struct View
{
  /// Position of the eye. A parallel view has no eye: the middle of its near plane, moved by
  /// nearDistance towards the viewer.
  glm::dvec3 position{ 0.0 };
  glm::dvec3 direction{ 0.0, 0.0, -1.0 }; ///< unit, away from the eye
  bool parallel = false;
  /// Pixels that one world unit covers, across the line of sight, along the axis of the screen that
  /// shows it larger. Perspective: at depth 1; parallel: at any depth.
  double pixelsPerUnit = 1.0;
  double nearDistance = 0.1; ///< along `direction`, > 0
  int width = 1; ///< width of the viewport, pixels
  int height = 1;
  /// Left, right, bottom, top, near, far: (n, d) with n unit length and n.p + d >= 0 inside. A far
  /// plane beyond what the matrix can resolve (far / near > 1e14) has d of the largest double.
  std::array<glm::dvec4, 6> planes{};
  /// The model's that is seen; `pixelsPerUnit` is of the world then.
  std::optional<ModelStretch> stretch;

  /// From a world-to-clip matrix (column vectors, clip z in [-w, w], any off-axis frustum) and the
  /// viewport. Everything else is derived from it; `position` from the matrix' null space for a
  /// perspective view. The matrix may contain a model matrix too: "world" is then the model's
  /// space.
  static View fromMatrix(const glm::dmat4& worldToClip, int width, int height);
  /// The same for a model with a matrix of its own: the view's places, planes and directions are
  /// the model's.
  static View ofModel(
    const glm::dmat4& modelToWorld, const glm::dmat4& worldToClip, int width, int height);

  /// A symmetric view for tools and tests; `verticalAngle` in radians, square pixels.
  static View perspective(const glm::dvec3& position, const glm::dvec3& focalPoint,
    const glm::dvec3& up, double verticalAngle, double nearDistance, double farDistance, int width,
    int height);
};

bool operator==(const View& a, const View& b);
inline bool operator!=(const View& a, const View& b)
{
  return !(a == b);
}

} // namespace pointfront
