#pragma once

#include "pointfront/Front/LayerLimits.h"
#include "pointfront/Front/View.h"
#include "pointfront/Plan/FrameCamera.h"
#include "pointfront/Plan/FramePlanner.h"
#include "pointfront/Style/FrameShading.h"
#include "pointfront/Style/StyleSheet.h"

#include <glm/vec2.hpp>

#include <functional>
#include <vector>

class vtkRenderer;

namespace pointfront
{

/// The part of a poster that a renderer draws. VTK makes a picture larger than its window from
/// tiles: it sets the window's tile scale and draws the window once for each tile
/// (vtkWindowToImageFilter::SetScale). A poster is one picture: a lens lies in it once, halos and
/// eye-dome lighting grow as the picture does, and no border between tiles is seen.
/// Threads  the renderer's.
class PosterTile
{
public:
  explicit PosterTile(vtkRenderer* renderer);

  /// Changes widths in pixels of the window into those of the poster.
  void enlarge(FrameShading& shading) const;
  /// The part around the tile that must be drawn so that its own pixels are those of the poster:
  /// light, halos and hole filling look at neighbours, and splats reach over borders. None beyond
  /// the poster. `shading`  enlarged.
  ViewportMargin margin(const FrameShading& shading) const;
  /// The part around the tile that must be in sight: splats of points further away than the margin
  /// may reach into it. `margin`  of the tile. Those that `styling` makes large in world units may
  /// reach further, and are missing then.
  ViewportMargin sight(
    const ViewportMargin& margin, const std::vector<LayerStyling>& styling) const;
  /// Limits layers to the nodes that reach into the tile, of all that are in sight around it: the
  /// point budget is for these. `viewWith`  the view with a margin.
  void limit(const std::function<View(const ViewportMargin&)>& viewWith,
    const ViewportMargin& margin, const std::vector<LayerStyling>& styling,
    std::vector<LayerLimits>& layers) const;
  /// Widens the request's camera by the margin, and moves the lenses from the renderer's viewport
  /// in the window into what is drawn.
  void place(PlanRequest& request, const ViewportMargin& margin) const;

private:
  /// At least that many pixels on each side.
  ViewportMargin wider(const ViewportMargin& margin, double px) const;
  bool isTile() const { return scale_.x > 1 || scale_.y > 1; }

  glm::ivec2 scale_{ 1 };
  glm::ivec2 whole_{ 1 }; ///< the renderer's size in the poster, pixels
  glm::ivec2 shift_{ 0 }; ///< the tile's place in it
  glm::ivec2 size_{ 1 }; ///< the tile's size
};

} // namespace pointfront
