#include "pointfront/Neighbourhood/SplatCell.h"

#include "pointfront/Base/Infinity.h"
#include "pointfront/Neighbourhood/FourLanes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace pointfront
{
namespace
{
/// Larger than what is needed at the point, because discs are drawn smaller where depth is decided,
/// and neighbours' cells differ.
constexpr double overReach = 1.25;
/// Farthest Voronoi vertex over the median distance to 15 neighbours: median over a surface.
constexpr double vertexOfMedianDistance = 0.5;
constexpr double mostScales = 4.0;      ///< of a closed cell on a surface
constexpr double openScales = 1.1;      ///< of a cell at the rim: distances grow there, too
constexpr double lineWidth = 0.1;       ///< of eigenvalues: narrower is a line
constexpr double planeFlatness = 0.05;  ///< thicker is a volume
constexpr double volumeFourth = 0.6;    ///< of the distance to the fourth neighbour
constexpr double noVertexFourth = 0.55; ///< likewise, of a cell without a vertex
constexpr std::size_t lineNeighbours = 8;
constexpr std::size_t firstCheck = 6; ///< of whether more neighbours can cut a cell

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
    const auto end = static_cast<std::size_t>(__builtin_ctz(beyond & ~before & all));   // not
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
    bool open = false;    ///< the cell reaches the square
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

bool NearOffsets::assignSorted(const glm::dvec3* offsets, std::size_t count)
{
  constexpr std::size_t room = most + 1;
  if (count > room)
  {
    return false;
  }
  std::array<double, room> squared{};
  double largest = 0.0;
  for (std::size_t i = 0; i < count; ++i)
  {
    squared[i] = squaredLength(offsets[i]);
    largest = std::max(largest, squared[i]);
  }
  // Keys of 27 bits of distance and 4 of number; each one's place is how many are less.
  const double scale = largest > 1e-290 ? double(1 << 27) * (1.0 - 1e-9) / largest : 0.0;
  alignas(16) std::array<std::int32_t, room> keys;
  keys.fill(std::numeric_limits<std::int32_t>::max());
  for (std::size_t i = 0; i < count; ++i)
  {
    keys[i] = static_cast<std::int32_t>(squared[i] * scale) << 4 | static_cast<std::int32_t>(i);
  }
  std::array<FourLanes, room / 4> places{};
  std::array<FourLanes, room / 4> fours;
  std::memcpy(fours.data(), keys.data(), sizeof fours);
  for (const std::int32_t key : keys)
  {
    const FourLanes other{ key, key, key, key };
    for (std::size_t f = 0; f < fours.size(); ++f)
    {
      places[f] -= other < fours[f]; // true is -1
    }
  }
  std::array<std::int32_t, room> order{};
  for (std::size_t i = 0; i < count; ++i)
  {
    order[static_cast<std::size_t>(places[i / 4][i % 4])] = keys[i];
  }
  count_ = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto from = static_cast<std::size_t>(order[i] & 15);
    if (i > 0 && order[i] >> 4 == order[i - 1] >> 4)
    {
      return false;
    }
    if (squared[from] > 0.0 && count_ < most)
    {
      entries_[count_++] = { offsets[from], squared[from] };
    }
  }
  return true;
}

void NearOffsets::assign(const glm::dvec3* offsets, std::size_t count)
{
  if (assignSorted(offsets, count))
  {
    return;
  }
  begin();
  for (std::size_t i = 0; i < count; ++i)
  {
    add(offsets[i]);
  }
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
  // Of neighbour number n, or of the last one.
  const auto distance = [&](std::size_t n)
  { return std::sqrt(near.squaredDistance(std::min(n, count) - 1)); };
  const double scale = vertexOfMedianDistance * distance((count + 1) / 2);
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
  CellPolygon cell;
  for (std::size_t i = 0; i < count; ++i)
  {
    const bool check = i >= firstCheck && i % 2 == 0;
    if (check && near.squaredDistance(i) * share * share > 4.0 * cell.squaredExtent())
    {
      break; // half way to it and to all behind it is beyond every vertex
    }
    cell.cut(static_cast<float>(glm::dot(near[i], first)),
      static_cast<float>(glm::dot(near[i], second)));
  }
  const CellPolygon::Reach found = cell.reach();
  if (rim != nullptr)
  {
    *rim = found.open;
  }
  const double vertex = length * std::sqrt(static_cast<double>(found.squared));
  const double reach =
    vertex > 0.0 ? std::min(vertex, length) : noVertexFourth * distance(4);
  if (plane.flatness < planeFlatness)
  {
    return overReach * (found.open ? openScales * scale : std::min(reach, mostScales * scale));
  }
  return overReach * std::min({ reach, volumeFourth * distance(4), scale });
}

} // namespace pointfront
