#pragma once

#include "pointfront/InPlace/NodeNormals.h"

#include <cstdint>

namespace pointfront
{

/// Normals of a node's points from the planes through the nearest of them (PCA), as NormalsPass
/// gives them for a cloud of these points alone. Facing up.
/// Memory  some 200 bytes a point of at most `mostPoints`: a larger node is cut along a Morton
///         curve, and each part has its own neighbours.
/// Source  EWA (Kovac 2009), section 3.2, has the triangle of two neighbours in place of the plane:
///         docs/tradeoffs.md compares both.
class NodePlanes final : public NodeNormals
{
public:
  static constexpr std::size_t mostPoints = std::size_t(1) << 16;
  static constexpr std::uint32_t usualNeighbours = 16; ///< as `build --normals pca`

  /// `neighbours` 3 to 64: of a plane, with the point itself.
  explicit NodePlanes(std::uint32_t neighbours = usualNeighbours)
    : neighbours_(neighbours)
  {
  }
  std::string origin() const override;
  void compute(
    const std::vector<glm::dvec3>& positions, std::vector<PackedNormal>& normals) const override;

private:
  std::uint32_t neighbours_;
};

} // namespace pointfront
