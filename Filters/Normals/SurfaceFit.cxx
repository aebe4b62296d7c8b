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
  // Moments about the nearest point, which is within the neighbourhood's own extent of the mean: no
  // digits are lost that count.
  const glm::dvec3 origin = points.front().position;
  double count = 0.0;
  glm::dvec3 sum(0.0);
  glm::dvec3 squares(0.0);  // xx, yy, zz
  glm::dvec3 products(0.0); // xy, xz, yz
  for (const NearPoint& point : points)
  {
    const glm::dvec3 d = point.position - origin;
    const glm::dvec3 weighted = double(point.count) * d;
    count += point.count;
    sum += weighted;
    squares += weighted * d;
    products += glm::dvec3(weighted.x * d.y, weighted.x * d.z, weighted.y * d.z);
  }
  const glm::dvec3 mean = sum / count;
  squares = squares / count - mean * mean;
  products = products / count -
    glm::dvec3(mean.x * mean.y, mean.x * mean.z, mean.y * mean.z);
  Eigen::Matrix3d covariance;
  covariance << squares.x, products.x, products.y, //
    products.x, squares.y, products.z,             //
    products.y, products.z, squares.z;
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
