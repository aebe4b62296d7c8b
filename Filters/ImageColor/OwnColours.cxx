#include "OwnColours.h"

#include "pointfront/Neighbourhood/PointTiles.h"
#include "pointfront/Points/WidenedColour.h"
#include "pointfront/Threads/WorkCrew.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstring>

namespace pointfront
{
namespace
{
constexpr std::uint64_t firstLooked = 16; ///< chunks all over the source: most have bright points

Result<bool> isDeep(
  const PointSource& source, std::uint64_t chunk, std::size_t column, PointBatch& batch)
{
  if (Result<void> done = source.read(chunk, batch); !done)
  {
    return done.error();
  }
  const std::vector<std::byte>& bytes = batch.columns[column];
  for (std::size_t at = 0; at + 2 <= bytes.size(); at += 2)
  {
    std::uint16_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    if (value > largestOf8Bits)
    {
      return true;
    }
  }
  return false;
}

/// The same of all chunks, by all threads.
Result<bool> anyIsDeep(
  const PointSource& source, std::size_t column, const PassResources& resources)
{
  WorkCrew crew(threadsOf(resources), resources.progress);
  crew.beginPhase("reading colours", source.description().pointCount, 1.0);
  std::atomic<std::uint64_t> next{ 0 };
  std::atomic<bool> deep{ false };
  const auto work = [&]() -> Result<void>
  {
    PointBatch batch;
    for (std::uint64_t chunk = next++; chunk < source.chunkCount() && !deep && !crew.stopped();
         chunk = next++)
    {
      const Result<bool> found = isDeep(source, chunk, column, batch);
      if (!found)
      {
        return found.error();
      }
      deep = deep || *found;
      crew.advance(batch.size());
    }
    return {};
  };
  if (Result<void> done = crew.run(work); !done)
  {
    return done.error();
  }
  return deep.load();
}
} // namespace

Result<bool> haveEightBits(
  const PointSource& source, std::size_t column, const PassResources& resources)
{
  const SourceDescription& description = source.description();
  if (description.deepColours || description.largestColour)
  {
    return !description.deepColours && *description.largestColour <= largestOf8Bits;
  }
  const std::uint64_t chunks = source.chunkCount();
  PointBatch batch;
  for (std::uint64_t i = 0; i < firstLooked && chunks > firstLooked; ++i)
  {
    const Result<bool> deep = isDeep(source, i * chunks / firstLooked, column, batch);
    if (!deep || *deep)
    {
      return deep ? Result<bool>(false) : deep;
    }
  }
  const Result<bool> deep = anyIsDeep(source, column, resources);
  return deep ? Result<bool>(!*deep) : deep;
}

} // namespace pointfront
