#include "pointfront/Trees/NodeSplat.h"

#include "pointfront/Base/Infinity.h"
#include "pointfront/Trees/BuiltTree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pointfront
{
namespace
{
/// Larger leaves more bloat, smaller more holes where points are unevenly dense (docs/adr/0017).
constexpr double quantile = 0.85;
/// A leaf that grows together with others is measured before: less for fewer points.
constexpr std::size_t pointsOfGroup = 1536;
constexpr std::size_t fewestGroups = 2;
constexpr std::size_t mostGroups = 8;
constexpr std::size_t askedOfGroup = 6;
/// Squared: the last neighbour is hardly farther than that of a point near by.
constexpr double likelyFarther = 1.7;
/// Points of a cell around which neighbours are looked for in the cells beside it: on a surface as
/// in a volume, the nearest 15 are not farther than its side.
constexpr std::size_t pointsOfCell = 12;
/// Points in all these cells together: fewer have not enough neighbours, more take long.
constexpr std::size_t leastAround = 2 * NearOffsets::most;
constexpr std::size_t mostAround = 1024;
constexpr unsigned largestLog2 = 31;
constexpr std::size_t middleCell = 13;

glm::dvec3 lengthsOf(const TreeSpace& space)
{
  glm::dvec3 lengths;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int bits = -static_cast<int>(space.shift[static_cast<std::size_t>(axis)]);
    lengths[axis] = std::ldexp(space.grid.scale[axis], bits);
  }
  return lengths;
}

/// The first number from which on `before` is not true, looked for from `near` on in steps that
/// double: cells side by side are mostly not far apart on the curve.
template <typename Before>
std::size_t firstNot(std::size_t size, std::size_t near, const Before& before)
{
  std::size_t begin = near;
  std::size_t end = near;
  for (std::size_t step = 1; end < size && before(end); step *= 2)
  {
    begin = end + 1;
    end = std::min(size, end + step);
  }
  if (end == near)
  {
    for (std::size_t step = 1; begin > 0 && !before(begin - 1); step *= 2)
    {
      end = begin - 1;
      begin -= std::min(begin, step);
    }
  }
  while (begin < end)
  {
    const std::size_t middle = begin + (end - begin) / 2;
    if (before(middle))
    {
      begin = middle + 1;
    }
    else
    {
      end = middle;
    }
  }
  return begin;
}
} // namespace

void SplatQuantile::add(
  const std::vector<glm::dvec3>& around, const std::vector<std::uint32_t>& asked)
{
  double likely = infinity;
  for (const std::uint32_t i : asked)
  {
    nearOf(around, around[i], likely);
    if (near_.size() < NearOffsets::most && likely < infinity)
    {
      nearOf(around, around[i], infinity);
    }
    likely = likelyFarther * near_.squaredBound();
    bool rim = false;
    const double radius = splatRadius(near_, neighbourPlane(near_), &rim);
    if (radius > 0.0)
    {
      (rim ? rims_ : radii_).push_back(radius);
    }
  }
}

void SplatQuantile::nearOf(
  const std::vector<glm::dvec3>& around, const glm::dvec3& from, double bound)
{
  near_.begin();
  for (const glm::dvec3& other : around)
  {
    const glm::dvec3 d = other - from;
    if (d.x * d.x + d.y * d.y + d.z * d.z <= bound)
    {
      near_.add(d);
      bound = std::min(bound, near_.squaredBound());
    }
  }
}

float SplatQuantile::radius()
{
  if (radii_.empty())
  {
    radii_ = rims_;
  }
  if (radii_.empty())
  {
    return 0.0f;
  }
  const auto at = static_cast<std::ptrdiff_t>(quantile * static_cast<double>(radii_.size() - 1));
  std::nth_element(radii_.begin(), radii_.begin() + at, radii_.end());
  const double found = radii_[static_cast<std::size_t>(at)];
  return found < std::numeric_limits<float>::max() ? roundedUp(found) : 0.0f;
}

NodeSplat::NodeSplat(const TreeSpace& space)
  : stepLengths_(lengthsOf(space))
{
}

NodeSplat::Range NodeSplat::inCell(const Points& points, std::size_t near, const OctreeCell& cell)
{
  const TreePosition last = cell.origin + TreePosition((1u << cell.log2Side) - 1u);
  const std::size_t begin = firstNot(
    points.size(), near, [&](std::size_t i) { return mortonLess(points[i], cell.origin); });
  if (begin == points.size() || differingBits(points[begin], cell.origin) > cell.log2Side)
  {
    return {};
  }
  return { begin,
    firstNot(points.size(), begin, [&](std::size_t i) { return !mortonLess(last, points[i]); }) };
}

/// Fills the cells around a point; how many points they have together.
std::size_t NodeSplat::cellsAround(const Points& points, std::size_t from, unsigned log2Side)
{
  const std::uint32_t side = 1u << log2Side;
  const TreePosition own = points[from] & TreePosition(~(side - 1u));
  std::size_t total = 0;
  for (std::size_t c = 0; c < cells_.size(); ++c)
  {
    TreePosition origin = own;
    bool inside = true; // it fits into 32 bits
    for (int axis = 0, number = static_cast<int>(c); axis < 3; ++axis, number /= 3)
    {
      const bool below = number % 3 == 0;
      const bool above = number % 3 == 2;
      inside = inside && !(below && own[axis] == 0) && !(above && own[axis] + side == 0);
      origin[axis] += above ? side : below ? 0u - side : 0u;
    }
    cells_[c] = inside ? inCell(points, from, { origin, log2Side }) : Range{};
    total += cells_[c].end - cells_[c].begin;
  }
  return total;
}

/// log2 of the side of cells that are likely to hold pointsOfCell points.
unsigned NodeSplat::likelySide(const Points& points, std::size_t from)
{
  const std::size_t last = points.size() - 1;
  const unsigned before = differingBits(points[from - std::min(from, pointsOfCell)], points[from]);
  const unsigned behind = differingBits(points[from], points[std::min(from + pointsOfCell, last)]);
  return std::min(from < pointsOfCell ? behind
      : from + pointsOfCell > last    ? before
                                      : std::min(before, behind),
    largestLog2);
}

void NodeSplat::lookAround(const Points& points, std::size_t from)
{
  unsigned log2Side = likelySide(points, from);
  std::size_t total = cellsAround(points, from, log2Side);
  while (total < std::min(leastAround, points.size()) && log2Side < largestLog2)
  {
    total = cellsAround(points, from, ++log2Side);
  }
  while (total > mostAround && log2Side > 0)
  {
    total = cellsAround(points, from, --log2Side);
  }
  const glm::dvec3 p(points[from]);
  const Range& middle = cells_[middleCell];
  const std::size_t stride = (middle.end - middle.begin + askedOfGroup - 1) / askedOfGroup;
  around_.clear();
  asked_.clear();
  for (const Range& cell : cells_)
  {
    for (std::size_t i = cell.begin; i < cell.end; ++i)
    {
      if (&cell == &middle && (i - cell.begin) % stride == 0)
      {
        asked_.push_back(static_cast<std::uint32_t>(around_.size()));
      }
      // Differences of whole numbers: exact wherever the node lies.
      around_.push_back((glm::dvec3(points[i]) - p) * stepLengths_);
    }
  }
}

float NodeSplat::measure(const RecordSpan& positions, const std::vector<std::uint32_t>& numbers)
{
  const Points points{ positions, numbers };
  quantile_.begin();
  const std::size_t count =
    std::min(numbers.size(), std::clamp(numbers.size() / pointsOfGroup, fewestGroups, mostGroups));
  for (std::size_t group = 0; group < count; ++group)
  {
    lookAround(points, (2 * group + 1) * numbers.size() / (2 * count));
    quantile_.add(around_, asked_);
  }
  return quantile_.radius();
}

} // namespace pointfront
