#include "SurfaceFit.h"

#include <pcl/common/eigen.h>

#include <Eigen/Eigenvalues>

namespace pointfront
{
namespace
{
/// Squared: extents of a millionth.
constexpr double onOneLine = 1e-12;
/// Below this gap between eigenvalues, relative to the largest, the closed form loses digits.
constexpr double closeEigenvalues = 1e-4;
} // namespace

std::optional<SurfaceFit> fitSurface(const std::vector<NearPoint>& points)
{
  if (points.size() < 3)
  {
    return std::nullopt;
  }
  const glm::dvec3 origin = points.front().position;
  glm::dvec3 sum(0.0);
  double count = 0.0;
  for (const NearPoint& point : points)
  {
    sum += double(point.count) * (point.position - origin);
    count += point.count;
  }
  const glm::dvec3 mean = sum / count;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const NearPoint& point : points)
  {
    const glm::dvec3 offset = point.position - origin - mean;
    const Eigen::Vector3d d(offset.x, offset.y, offset.z);
    covariance += (double(point.count) * d) * d.transpose();
  }
  covariance /= count;
  const double trace = covariance.trace();
  if (!(trace > 0.0))
  {
    return std::nullopt;
  }
  covariance /= trace;
  Eigen::Vector3d eigenvalues;
  Eigen::Vector3d normal;
  pcl::eigen33(covariance, eigenvalues);
  if (eigenvalues[1] - eigenvalues[0] < closeEigenvalues)
  {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
    eigenvalues = solver.eigenvalues();
    normal = solver.eigenvectors().col(0);
  }
  else
  {
    pcl::computeCorrespondingEigenVector(covariance, eigenvalues[0], normal);
  }
  if (!(eigenvalues[1] > onOneLine * eigenvalues[2]))
  {
    return std::nullopt;
  }
  SurfaceFit fit;
  fit.normal = { normal[0], normal[1], normal[2] };
  fit.curvature = std::max(0.0, eigenvalues[0]); // the trace is 1
  fit.centre = origin + mean;
  return fit;
}

} // namespace pointfront
