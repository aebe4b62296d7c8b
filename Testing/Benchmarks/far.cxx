// A view of a cloud behind a line: the first picture and the complete one, in round trips,
// requests, bytes and seconds. Once as the scheduler reads a far source, once as a naive reader
// would: one node after the other, nothing held.

#include "COPCFile.h"
#include "CountedBytes.h"
#include "EPTTree.h"
#include "LASFormat.h"

#include "pointfront/Front/RenderFront.h"
#include "pointfront/Residency/LoadScheduler.h"
#include "pointfront/Residency/Residency.h"
#include "pointfront/Tiles/StoredCloudFormats.h"

#include <glm/geometric.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

namespace
{
using namespace pointfront;
using Clock = std::chrono::steady_clock;

/// The whole cloud from above and aside, as the tool's first view.
View viewOf(const Bounds& bounds)
{
  const glm::dvec3 middle = bounds.low + 0.5 * bounds.size();
  const double radius = 0.5 * glm::length(bounds.size());
  const glm::dvec3 from = glm::normalize(glm::dvec3(0.0, -1.0, 1.0));
  const double angle = 0.5235987755982988;
  return View::perspective(middle + from * (radius / std::tan(0.5 * angle)), middle,
    glm::dvec3(0.0, 0.0, 1.0), angle, 0.01 * radius, 10.0 * radius, 1280, 720);
}

ColumnSelection coloursOf(const AttributeSchema& schema)
{
  for (std::uint32_t c = 0; c < schema.size(); ++c)
  {
    if (schema[c].name == "rgb")
    {
      return { c };
    }
  }
  return {};
}

struct Counts
{
  double seconds = 0.0;
  std::uint64_t rounds = 0;
  std::uint64_t requests = 0;
  std::uint64_t bytes = 0;
};

Counts countsOf(const CountedBytes& line, Clock::time_point begin)
{
  return { std::chrono::duration<double>(Clock::now() - begin).count(), line.rounds(),
    line.requests, line.bytes };
}

void print(const char* what, const Counts& counts)
{
  std::printf("  %-9s %7.3f s %5llu reads %5llu requests %9.3f MB\n", what, counts.seconds,
    static_cast<unsigned long long>(counts.rounds),
    static_cast<unsigned long long>(counts.requests), 1e-6 * static_cast<double>(counts.bytes));
}

int measure(const std::string& path, const std::shared_ptr<CountedBytes>& line, double errorPx)
{
  line->reset();
  const Clock::time_point begin = Clock::now();
  const auto opened = StoredCloudFormats::ofProcess().open(CountedBytes::addressOf(path));
  if (!opened)
  {
    std::fprintf(stderr, "%s\n", opened.error().what.c_str());
    return 1;
  }
  print("opened", countsOf(*line, begin));
  const StoredCloud& cloud = **opened;
  const ColumnSelection columns = coloursOf(cloud.description().schema);
  Residency residency(*opened, cloud.hierarchy()->nodeCount(),
    std::make_shared<LoadScheduler>(LoadSchedulerOptions()));
  residency.setColumns(columns);
  RenderFront front(cloud.hierarchy());
  FrontLimits limits;
  limits.targetErrorPx = errorPx;
  limits.prefetchSiblings = false;
  limits.requestLimit = 1024;
  const View view = viewOf(cloud.description().bounds);
  bool first = true;
  const FrontDelta* delta = nullptr;
  while (true)
  {
    const std::uint64_t seen = residency.arrivals();
    delta = &front.update(view, residency, limits);
    if (first && !delta->draw.empty())
    {
      print("first", countsOf(*line, begin));
      first = false;
    }
    if (delta->complete)
    {
      break;
    }
    residency.request(delta->requests);
    residency.waitForArrival(seen, std::chrono::milliseconds(2)); // the pace of frames
  }
  print("complete", countsOf(*line, begin));
  const ResidencyStatistics loaded = residency.statistics();
  std::uint64_t needed = 0;
  for (const DrawItem& item : delta->draw)
  {
    needed += cloud.storedBytes(item.node, columns);
  }
  std::printf(
    "  drawn: %zu nodes, %.3f MB stored; loaded %u nodes, %.3f MB; transfer of these %.3f s\n",
    delta->draw.size(), 1e-6 * static_cast<double>(needed), loaded.residentNodes,
    1e-6 * static_cast<double>(loaded.bytesRead),
    static_cast<double>(loaded.bytesRead) / line->bytesPerSecond);
  for (const Error& error : residency.takeErrors())
  {
    std::fprintf(stderr, "%s\n", error.what.c_str());
  }
  return 0;
}
} // namespace

int main(int argc, char** argv)
{
  if (argc < 4)
  {
    std::fprintf(stderr, "usage: %s ROUND_TRIP_MS MBIT_A_SECOND CLOUD... [far|naive]\n", argv[0]);
    return 2;
  }
  StoredCloudFormats::ofProcess().add(std::make_shared<COPCFormat>());
  StoredCloudFormats::ofProcess().add(std::make_shared<EPTTreeFormat>(&LASFormat::openBytes));
  const auto line = CountedBytes::add();
  line->roundTrip = std::chrono::duration<double>(std::atof(argv[1]) / 1000.0);
  line->bytesPerSecond = std::atof(argv[2]) * 1e6 / 8.0;
  line->mergeGapBytes = 16384;
  const std::string way = argv[argc - 1];
  const int last = way == "far" || way == "naive" ? argc - 1 : argc;
  int result = 0;
  for (int a = 3; a < last; ++a)
  {
    for (const bool far : { true, false })
    {
      if (way == (far ? "naive" : "far"))
      {
        continue;
      }
      line->cost = far
        ? ReadCost{ line->roundTrip.count(), line->bytesPerSecond, 8, std::size_t(512) << 10 }
        : ReadCost{};
      line->firstBytes = far;
      std::printf("%s, %s\n", argv[a], far ? "in batches" : "naive");
      const std::string path = std::filesystem::absolute(argv[a]).string();
      result = measure(path, line, 1.0) != 0 ? 1 : result;
    }
  }
  return result;
}
