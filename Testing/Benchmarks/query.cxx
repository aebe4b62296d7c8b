// usage: pointfrontQueryBenchmark STORE.pfront WORKFOLDER [REPEATS]
//
// A box with 1 % of a store's points against all of them, in turn: exported to LAS, and handed over
// without a sink. Prints medians and ratios as one JSON object; the exports are removed.

#include "LASWriter.h"

#include "pointfront/Export/StoreExport.h"
#include "pointfront/Query/BoxRegion.h"
#include "pointfront/Query/QueryPlan.h"
#include "pointfront/Store/PointStore.h"
#include "pointfront/Threads/ThreadCrew.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

namespace
{

using namespace pointfront;

constexpr double wantedShare = 0.01;

template <typename T>
T orExit(Result<T> result)
{
  if (!result)
  {
    std::fprintf(stderr, "%s\n", result.error().what.c_str());
    std::exit(1);
  }
  return std::move(*result);
}

struct Cost
{
  std::vector<double> seconds;
  std::vector<double> processorSeconds; ///< time of all threads
};

/// Earlier work that waits for the disk is removed or written first: nobody waits for another's
/// bytes.
void measure(Cost& cost, const std::string& target, const std::function<void()>& work)
{
  std::error_code unused;
  std::filesystem::remove(target, unused);
  ::sync();
  const std::clock_t processor = std::clock();
  const auto begin = std::chrono::steady_clock::now();
  work();
  using Seconds = std::chrono::duration<double>;
  cost.seconds.push_back(Seconds(std::chrono::steady_clock::now() - begin).count());
  cost.processorSeconds.push_back(double(std::clock() - processor) / CLOCKS_PER_SEC);
}

double median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// A share of the middle of the map, at any height.
PointQuery middle(const Bounds& bounds, double side)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const glm::dvec3 half = 0.5 * side * bounds.size();
  const glm::dvec3 centre = bounds.centre();
  PointQuery query;
  query.regions = { orExit(BoxRegion::make({ { centre.x - half.x, centre.y - half.y, -infinity },
    { centre.x + half.x, centre.y + half.y, infinity } })) };
  return query;
}

QueryReport asked(const StoredCloud& store, const PointQuery& query)
{
  return orExit(queryPoints(store, query, {}, [](QueryBatch&) -> Result<void> { return {}; }));
}

/// By bisection of the side.
PointQuery boxOfOnePercent(const StoredCloud& store)
{
  const StoreDescription& description = store.description();
  double low = 0.0;
  double high = 1.0;
  for (int step = 0; step < 12; ++step)
  {
    const double side = 0.5 * (low + high);
    PointQuery query = middle(description.bounds, side);
    query.attributes.emplace();
    const auto points = static_cast<double>(asked(store, query).pointsChosen);
    (points < wantedShare * static_cast<double>(description.pointCount) ? low : high) = side;
  }
  return middle(description.bounds, high);
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc < 3)
  {
    std::fprintf(stderr, "usage: pointfrontQueryBenchmark STORE.pfront WORKFOLDER [REPEATS]\n");
    return 2;
  }
  const auto store = orExit(PointStore::open(argv[1]));
  const std::string target = (std::filesystem::path(argv[2]) / "query-benchmark.las").string();
  const int repeats = argc > 3 ? std::max(1, std::atoi(argv[3])) : 3;
  const PointQuery box = boxOfOnePercent(*store);
  const auto exported = [&](const PointQuery& query)
  {
    LASWriter sink(target);
    orExit(exportStore(*store, ExportSelection{ query, std::nullopt }, sink));
  };
  Cost exportAll, exportBox, readAll, readBox;
  for (int i = 0; i < repeats; ++i)
  {
    measure(exportAll, target, [&] { exported({}); });
    measure(exportBox, target, [&] { exported(box); });
    measure(readAll, target, [&] { asked(*store, {}); });
    measure(readBox, target, [&] { asked(*store, box); });
  }
  std::error_code unused;
  std::filesystem::remove(target, unused);
  const QueryReport all = asked(*store, {});
  const QueryReport some = asked(*store, box);
  const auto share = [](std::uint64_t part, std::uint64_t whole)
  { return static_cast<double>(part) / static_cast<double>(whole); };
  std::printf("{\"points\": %llu, \"threads\": %u, \"share_of_points\": %.5f, "
              "\"share_of_bytes_read\": %.5f, \"share_of_points_decoded\": %.5f",
    static_cast<unsigned long long>(all.pointsChosen), ThreadCrew::ofProcess().threads(),
    share(some.pointsChosen, all.pointsChosen), share(some.bytesRead, all.bytesRead),
    share(some.pointsRead, all.pointsRead));
  const auto print = [](const char* name, const Cost& whole, const Cost& part)
  {
    const double seconds = median(whole.seconds);
    const double processor = median(whole.processorSeconds);
    std::printf(", \"%s\": {\"all_s\": %.4f, \"box_s\": %.4f, \"ratio\": %.5f, "
                "\"all_cpu_s\": %.4f, \"box_cpu_s\": %.4f, \"cpu_ratio\": %.5f}",
      name, seconds, median(part.seconds), median(part.seconds) / seconds, processor,
      median(part.processorSeconds), median(part.processorSeconds) / processor);
  };
  print("export", exportAll, exportBox);
  print("read", readAll, readBox);
  std::printf("}\n");
  return 0;
}
