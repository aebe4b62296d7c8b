#include "pointfront/InPlace/LeafSplats.h"

#include "pointfront/InPlace/RunList.h"
#include "pointfront/Trees/BuiltTree.h"
#include "pointfront/Trees/NeighbourDistances.h"
#include "pointfront/Trees/Sampler.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pointfront
{
namespace
{
/// Ratio of radius to spacing of points that are chosen at random: the quantile that NodeSplat
/// takes, of a white noise on a plane (docs/adr/0017).
constexpr double randomRatio = 1.58;
/// Crowns and strips that overlap have up to so many times the surface of their squares. A picture
/// shows them as densely as the ground, so only what is more is taken for a wall or a volume.
constexpr double mostOfGround = 4.0;
constexpr double leastOfWalls = 8.0;
/// A leaf of more points is one of many slices of a place: its points lie over one another.
constexpr std::uint64_t mostPoints = std::uint64_t(1) << 20;

TreeSpace spaceOf(const QuantisationGrid& grid)
{
  TreeSpace space;
  space.grid = grid;
  return space;
}

float toFloat(double radius)
{
  return radius < std::numeric_limits<float>::max() ? roundedUp(radius) : 0.0f;
}
} // namespace

LeafSplats::LeafSplats(const QuadTree& tree, const GridRecords& records,
  const QuantisationGrid& grid, std::function<void(std::uint64_t, std::uint64_t)> released)
  : tree_(tree)
  , records_(records)
  , released_(std::move(released))
  , scale_(grid.scale)
  , stepArea_(grid.scale.x * grid.scale.y)
  , splat_(spaceOf(grid))
{
  const std::vector<QuadNode>& nodes = tree.nodes();
  std::vector<NodeIndex> leaves;
  for (NodeIndex i = 0; i < nodes.size(); ++i)
  {
    if (nodes[i].leaf() && nodes[i].points <= mostPoints)
    {
      leaves.push_back(i);
    }
  }
  const std::size_t count = std::min(mostMeasured, leaves.size());
  for (std::size_t m = 0; m < count; ++m)
  {
    measured_.push_back(leaves[(2 * m + 1) * leaves.size() / (2 * count)]);
  }
  radii_.resize(count, 0.0);
  lifts_.resize(count, 0.0);
}

bool LeafSplats::isSlice(NodeIndex node) const
{
  const NodeIndex parent = tree_.nodes()[node].parent;
  return parent != noNode && tree_.nodes()[parent].sliced;
}

double LeafSplats::pointSpacing(NodeIndex node) const
{
  const QuadNode& from = tree_.nodes()[node];
  const double drawn = std::ldexp(static_cast<double>(from.points), -from.logStep);
  return std::sqrt(nodeLifts_[node] * from.area * stepArea_ / drawn);
}

double LeafSplats::spacing(NodeIndex node) const
{
  return sparse_.ratio(node) * meanSpacing(node);
}

double LeafSplats::meanSpacing(NodeIndex node) const
{
  const double copies = points_ > 0 ? double(points_) / double(places_) : 1.0;
  const double every = std::ldexp(1.0, tree_.nodes()[node].logStep); // a point drawn of so many
  return pointSpacing(node) * std::sqrt(std::max(1.0, copies / every));
}

/// A cell may be far wider than the wall in it, so distances from above would say too much of how
/// upright it is: points at random lie half of their spacing from the nearest one.
double LeafSplats::liftOf(NodeIndex leaf, const NeighbourDistances& distances) const
{
  const QuadNode& square = tree_.nodes()[leaf];
  const double spacing = std::sqrt(square.area * stepArea_ / double(square.points));
  const double above = std::max(distances.fromAbove, 0.5 * spacing);
  const double times = distances.inSpace > distances.fromAbove ? distances.inSpace / above : 1.0;
  const double lift = times * times;
  const double rise = std::clamp((lift - mostOfGround) / (leastOfWalls - mostOfGround), 0.0, 1.0);
  return 1.0 + rise * (std::max(lift, leastOfWalls) - 1.0);
}

void LeafSplats::look(NodeIndex node, const std::vector<std::byte>& list)
{
  const auto found = std::lower_bound(measured_.begin(), measured_.end(), node);
  if (found == measured_.end() || *found != node)
  {
    return;
  }
  std::vector<TreePosition> positions;
  RunListReader runs(list.data(), list.size());
  for (Run run; runs.next(run);)
  {
    for (std::uint64_t i = run.first; i < run.first + run.count; ++i)
    {
      // The order of whole numbers, without their sign.
      positions.push_back(TreePosition(records_.position(i)) + TreePosition(1u << 31));
    }
    released_(run.first, run.first + run.count);
  }
  const auto m = static_cast<std::size_t>(found - measured_.begin());
  lifts_[m] = liftOf(node, NeighbourDistances::of(positions, scale_));
  if (isSlice(node)) // its points lie over those of other slices
  {
    return;
  }
  const RecordSpan view{ reinterpret_cast<const std::byte*>(positions.data()),
    sizeof(TreePosition) };
  const std::vector<std::uint32_t> order = mortonOrder(view, positions.size());
  radii_[m] = splat_.measure(view, order);
  points_ += order.size();
  places_ += placesOf(view, order);
}

double LeafSplats::nearby(const std::vector<double>& ofMeasured, NodeIndex leaf) const
{
  const auto behind = static_cast<std::size_t>(
    std::lower_bound(measured_.begin(), measured_.end(), leaf) - measured_.begin());
  const bool itself = behind < measured_.size() && measured_[behind] == leaf;
  double sum = 0.0;
  int count = 0;
  for (std::size_t m = behind - std::min<std::size_t>(behind, 1);
       m < std::min(behind + 1, ofMeasured.size()); ++m)
  {
    if (ofMeasured[m] > 0.0 && (!itself || m == behind))
    {
      sum += ofMeasured[m];
      ++count;
    }
  }
  return count > 0 ? sum / count : 0.0;
}

SparseLeaves LeafSplats::sparseLeaves() const
{
  std::vector<SparseLeaves::Square> squares;
  squares.reserve(tree_.nodes().size());
  for (NodeIndex i = 0; i < tree_.nodes().size(); ++i)
  {
    const QuadNode& node = tree_.nodes()[i];
    squares.push_back({ node.parent, node.sliced || (node.leaf() && !isSlice(i)), node.area,
      std::sqrt(nodeLifts_[i] * node.area / double(node.points)) });
  }
  return SparseLeaves(squares);
}

void LeafSplats::finish()
{
  const std::vector<QuadNode>& nodes = tree_.nodes();
  nodeLifts_.assign(nodes.size(), 1.0);
  for (std::size_t i = nodes.size(); i-- > 0;) // children come behind their parent
  {
    const QuadNode& node = nodes[i];
    double surface = 0.0;
    double area = 0.0;
    for (NodeIndex c = node.firstChild; c < node.firstChild + node.childCount; ++c)
    {
      surface += nodeLifts_[c] * nodes[c].area;
      area += nodes[c].area;
    }
    const double lift = node.leaf() ? nearby(lifts_, static_cast<NodeIndex>(i))
      : area > 0.0                  ? surface / area
                                    : 0.0;
    nodeLifts_[i] = std::max(1.0, lift);
  }
  sparse_ = sparseLeaves();
  for (std::size_t m = 0; m < measured_.size(); ++m)
  {
    const double spacing = pointSpacing(measured_[m]);
    radii_[m] = spacing > 0.0 ? radii_[m] / spacing : 0.0;
  }
}

void LeafSplats::fill(std::vector<Node>& nodes) const
{
  for (NodeIndex i = 0; i < nodes.size(); ++i)
  {
    nodes[i].splatRadius = nodes[i].leaf() ? toFloat(nearby(radii_, i) * pointSpacing(i))
                                           : toFloat(randomRatio * meanSpacing(i));
  }
}

} // namespace pointfront
