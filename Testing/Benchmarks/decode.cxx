// usage: POINTFRONT_STORE=cloud.pfront pointfrontDecodeBenchmark
//
// Points a second that come decoded out of a store in the page cache: positions alone, with colour
// (if there is any), and with every attribute; by one thread and by all.

#include "pointfront/Store/PointStore.h"

#include <benchmark/benchmark.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <thread>
#include <vector>

namespace
{

using namespace pointfront;

std::shared_ptr<const PointStore> openStore()
{
  const char* const path = std::getenv("POINTFRONT_STORE");
  Result<std::shared_ptr<const PointStore>> store = PointStore::open(path != nullptr ? path : "");
  if (!store)
  {
    std::fprintf(stderr, "POINTFRONT_STORE: %s\n", store.error().what.c_str());
    std::exit(1);
  }
  return *store;
}

/// Every node once, taken in turn by the threads.
void decodeAll(const PointStore& store, const ColumnSelection& columns, unsigned threads)
{
  std::atomic<NodeIndex> next{ 0 };
  const auto work = [&]()
  {
    for (NodeIndex node = next++; node < store.hierarchy()->nodeCount(); node = next++)
    {
      const Result<NodeColumns> decoded = store.read(node, columns);
      if (!decoded)
      {
        std::fprintf(stderr, "%s\n", decoded.error().what.c_str());
        std::exit(1);
      }
      benchmark::DoNotOptimize(decoded->positions.data());
    }
  };
  std::vector<std::thread> crew;
  for (unsigned i = 1; i < threads; ++i)
  {
    crew.emplace_back(work);
  }
  work();
  for (std::thread& member : crew)
  {
    member.join();
  }
}

void registerDecode(const std::shared_ptr<const PointStore>& store, const std::string& name,
  const ColumnSelection& columns, unsigned threads)
{
  const auto run = [store, columns, threads](benchmark::State& state)
  {
    for ([[maybe_unused]] auto step : state)
    {
      decodeAll(*store, columns, threads);
    }
    state.SetItemsProcessed(
      state.iterations() * static_cast<std::int64_t>(store->description().pointCount));
  };
  benchmark::RegisterBenchmark((name + "/threads:" + std::to_string(threads)).c_str(), run)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
}

} // namespace

int main(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  const std::shared_ptr<const PointStore> store = openStore();
  const AttributeSchema& schema = store->description().schema;
  ColumnSelection all(schema.size());
  std::iota(all.begin(), all.end(), 0u);
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  for (const unsigned threads : { 1u, cores })
  {
    registerDecode(store, "positions", {}, threads);
    if (const std::optional<std::size_t> rgb = schema.find("rgb"))
    {
      registerDecode(store, "positions and rgb", { static_cast<std::uint32_t>(*rgb) }, threads);
    }
    registerDecode(store, "everything", all, threads);
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
