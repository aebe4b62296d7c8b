#pragma once

#include "pointfront/Neighbourhood/PointTiles.h"
#include "pointfront/Points/AttributePass.h"

#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

struct NormalsOptions
{
  std::uint32_t neighbours = 16; ///< k, the point itself included; 3 or more
  double radius = 0.0; ///< if > 0: instead all points within, world units
  double eps = 0.0; ///< bound of FLANN's approximate search; 0: exact
  bool curvature = false; ///< also give attribute "curvature"
  /// Planes are PCL's (PCLFit.h), in single precision, not those of SurfaceFit.h.
  bool byPCL = false;
  bool normals = true; ///< false: only the radius of splats, from 16 neighbours
  bool splatRadius = true; ///< also give attribute "splat_radius" (SplatRadius.h)
  /// These classes only: others get no normal and are nobody's neighbours.
  std::optional<std::vector<std::uint8_t>> classes;
  std::uint64_t tilePoints = 1u << 17; ///< only approximate results depend on it
};

/// Attribute "normal" (NormalAttribute.h) of each point from the plane through its nearest points
/// (PCA; LAYERS 3.1, after Mitra and Nguyen 2003), and "curvature" if asked: smallest eigenvalue
/// over the sum of all; and "splat_radius" (SplatCell.h) from the nearest 15 of the same
/// neighbours, or of as many as there are. They are 15 where normals have fewer, too.
/// Sign     towards the scanner where a source tells where it stood, else up.
/// Base     of the radii: chosen when all are known, in each source's description.
/// Zero     where there is no plane: fewer than three neighbours, or all on one line; for the other
///          classes; for positions that the build rejects.
/// Errors   Unsupported: planes by PCL in a build without it.
/// Exact    does not depend on parts, memory or threads (NearestNeighbours.h).
class NormalsPass final : public AttributePass
{
public:
  explicit NormalsPass(NormalsOptions options)
    : options_(std::move(options))
  {
  }
  Result<PointSources> apply(PointSources sources, const PassResources& resources) const override;
  double reach() const override
  {
    return options_.radius > 0.0 ? options_.radius : std::numeric_limits<double>::infinity();
  }
  std::vector<std::string> findings() const override;

private:
  NormalsOptions options_;
  mutable std::atomic<std::uint64_t> without_{ 0 }; ///< points that asked for a normal in vain
};

} // namespace pointfront
