#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Query/Region.h"

#include <glm/vec4.hpp>

#include <memory>
#include <vector>

namespace pointfront
{

/// The space on the inner side of some planes: the frustum of a camera (View::planes), or the space
/// that clipping planes leave.
class ConvexRegion final : public Region
{
public:
  /// Planes (n, d): inside where n.p + d >= 0; n of any length. Without planes it is all of space.
  /// BadArgument: a number is not finite, or a normal is 0.
  static Result<std::shared_ptr<const ConvexRegion>> make(std::vector<glm::dvec4> planes);

  bool contains(const glm::dvec3& point) const override;
  Overlap overlap(const Bounds& box) const override;
  /// The region's extent along each axis, a little more for rounding; infinite where the planes
  /// do not end it, and along all axes for more than 24 planes.
  Bounds bounds() const override;

private:
  explicit ConvexRegion(std::vector<glm::dvec4> planes)
    : planes_(std::move(planes))
  {
  }
  std::vector<glm::dvec4> planes_;
};

} // namespace pointfront
