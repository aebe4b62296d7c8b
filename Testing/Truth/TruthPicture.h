#pragma once

#include "PixelRays.h"
#include "RayCaster.h"

#include "pointfront/Picture/Picture.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace pointfront::truth
{

/// Dark, and of no surface in the scenes.
constexpr std::array<std::uint8_t, 3> background = { 39, 42, 47 };

/// The surface itself as a camera sees it.
/// Shapes  one value a pixel, rows from the top.
struct TruthPicture
{
  Picture colours; ///< mean of the samples, in the texture's own steps (no gamma)
  /// Share of the samples that met the surface: 0 none, 255 all, 1 to 254 some.
  std::vector<std::uint8_t> coverage;
  std::vector<float> depth; ///< at the pixel's centre; infinity where there is nothing
  std::vector<float> nearest; ///< nearest of the samples
  std::vector<float> farthest; ///< farthest of the samples that met the surface
  std::vector<glm::vec3> normal; ///< the triangle's at the centre, towards the eye; 0: nothing

  Picture mask() const; ///< the coverage as grey
};

/// samples x samples rays a pixel, in a grid, and one through its centre.
TruthPicture drawTruth(
  const RayCaster& rays, const PixelRays& pixels, unsigned samples, unsigned threads = 0);

/// Depth that half of what is seen is nearer than. The scene's, not the picture's: it is measured
/// on a grid of rays that does not depend on the picture's size.
double medianDepth(const RayCaster& rays, const TruthCamera& camera, double aspect);

} // namespace pointfront::truth
