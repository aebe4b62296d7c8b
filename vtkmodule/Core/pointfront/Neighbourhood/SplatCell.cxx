#include "pointfront/Neighbourhood/SplatCell.h"

#include "pointfront/Neighbourhood/CellPolygon.h"
#include "pointfront/Neighbourhood/DualCell.h"
#include "pointfront/Neighbourhood/FourLanes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

namespace pointfront
{
namespace
{
/// Larger than what is needed at the point, because discs are drawn smaller where depth is decided,
/// and neighbours' cells differ.
constexpr double overReach = 1.25;
/// Farthest Voronoi vertex over the median distance to 15 neighbours: median over a surface.
constexpr double vertexOfMedianDistance = 0.5;
constexpr double mostScales = 4.0; ///< scales of a closed cell on a surface
constexpr double openScales = 1.1; ///< scales of a cell at the rim: distances grow there, too
constexpr double lineWidth = 0.1; ///< ratio of eigenvalues: narrower is a line
constexpr double planeFlatness = 0.05; ///< thicker is a volume
constexpr double volumeFourth = 0.6; ///< share of the distance to the fourth neighbour
constexpr double noVertexFourth = 0.55; ///< likewise, of a cell without a vertex
constexpr std::size_t lineNeighbours = 8;
constexpr std::size_t fewestBeforeGap = 3;
constexpr double gapRatio = 2.0; ///< ratio of distances of neighbours that follow each other
constexpr std::size_t fewestAround = 6; ///< neighbours, to call a point a stray
constexpr double strayNearest = 0.5; ///< distance of the second over that of the last
constexpr double strayDirection = 0.8; ///< length of the sum of offsets over the sum of lengths
constexpr double scaleOfSpread = 0.5; ///< local scale over the spread of points of a surface
constexpr std::size_t firstCheck = 6; ///< neighbours before the first check whether more cut a cell

double squaredLength(const glm::dvec3& v)
{
  return v.x * v.x + v.y * v.y + v.z * v.z;
}

/// Six sums of a covariance, not divided by the number of points.
struct Covariance
{
  glm::dvec3 squares{ 0.0 }; ///< xx, yy, zz
  glm::dvec3 products{ 0.0 }; ///< xy, xz, yz
};

/// Covariance of the point and the first `count` of its neighbours, in units of `length`.
Covariance covarianceOf(const NearOffsets& near, std::size_t count, double length)
{
  glm::dvec3 sum(0.0);
  Covariance c;
  const double share = 1.0 / length;
  for (std::size_t i = 0; i < count; ++i)
  {
    const glm::dvec3 v = near[i] * share;
    sum += v;
    c.squares += v * v;
    c.products += glm::dvec3(v.x * v.y, v.x * v.z, v.y * v.z);
  }
  const double n = static_cast<double>(count) + 1.0;
  c.squares -= sum * sum / n;
  c.products -= glm::dvec3(sum.x * sum.y, sum.x * sum.z, sum.y * sum.z) / n;
  return c;
}

/// Whether the point and its nearest neighbours are on a line: the sum of the products of two
/// eigenvalues over the square of their sum is that small only if the middle one is less than
/// lineWidth of the largest. Needs no eigenvalue.
bool onLine(const NearOffsets& near)
{
  const std::size_t count = std::min(near.size(), lineNeighbours);
  const double length = std::sqrt(near.squaredDistance(count - 1));
  const Covariance c = covarianceOf(near, count, length);
  const double trace = c.squares.x + c.squares.y + c.squares.z;
  const double minors = c.squares.x * c.squares.y + c.squares.x * c.squares.z +
    c.squares.y * c.squares.z - squaredLength(c.products);
  constexpr double least = lineWidth / ((1.0 + lineWidth) * (1.0 + lineWidth));
  return !(minors >= least * trace * trace);
}

/// How many neighbours are before a gap: what is twice as far as all the others belongs to
/// something else, as the trees beside a wire. All of them if there is none. On a surface of random
/// points three are followed by such a gap once in 10,000 times.
std::size_t countBeforeGap(const NearOffsets& near)
{
  std::size_t count = std::min(near.size(), fewestBeforeGap);
  while (count < near.size() &&
    near.squaredDistance(count) <= gapRatio * gapRatio * near.squaredDistance(count - 1))
  {
    ++count;
  }
  return count;
}

/// The local scale of what a stray's neighbours are, if the point is a stray: a bird over a field,
/// or two. All its neighbours are that way, and nearly as far as each other; the rim and the corner
/// of a surface and the end of a line have near ones.
std::optional<double> scaleBesideStray(const NearOffsets& near)
{
  const std::size_t count = near.size();
  const double most = near.squaredDistance(count - 1);
  if (count < fewestAround || near.squaredDistance(1) < strayNearest * strayNearest * most)
  {
    return std::nullopt;
  }
  glm::dvec3 sum(0.0);
  double lengths = 0.0, squares = 0.0;
  const double share = 1.0 / std::sqrt(most);
  for (std::size_t i = 1; i < count; ++i) // the nearest may be another one
  {
    const glm::dvec3 v = near[i] * share;
    sum += v;
    squares += squaredLength(v);
    lengths += std::sqrt(squaredLength(v));
  }
  if (squaredLength(sum) < strayDirection * strayDirection * lengths * lengths)
  {
    return std::nullopt;
  }
  const double n = static_cast<double>(count) - 1.0;
  const double spread2 = squares / n - squaredLength(sum) / (n * n);
  return scaleOfSpread * std::sqrt(std::max(spread2, 0.0)) / share;
}

/// Two directions of length 1 in the plane, square to one another.
void planeAxes(const glm::dvec3& normal, glm::dvec3& first, glm::dvec3& second)
{
  const glm::dvec3 other =
    std::abs(normal.x) < 0.7 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  first = glm::normalize(glm::cross(normal, other));
  second = glm::cross(normal, first);
}

/// One step of Jacobi's method: makes matrix[p][q] zero.
void rotate(double (&matrix)[3][3], double (&vectors)[3][3], int p, int q)
{
  constexpr double converged = 1e-16;
  if (std::abs(matrix[p][q]) <= converged * (matrix[p][p] + matrix[q][q]))
  {
    return;
  }
  const double theta = (matrix[q][q] - matrix[p][p]) / (2.0 * matrix[p][q]);
  const double t = (theta >= 0.0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
  const double cosine = 1.0 / std::sqrt(t * t + 1.0);
  const double sine = t * cosine;
  for (auto& row : matrix)
  {
    const double a = row[p];
    row[p] = cosine * a - sine * row[q];
    row[q] = sine * a + cosine * row[q];
  }
  for (int k = 0; k < 3; ++k)
  {
    const double a = matrix[p][k];
    matrix[p][k] = cosine * a - sine * matrix[q][k];
    matrix[q][k] = sine * a + cosine * matrix[q][k];
    const double v = vectors[k][p];
    vectors[k][p] = cosine * v - sine * vectors[k][q];
    vectors[k][q] = sine * v + cosine * vectors[k][q];
  }
}
/// Reach of the cell among neighbours in a plane, in units of 1 / share, the axes' lengths.
CellPolygon::Reach reachOf(
  const NearOffsets& near, const glm::dvec3& first, const glm::dvec3& second, double share)
{
  constexpr float far = 1e9f;
  std::array<float, 16> x;
  std::array<float, 16> y;
  near.project(first, second, far, x, y);
  std::array<FourFloats, 4> xFours;
  std::array<FourFloats, 4> yFours;
  std::memcpy(xFours.data(), x.data(), sizeof x);
  std::memcpy(yFours.data(), y.data(), sizeof y);
  if (const std::optional<float> squared = DualCell(xFours, yFours).farthestVertex())
  {
    return { *squared, false };
  }
  CellPolygon cell;
  for (std::size_t i = 0; i < near.size(); ++i)
  {
    const bool check = i >= firstCheck && i % 2 == 0;
    if (check && near.squaredDistance(i) * share * share > 4.0 * cell.squaredExtent())
    {
      break; // half way to it and to all behind it is beyond every vertex
    }
    cell.cut(
      static_cast<float>(glm::dot(near[i], first)), static_cast<float>(glm::dot(near[i], second)));
  }
  return cell.reach();
}
} // namespace

NeighbourPlane neighbourPlane(const NearOffsets& near)
{
  NeighbourPlane plane;
  if (near.size() == 0)
  {
    return plane;
  }
  const double length = std::sqrt(near.squaredDistance(near.size() - 1));
  const Covariance c = covarianceOf(near, near.size(), length);
  double matrix[3][3] = { { c.squares.x, c.products.x, c.products.y },
    { c.products.x, c.squares.y, c.products.z }, { c.products.y, c.products.z, c.squares.z } };
  double vectors[3][3] = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
  constexpr int sweeps = 6; // digits double with each
  for (int sweep = 0; sweep < sweeps; ++sweep)
  {
    rotate(matrix, vectors, 0, 1);
    rotate(matrix, vectors, 0, 2);
    rotate(matrix, vectors, 1, 2);
  }
  std::array<int, 3> order{ 0, 1, 2 }; // order of eigenvalues
  std::sort(order.begin(), order.end(), [&](int a, int b) { return matrix[a][a] < matrix[b][b]; });
  const auto value = [&](std::size_t i) { return std::max(0.0, matrix[order[i]][order[i]]); };
  const double sum = value(0) + value(1) + value(2);
  if (!(sum > 0.0))
  {
    return plane;
  }
  plane.normal = { vectors[0][order[0]], vectors[1][order[0]], vectors[2][order[0]] };
  plane.flatness = value(0) / sum;
  plane.width = value(1) / value(2);
  return plane;
}

double splatRadius(const NearOffsets& near, const NeighbourPlane& plane, bool* rim)
{
  if (rim != nullptr)
  {
    *rim = false;
  }
  const std::size_t count = near.size();
  if (count == 0)
  {
    return 0.0;
  }
  if (const std::size_t together = countBeforeGap(near); together < count)
  {
    NearOffsets group;
    group.begin();
    for (std::size_t i = 0; i < together; ++i)
    {
      group.add(near[i]);
    }
    return splatRadius(group, neighbourPlane(group), rim);
  }
  // Distance of neighbour number n, or of the last one.
  const auto distance = [&](std::size_t n)
  { return std::sqrt(near.squaredDistance(std::min(n, count) - 1)); };
  const double scale = vertexOfMedianDistance * distance((count + 1) / 2);
  if (const std::optional<double> beside = scaleBesideStray(near); beside && *beside > 0.0)
  {
    return overReach * std::min(*beside, scale);
  }
  // Two have no plane, and a point between its neighbours on a line touches both.
  if (count < 3 || plane.width < lineWidth || onLine(near))
  {
    return overReach * (count < 3 ? 0.5 * distance(2) : std::min(0.5 * distance(2), scale));
  }
  glm::dvec3 first;
  glm::dvec3 second;
  planeAxes(plane.normal, first, second);
  const double length = distance(8);
  const double share = 1.0 / length;
  first *= share;
  second *= share;
  const CellPolygon::Reach found = reachOf(near, first, second, share);
  if (rim != nullptr)
  {
    *rim = found.open;
  }
  const double vertex = length * std::sqrt(static_cast<double>(found.squared));
  const double reach = vertex > 0.0 ? std::min(vertex, length) : noVertexFourth * distance(4);
  if (plane.flatness < planeFlatness)
  {
    return overReach * (found.open ? openScales * scale : std::min(reach, mostScales * scale));
  }
  return overReach * std::min({ reach, volumeFourth * distance(4), scale });
}

} // namespace pointfront
