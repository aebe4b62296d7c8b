#include "pointfront/Neighbourhood/SplatCell.h"

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
constexpr double mostScales = 4.0; ///< of a closed cell on a surface
constexpr double openScales = 1.1; ///< of a cell at the rim: distances grow there, too
constexpr double lineWidth = 0.1; ///< of eigenvalues: narrower is a line
constexpr double planeFlatness = 0.05; ///< thicker is a volume
constexpr double volumeFourth = 0.6; ///< of the distance to the fourth neighbour
constexpr double noVertexFourth = 0.55; ///< likewise, of a cell without a vertex
constexpr std::size_t lineNeighbours = 8;
constexpr std::size_t fewestBeforeGap = 3;
constexpr double gapRatio = 2.0; ///< of distances of neighbours that follow each other
constexpr std::size_t fewestAround = 6; ///< neighbours, to call a point a stray
constexpr double strayNearest = 0.5; ///< distance of the second over that of the last
constexpr double strayDirection = 0.8; ///< length of the sum of offsets over the sum of lengths
constexpr double scaleOfSpread = 0.5; ///< local scale over the spread of points of a surface
constexpr std::size_t firstCheck = 6; ///< of whether more neighbours can cut a cell

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

/// Of the point and the first `count` of its neighbours, in units of `length`.
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

/// A point's Voronoi cell in its plane, cut from a square of 2 x 2 by its neighbours one after
/// another. In float: 16 codes of a radius are a doubling.
class CellPolygon
{
public:
  CellPolygon()
  {
    x_[0] = FourFloats{ -halfSide, halfSide, halfSide, -halfSide };
    y_[0] = FourFloats{ -halfSide, -halfSide, halfSide, halfSide };
  }

  /// By the line half way to a neighbour.
  void cut(float x, float y)
  {
    const float half = 0.5f * (x * x + y * y);
    if (!(half > 0.0f) || count_ > mostVertices - 2)
    {
      return;
    }
    std::array<FourFloats, fours> side; // > 0: nearer to the neighbour
    std::uint32_t beyond = 0;
    for (std::size_t f = 0; 4 * f < count_; ++f)
    {
      side[f] = x_[f] * x + y_[f] * y - half;
      beyond |= static_cast<std::uint32_t>(bitsOf(side[f] > 0.0f)) << (4 * f);
    }
    const std::uint32_t all = (1u << count_) - 1u;
    beyond &= all;
    if (beyond == 0 || beyond == all)
    {
      return;
    }
    // The polygon is convex: those beyond follow one another, round the end.
    const std::uint32_t before = (beyond << 1 | beyond >> (count_ - 1)) & all; // one has it before
    const auto begin = static_cast<std::size_t>(__builtin_ctz(~beyond & before & all)); // kept
    const auto end = static_cast<std::size_t>(__builtin_ctz(beyond & ~before & all)); // not
    std::array<FourFloats, fours> keptX;
    std::array<FourFloats, fours> keptY;
    std::size_t count = 0;
    const auto keep = [&](float vx, float vy)
    {
      keptX[count / 4][count % 4] = vx;
      keptY[count / 4][count % 4] = vy;
      ++count;
    };
    const auto at = [](const std::array<FourFloats, fours>& v, std::size_t i)
    { return v[i / 4][i % 4]; };
    const auto meet = [&](std::size_t from, std::size_t to)
    {
      const float share = at(side, from) / (at(side, from) - at(side, to));
      keep(at(x_, from) + share * (at(x_, to) - at(x_, from)),
        at(y_, from) + share * (at(y_, to) - at(y_, from)));
    };
    meet(begin == 0 ? count_ - 1 : begin - 1, begin);
    std::size_t last = begin;
    for (std::size_t i = begin; i != end; i = i + 1 == count_ ? 0 : i + 1)
    {
      keep(at(x_, i), at(y_, i));
      last = i;
    }
    meet(last, end);
    count_ = count;
    for (std::size_t f = 0; 4 * f < count_; ++f)
    {
      x_[f] = keptX[f];
      y_[f] = keptY[f];
    }
  }

  /// Of the farthest vertex.
  double squaredExtent() const
  {
    float squared = 0.0f;
    for (std::size_t i = 0; i < count_; ++i)
    {
      const float x = x_[i / 4][i % 4];
      const float y = y_[i / 4][i % 4];
      squared = std::max(squared, x * x + y * y);
    }
    return static_cast<double>(squared);
  }

  struct Reach
  {
    float squared = 0.0f; ///< distance of the farthest vertex between points; 0: there is none
    bool open = false; ///< the cell reaches the square
  };
  Reach reach() const
  {
    Reach result;
    for (std::size_t i = 0; i < count_; ++i)
    {
      const float x = x_[i / 4][i % 4];
      const float y = y_[i / 4][i % 4];
      const bool rim = std::max(std::abs(x), std::abs(y)) > 0.999f * halfSide;
      result.open = result.open || rim;
      result.squared = rim ? result.squared : std::max(result.squared, x * x + y * y);
    }
    return result;
  }

private:
  static constexpr float halfSide = 2.0f;
  static constexpr std::size_t mostVertices = 4 + NearOffsets::most + 1;
  static constexpr std::size_t fours = (mostVertices + 3) / 4;
  std::array<FourFloats, fours> x_; ///< of the vertices, counter-clockwise
  std::array<FourFloats, fours> y_;
  std::size_t count_ = 4;
};

/// The polar dual of a point's cell: neighbour p is q = 2 p / |p|^2, and v is in the cell where no
/// v . q is more than 1. Seen in a direction the cell ends at the line of the largest q; where that
/// is another one in the next direction there is a vertex between them, if no third line cuts it
/// off. No branch depends on the lines but for that: a third of the time of cutting.
class DualCell
{
public:
  /// Neighbours in the plane; those behind `count` are set far away.
  DualCell(std::array<FourFloats, 4> x, std::array<FourFloats, 4> y)
  {
    for (std::size_t f = 0; f < x.size(); ++f)
    {
      const FourFloats squared = x[f] * x[f] + y[f] * y[f];
      tooNear_ = tooNear_ || bitsOf(squared < leastSquared) != 0;
      const FourFloats share = 2.0f / squared;
      x[f] *= share;
      y[f] *= share;
    }
    std::memcpy(x_.data(), x.data(), sizeof x);
    std::memcpy(y_.data(), y.data(), sizeof y);
  }

  /// Squared distance of the farthest vertex. Nothing for a cell that is open or reaches
  /// `mostReach`, and where float does not tell lines apart.
  std::optional<float> farthestVertex() const
  {
    std::array<std::uint8_t, directions + 1> lines;
    if (tooNear_ || !findLines(lines))
    {
      return std::nullopt;
    }
    std::array<Vertex, directions> vertices;
    std::size_t count = 0;
    for (std::size_t k = 0; k < directions; ++k)
    {
      vertices[count] = { lines[k], lines[k + 1], 0.0f };
      count += lines[k] != lines[k + 1] ? 1 : 0;
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      if (!meet(vertices[i]))
      {
        return std::nullopt;
      }
    }
    for (int cuts = 0; cuts < mostCuts; ++cuts)
    {
      const auto farthest = std::max_element(vertices.begin(), vertices.begin() + count,
        [](const Vertex& a, const Vertex& b) { return a.squared < b.squared; });
      const int third = cutOffBy(*farthest);
      if (third < 0)
      {
        return farthest->squared < mostReach * mostReach ? std::optional<float>(farthest->squared)
                                                         : std::nullopt;
      }
      if (count == vertices.size())
      {
        return std::nullopt;
      }
      Vertex& other = vertices[count++];
      other = { static_cast<std::uint8_t>(third), farthest->to, 0.0f };
      farthest->to = static_cast<std::uint8_t>(third);
      if (!meet(*farthest) || !meet(other))
      {
        return std::nullopt;
      }
    }
    return std::nullopt;
  }

private:
  static constexpr std::size_t directions = 16;
  static constexpr float leastSquared = 1e-8f;
  static constexpr float mostReach = 1.99f;
  static constexpr float leastAngle = 1e-3f; ///< between lines that meet
  static constexpr float rounding = 1e-5f;
  static constexpr int mostCuts = 8;
  struct Vertex
  {
    std::uint8_t from; ///< line that it is on, and the next one counter-clockwise
    std::uint8_t to;
    float squared; ///< distance
  };

  /// In each direction, and the first once more. False where there is none.
  bool findLines(std::array<std::uint8_t, directions + 1>& lines) const
  {
    // cos and sin of 0, 22.5 ... 157.5 degrees; the others are opposite.
    constexpr float a = 0.92387953f;
    constexpr float b = 0.70710678f;
    constexpr float c = 0.38268343f;
    constexpr FourFloats cosines[2] = { { 1.0f, a, b, c }, { 0.0f, -c, -b, -a } };
    constexpr FourFloats sines[2] = { { 0.0f, c, b, a }, { 1.0f, a, b, c } };
    FourFloats most[2] = { FourFloats{}, FourFloats{} };
    FourFloats least[2] = { FourFloats{}, FourFloats{} };
    for (std::int32_t i = 0; i < 16; ++i)
    {
      const FourFloats x = fourTimes(x_[static_cast<std::size_t>(i)]);
      const FourFloats y = fourTimes(y_[static_cast<std::size_t>(i)]);
      for (std::size_t f = 0; f < 2; ++f)
      {
        // The last four bits say which line it is.
        const FourFloats along = cosines[f] * x + sines[f] * y;
        FourLanes bits;
        std::memcpy(&bits, &along, sizeof bits);
        bits = (bits & ~15) | i;
        FourFloats numbered;
        std::memcpy(&numbered, &bits, sizeof numbered);
        most[f] = most[f] > numbered ? most[f] : numbered;
        least[f] = least[f] < numbered ? least[f] : numbered;
      }
    }
    std::array<std::int32_t, directions> numbers;
    std::memcpy(numbers.data(), most, sizeof most);
    std::memcpy(numbers.data() + directions / 2, least, sizeof least);
    bool found = true;
    for (std::size_t k = 0; k < directions; ++k)
    {
      lines[k] = static_cast<std::uint8_t>(numbers[k] & 15);
      found = found && (numbers[k] & ~(15 | 1 << 31)) != 0;
    }
    lines[directions] = lines[0];
    return found;
  }

  /// False where two lines do not meet, or nearly not.
  bool meet(Vertex& vertex) const
  {
    const float ax = x_[vertex.from];
    const float ay = y_[vertex.from];
    const float bx = x_[vertex.to];
    const float by = y_[vertex.to];
    const float cross = ax * by - ay * bx;
    const float lengths = (ax * ax + ay * ay) * (bx * bx + by * by);
    vertex.squared = ((bx - ax) * (bx - ax) + (by - ay) * (by - ay)) / (cross * cross);
    return cross > 0.0f && cross * cross > leastAngle * leastAngle * lengths;
  }

  /// The line that cuts most off; -1: none.
  int cutOffBy(const Vertex& vertex) const
  {
    const float ax = x_[vertex.from];
    const float ay = y_[vertex.from];
    const float bx = x_[vertex.to];
    const float by = y_[vertex.to];
    const float share = 1.0f / (ax * by - ay * bx);
    const FourFloats vx = fourTimes((by - ay) * share);
    const FourFloats vy = fourTimes((ax - bx) * share);
    std::array<float, 16> along;
    std::size_t beyond = 0;
    for (std::size_t f = 0; f < 4; ++f)
    {
      const FourFloats four = fourFrom(&x_[4 * f]) * vx + fourFrom(&y_[4 * f]) * vy;
      std::memcpy(&along[4 * f], &four, sizeof four);
      beyond |= bitsOf(four > 1.0f + rounding) << (4 * f);
    }
    if (beyond == 0)
    {
      return -1;
    }
    return static_cast<int>(std::max_element(along.begin(), along.end()) - along.begin());
  }

  std::array<float, 16> x_; ///< of the lines, one a neighbour
  std::array<float, 16> y_;
  bool tooNear_ = false;
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
/// Of the cell among neighbours in a plane, in units of 1 / share, which the axes' lengths are.
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
  // Of neighbour number n, or of the last one.
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
