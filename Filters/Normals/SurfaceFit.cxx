#include "SurfaceFit.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace pointfront
{
namespace
{
/// Squared: extents of a millionth.
constexpr double onOneLine = 1e-12;
/// Below this gap between eigenvalues whose sum is 1 roots of a polynomial lose digits.
constexpr double closeEigenvalues = 1e-4;
/// Newton's steps double the digits, unless roots are close.
constexpr int mostNewtonSteps = 16;
/// Share of the root: the step after one of that size would change its last bits.
constexpr double newtonStep = 1e-9;
/// Times the largest offset, it leaves 2^22 to 2^24 steps in one; the squares of mostExactlySummed
/// such numbers are less than 2^53 steps, which a double holds.
constexpr double roundingFactor = 1.5 * (1 << 30);
struct Moments
{
  double count = 0.0;
  glm::dvec3 sum{ 0.0 };
  glm::dvec3 squares{ 0.0 }; ///< xx, yy, zz
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
  Pair sumZ{}; // z, zz
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

/// The eigenvalues, smallest first, of a matrix that has no negative ones and a sum of 1. Nothing
/// where the two smallest are too close to one another for that way.
/// Way     the smallest root of the characteristic polynomial by Newton's steps from 0, which do
///         not pass it: less time than the closed form, with its arctangent and two sines.
std::optional<glm::dvec3> separateEigenvalues(const glm::dvec3& squares, const glm::dvec3& products)
{
  const double xy = products.x * products.x;
  const double xz = products.y * products.y;
  const double yz = products.z * products.z;
  const double minors = squares.x * squares.y + squares.x * squares.z + squares.y * squares.z - //
    (xy + xz + yz);
  const double determinant = squares.x * squares.y * squares.z +
    2.0 * products.x * products.y * products.z - (squares.x * yz + squares.y * xz + squares.z * xy);
  double smallest = 0.0;
  double step = 1.0;
  for (int steps = 0; steps < mostNewtonSteps; ++steps)
  {
    if (std::abs(step) <= newtonStep * std::abs(smallest))
    {
      break;
    }
    const double value = ((smallest - 1.0) * smallest + minors) * smallest - determinant;
    const double slope = (3.0 * smallest - 2.0) * smallest + minors;
    step = value / slope;
    smallest -= step;
  }
  const double others = 1.0 - smallest;
  const double apart = std::sqrt(others * others - 4.0 * (minors - smallest * others));
  const glm::dvec3 roots(smallest, 0.5 * (others - apart), 0.5 * (others + apart));
  // Not true for what is not a number: no slope, or roots that rounding made complex.
  return roots.y - roots.x >= closeEigenvalues ? std::optional<glm::dvec3>(roots) : std::nullopt;
}

/// The eigenvector of an eigenvalue that differs from both others, of length 1.
/// Way     the rows of the matrix less the eigenvalue on its diagonal span a plane to which the
///         eigenvector is normal. Of the cross products of two rows the longest has the most
///         digits.
Eigen::Vector3d eigenvectorOf(const Eigen::Matrix3d& matrix, double eigenvalue)
{
  const double largest = matrix.cwiseAbs().maxCoeff();
  Eigen::Matrix3d rows = matrix / largest; // squares of what is small keep their digits
  rows.diagonal().array() -= eigenvalue / largest;
  const std::array<Eigen::Vector3d, 3> normals{ rows.row(0).cross(rows.row(1)),
    rows.row(0).cross(rows.row(2)), rows.row(1).cross(rows.row(2)) };
  const auto longest = std::max_element(normals.begin(), normals.end(),
    [](const auto& a, const auto& b) { return a.squaredNorm() < b.squaredNorm(); });
  return *longest / std::sqrt(longest->squaredNorm());
}
} // namespace

std::optional<SurfaceFit> fitSurface(const glm::dvec3& origin, const std::vector<NearPoint>& points)
{
  if (points.size() < 3)
  {
    return std::nullopt;
  }
  const Moments moments = momentsOf(points, origin);
  const glm::dvec3 mean = moments.sum / moments.count;
  glm::dvec3 squares = moments.squares / moments.count - mean * mean;
  glm::dvec3 products = moments.products / moments.count -
    glm::dvec3(mean.x * mean.y, mean.x * mean.z, mean.y * mean.z);
  const double trace = squares.x + squares.y + squares.z;
  if (!(trace > 0.0))
  {
    return std::nullopt;
  }
  squares /= trace;
  products /= trace;
  Eigen::Matrix3d covariance;
  covariance << squares.x, products.x, products.y, //
    products.x, squares.y, products.z, //
    products.y, products.z, squares.z;
  Eigen::Vector3d eigenvalues;
  Eigen::Vector3d normal;
  if (const auto separate = separateEigenvalues(squares, products))
  {
    eigenvalues = { separate->x, separate->y, separate->z };
    normal = eigenvectorOf(covariance, eigenvalues[0]);
  }
  else
  {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
    eigenvalues = solver.eigenvalues();
    normal = solver.eigenvectors().col(0);
  }
  if (!(eigenvalues[1] > onOneLine * eigenvalues[2]))
  {
    return std::nullopt;
  }
  SurfaceFit fit;
  fit.normal = { normal[0], normal[1], normal[2] };
  fit.curvature = std::max(0.0, eigenvalues[0]); // the trace is 1
  fit.width = eigenvalues[1] / eigenvalues[2];
  fit.centre = origin + mean;
  return fit;
}

} // namespace pointfront
