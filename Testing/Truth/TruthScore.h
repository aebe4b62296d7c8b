#pragma once

#include "SpacingGrade.h"
#include "TruthPicture.h"

#include "pointfront/Base/Result.h"

#include <vector>

namespace pointfront::truth
{

/// How far a picture of points is from the surface that they were taken from. Percentages of the
/// silhouette: `holes` and `innerBloat` of the pixels that are wholly covered, `bloat` of those
/// that are at least half covered. PSNR, dB, and SSIM are those of comparePictures() there.
struct TruthScore
{
  double psnr = 0.0;
  double ssim = 0.0;
  /// Nothing drawn, or what is drawn lies more than 2 h / max(cos, 1/4) behind the surface; cos is
  /// that of the angle between surface and ray: what lies behind shows through.
  double holes = 0.0;
  double innerBloat = 0.0; ///< drawn as far in front: points that cover what they should not
  double bloat = 0.0; ///< drawn where the surface does not reach
  /// Root mean square of the depth's error at the pixel's centre, over h, where it is neither
  /// hole nor inner bloat; each error counts as 4 h at most.
  double depthError = 0.0;
};

/// `drawnDepth` as TruthPicture::depth. h is the spacing of the points at the depth of a pixel.
/// Errors  those of comparePictures().
Result<TruthScore> scoreAgainst(const TruthPicture& truth, const PixelRays& pixels,
  const SpacingGrade& grade, const Picture& drawn, const std::vector<float>& drawnDepth);

} // namespace pointfront::truth
