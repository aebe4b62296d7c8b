#include "SurfaceFit.h"

#include <pcl/common/eigen.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{
/// Squared: extents of a millionth.
constexpr double onOneLine = 1e-12;
/// Below this gap between eigenvalues, relative to the largest, the closed form loses digits.
constexpr double closeEigenvalues = 1e-4;
/// Times the largest offset, it leaves 2^22 to 2^24 steps in one; the squares of mostExactlySummed
/// such numbers are less than 2^53 steps, which a double holds.
constexpr double roundingFactor = 1.5 * (1 << 30);
struct Moments
{
  double count = 0.0;
  glm::dvec3 sum{ 0.0 };
  glm::dvec3 squares{ 0.0 };  ///< xx, yy, zz
  glm::dvec3 products{ 0.0 }; ///< xy, xz, yz
};

/// GCC's and Clang's vector types: one operation for two numbers on any machine that has such.
using Pair = double __attribute__((vector_size(16)));

Moments momentsOf(const std::vector<NearPoint>& points, const glm::dvec3& origin)
{
  double farthest = 0.0;
  std::uint64_t count = 0;
  for (const NearPoint& point : points)
  {
    farthest = std::max(farthest, point.squaredDistance);
    count += point.count;
  }
  // Added to an offset and taken away again, it leaves a multiple of a step.
  const double rounding = count > mostExactlySummed ? 0.0 : roundingFactor * std::sqrt(farthest);
  const Pair originXY{ origin.x, origin.y };
  Pair sumXY{};
  Pair squaresXY{}; // xx, yy
  Pair productsZ{}; // xz, yz
  Pair sumZ{};      // z, zz
  double productXY = 0.0;
  for (const NearPoint& point : points)
  {
    const double weight = point.count;
    const Pair xy = (Pair{ point.position.x, point.position.y } - originXY + rounding) - rounding;
    const double z = (point.position.z - origin.z + rounding) - rounding;
    const Pair weightedXY = weight * xy;
    sumXY += weightedXY;
    squaresXY += weightedXY * xy;
    productsZ += weightedXY * z;
    sumZ += weight * z * Pair{ 1.0, z };
    productXY += weightedXY[0] * xy[1];
  }
  Moments moments;
  moments.count = static_cast<double>(count);
  moments.sum = { sumXY[0], sumXY[1], sumZ[0] };
  moments.squares = { squaresXY[0], squaresXY[1], sumZ[1] };
  moments.products = { productXY, productsZ[0], productsZ[1] };
  return moments;
}
} // namespace

std::optional<SurfaceFit> fitSurface(
  const glm::dvec3& origin, const std::vector<NearPoint>& points)
{
  if (points.size() < 3)
  {
    return std::nullopt;
  }
  const Moments moments = momentsOf(points, origin);
  const glm::dvec3 mean = moments.sum / moments.count;
  const glm::dvec3 squares = moments.squares / moments.count - mean * mean;
  const glm::dvec3 products = moments.products / moments.count -
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
