#include "pointfront/Export/SourceExport.h"

#include "pointfront/Base/ExportClock.h"
#include "pointfront/Export/OutputTarget.h"
#include "pointfront/Threads/WorkBeside.h"

#include <future>
#include <utility>

namespace pointfront
{

namespace
{
/// One chunk, or why it could not be read.
Result<PointBatch> readChunk(const PointSource& source, std::uint64_t chunk)
{
  PointBatch batch;
  if (Result<void> read = source.read(chunk, batch); !read)
  {
    return read.error();
  }
  return batch;
}

std::future<Result<PointBatch>> readAhead(const PointSource& source, std::uint64_t chunk)
{
  return workBeside([&source, chunk]() { return readChunk(source, chunk); });
}
} // namespace

Result<std::uint64_t> exportSource(
  const PointSource& source, PointSink& sink, const ProgressFunction& progress)
{
  const SourceDescription& from = source.description();
  if (!from.grid)
  {
    return makeError(Error::Kind::BadArgument,
      from.path + ": its coordinates are on no grid of integers that a file could keep");
  }
  SinkDescription to;
  to.schema = from.schema;
  to.grid = *from.grid;
  to.bounds = from.declaredBounds;
  to.pointCount = from.pointCount;
  to.crsWkt = from.crsWkt;
  to.metadata = from.metadata;
  return exportSource(source, to, sink, progress);
}

Result<std::uint64_t> exportSource(const PointSource& source, const SinkDescription& told,
  PointSink& sink, const ProgressFunction& progress)
{
  const SourceDescription& from = source.description();
  if (Result<void> apart = checkApart(sink.path(), { from.path }); !apart)
  {
    return apart.error();
  }
  if (Result<void> begun = sink.begin(told); !begun)
  {
    return begun.error();
  }
  ExportClock clock(progress, from.pointCount);
  std::uint64_t written = 0;
  std::future<Result<PointBatch>> next;
  for (std::uint64_t chunk = 0; chunk < source.chunkCount(); ++chunk)
  {
    const Result<PointBatch> batch = chunk == 0 ? readChunk(source, 0) : next.get();
    if (!batch)
    {
      return batch.error();
    }
    if (chunk + 1 < source.chunkCount())
    {
      next = readAhead(source, chunk + 1);
    }
    if (Result<void> appended = sink.append(batch.value()); !appended)
    {
      return appended.error();
    }
    written += batch->size();
    if (!clock.report(written))
    {
      return makeError(Error::Kind::Cancelled, from.path + ": export cancelled");
    }
  }
  if (Result<void> finished = sink.finish(); !finished)
  {
    return finished.error();
  }
  return written;
}

} // namespace pointfront
