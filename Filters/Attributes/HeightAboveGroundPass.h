#pragma once

#include "pointfront/Points/AttributePass.h"

#include <atomic>
#include <cstdint>
#include <optional>

namespace pointfront
{

struct GroundOptions
{
  /// Whether a point of the cloud is of class 2, if the sources are a part of it; nothing: looked
  /// for in them.
  std::optional<bool> classified;
  double cell = 10.0; ///< world units: edge of the cells whose lowest points are taken as ground
  std::uint64_t tilePoints = 1u << 17;
};

/// Attribute "height_above_ground" (float32, world units): a point's height above the ground below
/// it, as GroundSurface.h extends it from the twelve nearest ground points.
/// Ground   the points of class 2 (ASPRS: ground). If there are none, the lowest point of each
///          cell: a guess, right where each cell sees the ground somewhere.
/// Exact    does not depend on parts, memory or threads; no gap between ground points is too wide.
/// Memory   from class 2: under resources.memoryBytes, as NearestNeighbours.h. From lowest points:
///          200 bytes a cell, kept while the points are read.
class HeightAboveGroundPass final : public AttributePass
{
public:
  explicit HeightAboveGroundPass(GroundOptions options)
    : options_(options)
  {
  }
  Result<PointSources> apply(PointSources sources, const PassResources& resources) const override;
  std::uint64_t heldBytes(const PassResources& resources) const override;
  /// Says so when the ground is a guess.
  std::vector<std::string> findings() const override;

private:
  Result<PointSources> aboveLowest(PointSources sources, const PassResources& resources) const;

  GroundOptions options_;
  mutable std::atomic<std::uint64_t> cells_{ 0 }; ///< cells with a lowest point; 0: ground is known
};

} // namespace pointfront
