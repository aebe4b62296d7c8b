#include "LAZSource.h"

#include "LASPointDecoder.h"
#include "LASzipReader.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::uint64_t pointsPerRun = 65536;
/// Records decompressed before they are decoded: they stay in the cache in between.
constexpr std::uint32_t pointsPerRead = 1024;

Error badChunk(const std::string& path, const LAZChunk& chunk, const std::string& what)
{
  return makeError(Error::Kind::BadFormat,
    path + ": the compressed chunk of " + std::to_string(chunk.points) + " points at byte " +
      std::to_string(chunk.offset) + " is damaged, " + what + "; get a sound copy");
}

Result<void> checkSizes(const std::string& path, const std::vector<LAZChunk>& chunks)
{
  for (const LAZChunk& chunk : chunks)
  {
    if (chunk.points > lazMostChunkPoints)
    {
      return makeError(Error::Kind::Unsupported,
        path + ": a chunk of " + std::to_string(chunk.points) + " points at byte " +
          std::to_string(chunk.offset) + " is larger than the " +
          std::to_string(lazMostChunkPoints) +
          " that are decompressed at once; compress the file again in chunks of 50,000");
    }
  }
  return {};
}
} // namespace

LAZSource::LAZSource(LASFile file, LAZCompression compression, std::vector<LAZChunk> chunks)
  : file_(std::move(file))
  , compression_(std::move(compression))
  , chunks_(std::move(chunks))
{
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < chunks_.size(); ++i)
  {
    const std::uint64_t points = chunks_[i].points;
    if (runs_.empty() || runs_.back().points + points > pointsPerRun)
    {
      runs_.push_back({ i, i, 0 });
    }
    runs_.back().end = i + 1;
    runs_.back().points += points;
    total += points;
  }
  file_.description.pointCount = total;
}

Result<std::unique_ptr<PointSource>> LAZSource::open(LASFile file)
{
  Result<LAZCompression> compression = LAZCompression::of(file);
  if (!compression)
  {
    return compression.error();
  }
  // LASzip has the last word on what it reads: ask it before anything is promised.
  if (Result<LASzipReader> probe = LASzipReader::open(file, *compression, {}, 1); !probe)
  {
    return probe.error();
  }
  Result<std::vector<LAZChunk>> chunks =
    findLAZChunks(file, *compression, file.description.warnings);
  const Result<void> sound =
    chunks ? checkSizes(file.description.path, *chunks) : Result<void>(chunks.error());
  if (Result<void> done = file.map.checkWhole(sound); !done)
  {
    return done.error();
  }
  file.map.release(0, file.map.size()); // the pages that the search for chunks has looked at
  return std::unique_ptr<PointSource>(
    new LAZSource(std::move(file), std::move(*compression), std::move(*chunks)));
}

std::uint64_t LAZSource::chunkPoints(std::uint64_t chunk) const
{
  assert(chunk < runs_.size());
  return runs_[chunk].points;
}

Result<void> LAZSource::read(std::uint64_t chunk, PointBatch& batch) const
{
  batch.resize(0, file_.layout.schema);
  return decompress(chunk, batch, Positions::World);
}

Result<void> LAZSource::readSteps(std::uint64_t chunk, PointBatch& batch) const
{
  batch.resizeSteps(0, file_.layout.schema);
  return decompress(chunk, batch, Positions::Steps);
}

Result<void> LAZSource::decompress(
  std::uint64_t chunk, PointBatch& batch, Positions positions) const
{
  assert(chunk < runs_.size());
  const Run& run = runs_[chunk];
  for (std::size_t i = run.first; i < run.end; ++i)
  {
    const Result<void> done = file_.map.checkWhole(decompress(chunks_[i], batch, positions));
    if (!done)
    {
      return done;
    }
    // Read once, not kept: a file larger than the memory limit must not count against it.
    file_.map.release(chunks_[i].offset, static_cast<std::size_t>(chunks_[i].bytes));
  }
  return {};
}

Result<void> LAZSource::decompress(
  const LAZChunk& chunk, PointBatch& batch, Positions positions) const
{
  const std::string& path = file_.description.path;
  if (!codesCanBegin(file_, compression_, chunk))
  {
    return badChunk(path, chunk, "it begins with a code that no encoder writes");
  }
  const ByteSpan bytes{ file_.bytes().data + chunk.offset, static_cast<std::size_t>(chunk.bytes) };
  Result<LASzipReader> reader = LASzipReader::open(file_, compression_, bytes, chunk.points);
  if (!reader)
  {
    return reader.error();
  }
  std::vector<std::byte> records(std::size_t{ pointsPerRead } * file_.layout.pointBytes);
  // The batch grows as points come: a count that lies does not allocate.
  for (std::uint32_t done = 0; done < chunk.points;)
  {
    const std::uint32_t wanted = std::min(pointsPerRead, chunk.points - done);
    if (reader->read(wanted, records.data()) < wanted)
    {
      return badChunk(path, chunk, "its bytes end or contradict themselves");
    }
    const std::size_t first = batch.size();
    if (positions == Positions::Steps)
    {
      batch.resizeSteps(first + wanted, file_.layout.schema);
    }
    else
    {
      batch.resize(first + wanted, file_.layout.schema);
    }
    decodeLASPoints(file_.layout, file_.header.grid, records.data(), wanted, batch, first);
    done += wanted;
  }
  if (!chunk.cut && reader->consumed() != chunk.bytes)
  {
    return badChunk(path, chunk,
      "its points take " + std::to_string(reader->consumed()) + " of its " +
        std::to_string(chunk.bytes) + " bytes");
  }
  return {};
}

} // namespace pointfront
