#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Query/Region.h"

#include <memory>

namespace pointfront
{

/// Points whose distance from a centre, squared in double arithmetic, is at most the radius'
/// square. Radius 0 is the centre alone.
class SphereRegion final : public Region
{
public:
  /// BadArgument: a number is not finite, or the radius is negative.
  static Result<std::shared_ptr<const SphereRegion>> make(const glm::dvec3& centre, double radius);

  bool contains(const glm::dvec3& point) const override;
  Overlap overlap(const Bounds& box) const override;
  Bounds bounds() const override;

private:
  SphereRegion(const glm::dvec3& centre, double radius)
    : centre_(centre)
    , radius_(radius)
  {
  }
  glm::dvec3 centre_;
  double radius_;
};

} // namespace pointfront
