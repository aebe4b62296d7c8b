#pragma once

#include "TruthPicture.h"
#include "TruthPoints.h"

#include "pointfront/Base/Result.h"

#include <string>
#include <vector>

namespace pointfront::truth
{

/// Files for the tool and for `pointfront compare`. Each is whole or absent.

/// PLY with colours, and normals as nx, ny, nz.
Result<void> writePoints(const std::string& path, const TruthPoints& points);
/// RGB.
Result<void> writePicture(const std::string& path, const Picture& picture);
/// width * height float32, little endian, rows from the top: metres along the camera's direction
/// at the centre of each pixel, infinity where there is nothing.
Result<void> writeDepth(const std::string& path, const std::vector<float>& depth);
/// As `pointfront render --camera` reads it.
Result<void> writeCamera(const std::string& path, const TruthCamera& camera);
/// Writes facts for scripts: points, spacing_px, spacing, median_depth, graded, focal_px,
/// background.
Result<void> writeFacts(const std::string& path, const PixelRays& pixels, const SpacingGrade& grade,
  const TruthPoints& points);

} // namespace pointfront::truth
