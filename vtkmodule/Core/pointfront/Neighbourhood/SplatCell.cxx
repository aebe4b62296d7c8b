#include "pointfront/Neighbourhood/SplatCell.h"

#include "pointfront/Base/Infinity.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pointfront
{
namespace
{
/// Larger than what is needed at the point, because discs are drawn smaller where depth is decided,
/// and neighbours' cells differ.
constexpr double margin = 1.25;
/// Farthest Voronoi vertex over the median distance to 15 neighbours: median over a surface.
constexpr double vertexOfMedianDistance = 0.5;
constexpr double mostScales = 4.0;      ///< of a closed cell on a surface
constexpr double openScales = 1.1;      ///< of a cell at the rim: distances grow there, too
constexpr double lineWidth = 0.1;       ///< of eigenvalues: narrower is a line
constexpr double planeFlatness = 0.05;  ///< thicker is a volume
constexpr double volumeFourth = 0.6;    ///< of the distance to the fourth neighbour
constexpr double noVertexFourth = 0.55; ///< likewise, of a cell without a vertex
constexpr std::size_t lineNeighbours = 8;
constexpr std::size_t mostVertices = 4 + NearOffsets::most + 1;

bool offsetLess(const glm::dvec3& a, const glm::dvec3& b)
{
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

double squaredLength(const glm::dvec3& v) { return v.x * v.x + v.y * v.y + v.z * v.z; }

/// Six sums of a covariance, not divided by the number of points.
struct Covariance
{
  glm::dvec3 squares{ 0.0 };  ///< xx, yy, zz
  glm::dvec3 products{ 0.0 }; ///< xy, xz, yz
};

/// Of the point and the first `count` of its neighbours, in units of `length`.
Covariance covarianceOf(const NearOffsets& near, std::size_t count, double length)
{
  glm::dvec3 sum(0.0);
  Covariance c;
  for (std::size_t i = 0; i < count; ++i)
  {
    const glm::dvec3 v = near[i] / length;
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

struct Vertex
{
  double x = 0.0;
  double y = 0.0;
  bool rim = false; ///< on the square that bounds the cell, not between three points
};

/// A point's Voronoi cell in its plane, cut from a square by its neighbours one after another.
class CellPolygon
{
public:
  explicit CellPolygon(double halfSide)
    : rimAt_(0.999 * halfSide)
    , farthest_(2.0 * halfSide * halfSide)
  {
    vertices_[0] = { -halfSide, -halfSide, true };
    vertices_[1] = { halfSide, -halfSide, true };
    vertices_[2] = { halfSide, halfSide, true };
    vertices_[3] = { -halfSide, halfSide, true };
  }

  void cut(double x, double y)
  {
    const double squared = x * x + y * y;
    if (!(squared > 0.0) || squared > 4.0 * farthest_) // half way is beyond every vertex
    {
      return;
    }
    const double half = 0.5 * squared;
    std::array<Vertex, mostVertices> kept;
    std::size_t count = 0;
    farthest_ = 0.0;
    const auto keep = [&](const Vertex& v)
    {
      kept[count++] = v;
      farthest_ = std::max(farthest_, v.x * v.x + v.y * v.y);
    };
    const Vertex* from = &vertices_[count_ - 1];
    double fromSide = from->x * x + from->y * y - half;
    for (std::size_t i = 0; i < count_ && count + 2 <= mostVertices; ++i)
    {
      const Vertex& to = vertices_[i];
      const double toSide = to.x * x + to.y * y - half;
      if ((fromSide <= 0.0) != (toSide <= 0.0))
      {
        const double share = fromSide / (fromSide - toSide);
        Vertex v{ from->x + share * (to.x - from->x), from->y + share * (to.y - from->y), false };
        v.rim = std::abs(v.x) > rimAt_ || std::abs(v.y) > rimAt_;
        keep(v);
      }
      if (toSide <= 0.0)
      {
        keep(to);
      }
      from = &to;
      fromSide = toSide;
    }
    vertices_ = kept;
    count_ = count;
  }

  bool open() const
  {
    return std::any_of(vertices_.begin(), vertices_.begin() + static_cast<std::ptrdiff_t>(count_),
      [](const Vertex& v) { return v.rim; });
  }
  /// Squared distance of the farthest vertex between points; 0: there is none.
  double squaredReach() const
  {
    double squared = 0.0;
    for (std::size_t i = 0; i < count_; ++i)
    {
      const Vertex& v = vertices_[i];
      squared = v.rim ? squared : std::max(squared, v.x * v.x + v.y * v.y);
    }
    return squared;
  }

private:
  std::array<Vertex, mostVertices> vertices_;
  std::size_t count_ = 4;
  double rimAt_;
  double farthest_;
};

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
  if (matrix[p][q] == 0.0)
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
} // namespace

double NearOffsets::squaredBound() const
{
  return count_ < most ? infinity : entries_[most - 1].squared;
}

void NearOffsets::add(const glm::dvec3& offset)
{
  const double squared = squaredLength(offset);
  const auto before = [&](const Entry& other)
  {
    return squared != other.squared ? squared < other.squared : offsetLess(offset, other.offset);
  };
  if (!(squared > 0.0) || (count_ == most && !before(entries_[most - 1])))
  {
    return;
  }
  std::size_t place = count_;
  while (place > 0 && before(entries_[place - 1]))
  {
    --place;
  }
  if (place > 0 && entries_[place - 1].offset == offset)
  {
    return; // a place is one neighbour, however many points it has
  }
  count_ = std::min(count_ + 1, most);
  for (std::size_t at = count_ - 1; at > place; --at)
  {
    entries_[at] = entries_[at - 1];
  }
  entries_[place] = { offset, squared };
}

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
  std::array<int, 3> order{ 0, 1, 2 }; // of eigenvalues
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

double splatRadius(const NearOffsets& near, const NeighbourPlane& plane)
{
  const std::size_t count = near.size();
  if (count == 0)
  {
    return 0.0;
  }
  // Of neighbour number n, or of the last one.
  const auto distance = [&](std::size_t n)
  { return std::sqrt(near.squaredDistance(std::min(n, count) - 1)); };
  const double scale = vertexOfMedianDistance * distance((count + 1) / 2);
  // Two have no plane, and a point between its neighbours on a line touches both.
  if (count < 3 || plane.width < lineWidth || onLine(near))
  {
    return margin * (count < 3 ? 0.5 * distance(2) : std::min(0.5 * distance(2), scale));
  }
  glm::dvec3 first;
  glm::dvec3 second;
  planeAxes(plane.normal, first, second);
  const double length = distance(8);
  CellPolygon cell(2.0);
  for (std::size_t i = 0; i < count; ++i)
  {
    cell.cut(glm::dot(near[i], first) / length, glm::dot(near[i], second) / length);
  }
  const double vertex = length * std::sqrt(cell.squaredReach());
  const double reach =
    vertex > 0.0 ? std::min(vertex, length) : noVertexFourth * distance(4);
  if (plane.flatness < planeFlatness)
  {
    return margin * (cell.open() ? openScales * scale : std::min(reach, mostScales * scale));
  }
  return margin * std::min({ reach, volumeFourth * distance(4), scale });
}

} // namespace pointfront
