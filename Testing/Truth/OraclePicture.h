#pragma once

#include "TruthPicture.h"
#include "TruthPoints.h"

namespace pointfront::truth
{

/// The best that can be drawn of these points, by a painter who knows the surface: at each pixel's
/// centre the true place, in a mean of the colours of the points around it, with weights
/// (1 - d2 / r2)^2 for a radius r of one and a half spacings, a pixel at the least.
/// No technique that has the points alone is much better.
Picture drawOracle(const TruthPicture& truth, const PixelRays& pixels, const SpacingGrade& grade,
  const TruthPoints& points);

} // namespace pointfront::truth
