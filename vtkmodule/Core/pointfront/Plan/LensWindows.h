#pragma once

#include "pointfront/Front/LayerLimits.h"
#include "pointfront/Front/View.h"
#include "pointfront/Plan/FrameCamera.h"
#include "pointfront/Style/FrameShading.h"
#include "pointfront/Style/StyleSheet.h"

#include <vector>

namespace pointfront
{

/// Where a style's points are seen that reach into a view, however far they lie from it.
SightWindow sightOf(const ResolvedStyle& style, const View& view);

/// Limits layers that are seen in lenses only to what these lenses can show: their windows, or
/// nothing where no lens lies in the viewport (LAYERS-10).
/// `styling`      by number of the layer.
/// `shading`      its lenses are those of the camera's viewport; light and hole filling look at
///                points beside a lens, too.
/// `thresholdPx`  the error of the frame; splats of what is far away reach some of it.
/// `wallHeight`   tallestWall().
/// `layers`       as FrameRequest::layers; changed where there is such a layer.
void limitToLenses(const std::vector<LayerStyling>& styling, const FrameShading& shading,
  const FrameCamera& camera, double thresholdPx, double wallHeight,
  std::vector<LayerLimits>& layers);

} // namespace pointfront
