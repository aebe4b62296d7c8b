#include "pointfront/Ingest/PointIngest.h"

#include "pointfront/Base/CpuClock.h"
#include "pointfront/Ingest/RecordPacker.h"
#include "pointfront/Records/WriteBehind.h"

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

/// Cells such that a surface has some thousand points in each: enough of them to cut parts along,
/// and few enough for the nearest caches. Of 2^least to the 512th part of the declared extent, if
/// `least` is less; coarsened as points come, counted again if too coarse.
unsigned hintedShift(const Sources& sources, const TreeSpace& space, double least)
{
  constexpr double pointsOfCell = 1024.0;
  Bounds bounds;
  double points = 1.0;
  for (const auto& source : sources)
  {
    bounds.add(source->description().declaredBounds);
    points += static_cast<double>(source->description().pointCount);
  }
  const double cellsLog2 =
    std::clamp(std::ceil(0.5 * std::log2(points / pointsOfCell)), least, std::max(least, 9.0));
  const glm::dvec3 size = bounds.empty() ? glm::dvec3(0.0) : bounds.size();
  const double steps = std::max({ size.x, size.y, size.z }) / space.stepLength();
  const double bits = std::log2(std::max(1.0, steps)) - cellsLog2;
  return bits > 0.0 && std::isfinite(bits) ? static_cast<unsigned>(std::min(bits, 26.0)) : 0u;
}

/// Chunks of one source that become a block.
struct ChunkRun
{
  std::size_t source = 0;
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
  std::uint64_t points = 0; ///< at most
};

std::vector<ChunkRun> chunkRuns(const Sources& sources, std::uint64_t blockPoints)
{
  std::vector<ChunkRun> runs;
  for (std::size_t s = 0; s < sources.size(); ++s)
  {
    for (std::uint64_t chunk = 0; chunk < sources[s]->chunkCount(); ++chunk)
    {
      const std::uint64_t more = sources[s]->chunkPoints(chunk);
      if (chunk == 0 || runs.back().points + more > blockPoints)
      {
        runs.push_back({ s, chunk, chunk, 0 });
      }
      runs.back().points += more;
      runs.back().end = chunk + 1;
    }
  }
  return runs;
}

/// One run over all chunks of all sources, shared by the threads.
class Ingest
{
public:
  Ingest(const IngestSite& site, std::optional<std::size_t> classOffset)
    : site_(site)
    , classOffset_(classOffset)
    , shift_(hintedShift(site.sources, site.space, site.leastCellsLog2))
    , runs_(chunkRuns(site.sources, site.blockPoints))
  {
    points_.counts = ClassCounts(shift_);
    points_.hintedShift = shift_;
    points_.sourceEnd.assign(site.sources.size(), 0);
    points_.largestColour.assign(site.sources.size(), 0);
    points_.wrong.assign(site.common.schema.size(), false);
    points_.blocks.resize(runs_.size());
    if (site.pool.onDisk())
    {
      // A block is read in longer than one is written: no thread needs two.
      behind_.emplace(site.pool, site.crew.threads());
    }
    for (const auto& source : site.sources)
    {
      onGrid_.push_back(source->description().grid == site.space.grid);
    }
  }

  /// The work of one thread.
  Result<void> work();
  /// After the last thread.
  Result<IngestedPoints> finish();

private:
  /// The work of one thread.
  struct Share
  {
    std::uint64_t points = 0; ///< read
    double readSeconds = 0.0; ///< CPU
    double quantiseSeconds = 0.0;
  };
  Result<bool> fill(const ChunkRun& run, RecordPacker& packer, PointBatch& batch, Share& share);
  Result<bool> store(std::size_t number, RecordPacker& packer);
  bool placeInOrder(std::size_t number, const RecordPacker& packer);
  void merge(const RecordPacker& packer, const Share& share);
  bool over() const { return site_.crew.stopped() || guessedWrong_; }

  const IngestSite& site_;
  std::optional<std::size_t> classOffset_;
  unsigned shift_;
  std::vector<ChunkRun> runs_;
  std::vector<bool> onGrid_; // whether the grid of each source is the store's
  std::optional<WriteBehind> behind_; // for a pool on disk
  std::atomic<std::size_t> nextRun_{ 0 };
  std::atomic<bool> guessedWrong_{ false };
  std::mutex mutex_; // guards what follows
  std::condition_variable turnChanged_;
  std::size_t turn_ = 0; // the run whose records are placed next
  IngestedPoints points_;
};

Result<void> Ingest::work()
{
  PointBatch batch;
  RecordPacker packer(site_.common, site_.columns, site_.space, shift_, classOffset_);
  Share share;
  for (std::size_t number = nextRun_++; number < runs_.size() && !over(); number = nextRun_++)
  {
    auto filled = fill(runs_[number], packer, batch, share);
    if (filled && *filled)
    {
      const CpuStopwatch watch(share.quantiseSeconds);
      filled = store(number, packer);
    }
    if (!filled)
    {
      site_.crew.fail(filled.error());
      turnChanged_.notify_all();
      return filled.error();
    }
    if (!*filled)
    {
      break;
    }
  }
  merge(packer, share);
  return {};
}

/// False when the run is given up.
Result<bool> Ingest::fill(
  const ChunkRun& run, RecordPacker& packer, PointBatch& batch, Share& share)
{
  const PointSource& source = *site_.sources[run.source];
  packer.begin(run.points);
  for (std::uint64_t chunk = run.begin; chunk < run.end; ++chunk)
  {
    {
      const CpuStopwatch watch(share.readSeconds);
      const Result<void> done =
        onGrid_[run.source] ? source.readSteps(chunk, batch) : source.read(chunk, batch);
      if (!done)
      {
        return done.error();
      }
    }
    const std::uint64_t read = batch.size();
    if (read > source.chunkPoints(chunk))
    {
      return makeError(Error::Kind::BadFormat,
        "'" + source.description().path + "' gave more points than it announced");
    }
    share.points += read;
    const CpuStopwatch watch(share.quantiseSeconds);
    if (!packer.append(source.description().schema, run.source, batch))
    {
      guessedWrong_ = true;
      turnChanged_.notify_all();
    }
    if (over())
    {
      return false;
    }
    site_.crew.advance(read);
  }
  return true;
}

/// False when the run is given up.
Result<bool> Ingest::store(std::size_t number, RecordPacker& packer)
{
  PoolBlock& block = points_.blocks[number]; // this thread's own until all are done
  block.runs = packer.order();
  block.shift = packer.runShift();
  block.count = packer.count();
  if (!placeInOrder(number, packer))
  {
    return false;
  }
  if (block.count == 0)
  {
    return true;
  }
  if (!behind_)
  {
    packer.writeTo(site_.pool.memory(block.first));
    return true;
  }
  auto sorted = behind_->buffer(block.count * site_.pool.recordBytes());
  if (!sorted)
  {
    return sorted.error();
  }
  packer.writeTo(sorted->data());
  behind_->write(block.first, block.count, std::move(*sorted));
  return true;
}

bool Ingest::placeInOrder(std::size_t number, const RecordPacker& packer)
{
  std::unique_lock<std::mutex> lock(mutex_);
  while (turn_ != number && !over())
  {
    turnChanged_.wait_for(lock, std::chrono::milliseconds(50)); // an Error elsewhere ends it too
  }
  if (over())
  {
    return false;
  }
  const std::size_t source = runs_[number].source;
  points_.blocks[number].first = points_.kept;
  points_.kept += packer.count();
  points_.sourceEnd[source] = points_.kept;
  points_.largestColour[source] = std::max(points_.largestColour[source], packer.largestColour());
  ++turn_;
  turnChanged_.notify_all();
  return true;
}

void Ingest::merge(const RecordPacker& packer, const Share& share)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  points_.counts.add(packer.counts());
  points_.read += share.points;
  points_.low = glm::min(points_.low, packer.low());
  points_.high = glm::max(points_.high, packer.high());
  points_.readSeconds += share.readSeconds;
  points_.quantiseSeconds += share.quantiseSeconds;
  for (std::size_t c = 0; c < points_.wrong.size(); ++c)
  {
    points_.wrong[c] = points_.wrong[c] || packer.wrong()[c];
  }
  for (std::size_t i = 0; i < std::size_t(Rejection::Count); ++i)
  {
    if (const std::uint64_t count = packer.rejected(Rejection(i)))
    {
      points_.rejected[nameOf(Rejection(i))] += count;
    }
  }
}

Result<IngestedPoints> Ingest::finish()
{
  if (behind_)
  {
    if (Result<void> done = behind_->finish(); !done)
    {
      return done.error();
    }
    points_.quantiseSeconds += behind_->seconds();
  }
  points_.guessedWrong = guessedWrong_;
  for (std::size_t s = 1; s < points_.sourceEnd.size(); ++s) // sources without a chunk
  {
    points_.sourceEnd[s] = std::max(points_.sourceEnd[s], points_.sourceEnd[s - 1]);
  }
  return std::move(points_);
}
} // namespace

Result<IngestedPoints> ingestPoints(const IngestSite& site, std::optional<std::size_t> classOffset)
{
  Ingest ingest(site, classOffset);
  if (Result<void> done = site.crew.run([&] { return ingest.work(); }); !done)
  {
    return done.error();
  }
  return ingest.finish();
}

} // namespace pointfront
