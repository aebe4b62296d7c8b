#pragma once

#include "pointfront/Neighbourhood/NearestNeighbours.h"

namespace pointfront
{

/// Height of the ground below (or above) a place, from ground points nearby: the plane of least
/// squares through them, each with the weight 1 / (squared distance + a hundredth of the farthest
/// one's), evaluated at the place. So a slope goes on below a building at its own steepness.
/// Limits  no steeper than 45 degrees; through ground points on one line, or fewer than three, the
///         weighted mean. `near`: nearest first by horizontal distance, not empty.
double groundHeight(const glm::dvec3& place, const std::vector<NearPoint>& near);

/// Float32: height above that ground; 0 where there is no ground point at all.
class HeightAboveGround final : public NeighbourhoodFeature
{
public:
  std::size_t bytes() const override { return sizeof(float); }
  void compute(const glm::dvec3& position, const std::vector<NearPoint>& near,
    std::byte* value) const override;
};

} // namespace pointfront
