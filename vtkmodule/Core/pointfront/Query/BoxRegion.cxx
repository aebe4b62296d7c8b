#include "pointfront/Query/BoxRegion.h"

#include <glm/vector_relational.hpp>

namespace pointfront
{

Result<std::shared_ptr<const BoxRegion>> BoxRegion::make(const Bounds& box)
{
  if (glm::any(glm::isnan(box.low)) || glm::any(glm::isnan(box.high)))
  {
    return makeError(Error::Kind::BadArgument, "a box has an end that is no number");
  }
  return std::shared_ptr<const BoxRegion>(new BoxRegion(box));
}

Overlap BoxRegion::overlap(const Bounds& box) const
{
  if (box_.empty() || !box_.overlaps(box))
  {
    return Overlap::Outside;
  }
  return box_.contains(box.low) && box_.contains(box.high) ? Overlap::Inside : Overlap::Crossing;
}

void BoxRegion::keepInside(
  const Bounds&, const glm::dvec3* points, std::size_t count, std::uint8_t* keep) const
{
  const glm::dvec3 low = box_.low;
  const glm::dvec3 high = box_.high;
  for (std::size_t i = 0; i < count; ++i)
  {
    const glm::dvec3 p = points[i];
    const bool inside = (p.x >= low.x) & (p.x <= high.x) & (p.y >= low.y) & (p.y <= high.y) &
      (p.z >= low.z) & (p.z <= high.z);
    keep[i] = static_cast<std::uint8_t>(keep[i] & static_cast<std::uint8_t>(inside));
  }
}

} // namespace pointfront
