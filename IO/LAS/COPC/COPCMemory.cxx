#include "COPCMemory.h"

#include "COPCChunks.h"
#include "COPCLevels.h"

#include <algorithm>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace pointfront
{
namespace
{
constexpr std::uint64_t mebibyte = std::uint64_t{ 1 } << 20;
/// LASzip's models and the buffers of its layers, of one chunk.
constexpr std::uint64_t compressorBytes = mebibyte;
/// Records, and the chunk in LASzip's layers, in its stream and as it is handed over.
constexpr std::uint64_t copiesOfNode = 3;
constexpr std::size_t leastNodeBytes = std::size_t{ 64 } << 10;
constexpr std::uint64_t leastRecordBytes = 2 * mebibyte;
/// Threads, tables and what the heap loses between them; measured, Autzen: 7.9 MiB.
constexpr std::uint64_t otherBytes = 9 * mebibyte;

/// One node that is compressed beside takes this.
std::uint64_t besideBytes(std::size_t nodeBytes)
{
  return compressorBytes + copiesOfNode * nodeBytes;
}

/// Besides the records and the query: blocks, records that are looked at ahead, open nodes.
std::uint64_t writingBytes(std::size_t width, std::size_t nodeBytes, unsigned threads)
{
  const std::uint64_t ahead =
    (COPCLevels::leafPoints + std::uint64_t{ 1 }) * (width + sizeof(std::uint64_t));
  return otherBytes + ahead + COPCChunks::levels * nodeBytes +
    (threads + std::uint64_t{ 1 }) * besideBytes(nodeBytes);
}
} // namespace

Result<COPCMemory> COPCMemory::share(std::uint64_t memoryBytes, std::uint64_t readBytes,
  std::size_t width, unsigned threads, const std::string& path)
{
  const std::uint64_t least =
    leastRecordBytes + std::max(readBytes, writingBytes(width, leastNodeBytes, 1));
  if (memoryBytes < least)
  {
    return makeError(Error::Kind::BadArgument,
      path + ": a memory limit of " + std::to_string(memoryBytes >> 10) +
        " KiB is too small: this export needs at least " + std::to_string((least + 1023) >> 10) +
        " KiB; raise it or leave out attributes");
  }
  COPCMemory memory;
  memory.nodeBytes =
    std::clamp<std::size_t>(memoryBytes / 64, leastNodeBytes, COPCChunks::rawBytes);
  memory.threads = static_cast<unsigned>(std::clamp<std::uint64_t>(
    memoryBytes / 4 / besideBytes(memory.nodeBytes), 1, std::max(1u, threads)));
  std::uint64_t writing = writingBytes(width, memory.nodeBytes, memory.threads);
  if (writing + leastRecordBytes > memoryBytes)
  {
    memory.nodeBytes = leastNodeBytes;
    memory.threads = 1;
    writing = writingBytes(width, leastNodeBytes, 1);
  }
  memory.mergeBytes = memoryBytes - writing;
  memory.recordBytes =
    memoryBytes - std::max({ writing, readBytes, ofReading(memoryBytes) + mebibyte });
  return memory;
}

void COPCMemory::giveBack()
{
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

} // namespace pointfront
