#pragma once

#include "PixelRays.h"
#include "RayCaster.h"
#include "SpacingGrade.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointfront::truth
{

/// Points taken from a surface, with what is true there.
struct TruthPoints
{
  std::vector<glm::dvec3> positions;
  std::vector<std::array<std::uint8_t, 3>> colours; ///< colours of the texture, light included
  std::vector<glm::vec3> normals; ///< unit

  std::size_t size() const { return positions.size(); }
  void add(const TriangleMesh& mesh, std::size_t triangle, double b, double c,
    const glm::dvec3& place, const glm::dvec3& normal);
  void append(const TruthPoints& more);
};

/// The part of a scene that is sampled, and how densely: it shows in the picture of a view, and a
/// little around it, on front and back sides alike.
struct SamplingRegion
{
  const RayCaster& rays;
  const PixelRays& pixels;
  SpacingGrade grade;

  double marginPx() const { return 12.0 + 0.04 * pixels.width(); }
  bool contains(const glm::dvec3& place) const;
};

/// Points as evenly spread as can be, with no pattern: Poisson disks of radius 0.713 h, which come
/// to one point for each h x h. They lie on the surface. Ordered so that each prefix is spread as
/// evenly, at a larger distance.
TruthPoints sampleBlueNoise(const SamplingRegion& region, std::uint64_t seed);

/// Points as a scanner flying past gets them, in the order of its scan lines: lines twice as far
/// apart as the points in them, jitter, noise of 0.1 h along the beam, and 1 % of the points off by
/// h. The town is flown over straight and in four oblique directions, half as dense; a single
/// object is scanned from six sides. Surfaces that no beam meets have no points.
TruthPoints sampleByScanner(const SamplingRegion& region, bool town, std::uint64_t seed);

} // namespace pointfront::truth
