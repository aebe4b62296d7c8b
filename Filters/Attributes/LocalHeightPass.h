#pragma once

#include "pointfront/Points/AttributePass.h"

#include <cstdint>

namespace pointfront
{

/// Attribute "local_height" (float32, world units): a point's height above the mean of the points
/// of its class in its proximity (LAYERS 3.1). Zero on a plane of any slope, positive on ridges and
/// chimneys, negative in gutters.
/// Mean     of all points of the class whose cell centre, in a grid of radius / 8 aligned to the
///          world's origin, is within `radius` of a cell centre; between the four cell centres
///          around the point it is interpolated, so that the grid is not seen.
/// Exact    does not depend on parts, memory or threads.
/// Classes  without a classification all points are of one class.
class LocalHeightPass final : public AttributePass
{
public:
  /// `radius` > 0, horizontal, world units.
  explicit LocalHeightPass(double radius, std::uint64_t tilePoints = 1u << 17)
    : radius_(radius)
    , tilePoints_(tilePoints)
  {
  }
  Result<PointSources> apply(PointSources sources, const PassResources& resources) const override;
  double reach() const override;

private:
  double radius_;
  std::uint64_t tilePoints_;
};

} // namespace pointfront
