#include "pointfront/Preview/BuildPreview.h"

#include "pointfront/Base/CpuClock.h"
#include "pointfront/Records/RecordLayout.h"
#include "pointfront/Threads/ThreadCrew.h"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <new>
#include <unistd.h>

namespace pointfront
{
namespace
{
constexpr std::uint64_t mostPoints = 2000000;
constexpr std::uint64_t fewestPoints = 10000;
constexpr std::uint64_t leastShareOfPoints = 256; ///< the sample has at most a 256th of all
constexpr std::uint64_t mostMemory = std::uint64_t(1) << 30;
constexpr std::uint64_t shareOfMemory = 16;
/// Share of that memory: the rest is for records that finished parts hold for the nodes above them.
constexpr double sampleShareOfMemory = 0.65;
/// A version copies what finished parts hold, and joins it level by level.
constexpr std::uint64_t copiesOfHeld = 2;
/// CPU seconds for a point of the sample: the first version's cost is a guess.
constexpr double firstEstimate = 4e-7;
/// Building needs a record twice, its node and what lies between, for each point of the sample.
constexpr std::uint64_t recordsPerPoint = 6;
/// Parts, buffers and tables of a small build, whatever its points.
constexpr std::uint64_t fixedMemory = std::uint64_t(4) << 20;
constexpr std::uint64_t mostPickedChunks = 64;
constexpr std::uint64_t fewestPickedChunks = 4;
constexpr std::uint64_t leastShareOfChunks = 64; ///< at most a 64th of them is decoded twice
/// Shares of the input, read, at which the preview is written again: 1/4, all of it.
constexpr double firstShare = 1.0 / 4.0;
constexpr double shareFactor = 4.0;

std::uint64_t memoryOf(const BuildOptions& build)
{
  const std::uint64_t machine =
    std::uint64_t(sysconf(_SC_PHYS_PAGES)) * std::uint64_t(sysconf(_SC_PAGESIZE));
  const std::uint64_t limit = build.memoryBytes > 0 ? build.memoryBytes : machine / 2;
  return std::min(limit / shareOfMemory, mostMemory);
}

} // namespace

/// A source that gives the preview a share of what is read from it.
class BuildPreview::WatchedSource final : public PointSource
{
public:
  WatchedSource(const PointSource& original, std::size_t number, BuildPreview& preview)
    : original_(original)
    , number_(number)
    , preview_(preview)
    , share_(preview.active()
          ? double(preview.capacity_) / double(std::max<std::uint64_t>(preview.expected_, 1))
          : 0.0)
    , seen_(original.chunkCount())
  {
  }
  const SourceDescription& description() const override { return original_.description(); }
  std::uint64_t chunkCount() const override { return original_.chunkCount(); }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override
  {
    return original_.chunkPoints(chunk);
  }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override
  {
    return watched(chunk, batch, original_.read(chunk, batch));
  }
  Result<void> readSteps(std::uint64_t chunk, PointBatch& batch) const override
  {
    return watched(chunk, batch, original_.readSteps(chunk, batch));
  }

private:
  Result<void> watched(std::uint64_t chunk, const PointBatch& batch, Result<void> done) const
  {
    if (done && share_ > 0.0)
    {
      preview_.sample_.keep(number_, chunk, original_.description(), batch, std::min(1.0, share_));
      // The build reads some chunks again: to guess its columns, or when that guess was wrong.
      if (!seen_[chunk].exchange(true))
      {
        preview_.pointsWereRead(batch.size());
      }
    }
    return done;
  }

  const PointSource& original_;
  std::size_t number_;
  BuildPreview& preview_;
  double share_;
  mutable std::vector<std::atomic<bool>> seen_; // chunks, counted as read
};

BuildPreview::BuildPreview(const BuildOptions& build, PreviewOptions options)
  : build_(build)
  , options_(std::move(options))
{
}

Result<std::unique_ptr<BuildPreview>> BuildPreview::create(
  const PointSources& sources, const BuildOptions& build, const PreviewOptions& options)
{
  std::unique_ptr<BuildPreview> preview(new BuildPreview(build, options));
  auto file = PreviewFile::claim(build.outputPath); // also for a build without: it cleans up
  if (!file)
  {
    return file.error();
  }
  preview->file_ = std::move(*file);
  preview->chooseCapacity(sources);
  return preview;
}

void BuildPreview::chooseCapacity(const PointSources& sources)
{
  std::size_t pointBytes = 0;
  std::size_t recordBytes = 0;
  for (const auto& source : sources)
  {
    const AttributeSchema& schema = source->description().schema;
    pointBytes = std::max(pointBytes, sizeof(glm::dvec3) + schema.pointBytes());
    recordBytes = std::max(recordBytes, RecordLayout(schema).bytes());
    expected_ += source->description().pointCount;
    chunks_ += source->chunkCount();
  }
  memoryBytes_ = memoryOf(build_);
  const bool worthIt = options_.wanted && expected_ >= options_.leastPoints;
  if (!worthIt || memoryBytes_ <= 2 * fixedMemory)
  {
    memoryBytes_ = 0;
    return;
  }
  const auto forSample = static_cast<std::uint64_t>(sampleShareOfMemory * double(memoryBytes_));
  const std::uint64_t fitting =
    (forSample - fixedMemory) / (2 * pointBytes + recordsPerPoint * recordBytes);
  capacity_ =
    std::min({ mostPoints, fitting, std::max(fewestPoints, expected_ / leastShareOfPoints) });
}

BuildPreview::~BuildPreview()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  if (refiner_.started())
  {
    refiner_.join();
  }
}

void BuildPreview::showOverview(const PointSources& sources, const ProgressFunction& progress)
{
  if (!active() || sources.empty())
  {
    return;
  }
  Progress state;
  state.phase = "overview";
  state.total = expected_;
  if (progress && !progress(state))
  {
    return; // whoever cancels is asked again by the build
  }
  const auto goOn = [&] { return !progress || progress(state); };
  firstShown_ = sources.front().get();
  try
  {
    pickChunks(sources, goOn);
  }
  catch (const std::bad_alloc&)
  {
    tell(makeError(Error::Kind::NoMemory, "the system gave no more memory"));
    return;
  }
  show(sources, 0, threadsOr(build_.threads), goOn);
}

void BuildPreview::pickChunks(const PointSources& sources, const std::function<bool()>& goOn)
{
  const std::uint64_t picks = std::min(
    chunks_, std::clamp(chunks_ / leastShareOfChunks, fewestPickedChunks, mostPickedChunks));
  std::vector<std::pair<std::size_t, std::uint64_t>> picked; // source, chunk
  std::uint64_t points = 0;
  std::size_t source = 0;
  std::uint64_t before = 0; // chunks of the sources before
  for (std::uint64_t i = 0; i < picks; ++i)
  {
    const auto chunk =
      static_cast<std::uint64_t>((double(i) + 0.5) * double(chunks_) / double(picks));
    while (chunk >= before + sources[source]->chunkCount())
    {
      before += sources[source++]->chunkCount();
    }
    picked.emplace_back(source, chunk - before);
    points += sources[source]->chunkPoints(chunk - before);
  }
  // Half of the sample: the rest is for what the build reads before it comes to these chunks.
  const double share =
    std::min(1.0, double(capacity_) / double(2 * std::max<std::uint64_t>(points, 1)));
  ThreadCrew crew(
    static_cast<unsigned>(std::min<std::uint64_t>(threadsOr(build_.threads), picked.size())));
  std::vector<PointBatch> batches(crew.threads());
  crew.run(picked.size(),
    [&](std::size_t i, unsigned thread)
    {
      const auto [number, chunk] = picked[i];
      PointBatch& batch = batches[thread];
      if (sources[number]->read(chunk, batch)) // the build meets, and tells, what is wrong
      {
        sample_.keep(number, chunk, sources[number]->description(), batch, share);
      }
    });
  mixed_ = goOn();
}

Result<BuildReport> BuildPreview::build(
  const PointSources& sources, const BuildOptions& options, const ProgressFunction& progress)
{
  const PointSources watchedSources = watched(sources);
  Result<BuildReport> report =
    buildStore(watchedSources, options, progress, active() ? this : nullptr);
  if (report)
  {
    const std::vector<std::string> told = warnings();
    report->warnings.insert(report->warnings.end(), told.begin(), told.end());
  }
  return report;
}

PointSources BuildPreview::watched(const PointSources& sources)
{
  PointSources result;
  for (std::size_t s = 0; s < sources.size(); ++s)
  {
    result.push_back(std::make_unique<WatchedSource>(*sources[s], s, *this));
  }
  if (active() && !sources.empty())
  {
    if (sources.front().get() != firstShown_)
    {
      sample_.clear(); // other coordinates, other columns
      mixed_ = false;
    }
    sources_ = &sources;
    // Where there is no thread for it, the overview stays until parts are finished.
    static_cast<void>(refiner_.start([this, &sources] { refine(sources); }));
  }
  return result;
}

void BuildPreview::pointsWereRead(std::uint64_t points)
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    read_ += points;
  }
  changed_.notify_all();
}

void BuildPreview::refine(const PointSources& sources)
{
  // Without points from all over the cloud a part of it would replace an overview of the whole.
  double share = mixed_ ? firstShare : 1.0;
  while (share <= 1.0)
  {
    const auto wanted = static_cast<std::uint64_t>(share * double(expected_));
    std::uint64_t read = 0;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [&] { return stop_ || allRead_ || read_ >= wanted; });
      if (stop_ || allRead_)
      {
        return;
      }
      read = read_;
      refining_ = true;
    }
    const std::chrono::duration<double> age = std::chrono::steady_clock::now() - shownAt_;
    if (age.count() >= options_.leastSeconds)
    {
      show(sources, read, 1, [this] { return !stopped(); });
    }
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      refining_ = false;
    }
    do
    {
      share *= shareFactor;
    } while (share <= 1.0 && static_cast<double>(read) >= share * double(expected_));
  }
}

void BuildPreview::show(const PointSources& originals, std::uint64_t pointsRead, unsigned threads,
  const std::function<bool()>& goOn)
{
  Result<void> done;
  try
  {
    done = write(originals, pointsRead, threads, goOn);
  }
  catch (const std::bad_alloc&)
  {
    done = makeError(Error::Kind::NoMemory, "the system gave no more memory");
  }
  tell(done);
}

void BuildPreview::tell(const Result<void>& done)
{
  if (done)
  {
    shownAt_ = std::chrono::steady_clock::now();
    if (options_.shown)
    {
      options_.shown(file_->path());
    }
  }
  else if (done.error().kind != Error::Kind::Cancelled)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    warnings_.push_back("The preview was not written: " + done.error().what + ".");
  }
}

bool BuildPreview::stopped() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return stop_;
}

PreviewRecord BuildPreview::recordOf(std::uint64_t pointsRead) const
{
  PreviewRecord record;
  record.storeName = std::filesystem::path(build_.outputPath).filename().string();
  record.pointsExpected = expected_;
  record.pointsRead = pointsRead;
  return record;
}

Result<void> BuildPreview::write(const PointSources& originals, std::uint64_t pointsRead,
  unsigned threads, const std::function<bool()>& goOn)
{
  BuildOptions options;
  options.outputPath = file_->nextPath();
  options.overwrite = true;
  options.temporaryFolder = build_.temporaryFolder;
  options.memoryBytes = std::max(memoryBytes_ / 3, 2 * fixedMemory);
  options.threads = threads;
  options.precision = build_.precision;
  options.attributes = build_.attributes;
  const PointSources sample = sample_.snapshot(originals, previewMetadata(recordOf(pointsRead)));
  const Result<BuildReport> built =
    buildStore(sample, options, [&](const Progress&) { return goOn(); });
  return built ? file_->replace() : Result<void>(built.error());
}

PointSources BuildPreview::sample()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    allRead_ = true;
  }
  changed_.notify_all();
  began_ = processSeconds();
  estimate_ = firstEstimate * double(sample_.points());
  PointSources taken = sample_.snapshot(*sources_, {});
  sample_.clear(); // the refiner keeps the points that it still has at hand
  return taken;
}

bool BuildPreview::due(std::size_t bytes)
{
  const double affordable = options_.shareOfTime * (processSeconds() - began_);
  if (spent_ + estimate_ > affordable)
  {
    return false;
  }
  const double left = (1.0 - sampleShareOfMemory) * double(memoryBytes_);
  const bool fits = double(copiesOfHeld * bytes) <= left;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!fits && !tooLittleMemory_)
  {
    tooLittleMemory_ = true;
    warnings_.push_back("The preview shows no finished parts: the memory limit leaves " +
      std::to_string(std::uint64_t(left)) + " bytes for it, " +
      std::to_string(copiesOfHeld * bytes) + " are needed.");
  }
  return fits && !refining_;
}

void BuildPreview::show(PartialStore& store)
{
  double seconds = 0.0;
  Result<void> done;
  try
  {
    const CpuStopwatch watch(seconds);
    PreviewRecord record = recordOf(expected_);
    record.pointsFinished = store.pointsFinished();
    done = store.write(file_->nextPath(), previewMetadata(record));
    if (done)
    {
      done = file_->replace();
    }
  }
  catch (const std::bad_alloc&)
  {
    done = makeError(Error::Kind::NoMemory, "the system gave no more memory");
  }
  spent_ += seconds;
  estimate_ = seconds;
  tell(done);
}

std::vector<std::string> BuildPreview::warnings() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return warnings_;
}

} // namespace pointfront
