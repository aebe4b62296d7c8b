#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Query/Region.h"

#include <memory>

namespace pointfront
{

/// An axis-aligned box. Its ends may be infinite; one with low > high contains nothing.
class BoxRegion final : public Region
{
public:
  /// BadArgument: an end is NaN.
  static Result<std::shared_ptr<const BoxRegion>> make(const Bounds& box);

  bool contains(const glm::dvec3& point) const override { return box_.contains(point); }
  Overlap overlap(const Bounds& box) const override;
  Bounds bounds() const override { return box_; }
  void keepInside(const Bounds& box, const glm::dvec3* points, std::size_t count,
    std::uint8_t* keep) const override;

private:
  explicit BoxRegion(const Bounds& box)
    : box_(box)
  {
  }
  Bounds box_;
};

} // namespace pointfront
