#pragma once

#include "SurfaceFit.h"

namespace pointfront
{

/// Whether this build has PCL (POINTFRONT_PCL).
bool hasPCLFit();

/// The plane that the Point Cloud Library fits to the points: pcl::computePointNormal, which
/// pcl::NormalEstimation calls for each point. In single precision as there, but of offsets from
/// `origin`, so that coordinates of millions of metres lose nothing.
/// Gives    normal and curvature; width and centre stay as they are in SurfaceFit().
/// Nothing  for fewer than three places, and where PCL's normal or curvature is no number; without
///          PCL always.
std::optional<SurfaceFit> fitSurfaceByPCL(
  const glm::dvec3& origin, const std::vector<NearPoint>& points);

} // namespace pointfront
