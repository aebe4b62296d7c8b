#include "pointfront/Build/PointIngest.h"

#include "pointfront/Build/CpuClock.h"
#include "pointfront/Build/RecordPacker.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <mutex>

namespace pointfront
{
namespace
{
using Sources = std::vector<std::unique_ptr<PointSource>>;

/// Cells such that a surface has some hundred points in each: enough of them to cut parts along,
/// and few enough for the nearest caches. Of a 64th to a 512th of the declared extent; coarsened as
/// points come, counted again if too coarse.
unsigned hintedShift(const Sources& sources, const TreeSpace& space)
{
  constexpr double pointsOfCell = 256.0;
  Bounds bounds;
  double points = 1.0;
  for (const auto& source : sources)
  {
    bounds.add(source->description().declaredBounds);
    points += static_cast<double>(source->description().pointCount);
  }
  const double cellsLog2 = std::clamp(std::ceil(0.5 * std::log2(points / pointsOfCell)), 6.0, 9.0);
  const glm::dvec3 size = bounds.empty() ? glm::dvec3(0.0) : bounds.size();
  const double steps = std::max({size.x, size.y, size.z}) / space.stepLength();
  const double bits = std::log2(std::max(1.0, steps)) - cellsLog2;
  return bits > 0.0 && std::isfinite(bits) ? static_cast<unsigned>(std::min(bits, 26.0)) : 0u;
}

/// One run over all chunks of all sources, shared by the threads.
class Ingest
{
public:
  Ingest(const Sources& sources, const CommonSchema& schema, const TreeSpace& space,
    RecordPool& pool, WorkCrew& crew, std::optional<std::size_t> classOffset)
      : sources_(sources), schema_(schema), space_(space), pool_(pool), crew_(crew),
        classOffset_(classOffset), shift_(hintedShift(sources, space))
  {
    for (const auto& source : sources)
    {
      chunkBegin_.push_back(chunks_);
      chunks_ += source->chunkCount();
    }
    points_.counts = ClassCounts(shift_);
    points_.hintedShift = shift_;
    points_.sourceEnd.assign(sources.size(), 0);
    points_.largestColour.assign(sources.size(), 0);
  }

  /// The work of one thread.
  Result<void> work();
  /// After the last thread.
  IngestedPoints finish();

private:
  std::optional<std::uint64_t> placeInOrder(
    std::uint64_t chunk, std::size_t source, std::uint64_t read, const RecordPacker& packer);
  void merge(const RecordPacker& packer, double readSeconds, double quantiseSeconds);

  const Sources& sources_;
  const CommonSchema& schema_;
  const TreeSpace& space_;
  RecordPool& pool_;
  WorkCrew& crew_;
  std::optional<std::size_t> classOffset_;
  unsigned shift_;
  std::vector<std::uint64_t> chunkBegin_; // number of the first chunk of each source
  std::uint64_t chunks_ = 0;
  std::atomic<std::uint64_t> nextChunk_{0};
  std::mutex mutex_; // guards what follows
  std::condition_variable turnChanged_;
  std::uint64_t turn_ = 0; // the chunk whose records are placed next
  IngestedPoints points_;
};

Result<void> Ingest::work()
{
  PointBatch batch;
  RecordPacker packer(schema_, space_, shift_, classOffset_);
  double readSeconds = 0.0;
  double quantiseSeconds = 0.0;
  for (std::uint64_t chunk = nextChunk_++; chunk < chunks_ && !crew_.stopped();
       chunk = nextChunk_++)
  {
    const auto after = std::upper_bound(chunkBegin_.begin(), chunkBegin_.end(), chunk);
    const auto source = static_cast<std::size_t>(after - chunkBegin_.begin() - 1);
    {
      const CpuStopwatch watch(readSeconds);
      const Result<void> done = sources_[source]->read(chunk - chunkBegin_[source], batch);
      if (!done)
      {
        crew_.fail(done.error());
        turnChanged_.notify_all();
        return done;
      }
    }
    const std::uint64_t read = batch.size();
    if (read > sources_[source]->chunkPoints(chunk - chunkBegin_[source]))
    {
      return makeError(Error::Kind::BadFormat,
        "'" + sources_[source]->description().path + "' gave more points than it announced");
    }
    const CpuStopwatch watch(quantiseSeconds);
    packer.pack(sources_[source]->description().schema, source, batch);
    const auto place = placeInOrder(chunk, source, read, packer);
    if (!place)
    {
      break;
    }
    if (Result<void> done = pool_.write(*place, packer.count(), packer.records().data()); !done)
    {
      return done;
    }
    crew_.advance(read);
  }
  merge(packer, readSeconds, quantiseSeconds);
  return {};
}

std::optional<std::uint64_t> Ingest::placeInOrder(
  std::uint64_t chunk, std::size_t source, std::uint64_t read, const RecordPacker& packer)
{
  std::unique_lock<std::mutex> lock(mutex_);
  while (turn_ != chunk && !crew_.stopped())
  {
    turnChanged_.wait_for(lock, std::chrono::milliseconds(50)); // an Error elsewhere ends it too
  }
  if (crew_.stopped())
  {
    return std::nullopt;
  }
  const std::uint64_t place = points_.kept;
  points_.kept += packer.count();
  points_.read += read;
  points_.sourceEnd[source] = points_.kept;
  points_.largestColour[source] = std::max(points_.largestColour[source], packer.largestColour());
  ++turn_;
  turnChanged_.notify_all();
  return place;
}

void Ingest::merge(const RecordPacker& packer, double readSeconds, double quantiseSeconds)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  points_.counts.add(packer.counts());
  points_.low = glm::min(points_.low, packer.low());
  points_.high = glm::max(points_.high, packer.high());
  points_.readSeconds += readSeconds;
  points_.quantiseSeconds += quantiseSeconds;
  for (std::size_t i = 0; i < std::size_t(Rejection::Count); ++i)
  {
    if (const std::uint64_t count = packer.rejected(Rejection(i)))
    {
      points_.rejected[nameOf(Rejection(i))] += count;
    }
  }
}

IngestedPoints Ingest::finish()
{
  for (std::size_t s = 1; s < points_.sourceEnd.size(); ++s) // sources without a chunk
  {
    points_.sourceEnd[s] = std::max(points_.sourceEnd[s], points_.sourceEnd[s - 1]);
  }
  return std::move(points_);
}
} // namespace

std::optional<std::size_t> wideColourColumn(const AttributeSchema& schema)
{
  for (std::size_t c = 0; c < schema.size(); ++c)
  {
    if (schema[c].name == "rgb" && schema[c].type == ScalarType::UInt16)
    {
      return c;
    }
  }
  return std::nullopt;
}

Result<IngestedPoints> ingestPoints(const Sources& sources, const CommonSchema& schema,
  const TreeSpace& space, RecordPool& pool, WorkCrew& crew, std::optional<std::size_t> classOffset)
{
  Ingest ingest(sources, schema, space, pool, crew, classOffset);
  if (Result<void> done = crew.run([&] { return ingest.work(); }); !done)
  {
    return done.error();
  }
  return ingest.finish();
}

} // namespace pointfront
