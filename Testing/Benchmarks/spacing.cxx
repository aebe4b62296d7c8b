// usage: pointfrontSpacingBenchmark STORE [LEVEL]
//
// How evenly an inner level of a store covers its cloud. For nodes of the level (3), spread over
// the table: the points that are drawn when the node and all above it are, inside the node's box;
// as many picked at random from all points in the box; and as many darts: all points in
// random order, each kept if it is not closer than a distance to one before (by bisection).
// Prints the distances to the nearest neighbour in units of the darts' mean: means, 5th
// percentiles, histogram. 1 is as good as Poisson disk; random points of a plane are at about 0.56.

#include "pointfront/Store/PointStore.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <random>
#include <unordered_map>
#include <vector>

namespace
{
using namespace pointfront;
using Points = std::vector<glm::dvec3>;

constexpr std::size_t mostNodes = 12;
constexpr std::size_t fewestPoints = 2000; ///< points of a node that is measured
constexpr unsigned seed = 1;

[[noreturn]] void fail(const std::string& what)
{
  std::fprintf(stderr, "%s\n", what.c_str());
  std::exit(1);
}

/// Points by cells of one size; what is within one size of a point lies in 27 cells.
class PointCells
{
public:
  PointCells(double size, const glm::dvec3& low)
    : size_(size)
    , low_(low)
  {
  }
  void add(const glm::dvec3& p) { cells_[key(cellOf(p))].push_back(p); }
  /// Smallest distance to another point, if it is below the size; else infinite.
  double nearest(const glm::dvec3& p) const
  {
    double least = HUGE_VAL;
    const glm::ivec3 cell = cellOf(p);
    for (int i = 0; i < 27; ++i)
    {
      const auto found = cells_.find(key(cell + glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1));
      if (found != cells_.end())
      {
        for (const glm::dvec3& q : found->second)
        {
          least = p == q ? least : std::min(least, glm::distance(p, q));
        }
      }
    }
    return least <= size_ ? least : HUGE_VAL;
  }

private:
  glm::ivec3 cellOf(const glm::dvec3& p) const { return glm::ivec3((p - low_) / size_) + 1; }
  static std::uint64_t key(const glm::ivec3& c)
  {
    return std::uint64_t(std::uint32_t(c.x)) << 42 ^ std::uint64_t(std::uint32_t(c.y)) << 21 ^
      std::uint64_t(std::uint32_t(c.z));
  }
  double size_;
  glm::dvec3 low_;
  std::unordered_map<std::uint64_t, Points> cells_;
};

/// Distances from each point to its nearest other one, ascending; equal points count as one.
std::vector<double> nearestDistances(const Points& points, const Bounds& box, double guess)
{
  std::vector<double> distances;
  PointCells cells(2.0 * guess, box.low);
  for (const glm::dvec3& p : points)
  {
    cells.add(p);
  }
  for (const glm::dvec3& p : points)
  {
    double nearest = cells.nearest(p);
    if (!std::isfinite(nearest)) // a lone point: rare, so by looking at all
    {
      for (const glm::dvec3& q : points)
      {
        nearest = p == q ? nearest : std::min(nearest, glm::distance(p, q));
      }
    }
    distances.push_back(nearest);
  }
  std::sort(distances.begin(), distances.end());
  return distances;
}

/// `shuffled` in its order, each kept if it is at least `distance` from those before.
Points darts(const Points& shuffled, const Bounds& box, double distance)
{
  Points kept;
  PointCells cells(distance, box.low);
  for (const glm::dvec3& p : shuffled)
  {
    if (cells.nearest(p) >= distance)
    {
      kept.push_back(p);
      cells.add(p);
    }
  }
  return kept;
}

/// As many darts as `count`, as far as a distance gives that number.
Points dartsOfCount(const Points& shuffled, const Bounds& box, std::size_t count, double guess)
{
  double low = 0.25 * guess;
  double high = 4.0 * guess;
  Points best;
  for (int step = 0; step < 10; ++step)
  {
    const double middle = std::sqrt(low * high);
    best = darts(shuffled, box, middle);
    (best.size() > count ? low : high) = middle;
  }
  return best;
}

class Cloud
{
public:
  explicit Cloud(const std::string& path)
  {
    auto store = PointStore::open(path);
    if (!store)
    {
      fail(store.error().what);
    }
    store_ = *store;
  }
  const Hierarchy& tree() const { return *store_->hierarchy(); }
  /// Adds the node's points inside `box`.
  void add(NodeIndex node, const Bounds& box, Points& points) const
  {
    const Result<NodeColumns> columns = store_->read(node, {});
    if (!columns)
    {
      fail(columns.error().what);
    }
    for (const glm::u32vec3& p : columns->positions)
    {
      const glm::dvec3 world =
        store_->description().grid.toWorld(columns->origin + GridPosition(p));
      if (glm::all(glm::greaterThanEqual(world, box.low)) &&
        glm::all(glm::lessThanEqual(world, box.high)))
      {
        points.push_back(world);
      }
    }
  }
  void addBelow(NodeIndex node, const Bounds& box, Points& points) const
  {
    const Node& parent = tree().node(node);
    for (NodeIndex i = 0; i < parent.childCount; ++i)
    {
      add(parent.firstChild + i, box, points);
      addBelow(parent.firstChild + i, box, points);
    }
  }

private:
  std::shared_ptr<const PointStore> store_;
};

/// Nearest distances of one way to choose, over all nodes, in units of the darts' mean.
struct Spacings
{
  const char* name = "";
  std::vector<double> relative;
  double sumOfMeans = 0.0;
  double sumOfFifths = 0.0;

  void add(const std::vector<double>& distances, double unit)
  {
    const double sum = std::accumulate(distances.begin(), distances.end(), 0.0);
    sumOfMeans += sum / double(distances.size()) / unit;
    sumOfFifths += distances[distances.size() / 20] / unit;
    for (const double d : distances)
    {
      relative.push_back(d / unit);
    }
  }
};

void measure(const Cloud& cloud, NodeIndex index, std::array<Spacings, 3>& spacings)
{
  const Node& node = cloud.tree().node(index);
  Points shown;
  for (NodeIndex i = index; i != noNode; i = cloud.tree().node(i).parent)
  {
    cloud.add(i, node.box(), shown);
  }
  Points all = shown;
  cloud.addBelow(index, node.box(), all);
  std::mt19937_64 random(seed);
  std::shuffle(all.begin(), all.end(), random);
  const double guess = node.spacing;
  const Points thrown = dartsOfCount(all, node.box(), shown.size(), guess);
  all.resize(shown.size());
  const std::vector<double> reference = nearestDistances(thrown, node.box(), guess);
  const double unit =
    std::accumulate(reference.begin(), reference.end(), 0.0) / double(reference.size());
  spacings[0].add(nearestDistances(shown, node.box(), guess), unit);
  spacings[1].add(nearestDistances(all, node.box(), guess), unit);
  spacings[2].add(reference, unit);
  std::printf("node %u: %zu points shown, %zu darts, spacing %.3f\n", index, shown.size(),
    thrown.size(), double(node.spacing));
}

void print(const std::array<Spacings, 3>& spacings, std::size_t nodes)
{
  std::printf("\n%-12s %8s %8s", "", "mean", "5 %");
  constexpr int bins = 10;
  for (int bin = 0; bin < bins; ++bin)
  {
    std::printf(" %6.1f", 0.2 * bin);
  }
  std::printf("+\n");
  for (const Spacings& s : spacings)
  {
    std::printf(
      "%-12s %8.3f %8.3f", s.name, s.sumOfMeans / double(nodes), s.sumOfFifths / double(nodes));
    std::array<std::size_t, bins> histogram{};
    for (const double d : s.relative)
    {
      ++histogram[std::size_t(std::min(double(bins) - 1.0, d / 0.2))];
    }
    for (const std::size_t count : histogram)
    {
      std::printf(" %5.1f%%", 100.0 * double(count) / double(s.relative.size()));
    }
    std::printf("\n");
  }
}
} // namespace

int main(int argc, char** argv)
{
  if (argc < 2 || argc > 3)
  {
    fail("usage: pointfrontSpacingBenchmark STORE [LEVEL]");
  }
  const Cloud cloud(argv[1]);
  const int level = argc == 3 ? std::atoi(argv[2]) : 3;
  std::vector<NodeIndex> nodes;
  for (NodeIndex i = 0; i < cloud.tree().nodeCount(); ++i)
  {
    const Node& node = cloud.tree().node(i);
    if (node.level == level && !node.leaf() && node.pointCount >= fewestPoints)
    {
      nodes.push_back(i);
    }
  }
  if (nodes.empty())
  {
    fail("no inner node of level " + std::to_string(level) + " has enough points");
  }
  std::array<Spacings, 3> spacings{};
  spacings[0].name = "store";
  spacings[1].name = "random";
  spacings[2].name = "darts";
  const std::size_t measured = std::min(mostNodes, nodes.size());
  for (std::size_t i = 0; i < measured; ++i)
  {
    measure(cloud, nodes[i * nodes.size() / measured], spacings);
  }
  print(spacings, measured);
  return 0;
}
