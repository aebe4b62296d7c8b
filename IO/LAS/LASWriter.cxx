#include "LASWriter.h"

#include "LASPointEncoder.h"
#include "LASzipWriter.h"

#include "pointfront/Disk/OutputFile.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace pointfront
{
namespace
{
/// Encoded together: some MiB at most.
constexpr std::size_t pointsPerBlock = 16384;
} // namespace

struct LASWriter::State
{
  std::string path;
  Encoding encoding;
  LASDate created;
  LASExport plan;
  LASTotals totals;
  std::unique_ptr<OutputFile> file;
  std::optional<LASzipWriter> laszip; ///< after `file`: ends before it
  std::vector<std::byte> records; ///< the records of the current block
  std::uint32_t recordCount = 0;
  std::uint32_t pointOffset = 0;
  std::uint64_t end = 0; ///< bytes in `file`

  Result<void> write(const std::vector<std::byte>& bytes)
  {
    end += bytes.size();
    return file->append(bytes.data(), bytes.size());
  }

  std::vector<std::byte> header(std::uint64_t extendedOffset) const
  {
    return plan.header(totals, recordCount, pointOffset, extendedOffset, encoding == Encoding::Laz);
  }

  Result<void> writeBeginning();
  Result<void> appendBlock(const PointBatch& batch, std::size_t first, std::size_t count);
};

LASWriter::LASWriter(std::string path, Encoding encoding, LASDate created)
  : state_(std::make_unique<State>())
{
  state_->path = std::move(path);
  state_->encoding = encoding;
  state_->created = created;
}

LASWriter::~LASWriter() = default;

std::string LASWriter::path() const
{
  return state_->path;
}

std::vector<std::string> LASWriter::findings() const
{
  return state_->plan.findings(state_->totals);
}

Result<void> LASWriter::begin(const SinkDescription& description)
{
  State& state = *state_;
  assert(!state.file);
  Result<LASExport> plan = LASExport::plan(description, state.path);
  if (!plan)
  {
    return plan.error();
  }
  state.plan = std::move(*plan);
  state.plan.created = state.created;
  Result<std::unique_ptr<OutputFile>> file = OutputFile::create(state.path);
  if (!file)
  {
    return file.error();
  }
  state.file = std::move(*file);
  if (state.encoding == Encoding::Laz)
  {
    Result<LASzipWriter> laszip = LASzipWriter::create(state.plan.layout, state.path);
    if (!laszip)
    {
      return laszip.error();
    }
    state.laszip = std::move(*laszip);
  }
  return state.writeBeginning();
}

/// Header and records; their final counts come in finish().
Result<void> LASWriter::State::writeBeginning()
{
  std::vector<MetadataRecord> all = plan.records;
  if (laszip)
  {
    Result<MetadataRecord> compression = laszip->compressionRecord();
    if (!compression)
    {
      return compression.error();
    }
    all.push_back(std::move(*compression));
  }
  const std::vector<std::byte> bytes = plan.beginning(all);
  recordCount = static_cast<std::uint32_t>(all.size());
  pointOffset = static_cast<std::uint32_t>(bytes.size());
  if (auto done = write(bytes); !done || !laszip)
  {
    return done;
  }
  return laszip->begin(*file, end);
}

Result<void> LASWriter::append(const PointBatch& batch)
{
  assert(state_->file);
  for (std::size_t first = 0; first < batch.size(); first += pointsPerBlock)
  {
    const std::size_t count = std::min(pointsPerBlock, batch.size() - first);
    if (auto done = state_->appendBlock(batch, first, count); !done)
    {
      return done;
    }
  }
  return {};
}

Result<void> LASWriter::State::appendBlock(
  const PointBatch& batch, std::size_t first, std::size_t count)
{
  if (auto done = encodeLASPoints(plan, path, batch, first, count, records, totals); !done)
  {
    return done;
  }
  if (plan.versionMinor < 4 && totals.points > std::numeric_limits<std::uint32_t>::max())
  {
    return makeError(Error::Kind::BadArgument,
      path + ": LAS 1." + std::to_string(plan.versionMinor) +
        " cannot count more than 4294967295 points; export a part of the cloud");
  }
  return laszip ? laszip->append(records.data(), count) : write(records);
}

Result<void> LASWriter::finish()
{
  State& state = *state_;
  assert(state.file);
  if (state.laszip)
  {
    Result<std::uint64_t> end = state.laszip->finish();
    if (!end)
    {
      return end.error();
    }
    state.end = *end;
  }
  const std::uint64_t extendedOffset = state.plan.extendedRecords.empty() ? 0 : state.end;
  for (const MetadataRecord& record : state.plan.extendedRecords)
  {
    if (auto done = state.write(composeLASRecord(record, true)); !done)
    {
      return done;
    }
  }
  const std::vector<std::byte> header = state.header(extendedOffset);
  if (auto done = state.file->overwrite(0, header.data(), header.size()); !done)
  {
    return done;
  }
  return state.file->publish();
}

} // namespace pointfront
