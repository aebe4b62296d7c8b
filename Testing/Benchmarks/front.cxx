// Costs of an update of the rendering front, and that neither it nor memory grows with the table:
// made-up terrain quadtrees of 10^4 to 10^8 nodes (10^12 points), paged as those of a store are.
// Besides the mean, each case reports p50_ms and p99_ms of its updates, the pages that were read,
// the memory of those kept and of the process; at the end the ratios to the smallest table, also of
// the time for a node drawn: a tour over one table does not see quite as many as over another.

#include "pointfront/Front/RenderFront.h"
#include "pointfront/Store/MissingRows.h"

#include "TerrainPages.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace
{

using namespace pointfront;

constexpr double terrainSize = test::Terrain::sizeMetres;

/// Resident memory of this process, bytes.
double processBytes()
{
  std::ifstream statistics("/proc/self/statm");
  double pages = 0.0;
  double resident = 0.0;
  statistics >> pages >> resident;
  return resident * 4096.0;
}

class AllResident final : public ResidencySnapshot
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

enum Motion
{
  Still, ///< and the residency tells that nothing changed: what a view at rest costs
  StillAsked, ///< everything is looked at anew
  Moving, ///< to and fro over a hundredth of the terrain in 2,000 updates
  Rotating ///< once round in 2,000 updates, in the middle: as much terrain to every side
};

/// Low over the terrain, so that the front reaches from the first levels to the deepest.
View lowFlight(int levels, double x, double y, double turn)
{
  const double height = terrainSize * std::exp2(-levels) * 10.0;
  const glm::dvec3 eye(x * terrainSize, y * terrainSize, height);
  const glm::dvec3 ahead(std::cos(turn), std::sin(turn), -0.25);
  return View::perspective(eye, eye + ahead, { 0, 0, 1 }, 0.8, 0.1, 2 * terrainSize, 1920, 1080);
}

View viewOf(Motion motion, int levels, std::size_t update)
{
  const double phase = 6.2831853 * double(update % 2000) / 2000.0;
  if (motion == Rotating)
  {
    return lowFlight(levels, 0.5, 0.5, 0.4 + phase);
  }
  return lowFlight(levels, 0.3 + (motion == Moving ? 0.005 * std::sin(phase) : 0.0), 0.3, 0.4);
}

/// Until the front rests: rows of the table that it waits for are waited for.
const FrontDelta& settle(RenderFront& front, const Hierarchy& table, const View& view,
  const ResidencySnapshot& residency, const FrontLimits& limits)
{
  const FrontDelta* delta = nullptr;
  for (int u = 0; u < 5000; ++u)
  {
    const std::uint64_t seen = table.arrivals();
    delta = &front.update(view, residency, limits);
    if (delta->complete)
    {
      break;
    }
    if (delta->rowsComing)
    {
      table.waitForArrival(seen);
    }
  }
  return *delta;
}

/// The error at which the front of that view has some 2,000 nodes.
double errorFor2000(const std::shared_ptr<const Hierarchy>& table, Motion motion, int levels)
{
  AllResident residency(0);
  for (double error = 50.0; error > 0.01; error *= 0.96)
  {
    RenderFront front(table);
    FrontLimits limits;
    limits.targetErrorPx = limits.initialErrorPx = error;
    limits.movesPerFrame = 100000;
    const View view = viewOf(motion, levels, 0);
    if (settle(front, *table, view, residency, limits).frontLength >= 2000)
    {
      return error;
    }
  }
  return 0.01;
}

/// The outcome of one case, for the ratios; milliseconds.
struct Outcome
{
  double p50;
  double p99;
  double forNode; ///< all updates by all nodes that they drew
};

std::map<std::pair<int, int>, Outcome>& results()
{
  static std::map<std::pair<int, int>, Outcome> byMotionAndLevels;
  return byMotionAndLevels;
}

void frontUpdate(benchmark::State& state)
{
  const auto levels = static_cast<int>(state.range(0));
  const auto motion = static_cast<Motion>(state.range(1));
  const auto table = test::terrainTable(levels);
  FrontLimits limits;
  limits.targetErrorPx = limits.initialErrorPx = errorFor2000(table, motion, levels);
  limits.pointBudget = 50000000;
  AllResident residency(motion == Still ? 1 : 0);
  RenderFront front(table);
  const FrontDelta* delta = &settle(front, *table, viewOf(motion, levels, 0), residency, limits);
  const std::uint64_t pagesBefore = table->pagesRead();
  std::vector<double> times;
  double nodesDrawn = 0.0;
  double sum = 0.0;
  for (auto _ : state)
  {
    const View view = viewOf(motion, levels, times.size());
    const auto begin = std::chrono::steady_clock::now();
    delta = &front.update(view, residency, limits);
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
    times.push_back(time.count());
    sum += time.count();
    nodesDrawn += double(delta->draw.size());
    benchmark::DoNotOptimize(delta->pointsDrawn);
    while (table->missingRows()->readNext() > 0) // as a scheduler does, beside the updates
    {
    }
  }
  std::sort(times.begin(), times.end());
  const double p50 = times[times.size() / 2];
  const double p99 = times[times.size() * 99 / 100];
  results()[{ motion, levels }] = { p50, p99, sum / nodesDrawn };
  state.counters["p50_ms"] = p50;
  state.counters["p99_ms"] = p99;
  state.counters["front"] = delta->frontLength;
  state.counters["nodes_drawn"] = nodesDrawn / double(times.size());
  state.counters["ns_a_node"] = 1e6 * sum / nodesDrawn;
  state.counters["table_nodes"] = table->nodeCount();
  state.counters["table_points"] = double(table->nodeCount()) * test::Terrain::pointsOfNode;
  state.counters["pages_read"] = double(table->pagesRead() - pagesBefore);
  state.counters["rows_mib"] = double(table->cachedBytes()) / 1048576.0;
  state.counters["process_mib"] = processBytes() / 1048576.0;
}

/// Beside what the library prints, which may be JSON for others to read.
void printRatios()
{
  const char* const names[] = { "still", "still, asked", "moving", "rotating" };
  std::fprintf(
    stderr, "\n%-14s %8s %14s %14s %14s\n", "to 8 levels", "levels", "p50", "p99", "a node drawn");
  for (const auto& [key, times] : results())
  {
    const auto smallest = results().find({ key.first, 8 });
    if (smallest != results().end())
    {
      const Outcome& least = smallest->second;
      std::fprintf(stderr, "%-14s %8d %14.2f %14.2f %14.2f\n", names[key.first], key.second,
        times.p50 / least.p50, times.p99 / least.p99, times.forNode / least.forNode);
    }
  }
}

} // namespace

// 8, 11 and 14 levels: 21,845, 1,398,101 and 89,478,485 nodes; 2,000 iterations are one tour. Of
// fewer levels a view does not find 2,000 nodes to every side.
BENCHMARK(frontUpdate)
  ->ArgNames({ "levels", "motion" })
  ->ArgsProduct({ { 8, 11, 14 }, { Still, StillAsked, Moving, Rotating } })
  ->Iterations(4000)
  ->Unit(benchmark::kMillisecond);

int main(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
  {
    return 1;
  }
  benchmark::RunSpecifiedBenchmarks();
  printRatios();
  return 0;
}
