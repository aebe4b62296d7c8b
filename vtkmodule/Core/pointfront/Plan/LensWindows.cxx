#include "pointfront/Plan/LensWindows.h"

#include "pointfront/Views/WallReach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace pointfront
{
namespace
{

/// Times a node's spacing, more than the splats of any technique reach.
constexpr double mostOfSpacing = 8.0;
/// Pixels beyond that: the centre's own, a low-pass, rounding.
constexpr double marginPx = 8.0;

/// A power of two, so that windows do not change with each small change of a frame's error.
double roundedUp(double px)
{
  return std::exp2(std::ceil(std::log2(std::clamp(px, 1.0, 1024.0))));
}

/// Whether it limits where points of a style are needed.
bool isBounded(const ResolvedStyle& style, const std::vector<FrameLens>& lenses)
{
  return style.lens >= 0 && static_cast<std::size_t>(style.lens) < lenses.size() &&
    !style.lensMask && style.size.mode != SplatSize::Mode::Attribute;
}

/// Where a style's points are seen; nothing if its lens lies beside the viewport.
std::optional<SightWindow> windowOf(const ResolvedStyle& style, const FrameLens& lens,
  const FrameCamera& camera, double thresholdPx, double aroundPx, double wallHeight)
{
  const std::array<int, 4> extent = lens.extent(camera.width, camera.height);
  if (extent[0] >= extent[2] || extent[1] >= extent[3])
  {
    return std::nullopt;
  }
  const double factor = std::max(1.0, style.size.value);
  const SplatSize::Mode mode = style.size.mode;
  const double margin = marginPx + aroundPx +
    (mode == SplatSize::Mode::Pixels       ? factor
        : mode == SplatSize::Mode::Spacing ? mostOfSpacing * factor * roundedUp(thresholdPx)
                                           : 0.0);
  // The lens and its margin as a viewport of its own.
  glm::dmat4 toClip = camera.storeToClip();
  const std::array<int, 2> size = { camera.width, camera.height };
  for (int axis = 0; axis < 2; ++axis)
  {
    const auto a = static_cast<std::size_t>(axis);
    const double low = 2.0 * (extent[a] - margin) / size[a] - 1.0;
    const double high = 2.0 * (extent[a + 2] + margin) / size[a] - 1.0;
    for (int column = 0; column < 4; ++column)
    {
      toClip[column][axis] =
        (2.0 * toClip[column][axis] - (low + high) * toClip[column][3]) / (high - low);
    }
  }
  return sightOf(
    style, withWallsFromAbove(View::fromMatrix(toClip, camera.width, camera.height), wallHeight));
}

} // namespace

SightWindow sightOf(const ResolvedStyle& style, const View& view)
{
  SightWindow window;
  std::copy_n(view.planes.begin(), window.planes.size(), window.planes.begin());
  const double value = style.size.value;
  const SplatSize::Mode mode = style.size.mode;
  window.reachSpacings =
    mode == SplatSize::Mode::Spacing ? mostOfSpacing * std::max(1.0, value) : 0.0;
  window.reach = mode == SplatSize::Mode::World ? 0.5 * value : 0.0;
  return window;
}

void limitToLenses(const std::vector<LayerStyling>& styling, const FrameShading& shading,
  const FrameCamera& camera, double thresholdPx, double wallHeight,
  std::vector<LayerLimits>& layers)
{
  const std::vector<FrameLens>& lenses = shading.lenses;
  for (std::size_t layer = 0; layer < styling.size() && !lenses.empty(); ++layer)
  {
    const auto& styles = styling[layer].styles;
    if (styles.empty() ||
      !std::all_of(
        styles.begin(), styles.end(), [&](const auto& style) { return isBounded(*style, lenses); }))
    {
      continue;
    }
    layers.resize(std::max(layers.size(), styling.size()));
    for (const auto& style : styles)
    {
      const FrameLens& lens = lenses[static_cast<std::size_t>(style->lens)];
      if (const auto window =
            windowOf(*style, lens, camera, thresholdPx, shading.reachPx(), wallHeight))
      {
        layers[layer].windows.push_back(*window);
      }
    }
    layers[layer].visible = layers[layer].visible && !layers[layer].windows.empty();
  }
}

} // namespace pointfront
