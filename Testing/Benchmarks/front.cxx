// What an update of the rendering front costs, and that it does not grow with the table: made-up
// terrain quadtrees of 10^4 to 10^8 nodes (10^12 points) that are computed when they are asked for.
// Besides the mean, each case reports p50_ms and p99_ms of its updates.

#include "pointfront/Front/RenderFront.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <vector>

namespace
{

using namespace pointfront;

constexpr double terrainSize = 1e5; // metres
constexpr std::uint32_t pointsOfNode = 10000;

/// A complete quadtree, breadth first. No table in memory: a node is computed from its number.
class TerrainTable final : public Hierarchy
{
public:
  explicit TerrainTable(int levels)
  {
    NodeIndex first = 0;
    for (int level = 0; level < levels; ++level)
    {
      firstOf_.push_back(first);
      first += NodeIndex(1) << (2 * level);
    }
    count_ = first;
  }

  NodeIndex nodeCount() const override { return count_; }
  const std::vector<NodeIndex>& roots() const override { return roots_; }
  Refinement refinement() const override { return Refinement::Add; }

  const Node& node(NodeIndex index) const override
  {
    thread_local Node node;
    const auto above = std::upper_bound(firstOf_.begin(), firstOf_.end(), index);
    const auto level = static_cast<std::uint8_t>(above - firstOf_.begin() - 1);
    const NodeIndex place = index - firstOf_[level];
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    for (int bit = 0; bit < level; ++bit)
    {
      x |= (place >> (2 * bit) & 1u) << bit;
      y |= (place >> (2 * bit + 1) & 1u) << bit;
    }
    const double size = terrainSize / double(NodeIndex(1) << level);
    node = Node();
    node.centre = { (x + 0.5) * size, (y + 0.5) * size, 0.0 };
    node.halfSize = glm::vec3(float(0.5 * size), float(0.5 * size), float(0.05 * size));
    node.radius = float(0.71 * size);
    node.spacing = float(size / 100.0);
    node.pointCount = pointsOfNode;
    node.level = level;
    node.parent = level == 0 ? noNode : firstOf_[level - 1] + place / 4;
    if (std::size_t(level) + 1 < firstOf_.size())
    {
      node.childCount = 4;
      node.firstChild = firstOf_[level + 1] + place * 4;
    }
    return node;
  }

private:
  std::vector<NodeIndex> firstOf_;
  std::vector<NodeIndex> roots_{ 0 };
  NodeIndex count_ = 0;
};

class AllResident final : public ResidencyView
{
public:
  explicit AllResident(std::uint64_t revision)
    : revision_(revision)
  {
  }
  State state(NodeIndex) const override { return State::Resident; }
  std::uint64_t revision() const override { return revision_; }

private:
  std::uint64_t revision_;
};

/// Low over the terrain, so that the front reaches from the first levels to the deepest.
View lowFlight(int levels, double along)
{
  const double height = terrainSize * std::exp2(-levels) * 10.0;
  const glm::dvec3 eye((0.02 + 0.1 * along) * terrainSize, 0.3 * terrainSize, height);
  return View::perspective(
    eye, eye + glm::dvec3(1.0, 0.4, -0.3), { 0, 0, 1 }, 0.8, 0.1, 2 * terrainSize, 1920, 1080);
}

enum Motion
{
  Still,      ///< and the residency tells that nothing changed: what a view at rest costs
  StillAsked, ///< everything is looked at anew
  Moving      ///< to and fro over a hundredth of the terrain in 2,000 updates
};

/// The error at which the front of that view has some 2,000 nodes.
double errorFor2000(const std::shared_ptr<const Hierarchy>& table, int levels)
{
  AllResident residency(0);
  for (double error = 50.0; error > 0.01; error *= 0.96)
  {
    RenderFront front(table);
    FrontLimits limits;
    limits.targetErrorPx = limits.initialErrorPx = error;
    limits.movesPerFrame = 100000;
    for (int u = 0; u < 20; ++u)
    {
      front.update(lowFlight(levels, 0.0), residency, limits);
    }
    if (front.update(lowFlight(levels, 0.0), residency, limits).frontLength >= 2000)
    {
      return error;
    }
  }
  return 0.01;
}

void frontUpdate(benchmark::State& state)
{
  const auto levels = static_cast<int>(state.range(0));
  const auto motion = static_cast<Motion>(state.range(1));
  const auto table = std::make_shared<TerrainTable>(levels);
  FrontLimits limits;
  limits.targetErrorPx = limits.initialErrorPx = errorFor2000(table, levels);
  limits.pointBudget = 50000000;
  AllResident residency(motion == Still ? 1 : 0);
  RenderFront front(table);
  const FrontDelta* delta = nullptr;
  for (int u = 0; u < 500; ++u)
  {
    delta = &front.update(lowFlight(levels, 0.0), residency, limits);
  }
  std::vector<double> times;
  for (auto _ : state)
  {
    const double phase = 6.2831853 * double(times.size() % 2000) / 2000.0;
    const double along = motion == Moving ? 0.05 * std::sin(phase) : 0.0;
    const View view = lowFlight(levels, along);
    const auto begin = std::chrono::steady_clock::now();
    delta = &front.update(view, residency, limits);
    const std::chrono::duration<double, std::milli> time =
      std::chrono::steady_clock::now() - begin;
    times.push_back(time.count());
    benchmark::DoNotOptimize(delta->pointsDrawn);
  }
  std::sort(times.begin(), times.end());
  state.counters["p50_ms"] = times[times.size() / 2];
  state.counters["p99_ms"] = times[times.size() * 99 / 100];
  state.counters["front"] = delta->frontLength;
  state.counters["nodes_drawn"] = double(delta->draw.size());
  state.counters["table_nodes"] = table->nodeCount();
  state.counters["table_points"] = double(table->nodeCount()) * pointsOfNode;
}

} // namespace

// 7, 11 and 14 levels: 5,461, 1,398,101 and 89,478,485 nodes.
BENCHMARK(frontUpdate)
  ->ArgNames({ "levels", "motion" })
  ->ArgsProduct({ { 7, 11, 14 }, { Still, StillAsked, Moving } })
  ->Unit(benchmark::kMillisecond);

BENCHMARK_MAIN();
