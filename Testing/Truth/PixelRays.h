#pragma once

#include "TruthScene.h"

#include <glm/vec3.hpp>

#include <cstdint>

namespace pointfront::truth
{

/// The rays through the pixels of a picture, as the tool's perspective cameras see it.
/// Units  pixels from the upper left corner of the picture, x to the right, y down; the centre of
///        the first pixel is (0.5, 0.5). Depth is measured along the camera's direction.
class PixelRays
{
public:
  PixelRays(const TruthCamera& camera, std::uint32_t width, std::uint32_t height);

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  const glm::dvec3& eye() const { return eye_; }
  const glm::dvec3& forward() const { return forward_; }
  double focalPx() const { return focalPx_; } ///< width in pixels of 1 m at depth 1 m
  /// Not of unit length: a hit's distance along it is its depth.
  glm::dvec3 through(double x, double y) const;
  /// (x, y, depth); means nothing where the depth is not positive.
  glm::dvec3 project(const glm::dvec3& place) const;
  /// May a ball show in the picture, grown by `marginPx` on each side? True for some that do not.
  bool mayShow(const glm::dvec3& centre, double radius, double marginPx) const;

private:
  std::uint32_t width_;
  std::uint32_t height_;
  double focalPx_;
  glm::dvec3 eye_;
  glm::dvec3 forward_;
  glm::dvec3 right_;
  glm::dvec3 down_;
};

} // namespace pointfront::truth
