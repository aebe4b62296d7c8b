#include "pointfront/Ingest/MemoryPlan.h"

#include "pointfront/Records/MortonOrder.h"

#include <algorithm>
#include <string>

namespace pointfront
{
namespace
{
/// Larger parts gain nothing: sorting and sampling leave the caches.
constexpr std::uint64_t mostPartPoints = 1u << 18;
constexpr std::uint64_t mostBlockPoints = 1u << 22;
constexpr std::uint64_t memoryBlockPoints = 1u << 17;
/// For each thread. Small parts go by faster than the disk answers.
constexpr std::uint64_t mostPartsAhead = 4;

/// Bytes for one point of a part while it is built: its record twice (unsorted and sorted), keys,
/// its position once more, index lists of the levels (their sum is below 2 indices a point), the
/// encoded nodes of the part and of those finished out of turn.
std::uint64_t partPointBytes(const BuildSize& size)
{
  return 2 * size.recordBytes + mortonOrderBytes + RecordLayout::positionBytes + 8 +
    2 * size.recordBytes + size.partBytes;
}

/// A block, its sorted copy, and the cell of each point.
std::uint64_t blockPointBytes(const BuildSize& size)
{
  return 2 * size.recordBytes + 8 + size.blockBytes;
}

/// Parts much larger than a node: their ancestors are surely inner nodes.
std::uint64_t leastPartPoints(const BuildSize& size)
{
  return std::max<std::uint64_t>(4ull * size.nodePoints, size.wholePart);
}

/// A batch of doubles, for each thread.
std::uint64_t batchBytes(const BuildSize& size)
{
  return size.largestChunk * (3 * sizeof(double) + size.sourceBytes);
}

/// A batch, and a block of it alone.
std::uint64_t readBytes(const BuildSize& size)
{
  return batchBytes(size) + size.largestChunk * blockPointBytes(size);
}

std::uint64_t leastBytes(const BuildSize& size)
{
  return std::max(
    readBytes(size), std::min(size.points, leastPartPoints(size)) * partPointBytes(size));
}

/// Takes off the allocator's rest, tables of cells and nodes, decoders, the pages of mapped inputs,
/// the buffers of a spill.
std::uint64_t withoutOverhead(std::uint64_t bytes)
{
  return bytes - bytes / 4;
}

/// With the bytes left beside what stays in memory all the time.
MemoryPlan divided(const BuildSize& size, std::uint64_t available, bool spill)
{
  const std::uint64_t bytes = withoutOverhead(available);
  MemoryPlan plan;
  plan.spill = spill;
  const std::uint64_t least = std::max<std::uint64_t>(1, leastBytes(size));
  const std::uint64_t aThread = std::max(least, readBytes(size) + size.tableBytes);
  plan.threads = static_cast<unsigned>(
    std::clamp<std::uint64_t>(bytes / aThread, 1, std::max(1u, size.threads)));
  const std::uint64_t share = bytes / plan.threads;
  const std::uint64_t forBalance = size.points / (8ull * plan.threads);
  plan.partPoints = std::clamp(std::min(share / partPointBytes(size), forBalance),
    leastPartPoints(size), std::max(mostPartPoints, leastPartPoints(size)));
  const std::uint64_t tables = std::min(share / 2, size.tableBytes);
  const std::uint64_t forBlock = share - tables - std::min(share - tables, batchBytes(size));
  plan.blockPoints = std::clamp<std::uint64_t>(
    forBlock / blockPointBytes(size), 1024, spill ? mostBlockPoints : memoryBlockPoints);
  if (spill) // from the rest of the parts, so that little memory is still enough
  {
    const std::uint64_t left = share - std::min(share, plan.partPoints * partPointBytes(size));
    const std::uint64_t part = std::max<std::uint64_t>(1, plan.partPoints * size.recordBytes);
    plan.partsAhead = plan.threads * std::min(mostPartsAhead, left / part);
  }
  return plan;
}
} // namespace

Result<MemoryPlan> planMemory(const BuildSize& size)
{
  const std::uint64_t all = size.points * size.recordBytes;
  const std::uint64_t least = leastBytes(size);
  if (size.memoryBytes >= all &&
    size.memoryBytes - all >= std::min(least * size.threads, size.memoryBytes / 4 + least))
  {
    return divided(size, size.memoryBytes - all, false);
  }
  if (size.memoryBytes < least)
  {
    return makeError(Error::Kind::NoMemory,
      "a memory limit of " + std::to_string(size.memoryBytes >> 10) +
        " KiB is too small: this build needs at least " + std::to_string((least >> 10) + 1) +
        " KiB; raise it or use fewer points a node");
  }
  return divided(size, size.memoryBytes, true);
}

} // namespace pointfront
