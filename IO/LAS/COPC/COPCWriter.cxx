#include "COPCWriter.h"

#include "COPCChunks.h"
#include "COPCGrid.h"
#include "COPCLevels.h"
#include "COPCMemory.h"
#include "COPCPages.h"
#include "COPCRecords.h"
#include "LASBytes.h"
#include "LASPointEncoder.h"
#include "LASRecords.h"

#include "pointfront/Base/ExportClock.h"
#include "pointfront/Disk/OutputFile.h"
#include "pointfront/Disk/TemporaryFile.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <optional>
#include <thread>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::size_t pointsPerBlock = 16384; ///< encoded together
constexpr std::size_t infoBytes = 160;
constexpr std::size_t gpsTimeAt = 22; ///< in records of formats 6 to 8
constexpr const char* owner = "copc";

/// Some records that come next, so that a point's node can be told by those behind it.
class RecordsAhead
{
public:
  RecordsAhead(COPCRecords& records, std::size_t width)
    : records_(records)
    , width_(width)
    , keys_(size)
    , bytes_(size * width)
  {
  }

  /// Has the current record and COPCLevels::leafPoints behind it, as far as there are so many.
  Result<void> fill()
  {
    while (!ended_ && end_ - at_ < size)
    {
      const Result<std::optional<COPCRecords::Record>> next = records_.next();
      if (!next)
      {
        return next.error();
      }
      if (!*next)
      {
        ended_ = true;
        break;
      }
      keys_[end_ % size] = (*next)->key;
      std::memcpy(bytes_.data() + (end_ % size) * width_, (*next)->bytes, width_);
      ++end_;
    }
    return {};
  }

  bool any() const { return at_ < end_; }
  std::uint64_t position() const { return at_; }
  const std::byte* record() const { return bytes_.data() + (at_ % size) * width_; }
  std::uint64_t key() const { return keys_[at_ % size]; }
  /// Levels that the current record has in common with that `ahead` behind it; -1: none is there.
  int commonLevels(std::uint64_t ahead) const
  {
    return at_ + ahead < end_ ? COPCGrid::commonLevels(key(), keys_[(at_ + ahead) % size]) : -1;
  }
  void advance() { ++at_; }

private:
  static constexpr std::size_t size = COPCLevels::leafPoints + 1;

  COPCRecords& records_;
  std::size_t width_;
  std::vector<std::uint64_t> keys_;
  std::vector<std::byte> bytes_;
  std::uint64_t at_ = 0;
  std::uint64_t end_ = 0;
  bool ended_ = false;
};
} // namespace

struct COPCWriter::State
{
  std::string path;
  Options options;
  LASExport plan;
  COPCMemory memory;
  LASTotals totals;
  double firstTime = 0.0; ///< least and largest GPS time
  double lastTime = 0.0;
  std::unique_ptr<OutputFile> file;
  std::optional<COPCRecords> records;
  std::vector<std::byte> block;
  std::uint32_t recordCount = 0;
  std::uint32_t pointOffset = 0;
  std::uint64_t end = 0; ///< bytes in `file`
  bool lostSystem = false;

  Result<void> write(const std::vector<std::byte>& bytes)
  {
    end += bytes.size();
    return file->append(bytes.data(), bytes.size());
  }
  std::string temporaryFolder() const
  {
    return options.temporaryFolder.empty() ? folderOf(path) : options.temporaryFolder;
  }
  Error cancelled() const { return makeError(Error::Kind::Cancelled, path + ": export cancelled"); }

  void countTimes();
  Result<void> writeBeginning();
  Result<void> writeNodes(const COPCGrid& grid, COPCChunks& chunks);
  Result<void> writeEnd(const COPCGrid& grid, COPCChunks& chunks);
  std::vector<std::byte> info(
    const COPCGrid& grid, std::uint64_t rootOffset, std::uint64_t rootBytes) const;
};

COPCWriter::COPCWriter(std::string path, Options options)
  : state_(std::make_unique<State>())
{
  state_->path = std::move(path);
  state_->options = std::move(options);
}

COPCWriter::~COPCWriter() = default;

std::string COPCWriter::path() const
{
  return state_->path;
}

std::vector<std::string> COPCWriter::findings() const
{
  std::vector<std::string> found = state_->plan.findings(state_->totals);
  if (state_->lostSystem)
  {
    found.push_back(
      "The coordinate reference system is known by GeoTIFF keys only, which COPC does "
      "not have; the file names none (a build with " +
      state_->options.assumedCrsName + " gives it one).");
  }
  return found;
}

Result<void> COPCWriter::begin(const SinkDescription& description)
{
  State& state = *state_;
  assert(!state.file);
  Result<LASExport> plan = LASExport::plan(description, state.path, LASExport::Formats::OfCOPC);
  if (!plan)
  {
    return plan.error();
  }
  state.plan = std::move(*plan);
  state.plan.created = state.options.created;
  state.lostSystem = state.plan.lostGeoKeys;
  const Result<COPCMemory> memory =
    COPCMemory::share(state.options.memoryBytes, state.options.readBytes,
      state.plan.layout.pointBytes, std::min(std::thread::hardware_concurrency(), 16u), state.path);
  if (!memory)
  {
    return memory.error();
  }
  state.memory = *memory;
  Result<std::unique_ptr<OutputFile>> file = OutputFile::create(state.path);
  if (!file)
  {
    return file.error();
  }
  state.file = std::move(*file);
  state.records.emplace(COPCRecords::Options{ state.plan.layout.pointBytes, memory->recordBytes,
    memory->mergeBytes, state.temporaryFolder(), description.pointCount });
  return {};
}

Result<void> COPCWriter::append(const PointBatch& batch)
{
  State& state = *state_;
  assert(state.file);
  for (std::size_t first = 0; first < batch.size(); first += pointsPerBlock)
  {
    const std::size_t count = std::min(pointsPerBlock, batch.size() - first);
    if (auto done =
          encodeLASPoints(state.plan, state.path, batch, first, count, state.block, state.totals);
        !done)
    {
      return done;
    }
    state.countTimes();
    if (auto done = state.records->append(state.block.data(), count); !done)
    {
      return done;
    }
  }
  return {};
}

/// Looks at the block that was encoded last. Times that are no number are in no range.
void COPCWriter::State::countTimes()
{
  const std::size_t width = plan.layout.pointBytes;
  bool any = totals.points > block.size() / width;
  for (std::size_t at = 0; at < block.size(); at += width)
  {
    const auto time = loadNumber<double>(block.data() + at + gpsTimeAt);
    if (time == time)
    {
      firstTime = any ? std::min(firstTime, time) : time;
      lastTime = any ? std::max(lastTime, time) : time;
      any = true;
    }
  }
}

/// Header, the records with that of COPC as the first, and the place of the chunk table's address.
Result<void> COPCWriter::State::writeBeginning()
{
  Result<LASzipWriter> laszip =
    LASzipWriter::create(plan.layout, path, LASzipWriter::Chunks::Variable);
  if (!laszip)
  {
    return laszip.error();
  }
  Result<MetadataRecord> compression = laszip->compressionRecord();
  if (!compression)
  {
    return compression.error();
  }
  std::vector<MetadataRecord> all;
  all.push_back({ owner, 1, "COPC info", std::vector<std::byte>(infoBytes) });
  all.push_back(std::move(*compression));
  all.insert(all.end(), plan.records.begin(), plan.records.end());
  std::vector<std::byte> bytes = plan.beginning(all);
  recordCount = static_cast<std::uint32_t>(all.size());
  pointOffset = static_cast<std::uint32_t>(bytes.size());
  bytes.resize(bytes.size() + 8);
  return write(bytes);
}

Result<void> COPCWriter::State::writeNodes(const COPCGrid& grid, COPCChunks& chunks)
{
  ExportClock clock(options.progress, totals.points, "writing");
  RecordsAhead ahead(*records, plan.layout.pointBytes);
  COPCLevels levels;
  std::uint64_t before = 0;
  for (;; ahead.advance())
  {
    if (auto done = ahead.fill(); !done)
    {
      return done;
    }
    if (!ahead.any())
    {
      break;
    }
    const bool first = ahead.position() == 0;
    const int differs = first ? 0 : COPCGrid::commonLevels(before, ahead.key()) + 1;
    before = ahead.key();
    const int level = levels.place(differs, ahead.commonLevels(COPCLevels::leafPoints),
      ahead.commonLevels(COPCLevels::leastPoints));
    if (auto done = chunks.close(differs); !done)
    {
      return done;
    }
    const glm::uvec3 cell = grid.cell(ahead.record());
    const int shift = COPCGrid::keyLevels - level;
    if (auto done =
          chunks.add(level, { cell.x >> shift, cell.y >> shift, cell.z >> shift }, ahead.record());
        !done)
    {
      return done;
    }
    if (!clock.report(ahead.position()))
    {
      return cancelled();
    }
  }
  if (auto done = chunks.close(0); !done)
  {
    return done;
  }
  return chunks.settle();
}

std::vector<std::byte> COPCWriter::State::info(
  const COPCGrid& grid, std::uint64_t rootOffset, std::uint64_t rootBytes) const
{
  std::vector<std::byte> bytes(infoBytes);
  for (int axis = 0; axis < 3; ++axis)
  {
    storeNumber(bytes.data() + 8 * axis, grid.centre()[axis]);
  }
  constexpr double cells = 1 << COPCLevels::sampleLevels;
  storeNumber(bytes.data() + 24, grid.halfSize());
  storeNumber(bytes.data() + 32, 2.0 * grid.halfSize() / cells);
  storeNumber(bytes.data() + 40, rootOffset);
  storeNumber(bytes.data() + 48, rootBytes);
  storeNumber(bytes.data() + 56, firstTime);
  storeNumber(bytes.data() + 64, lastTime);
  return bytes;
}

/// The chunk table, the extended records, and all that points to them.
Result<void> COPCWriter::State::writeEnd(const COPCGrid& grid, COPCChunks& chunks)
{
  const std::uint64_t tableOffset = end = chunks.end();
  if (auto done = write(chunks.table()); !done)
  {
    return done;
  }
  const std::uint64_t extendedOffset = end;
  const std::uint64_t rootOffset = end + lasExtendedRecordHeaderBytes;
  COPCPages pages = COPCPages::compose(std::move(chunks.nodes()), rootOffset);
  const MetadataRecord hierarchy{ owner, 1000, "EPT hierarchy", std::move(pages.bytes) };
  plan.extendedRecords.insert(plan.extendedRecords.begin(), hierarchy);
  for (const MetadataRecord& record : plan.extendedRecords)
  {
    if (auto done = write(composeLASRecord(record, true)); !done)
    {
      return done;
    }
  }
  const std::vector<std::byte> copc = info(grid, rootOffset, pages.rootBytes);
  if (auto done =
        file->overwrite(plan.headerBytes() + lasRecordHeaderBytes, copc.data(), copc.size());
      !done)
  {
    return done;
  }
  std::vector<std::byte> place(8);
  storeNumber(place.data(), tableOffset);
  if (auto done = file->overwrite(pointOffset, place.data(), place.size()); !done)
  {
    return done;
  }
  const std::vector<std::byte> header =
    plan.header(totals, recordCount, pointOffset, extendedOffset, true);
  return file->overwrite(0, header.data(), header.size());
}

Result<void> COPCWriter::finish()
{
  State& state = *state_;
  assert(state.file);
  const COPCGrid grid(state.totals, state.plan.grid);
  state.block = std::vector<std::byte>();
  COPCMemory::giveBack();
  ExportClock clock(state.options.progress, state.totals.points, "sorting");
  if (auto done =
        state.records->sort(grid, [&clock](std::uint64_t sorted) { return clock.report(sorted); });
      !done)
  {
    return done;
  }
  if (auto done = state.writeBeginning(); !done)
  {
    return done;
  }
  COPCMemory::giveBack();
  COPCChunks chunks(
    state.plan.layout, state.path, *state.file, state.end, state.memory, state.temporaryFolder());
  if (auto done = state.writeNodes(grid, chunks); !done)
  {
    return done;
  }
  state.records.reset();
  if (auto done = state.writeEnd(grid, chunks); !done)
  {
    return done;
  }
  return state.file->publish();
}

} // namespace pointfront
