#include "pointfront/Views/WallReach.h"

#include <algorithm>
#include <cmath>

namespace pointfront
{

double tallestWall(const StoreDescription& store, const std::vector<LayerStyling>& layers)
{
  double tallest = 0.0;
  for (const LayerStyling& layer : layers)
  {
    for (const auto& style : layer.styles)
    {
      if (!style->heightColumn)
      {
        continue;
      }
      const std::size_t column = *style->heightColumn;
      const bool known = !store.rangesAreSampled && column < store.ranges.size() &&
        store.ranges[column].components.size() == 1 &&
        std::isfinite(store.ranges[column].components[0][1]);
      tallest = std::max(tallest,
        known ? store.ranges[column].components[0][1] : store.bounds.high.z - store.bounds.low.z);
    }
  }
  return tallest;
}

View withWallsFromAbove(View view, double height)
{
  for (glm::dvec4& plane : view.planes)
  {
    plane.w += std::max(0.0, -plane.z * height);
  }
  return view;
}

} // namespace pointfront
