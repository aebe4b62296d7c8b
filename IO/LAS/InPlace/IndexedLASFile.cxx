#include "IndexedLASFile.h"

#include "LASIndexing.h"
#include "LASPointDecoder.h"

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/InPlace/NodePoints.h"
#include "pointfront/InPlace/SampleStream.h"
#include "pointfront/Store/ColumnStatistics.h"
#include "pointfront/Store/NodeTableSection.h"
#include "pointfront/Store/StoreVerification.h"
#include "pointfront/Trees/PrefixOrder.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <filesystem>

namespace pointfront
{
namespace
{
constexpr std::size_t pageBytes = 4096;
constexpr double secondsBetweenReports = 0.1;
/// The places of a node's points, which ascend by number, in the prefix order.
std::vector<std::uint32_t> prefixOrder(const std::vector<std::uint64_t>& points)
{
  std::vector<NumberedHash> hashes(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i)
  {
    hashes[i] = { i, static_cast<std::uint32_t>(SampleStream::mixed(points[i]) >> 32) };
  }
  return prefixBatches(std::move(hashes));
}

/// Values of `stride` bytes in that order.
std::vector<std::byte> ordered(
  const std::byte* values, std::size_t stride, const std::vector<std::uint32_t>& order)
{
  std::vector<std::byte> result(order.size() * stride);
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    std::memcpy(result.data() + i * stride, values + order[i] * stride, stride);
  }
  return result;
}

void decodeSteps(const GridRecords& gathered, const glm::ivec3& low, NodeColumns& to)
{
  to.origin = GridPosition(low);
  for (std::size_t i = 0; i < to.positions.size(); ++i)
  {
    // Modulo 2^32: bytes that somebody changed since are wrong, never undefined.
    const glm::ivec3 position = gathered.position(i);
    for (int axis = 0; axis < 3; ++axis)
    {
      to.positions[i][axis] =
        static_cast<std::uint32_t>(position[axis]) - static_cast<std::uint32_t>(low[axis]);
    }
  }
}

std::string numbers(const char* what, std::uint64_t now, std::uint64_t then)
{
  return std::string(what) + " " + std::to_string(now) + ", not " + std::to_string(then);
}

std::string differenceOf(const IndexedFile& now, const IndexedFile& then)
{
  if (now.bytes != then.bytes)
  {
    return numbers("its size in bytes is", now.bytes, then.bytes);
  }
  if (now.headerChecksum != then.headerChecksum)
  {
    return "its header is another one";
  }
  if (now.points != then.points)
  {
    return numbers("its points are", now.points, then.points);
  }
  if (now.firstRecord != then.firstRecord || now.recordBytes != then.recordBytes)
  {
    return "its points lie elsewhere";
  }
  return now.edgesChecksum != then.edgesChecksum ? "its first or last points are others" : "";
}

/// Before a byte of the file is read: a side file may come from anywhere and name anything, a
/// device or a pipe that never answers as well.
Result<void> checkPlace(
  const std::string& sidePath, const std::string& lasPath, const IndexedFile& indexed)
{
  std::error_code failure;
  if (!std::filesystem::exists(lasPath, failure))
  {
    return makeError(Error::Kind::NotFound,
      "'" + sidePath + "' is an index of '" + lasPath +
        "', which is not there; move it back, or index it where it is: pointfront index");
  }
  if (!std::filesystem::is_regular_file(lasPath, failure))
  {
    return makeError(Error::Kind::Corrupt,
      "'" + sidePath + "' is an index of '" + lasPath +
        "', which is no file; index the LAS file again: pointfront index --force");
  }
  const std::uint64_t bytes = std::filesystem::file_size(lasPath, failure);
  if (failure || bytes != indexed.bytes)
  {
    return makeError(Error::Kind::Corrupt,
      "'" + sidePath + "' is not an index of '" + lasPath +
        "' as it is now: " + numbers("its size in bytes is", bytes, indexed.bytes) +
        "; index the file again: pointfront index --force");
  }
  return {};
}
} // namespace

IndexedLASFile::IndexedLASFile(
  std::unique_ptr<const SideFile> side, LASFile file, std::unique_ptr<const InputFile> points)
  : side_(std::move(side))
  , file_(std::move(file))
  , points_(std::move(points))
{
}

Result<void> IndexedLASFile::checkIdentity(const std::string& sidePath) const
{
  const std::string difference = differenceOf(identityOf(file_), side_->content().indexed);
  if (!difference.empty())
  {
    return makeError(Error::Kind::Corrupt,
      "'" + sidePath + "' is not an index of '" + file_.description.path +
        "' as it is now: " + difference + "; index the file again: pointfront index --force");
  }
  AttributeSchema expected = file_.layout.schema;
  const AttributeSchema& described = side_->content().stored.description.schema;
  for (std::size_t c = described.size() - side_->content().held; c < described.size(); ++c)
  {
    expected.add(described[c]);
  }
  if (!(expected == described))
  {
    return makeError(Error::Kind::Corrupt,
      "'" + sidePath + "' describes other attributes than '" + file_.description.path +
        "' has; index the file again: pointfront index --force");
  }
  return {};
}

void IndexedLASFile::describe(const std::string& sidePath)
{
  const SideFileContent& content = side_->content();
  description_ = content.stored.description;
  description_.path = sidePath;
  description_.fileBytes = side_->bytes();
  description_.pointCount = content.indexed.points;
  description_.layers[0].pointCount = content.indexed.points;
  description_.layers[0].nodeCount = static_cast<std::uint32_t>(content.table.nodes.size());
  for (const Node& node : content.table.nodes)
  {
    description_.levels = std::max<std::uint32_t>(description_.levels, node.level + 1u);
  }
  hierarchy_ = std::make_shared<HierarchyTable>(
    content.table.nodes, rootsOf(content.table.nodes), description_.refinement);
}

Result<std::shared_ptr<const IndexedLASFile>> IndexedLASFile::open(const std::string& sidePath)
{
  if (isAddress(sidePath))
  {
    // The points of a node lie all over the file: thousands of pieces of some bytes each.
    return makeError(Error::Kind::Unsupported,
      "'" + sidePath +
        "' is an index of a LAS file, which is read from a disk only; build a store from the file, "
        "or write it as COPC");
  }
  Result<std::unique_ptr<const SideFile>> side = SideFile::open(sidePath);
  if (!side)
  {
    return side.error();
  }
  const std::filesystem::path folder = std::filesystem::path(sidePath).parent_path();
  const std::string lasPath = (folder / (*side)->content().indexed.name).string();
  if (Result<void> plausible = checkPlace(sidePath, lasPath, (*side)->content().indexed);
      !plausible)
  {
    return plausible.error();
  }
  Result<LASFile> file = LASFile::open(lasPath, MemoryMap::Access::Random);
  if (!file)
  {
    return file.error();
  }
  if (file->header.compressed)
  {
    return makeError(Error::Kind::Corrupt,
      "'" + sidePath + "' is an index of '" + lasPath + "', whose points are compressed now");
  }
  if (Result<void> counted = file->countRecords(); !counted)
  {
    return counted.error();
  }
  Result<std::unique_ptr<const InputFile>> points = InputFile::open(lasPath);
  if (!points)
  {
    return points.error();
  }
  std::shared_ptr<IndexedLASFile> indexed(
    new IndexedLASFile(std::move(*side), std::move(*file), std::move(*points)));
  if (Result<void> same = indexed->checkIdentity(sidePath); !same)
  {
    return same.error();
  }
  indexed->describe(sidePath);
  return std::shared_ptr<const IndexedLASFile>(std::move(indexed));
}

std::size_t IndexedLASFile::decodedBytes(
  NodeIndex, std::uint32_t points, const ColumnSelection& columns) const
{
  return decodedBytesOf(points, columns, description_.schema);
}

std::size_t IndexedLASFile::storedBytes(NodeIndex node, const ColumnSelection& columns) const
{
  const InPlaceRow& row = side_->content().table.rows[node];
  std::size_t bytes = row.bytes + row.pages * pageBytes;
  for (const std::uint32_t held : heldColumns(columns))
  {
    bytes += side_->blockBytes(node, held);
  }
  return bytes;
}

std::vector<std::uint32_t> IndexedLASFile::heldColumns(const ColumnSelection& columns) const
{
  const auto first = static_cast<std::uint32_t>(file_.layout.schema.size());
  std::vector<std::uint32_t> held;
  for (const std::uint32_t column : columns)
  {
    if (column >= first)
    {
      held.push_back(column - first);
    }
  }
  return held;
}

Result<FetchedNode> IndexedLASFile::fetch(NodeIndex node, const ColumnSelection& columns) const
{
  assert(node < hierarchy_->nodeCount());
  const Result<std::vector<std::uint64_t>> points = side_->pointsOf(node);
  if (!points)
  {
    return points.error();
  }
  const GridRecords all = recordsOf(file_);
  Result<RawBytes> records = gatherValues({ all.fileOffset, all.stride,
                                            [this](std::uint64_t at, std::byte* to, std::size_t n)
                                            { return points_->readAt(at, to, n); } },
    *points);
  if (!records)
  {
    return records.error();
  }
  RawBytes numbers(points->size() * sizeof(std::uint64_t));
  std::copy_n(reinterpret_cast<const std::byte*>(points->data()), numbers.size,
    numbers.data.get()); // none of a node without points: memcpy must not have a null
  FetchedNode fetched{ node, columns, {}, storedBytes(node, columns), hierarchy_->node(node) };
  fetched.runs.push_back(std::move(records).value());
  fetched.runs.push_back(std::move(numbers));
  for (const std::uint32_t held : heldColumns(columns))
  {
    Result<RawBytes> coded = side_->blockOf(node, held);
    if (!coded)
    {
      return coded.error();
    }
    fetched.runs.push_back(std::move(*coded));
  }
  return fetched;
}

Result<NodeColumns> IndexedLASFile::decode(const FetchedNode& fetched) const
{
  const RawBytes& numbers = fetched.runs[1];
  std::vector<std::uint64_t> points(numbers.size / sizeof(std::uint64_t));
  std::copy_n(numbers.data.get(), numbers.size, reinterpret_cast<std::byte*>(points.data()));
  GridRecords records = recordsOf(file_);
  const std::vector<std::uint32_t> order = prefixOrder(points);
  const std::vector<std::byte> bytes = ordered(fetched.runs[0].data.get(), records.stride, order);
  records.first = bytes.data();
  records.count = points.size();
  NodeColumns result =
    emptyColumns(fetched.node, points.size(), fetched.columns, description_.schema);
  result.describe(fetched.row);
  decodeSteps(records, side_->content().table.rows[fetched.node].low, result);
  const std::vector<std::uint32_t> held = heldColumns(fetched.columns);
  const std::size_t own = fetched.columns.size() - held.size();
  for (std::size_t c = 0; c < own; ++c)
  {
    decodeLASColumn(
      file_.layout, fetched.columns[c], bytes.data(), points.size(), result.columns[c].data());
  }
  for (std::size_t h = 0; h < held.size(); ++h)
  {
    const Result<std::vector<std::byte>> values =
      side_->decodeBlock(fetched.node, held[h], fetched.runs[2 + h]);
    if (!values)
    {
      return values.error();
    }
    const std::size_t stride = description_.schema[fetched.columns[own + h]].bytes();
    result.columns[own + h] = ordered(values->data(), stride, order);
  }
  return result;
}

/// Counts alone could hide one point twice and another left out; a sum of hashes of their numbers
/// does not.
Result<std::string> IndexedLASFile::membersFault(const ProgressFunction& progress) const
{
  Progress state{ "verifying", description_.pointCount, description_.pointCount, 1.0, 0.0 };
  const auto begin = std::chrono::steady_clock::now();
  double reported = 0.0;
  std::uint64_t wanted = 0;
  for (std::uint64_t point = 0; point < description_.pointCount; ++point)
  {
    wanted += SampleStream::mixed(point);
  }
  std::uint64_t found = 0;
  for (NodeIndex node = 0; node < hierarchy_->nodeCount(); ++node)
  {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
    state.secondsElapsed = elapsed.count();
    if (progress && state.secondsElapsed - reported > secondsBetweenReports)
    {
      reported = state.secondsElapsed;
      if (!progress(state))
      {
        return makeError(
          Error::Kind::Cancelled, "verifying '" + description_.path + "' was cancelled");
      }
    }
    const Result<std::vector<std::uint64_t>> points = side_->pointsOf(node);
    if (!points)
    {
      return points.error().what;
    }
    for (const std::uint64_t point : *points)
    {
      found += SampleStream::mixed(point);
    }
  }
  return found == wanted
    ? std::string()
    : "'" + description_.path + "': its nodes do not hold every point exactly once";
}

Result<VerifyReport> IndexedLASFile::verify(const ProgressFunction& progress) const
{
  Result<VerifyReport> report =
    StoreVerification(*this, side_->content().stored.gridBounds).run(progress);
  if (report && report->ok)
  {
    const Result<std::string> fault = membersFault(progress);
    if (!fault)
    {
      return fault.error();
    }
    report->firstError = *fault;
    report->ok = report->firstError.empty();
  }
  return report;
}

bool LASIndexFormat::accepts(const std::string& path) const
{
  return SideFile::looksLikeSideFile(path);
}

Result<std::shared_ptr<const StoredCloud>> LASIndexFormat::open(const std::string& path) const
{
  Result<std::shared_ptr<const IndexedLASFile>> file = IndexedLASFile::open(path);
  if (!file)
  {
    return file.error();
  }
  return std::shared_ptr<const StoredCloud>(std::move(*file));
}

} // namespace pointfront
