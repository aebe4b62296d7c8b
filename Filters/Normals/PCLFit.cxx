#include "PCLFit.h"

#include <pcl/features/normal_3d.h>
#include <pcl/point_types.h>

#include <cmath>

namespace pointfront
{

bool hasPCLFit()
{
  return true;
}

std::optional<SurfaceFit> fitSurfaceByPCL(
  const glm::dvec3& origin, const std::vector<NearPoint>& points)
{
  pcl::PointCloud<pcl::PointXYZ> near;
  for (const NearPoint& point : points)
  {
    const glm::vec3 offset(point.position - origin);
    near.insert(near.end(), point.count, pcl::PointXYZ(offset.x, offset.y, offset.z));
  }
  Eigen::Vector4f plane;
  float curvature = 0.0f;
  if (points.size() < 3 || !pcl::computePointNormal(near, plane, curvature) || !plane.allFinite() ||
    !std::isfinite(curvature))
  {
    return std::nullopt;
  }
  SurfaceFit fit;
  fit.normal = { plane[0], plane[1], plane[2] };
  fit.curvature = curvature;
  return fit;
}

} // namespace pointfront
