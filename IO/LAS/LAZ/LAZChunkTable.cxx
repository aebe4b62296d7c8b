#include "LAZChunkTable.h"

#include "LASzipReader.h"
#include "LAZIntegerDecoder.h"

#include <algorithm>
#include <optional>

namespace pointfront
{
namespace
{
using Scheme = LAZCompression::Scheme;

constexpr std::uint64_t tablePointerBytes = 8; ///< before the first chunk
constexpr std::uint64_t tableHeaderBytes = 8; ///< version, number of chunks

/// Where the table begins, if it is there: between the first chunk and the end of the file.
std::optional<std::uint64_t> tableOffset(const LASFile& file)
{
  const ByteSpan bytes = file.bytes();
  const std::uint64_t first = file.header.pointOffset + tablePointerBytes;
  if (first > bytes.size)
  {
    return std::nullopt;
  }
  auto offset = loadNumber<std::int64_t>(bytes.data + file.header.pointOffset);
  if (offset == -1) // written to a stream that could not go back: the pointer is at the end
  {
    offset = loadNumber<std::int64_t>(bytes.data + bytes.size - tablePointerBytes);
  }
  const auto place = static_cast<std::uint64_t>(offset);
  const bool inside = offset > 0 && place >= first && bytes.size >= tableHeaderBytes &&
    place <= bytes.size - tableHeaderBytes;
  return inside ? std::optional<std::uint64_t>(place) : std::nullopt;
}

/// The table as it stands; nothing if it contradicts itself or the file. Point counts of chunks
/// of fixed size are left at that size, also the last one's.
std::optional<std::vector<LAZChunk>> readTable(
  const LASFile& file, const LAZCompression& compression)
{
  const std::optional<std::uint64_t> table = tableOffset(file);
  if (!table)
  {
    return std::nullopt;
  }
  const std::byte* head = file.bytes().data + *table;
  const std::uint64_t count = loadNumber<std::uint32_t>(head + 4);
  std::uint64_t offset = file.header.pointOffset + tablePointerBytes;
  // Each chunk begins with a whole point: this bounds the count before anything is allocated.
  if (loadNumber<std::uint32_t>(head) != 0 || count > (*table - offset) / file.header.pointBytes)
  {
    return std::nullopt;
  }
  LAZIntegerDecoder decoder(
    { head + tableHeaderBytes, file.bytes().size - *table - tableHeaderBytes });
  const bool variable = compression.chunkPoints == LAZCompression::variableChunks;
  std::vector<LAZChunk> chunks(count);
  std::uint32_t points = 0;
  std::uint32_t bytes = 0;
  for (LAZChunk& chunk : chunks)
  {
    const auto nextPoints = variable ? decoder.next(points, 0) : compression.chunkPoints;
    const auto nextBytes = decoder.next(bytes, 1);
    if (!nextPoints || !nextBytes || *nextBytes == 0 || *nextBytes > *table - offset)
    {
      return std::nullopt;
    }
    points = *nextPoints;
    bytes = *nextBytes;
    chunk = { offset, bytes, points };
    offset += bytes;
  }
  chunks.erase(std::remove_if(chunks.begin(), chunks.end(),
                 [](const LAZChunk& chunk) { return chunk.points == 0; }),
    chunks.end());
  return chunks;
}

std::uint64_t totalPoints(const std::vector<LAZChunk>& chunks)
{
  std::uint64_t sum = 0;
  for (const LAZChunk& chunk : chunks)
  {
    sum += chunk.points;
  }
  return sum;
}

/// Finds the chunk at `offset` by decompressing it: at most `points`, or as many as are sound.
Result<LAZChunk> measureChunk(const LASFile& file, const LAZCompression& compression,
  std::uint64_t offset, std::uint32_t points)
{
  LAZChunk chunk{ offset, file.bytes().size - offset, 0 };
  if (!codesCanBegin(file, compression, chunk))
  {
    return chunk;
  }
  const ByteSpan rest{ file.bytes().data + offset, static_cast<std::size_t>(chunk.bytes) };
  Result<LASzipReader> reader = LASzipReader::open(file, compression, rest, points);
  if (!reader)
  {
    return reader.error();
  }
  constexpr std::uint32_t block = 4096;
  std::vector<std::byte> records(std::size_t{ block } * file.header.pointBytes);
  while (chunk.points < points)
  {
    const std::uint32_t wanted = std::min(block, points - chunk.points);
    const auto got = static_cast<std::uint32_t>(reader->read(wanted, records.data()));
    chunk.points += got;
    if (got < wanted)
    {
      chunk.cut = true;
      return chunk;
    }
  }
  chunk.bytes = reader->consumed();
  return chunk;
}

/// Walks from chunk to chunk without a table, up to the first that is not whole.
Result<std::vector<LAZChunk>> walkChunks(const LASFile& file, const LAZCompression& compression)
{
  const bool pointwise = compression.scheme == Scheme::Pointwise;
  const bool layered = compression.scheme == Scheme::Layered;
  std::vector<LAZChunk> chunks;
  std::uint64_t offset = file.header.pointOffset + (pointwise ? 0 : tablePointerBytes);
  std::uint64_t left = file.header.pointCount;
  while (left > 0 && offset < file.bytes().size)
  {
    const std::uint64_t most = pointwise ? left : compression.chunkPoints;
    const auto points =
      static_cast<std::uint32_t>(std::min({ left, most, std::uint64_t{ lazMostChunkPoints } }));
    Result<LAZChunk> chunk = layered
      ? Result<LAZChunk>(parseLayeredChunk(file, compression, offset, file.bytes().size))
      : measureChunk(file, compression, offset, points);
    if (!chunk)
    {
      return chunk.error();
    }
    if (chunk->points == 0 || chunk->points > left)
    {
      break;
    }
    chunks.push_back(*chunk);
    left -= chunk->points;
    offset += chunk->bytes;
    if (pointwise || chunk->cut)
    {
      break;
    }
  }
  return chunks;
}

Error noPoints(const LASFile& file)
{
  return makeError(Error::Kind::Truncated,
    file.description.path + ": the header promises " + std::to_string(file.header.pointCount) +
      " points from byte " + std::to_string(file.header.pointOffset) + " on, but the file of " +
      std::to_string(file.bytes().size) + " bytes holds not one that is sound; get a whole copy");
}

/// Chunks found without a table: says what is missing.
Result<std::vector<LAZChunk>> recoverChunks(
  const LASFile& file, const LAZCompression& compression, std::vector<std::string>& warnings)
{
  Result<std::vector<LAZChunk>> chunks = walkChunks(file, compression);
  if (!chunks)
  {
    return chunks;
  }
  const std::uint64_t found = totalPoints(*chunks);
  const std::uint64_t claimed = file.header.pointCount;
  if (found == 0)
  {
    return noPoints(file);
  }
  const bool hasTable = compression.scheme != Scheme::Pointwise;
  if (hasTable || found < claimed)
  {
    warnings.push_back(
      std::string(hasTable ? "The chunk table is missing or damaged, the chunks were searched for: "
                           : "The compressed points end early: ") +
      std::to_string(claimed - found) + " of " + std::to_string(claimed) + " points are missing.");
  }
  return chunks;
}

/// Makes the last chunk of fixed size as short as the header's count says.
Result<void> fitLastChunk(
  const LASFile& file, std::vector<LAZChunk>& chunks, std::vector<std::string>& warnings)
{
  const std::uint64_t claimed = file.header.pointCount;
  const std::uint64_t room = totalPoints(chunks);
  if (claimed > room)
  {
    return makeError(Error::Kind::BadFormat,
      file.description.path + ": the header counts " + std::to_string(claimed) +
        " points, but its " + std::to_string(chunks.size()) + " chunks hold at most " +
        std::to_string(room) + "; write the file again with a valid header");
  }
  const std::size_t before = chunks.size();
  std::uint64_t held = room;
  while (!chunks.empty() && held - chunks.back().points >= claimed)
  {
    held -= chunks.back().points;
    chunks.pop_back();
  }
  if (chunks.size() < before)
  {
    warnings.push_back("The header counts " + std::to_string(claimed) + " points, " +
      std::to_string(before - chunks.size()) + " of " + std::to_string(before) +
      " chunks lie behind them: these were not read.");
  }
  if (!chunks.empty())
  {
    chunks.back().points -= static_cast<std::uint32_t>(held - claimed);
  }
  return {};
}

/// Layered chunks repeat how many points they hold: the table must agree.
bool layeredChunksAgree(
  const LASFile& file, const LAZCompression& compression, const std::vector<LAZChunk>& chunks)
{
  return std::all_of(chunks.begin(), chunks.end(),
    [&](const LAZChunk& chunk)
    {
      const LAZChunk itself =
        parseLayeredChunk(file, compression, chunk.offset, chunk.offset + chunk.bytes);
      file.map.release(chunk.offset, chunk.bytes); // a look at a chunk maps 64 KiB around
      return itself.points == chunk.points && itself.bytes == chunk.bytes;
    });
}

/// Points of a table of variable chunks against the header's count.
void compareCounts(
  const LASFile& file, const std::vector<LAZChunk>& chunks, std::vector<std::string>& warnings)
{
  const std::uint64_t found = totalPoints(chunks);
  if (found != file.header.pointCount)
  {
    warnings.push_back("The header counts " + std::to_string(file.header.pointCount) +
      " points, the chunk table " + std::to_string(found) + ": the second was used.");
  }
}
} // namespace

Result<std::vector<LAZChunk>> findLAZChunks(
  const LASFile& file, const LAZCompression& compression, std::vector<std::string>& warnings)
{
  if (file.header.pointCount == 0)
  {
    return std::vector<LAZChunk>();
  }
  std::optional<std::vector<LAZChunk>> chunks;
  if (compression.scheme != Scheme::Pointwise)
  {
    chunks = readTable(file, compression);
  }
  if (!chunks || chunks->empty())
  {
    return recoverChunks(file, compression, warnings);
  }
  if (compression.chunkPoints == LAZCompression::variableChunks)
  {
    compareCounts(file, *chunks, warnings);
  }
  else if (auto done = fitLastChunk(file, *chunks, warnings); !done)
  {
    return done.error();
  }
  if (compression.scheme == Scheme::Layered && !layeredChunksAgree(file, compression, *chunks))
  {
    return recoverChunks(file, compression, warnings);
  }
  return std::move(*chunks);
}

} // namespace pointfront
