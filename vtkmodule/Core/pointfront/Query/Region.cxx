#include "pointfront/Query/Region.h"

namespace pointfront
{

void Region::keepInside(
  const Bounds&, const glm::dvec3* points, std::size_t count, std::uint8_t* keep) const
{
  for (std::size_t i = 0; i < count; ++i)
  {
    keep[i] = keep[i] != 0 && contains(points[i]) ? 1 : 0;
  }
}

} // namespace pointfront
