#pragma once

#include "TruthPicture.h"
#include "TruthPoints.h"
#include "TruthScene.h"

#include <cstdint>
#include <string>

namespace pointfront::truth
{

/// One scene, seen from one of its views in a picture of some size, with points at a spacing of so
/// many pixels: what a test or a table row is about.
/// Threads  const after it is made.
class TruthCase
{
public:
  struct Choice
  {
    std::string view = "far"; ///< one that the scene has
    double spacingPx = 1.0; ///< projected, at the median depth
    std::uint32_t width = 800;
    std::uint32_t height = 600;
  };
  TruthCase(TruthScene scene, const Choice& choice);
  TruthCase(const TruthCase&) = delete;
  TruthCase& operator=(const TruthCase&) = delete;

  const TruthScene& scene() const { return scene_; }
  const TruthCamera& camera() const { return camera_; }
  const RayCaster& rays() const { return rays_; }
  const PixelRays& pixels() const { return pixels_; }
  const SpacingGrade& grade() const { return region_.grade; }
  const SamplingRegion& region() const { return region_; }

  /// Moved to the right by what is so many pixels wide at the depth of the focal point.
  TruthCamera pannedCamera(double px) const;

  TruthPicture draw(unsigned samples) const { return drawTruth(rays_, pixels_, samples); }
  TruthPoints blueNoise(std::uint64_t seed) const { return sampleBlueNoise(region_, seed); }
  /// The town's flights over everything that is called "town", else those around an object.
  TruthPoints scan(std::uint64_t seed) const
  {
    return sampleByScanner(region_, scene_.name == "town", seed);
  }

private:
  TruthScene scene_;
  TruthCamera camera_;
  RayCaster rays_;
  PixelRays pixels_;
  SamplingRegion region_{ rays_, pixels_, {} };
};

} // namespace pointfront::truth
