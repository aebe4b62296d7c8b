#include "PosterTile.h"

#include "pointfront/Plan/LensWindows.h"

#include <glm/common.hpp>

#include <vtkRenderer.h>
#include <vtkWindow.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace pointfront
{
namespace
{

/// Splats of points beside a tile are drawn if they reach that far into it.
constexpr int leastMarginPx = 16;

/// At least `least`; a multiple of the hole filler's blocks from the corner of the whole.
int alignedMargin(int least, int shift)
{
  const int place = shift - least;
  const int block = holeFillerReach;
  return least + (place % block + block) % block;
}

std::shared_ptr<const LensMask> maskOf(
  const FrameLens& lens, const glm::ivec2& size, const glm::ivec2& corner, const glm::ivec2& whole)
{
  auto part = std::make_shared<LensMask>();
  part->width = size.x;
  part->height = size.y;
  for (int y = 0; y < part->height; ++y)
  {
    for (int x = 0; x < part->width; ++x)
    {
      const glm::ivec2 place = glm::clamp(corner + glm::ivec2(x, y), glm::ivec2(0), whole - 1);
      part->values.push_back(lens.covers(place.x, place.y, whole.x, whole.y));
    }
  }
  return part;
}

} // namespace

PosterTile::PosterTile(vtkRenderer* renderer)
{
  vtkWindow* const window = renderer->GetVTKWindow();
  int corner[2];
  renderer->GetTiledSizeAndOrigin(&size_.x, &size_.y, &corner[0], &corner[1]);
  const double* const tile = window->GetTileViewport();
  const double* const viewport = renderer->GetViewport();
  for (int axis = 0; axis < 2; ++axis)
  {
    scale_[axis] = window->GetTileScale()[axis];
    const double pixels = double(window->GetActualSize()[axis]) * scale_[axis];
    const double first = std::max(tile[axis], viewport[axis]);
    whole_[axis] =
      std::max(1, static_cast<int>(std::lround((viewport[axis + 2] - viewport[axis]) * pixels)));
    shift_[axis] = static_cast<int>(std::lround((first - viewport[axis]) * pixels));
  }
}

void PosterTile::enlarge(FrameShading& shading) const
{
  const auto larger = static_cast<float>(std::max(scale_.x, scale_.y));
  shading.eyeDomeRadiusPx *= larger;
  for (FrameLook& look : shading.furtherLooks)
  {
    look.eyeDomeRadiusPx *= larger;
  }
  for (FrameHighlight& highlight : shading.highlights)
  {
    highlight.haloPx *= larger;
  }
}

ViewportMargin PosterTile::margin(const FrameShading& shading) const
{
  if (!isTile())
  {
    return {};
  }
  const int least = std::max(leastMarginPx, shading.reachPx());
  const glm::ivec2 beyond = whole_ - shift_ - size_;
  return { std::min(shift_.x, alignedMargin(least, shift_.x)),
    std::min(shift_.y, alignedMargin(least, shift_.y)), std::clamp(beyond.x, 0, least),
    std::clamp(beyond.y, 0, least) };
}

ViewportMargin PosterTile::sight(
  const ViewportMargin& margin, const std::vector<LayerStyling>& styling) const
{
  double radius = 0.0;
  for (const LayerStyling& layer : styling)
  {
    for (const auto& style : layer.styles)
    {
      radius = std::max(radius,
        style->size.mode == SplatSize::Mode::Pixels
          ? style->size.value
          : SplatSize::mostOfHeight * static_cast<double>(whole_.y));
    }
  }
  return isTile() ? wider(margin, radius) : margin;
}

ViewportMargin PosterTile::wider(const ViewportMargin& margin, double px) const
{
  const auto reach = static_cast<int>(std::ceil(std::min(px, static_cast<double>(whole_.y))));
  return { std::max(margin.left, reach), std::max(margin.bottom, reach),
    std::max(margin.right, reach), std::max(margin.top, reach) };
}

void PosterTile::limit(const std::function<View(const ViewportMargin&)>& viewWith,
  const ViewportMargin& margin, const std::vector<LayerStyling>& styling,
  std::vector<LayerLimits>& layers) const
{
  const auto isUnknown = [](const auto& style)
  { return style->size.mode == SplatSize::Mode::Attribute; };
  for (std::size_t layer = 0; isTile() && layer < styling.size(); ++layer)
  {
    const auto& styles = styling[layer].styles;
    layers.resize(std::max(layers.size(), styling.size()));
    if (!layers[layer].windows.empty() || std::any_of(styles.begin(), styles.end(), isUnknown))
    {
      continue;
    }
    for (const auto& style : styles)
    {
      const bool pixels = style->size.mode == SplatSize::Mode::Pixels;
      layers[layer].windows.push_back(
        sightOf(*style, viewWith(pixels ? wider(margin, style->size.value) : margin)));
    }
  }
}

void PosterTile::place(PlanRequest& request, const ViewportMargin& margin) const
{
  FrameCamera& camera = request.camera;
  camera.setViewport(camera.width, camera.height, margin);
  if (!isTile())
  {
    return;
  }
  camera.pictureHeight = whole_.y;
  const glm::ivec2 corner = shift_ - glm::ivec2(margin.left, margin.bottom);
  for (FrameLens& lens : request.shading.lenses)
  {
    if (lens.shape == LensShape::Mask)
    {
      lens.mask = maskOf(lens, { camera.width, camera.height }, corner, whole_);
    }
    const glm::vec2 larger(scale_);
    lens.centrePx = lens.centrePx * larger - glm::vec2(corner);
    lens.halfSizePx *= larger;
  }
}

} // namespace pointfront
