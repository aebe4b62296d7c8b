#include "pointfront/Views/SplatReach.h"

#include <algorithm>
#include <cstddef>

namespace pointfront
{
namespace
{

/// Radii of a silhouette, whose rim goes half as far again.
constexpr double mostRadii = 1.5;
/// A view's first planes: near and far ones end splats by their centres.
constexpr std::size_t sides = 4;

} // namespace

double largestSplat(const std::vector<LayerStyling>& layers)
{
  double largest = 0.0;
  for (const LayerStyling& layer : layers)
  {
    for (const auto& style : layer.styles)
    {
      const bool known = style->size.mode == SplatSize::Mode::World;
      largest = std::max(largest, known ? mostRadii * 0.5 * style->size.value : 0.0);
    }
  }
  return largest;
}

View withSplatsFromAside(View view, double radius)
{
  for (std::size_t side = 0; side < sides; ++side)
  {
    view.planes[side].w += radius;
  }
  return view;
}

} // namespace pointfront
