#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/Result.h"

#include <glm/vec3.hpp>

#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// A camera as the tool's files describe it. World units, double to the end.
struct Camera
{
  glm::dvec3 position{ 0.0 };
  glm::dvec3 focalPoint{ 0.0, 0.0, -1.0 };
  glm::dvec3 viewUp{ 0.0, 1.0, 0.0 };
  double viewAngleDegrees = 30.0; ///< vertical; for a perspective camera
  std::optional<double> parallelScale; ///< half the height of a parallel view, world units

  glm::dvec3 direction() const; ///< unit, away from the eye
};

/// The same picture, bit for bit.
inline bool operator==(const Camera& a, const Camera& b)
{
  return a.position == b.position && a.focalPoint == b.focalPoint && a.viewUp == b.viewUp &&
    a.viewAngleDegrees == b.viewAngleDegrees && a.parallelScale == b.parallelScale;
}

/// From where `--view` looks.
enum class ViewDirection
{
  Iso, ///< from the south-east, 35 degrees above the horizon; z is up
  Top, ///< straight down; north (y) is up in the picture
  Front, ///< from the south
  Back,
  Left, ///< from the west
  Right
};
std::optional<ViewDirection> namedView(const std::string& name);

/// A perspective camera that shows all of the box, as large as fits with a margin of 4 %.
/// `aspect` is width / height of the picture.
Camera cameraFitting(const Bounds& bounds, ViewDirection view, double aspect);

/// Reads {"position":[x,y,z],"focal_point":[x,y,z],"view_up":[x,y,z],"view_angle":30}, or with
/// "parallel_scale" instead of "view_angle".
/// Errors  NotFound, Unreadable; BadFormat names the file and the key.
Result<Camera> readCameraFile(const std::string& path);

} // namespace pointfront
