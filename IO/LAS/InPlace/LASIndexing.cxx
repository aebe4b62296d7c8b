#include "LASIndexing.h"

#include "IndexedNormals.h"
#include "LASPointDecoder.h"

#include "pointfront/Base/NumberText.h"
#include "pointfront/Codec/Checksum.h"
#include "pointfront/Export/OutputTarget.h"
#include "pointfront/InPlace/NodePoints.h"
#include "pointfront/Points/NormalAttribute.h"
#include "pointfront/Store/ColumnStatistics.h"
#include "pointfront/Store/GridBounds.h"
#include "pointfront/Threads/WorkerThread.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <mutex>

namespace pointfront
{
namespace
{
constexpr std::uint64_t blockPoints = 65536;
constexpr std::uint64_t edgeBytes = 65536;
constexpr std::uint64_t usualMemory = std::uint64_t(256) << 20;
constexpr double normalsShare = 0.7; ///< share of the time, where normals are computed
constexpr double readingWeight = 0.3; // the other phases are those of indexInPlace()
constexpr double manyRuns = 0.25; ///< runs a point from which on an order is called poor

/// Facts that a pass over all points learns.
struct Survey
{
  RecordBox box;
  std::vector<ColumnRange> ranges;

  explicit Survey(const AttributeSchema& schema)
  {
    for (const Attribute& attribute : schema)
    {
      ranges.push_back(emptyRange(attribute));
    }
  }
  void add(const Survey& other)
  {
    box.add(other.box);
    for (std::size_t c = 0; c < ranges.size(); ++c)
    {
      addRange(ranges[c], other.ranges[c]);
    }
  }
};

void surveyBlock(const LASFile& file, const GridRecords& records, std::uint64_t begin,
  std::uint64_t end, std::vector<std::byte>& values, Survey& survey)
{
  // Some hundred records at a time: they stay in the cache from column to column.
  constexpr std::uint64_t step = 512;
  for (std::uint64_t at = begin; at < end; at += step)
  {
    const std::uint64_t count = std::min(step, end - at);
    survey.box.add(boxOf(records, at, at + count));
    for (std::size_t c = 0; c < file.layout.schema.size(); ++c)
    {
      const Attribute& attribute = file.layout.schema[c];
      values.resize(count * attribute.bytes());
      decodeLASColumn(file.layout, c, records.record(at), count, values.data());
      addRange(survey.ranges[c], rangeOf(values.data(), attribute, count));
    }
  }
}

Result<Survey> surveyPoints(const LASFile& file, const GridRecords& records, WorkCrew& crew,
  const std::function<void(std::uint64_t, std::uint64_t)>& released)
{
  crew.beginPhase("reading", records.count, readingWeight);
  Survey whole(file.layout.schema);
  std::mutex mutex;
  std::atomic<std::uint64_t> next{ 0 };
  Result<void> done = crew.run(
    [&]() -> Result<void>
    {
      Survey own(file.layout.schema);
      std::vector<std::byte> values;
      for (std::uint64_t begin = next.fetch_add(blockPoints);
           begin < records.count && !crew.stopped(); begin = next.fetch_add(blockPoints))
      {
        const std::uint64_t end = std::min(begin + blockPoints, records.count);
        surveyBlock(file, records, begin, end, values, own);
        released(begin, end);
        if (Result<void> there = file.map.checkWhole(); !there)
        {
          return there;
        }
        crew.advance(end - begin);
      }
      const std::lock_guard<std::mutex> lock(mutex);
      whole.add(own);
      return {};
    });
  if (!done)
  {
    return done.error();
  }
  return whole;
}

StoredDescription describe(const LASFile& file, Survey survey)
{
  StoredDescription stored;
  StoreDescription& description = stored.description;
  description.grid = file.header.grid;
  description.crsWkt = file.description.crsWkt;
  description.structure = "inplace";
  description.refinement = Refinement::Add;
  description.schema = file.layout.schema;
  description.ranges = std::move(survey.ranges);
  description.layers.push_back(Layer{ 0, "all", 0, 0 });
  description.metadata = file.description.metadata;
  description.generator = "pointfront " POINTFRONT_VERSION;
  if (!survey.box.empty())
  {
    stored.gridBounds = { GridPosition(survey.box.low), GridPosition(survey.box.high) };
  }
  return stored;
}

/// Path of the LAS file as seen from the side file's folder.
std::string relativeName(const std::string& lasPath, const std::string& sidePath)
{
  namespace fs = std::filesystem;
  std::error_code failure;
  // Absolute first: of a bare name that does not exist yet the canonical path is the name.
  const fs::path from =
    fs::weakly_canonical(fs::absolute(sidePath, failure), failure).parent_path();
  const fs::path to = fs::weakly_canonical(lasPath, failure);
  const fs::path relative = to.lexically_relative(from);
  return relative.empty() ? to.string() : relative.string();
}

/// Size and time of last writing: has somebody written to the file since?
struct FileState
{
  std::uintmax_t bytes = 0;
  std::filesystem::file_time_type written;

  explicit FileState(const std::string& path)
  {
    std::error_code failure;
    bytes = std::filesystem::file_size(path, failure);
    written = std::filesystem::last_write_time(path, failure);
  }
  bool operator!=(const FileState& other) const
  {
    return bytes != other.bytes || written != other.written;
  }
};

void warnOfOrder(LASIndexReport& report)
{
  const double runs = static_cast<double>(report.runs);
  if (report.points > 100000 && runs > manyRuns * static_cast<double>(report.points))
  {
    report.warnings.push_back("The points are in no spatial order (" +
      decimalText(static_cast<double>(report.points) / runs, 1) +
      " a run): reading them in place is slow; a store (pointfront build) or a sorted file draws "
      "faster.");
  }
}

LASIndexReport reportOf(const LASFile& file, const SideFileContent& content,
  const SideFileWriter& writer, const IndexedNormals* normals, double seconds)
{
  LASIndexReport report;
  report.points = content.indexed.points;
  report.nodes = content.table.nodes.size();
  report.runs = content.table.leafRuns;
  report.bytesWritten = writer.bytesWritten();
  report.spilledBytes = content.table.spilledBytes;
  report.seconds = seconds;
  report.warnings = file.description.warnings;
  warnOfOrder(report);
  if (normals != nullptr)
  {
    report.spilledBytes += normals->spilledBytes();
    report.warnings.insert(
      report.warnings.end(), normals->findings().begin(), normals->findings().end());
  }
  return report;
}

Result<LASFile> openToIndex(const std::string& path)
{
  Result<LASFile> file = LASFile::open(path);
  if (file && file->header.compressed)
  {
    return makeError(Error::Kind::Unsupported,
      path +
        ": compressed points (LAZ) cannot be indexed in place; build a store (pointfront "
        "build), or decompress the file");
  }
  if (file)
  {
    if (Result<void> counted = file->countRecords(); !counted)
    {
      return counted.error();
    }
  }
  return file;
}

/// Null where none are asked for.
Result<std::unique_ptr<IndexedNormals>> normalsOf(const LASFile& file,
  const LASIndexOptions& options, const std::string& folder, const ProgressFunction& progress)
{
  if (!options.normals)
  {
    return std::unique_ptr<IndexedNormals>();
  }
  if (file.layout.schema.find(normalAttribute().name))
  {
    return makeError(Error::Kind::BadArgument,
      "the file has an attribute 'normal' of its own, which is drawn; index it without --normals");
  }
  PassResources resources;
  resources.memoryBytes = options.memoryBytes;
  resources.threads = threadsOr(options.threads);
  resources.temporaryFolder = folder;
  resources.progress = partOf(progress, 0.0, normalsShare);
  return IndexedNormals::compute(file.description.path, *options.normals, resources);
}

/// Appends a node's list and its normals.
RunListSink appendingTo(
  SideFileWriter& writer, const IndexedNormals* normals, std::uint64_t count, InPlaceTable& held)
{
  return [&writer, normals, count, &held](const InPlaceTable& table, NodeIndex node,
           const std::vector<std::byte>& list) -> Result<std::uint64_t>
  {
    Result<std::uint64_t> offset = writer.append(list);
    if (normals == nullptr || !offset)
    {
      return offset;
    }
    const auto points = pointsOfList(table, node, list, count);
    if (!points)
    {
      return makeError(Error::Kind::Corrupt,
        "the points changed while they were indexed; index again when nobody writes to the file");
    }
    const Result<void> done = normals->append(*points, writer, held);
    return done ? offset : done.error();
  };
}

Result<SideFileContent> indexPoints(const LASFile& file, const LASIndexOptions& options,
  const std::string& folder, const IndexedNormals* normals, WorkCrew& crew, SideFileWriter& writer)
{
  const GridRecords records = recordsOf(file);
  const auto released = [&](std::uint64_t begin, std::uint64_t end) {
    file.map.release(records.fileOffset + begin * records.stride, (end - begin) * records.stride);
  };
  Result<Survey> survey = surveyPoints(file, records, crew, released);
  if (!survey)
  {
    return survey.error();
  }
  InPlaceOptions inPlace;
  inPlace.leafPoints = options.leafPoints;
  inPlace.memoryBytes = options.memoryBytes;
  inPlace.temporaryFolder = folder;
  InPlaceTable held;
  Result<InPlaceTable> table = indexInPlace(records, survey->box, file.header.grid, inPlace, crew,
    released, appendingTo(writer, normals, records.count, held));
  if (!table)
  {
    return table.error();
  }
  SideFileContent content;
  content.indexed = identityOf(file);
  content.table = std::move(*table);
  content.leafPoints = options.leafPoints;
  content.stored = describe(file, std::move(*survey));
  if (normals != nullptr)
  {
    normals->describe(content.stored.description, options.normalsOrigin);
    content.table.blocks = std::move(held.blocks);
    content.held = 1;
  }
  return content;
}
} // namespace

Result<void> checkIndexable(const std::string& lasPath)
{
  const Result<LASFile> file = openToIndex(lasPath);
  return file ? Result<void>() : file.error();
}

GridRecords recordsOf(const LASFile& file)
{
  GridRecords records;
  records.first = file.map.data() + file.header.pointOffset;
  records.stride = file.layout.pointBytes;
  records.count = file.description.pointCount;
  records.fileOffset = file.header.pointOffset;
  return records;
}

IndexedFile identityOf(const LASFile& file)
{
  const GridRecords records = recordsOf(file);
  const std::uint64_t bytes = records.count * records.stride;
  const auto edge = static_cast<std::size_t>(std::min(bytes, edgeBytes));
  std::vector<std::byte> edges(records.first, records.first + edge);
  edges.insert(edges.end(), records.first + (bytes - edge), records.first + bytes);
  IndexedFile identity;
  identity.bytes = file.map.size();
  identity.points = records.count;
  identity.firstRecord = records.fileOffset;
  identity.recordBytes = static_cast<std::uint32_t>(records.stride);
  identity.headerChecksum = checksumOf(file.map.data(), file.header.pointOffset);
  identity.edgesChecksum = checksumOf(edges.data(), edges.size());
  return identity;
}

Result<LASIndexReport> indexLASFile(const std::string& lasPath, const std::string& sidePath,
  const LASIndexOptions& chosen, const ProgressFunction& progress)
{
  const FileState before(lasPath);
  Result<LASFile> file = openToIndex(lasPath);
  if (!file)
  {
    return file.error();
  }
  Result<void> checked =
    checkOutputTarget({ sidePath, FileKind::SideFile, chosen.overwrite }, { lasPath });
  if (!checked)
  {
    return checked.error();
  }
  Result<std::unique_ptr<SideFileWriter>> writer = SideFileWriter::create(sidePath);
  if (!writer)
  {
    return writer.error();
  }
  LASIndexOptions options = chosen;
  options.memoryBytes = options.memoryBytes > 0 ? options.memoryBytes : usualMemory;
  const std::string beside = std::filesystem::absolute(sidePath).parent_path().string();
  const std::string& folder = options.temporaryFolder.empty() ? beside : options.temporaryFolder;
  const auto begin = std::chrono::steady_clock::now();
  const Result<std::unique_ptr<IndexedNormals>> normals =
    normalsOf(*file, options, folder, progress);
  const double first = options.normals ? normalsShare : 0.0;
  WorkCrew crew(threadsOr(options.threads), partOf(progress, first, 1.0 - first));
  Result<SideFileContent> content = normals
    ? indexPoints(*file, options, folder, normals->get(), crew, **writer)
    : Result<SideFileContent>(normals.error());
  if (!content)
  {
    const bool cancelled = content.error().kind == Error::Kind::Cancelled;
    return makeError(content.error().kind,
      lasPath + ": " +
        (cancelled ? "indexing was cancelled; nothing was written" : content.error().what));
  }
  if (before != FileState(lasPath))
  {
    return makeError(Error::Kind::Corrupt,
      lasPath + ": was written to while it was indexed; index it again when it is finished");
  }
  content->indexed.name = relativeName(lasPath, sidePath);
  if (Result<void> done = (*writer)->commit(*content); !done)
  {
    return done.error();
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  return reportOf(*file, *content, **writer, normals->get(), elapsed.count());
}

} // namespace pointfront
