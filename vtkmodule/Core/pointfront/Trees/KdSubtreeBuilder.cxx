#include "pointfront/Trees/KdSubtreeBuilder.h"

#include "pointfront/Base/CpuClock.h"
#include "pointfront/Records/MortonOrder.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace pointfront
{
namespace
{
constexpr unsigned intervalsLog2 = 11;

RecordSpan viewOf(const std::vector<TreePosition>& positions)
{
  return { reinterpret_cast<const std::byte*>(positions.data()), sizeof(TreePosition) };
}
} // namespace

RecordSpan KdSubtreeBuilder::sortedPoints(std::vector<std::byte> records, std::size_t count)
{
  positions_.resize(std::max(positions_.size(), count));
  return sorted(std::move(records), count,
    [&](std::size_t i, const std::byte* record) { positions_[i] = positionOf(record); });
}

OpenSubtree KdSubtreeBuilder::build(
  std::vector<std::byte> records, std::size_t count, std::uint32_t node)
{
  if (count == 0)
  {
    return {};
  }
  const RecordSpan view = sortedPoints(std::move(records), count);
  active_.resize(count);
  std::iota(active_.begin(), active_.end(), 0u);
  countSteps(active_);
  Region all{ 0, count, 0.0 };
  OpenSubtree subtree;
  subtree.records = owed(view, node, all);
  subtree.root = this->node(view, all);
  return subtree;
}

/// All that is owed is taken at once, evenly spread; the nodes farthest above choose among it
/// first.
std::vector<std::byte> KdSubtreeBuilder::owed(
  const RecordSpan& records, std::uint32_t node, Region& region)
{
  std::uint64_t total = 0;
  for (const KdShare& share : shares_[node])
  {
    total += share.points;
  }
  take(region, total);
  region.above = static_cast<double>(total);
  std::vector<std::uint32_t> rest = std::exchange(active_, std::move(held_));
  std::vector<std::uint8_t> restSteps = std::exchange(steps_, {});
  countSteps(active_);
  Region open{ 0, active_.size(), 0.0 };
  std::vector<std::byte> owedRecords;
  owedRecords.reserve(total * recordBytes_);
  for (const KdShare& share : shares_[node])
  {
    take(open, share.points);
    for (const std::uint32_t i : held_)
    {
      owedRecords.insert(owedRecords.end(), records.record(i), records.record(i) + recordBytes_);
    }
  }
  active_ = std::move(rest);
  steps_ = std::move(restSteps);
  return owedRecords;
}

void KdSubtreeBuilder::countSteps(const std::vector<std::uint32_t>& points)
{
  const CpuStopwatch watch(seconds_.sample);
  steps_.resize(points.size());
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    steps_[i] =
      static_cast<std::uint8_t>(differingBits(positions_[points[i]], positions_[points[i - 1]]));
  }
}

/// Along the Morton curve, two points differ in as many bits as the neighbours between them that
/// differ most: so steps_ is kept without asking again where the points are.
void KdSubtreeBuilder::take(Region& region, std::uint64_t wanted)
{
  const CpuStopwatch watch(seconds_.sample);
  points_.assign(active_.begin() + static_cast<std::ptrdiff_t>(region.begin),
    active_.begin() + static_cast<std::ptrdiff_t>(region.end));
  held_.clear();
  occupancy_ = cellOccupancy(steps_.data() + region.begin, points_.size());
  sampler_.choose(viewOf(positions_), points_, occupancy_, wanted, chosen_);
  std::size_t left = region.begin;
  std::size_t from = region.begin; // behind the last one taken
  std::uint8_t step = 0; // the largest of those taken since one was left
  const auto leave = [&](std::size_t end)
  {
    if (from < end)
    {
      steps_[from] = std::max(steps_[from], step);
      step = 0;
    }
    for (; from < end; ++from, ++left)
    {
      active_[left] = active_[from];
      steps_[left] = steps_[from];
    }
  };
  for (const std::uint32_t place : chosen_)
  {
    leave(region.begin + place);
    step = std::max(step, steps_[from]);
    held_.push_back(active_[from++]);
  }
  leave(region.end);
  region.end = left;
}

/// Places of `drawn` points in the region of points_, which are evenly spread: one each, as long as
/// there are so many among those of points_ and of the points above them.
double KdSubtreeBuilder::places(double drawn, double above) const
{
  const auto points = static_cast<double>(points_.size());
  const double share = static_cast<double>(occupancy_.places()) / points;
  return std::min(drawn, (points + above) * share);
}

/// Spacing of points with so many places in the region of points_.
double KdSubtreeBuilder::spacing(double places) const
{
  const unsigned side = differingBits(positions_[points_.front()], positions_[points_.back()]);
  const double all = surfaceSpacing(occupancy_, side);
  return all * std::sqrt(static_cast<double>(occupancy_.places()) / places) * space().stepLength();
}

/// Measured among a node's own points, whose places are some of those drawn there, evenly spread:
/// discs shrink as the square root of their number grows.
float KdSubtreeBuilder::splatRadius(
  const std::vector<std::uint32_t>& own, double ownPlaces, double places)
{
  const CpuStopwatch watch(seconds_.sample);
  const double share = std::sqrt(ownPlaces / places);
  return static_cast<float>(splat_.measure(viewOf(positions_), own) * share);
}

std::unique_ptr<BuiltNode> KdSubtreeBuilder::node(const RecordSpan& records, Region region)
{
  auto built = std::make_unique<BuiltNode>();
  const std::size_t count = region.end - region.begin;
  take(region, std::min<std::size_t>(count, rule_.nodePoints));
  const double drawn = static_cast<double>(held_.size()) + region.above;
  const double shown = places(drawn, region.above);
  built->row.spacing = static_cast<float>(spacing(shown));
  const std::vector<std::uint32_t> own = std::move(held_);
  held_ = {};
  const double ownPlaces = places(static_cast<double>(own.size()), region.above);
  built->row.splatRadius = splatRadius(own, ownPlaces, shown);
  seeSparse(*built, viewOf(positions_), own);
  if (region.end > region.begin)
  {
    const double left = static_cast<double>(region.end - region.begin);
    const std::size_t middle = divide(region);
    for (const auto& [begin, end] : { std::pair(region.begin, middle), { middle, region.end } })
    {
      if (begin < end)
      {
        built->children.push_back(
          node(records, { begin, end, drawn * static_cast<double>(end - begin) / left }));
      }
    }
  }
  emit(*built, records, own);
  return built;
}

unsigned KdSubtreeBuilder::longestAxis(
  const Region& region, std::uint32_t& low, std::uint32_t& high) const
{
  TreePosition lowest(UINT32_MAX);
  TreePosition highest(0);
  for (std::size_t i = region.begin; i < region.end; ++i)
  {
    lowest = glm::min(lowest, positions_[active_[i]]);
    highest = glm::max(highest, positions_[active_[i]]);
  }
  const TreePosition size = highest - lowest;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  low = lowest[axis];
  high = highest[axis];
  return static_cast<unsigned>(axis);
}

/// Puts the points of the left before those of the right, each in Morton order; where these begin.
std::size_t KdSubtreeBuilder::divide(const Region& region)
{
  const CpuStopwatch watch(seconds_.sample);
  const std::uint64_t wanted = kdLeftPoints(region.end - region.begin, rule_.nodePoints);
  if (wanted == region.end - region.begin)
  {
    return region.end;
  }
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  const auto axis = static_cast<int>(longestAxis(region, low, high));
  coordinates_.resize(std::max(coordinates_.size(), region.end));
  const auto coordinate = [&](std::size_t i) { return coordinates_[i]; };
  unsigned shift = 0;
  while ((high - low) >> shift >= 1u << intervalsLog2)
  {
    ++shift;
  }
  std::array<std::uint32_t, 1u << intervalsLog2> counts{};
  for (std::size_t i = region.begin; i < region.end; ++i)
  {
    coordinates_[i] = positions_[active_[i]][axis];
    ++counts[(coordinate(i) - low) >> shift];
  }
  std::uint64_t nth = wanted;
  std::uint32_t interval = 0;
  while (nth >= counts[interval])
  {
    nth -= counts[interval++];
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> inside; // coordinate, Morton order
  for (std::size_t i = region.begin; i < region.end; ++i)
  {
    if ((coordinate(i) - low) >> shift == interval)
    {
      inside.emplace_back(coordinate(i), active_[i]);
    }
  }
  const auto at = inside.begin() + static_cast<std::ptrdiff_t>(nth);
  std::nth_element(inside.begin(), at, inside.end());
  const std::pair<std::uint32_t, std::uint32_t> first = *at; // the first of the right half
  return separate(region, first);
}

/// Moves what is before `first` (coordinate, Morton order) to the left, each side in the order it
/// had; where the right begins. The coordinates are those of divide().
std::size_t KdSubtreeBuilder::separate(
  const Region& region, const std::pair<std::uint32_t, std::uint32_t>& first)
{
  right_.clear();
  rightSteps_.clear();
  std::size_t left = region.begin;
  std::uint8_t leftStep = 0; // the largest since the last one on that side
  std::uint8_t rightStep = 0;
  for (std::size_t i = region.begin; i < region.end; ++i)
  {
    const std::uint32_t point = active_[i];
    leftStep = std::max(leftStep, steps_[i]);
    rightStep = std::max(rightStep, steps_[i]);
    if (std::pair(coordinates_[i], point) < first)
    {
      steps_[left] = std::exchange(leftStep, std::uint8_t(0));
      active_[left++] = point;
    }
    else
    {
      rightSteps_.push_back(std::exchange(rightStep, std::uint8_t(0)));
      right_.push_back(point);
    }
  }
  std::copy(right_.begin(), right_.end(), active_.begin() + static_cast<std::ptrdiff_t>(left));
  std::copy(
    rightSteps_.begin(), rightSteps_.end(), steps_.begin() + static_cast<std::ptrdiff_t>(left));
  return left;
}

OpenSubtree KdSubtreeBuilder::join(std::vector<OpenSubtree> children, std::uint32_t node)
{
  OpenSubtree joined;
  joined.root = std::make_unique<BuiltNode>();
  std::vector<std::byte> own;
  std::vector<std::size_t> read(children.size(), 0);
  const std::size_t owed = shares_[node].size(); // the children owe to these, and to this node
  for (std::size_t level = 0; level <= owed; ++level)
  {
    std::vector<std::byte>& out = level == owed ? own : joined.records;
    for (std::size_t c = 0; c < children.size(); ++c)
    {
      const auto& records = children[c].records;
      const std::size_t bytes = shares_[tree_[node].children[c]][level].points * recordBytes_;
      const auto from = records.begin() + static_cast<std::ptrdiff_t>(read[c]);
      out.insert(out.end(), from, from + static_cast<std::ptrdiff_t>(bytes));
      read[c] += bytes;
    }
  }
  for (OpenSubtree& child : children)
  {
    joined.root->children.push_back(std::move(child.root));
  }
  const std::size_t count = own.size() / recordBytes_;
  const RecordSpan records = sortedPoints(std::move(own), count);
  points_.resize(count);
  std::iota(points_.begin(), points_.end(), 0u);
  occupancy_ = cellOccupancy(viewOf(positions_), points_);
  double above = 0.0;
  for (const KdShare& share : shares_[node])
  {
    above += static_cast<double>(share.points);
  }
  const auto ownPoints = static_cast<double>(count);
  const double shown = places(ownPoints + above, above);
  joined.root->row.spacing = static_cast<float>(spacing(shown));
  joined.root->row.splatRadius = splatRadius(points_, places(ownPoints, above), shown);
  seeSparse(*joined.root, records, points_);
  emit(*joined.root, records, points_);
  return joined;
}

} // namespace pointfront
