#include "COPCFile.h"

#include "LASPointDecoder.h"
#include "LASzipReader.h"
#include "LAZChunk.h"

#include "pointfront/Disk/ByteSource.h"
#include "pointfront/Disk/SmallFile.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

namespace pointfront
{
namespace
{
constexpr const char* copcOwner = "copc";
constexpr std::uint16_t copcInfoRecord = 1;
constexpr std::uint16_t copcHierarchyRecord = 1000;
constexpr std::size_t infoBytes = 160;
constexpr std::size_t entryBytes = 32;
constexpr std::uint32_t recordsAtOnce = 1024; ///< decompressed, then decoded from the cache

constexpr std::uint64_t smallHierarchy = std::uint64_t(256) << 10; ///< bytes that come at once
constexpr std::uint64_t mostPageBytes = std::uint64_t(256) << 20; ///< eight million nodes

Error corrupt(const std::string& path, std::uint64_t byte, const std::string& what)
{
  return makeError(Error::Kind::Corrupt,
    path + ": its octree is damaged at byte " + std::to_string(byte) + ": " + what +
      "; build a store from the file, which does not need it");
}

/// Whether so many bytes there lie in a file.
bool inside(std::uint64_t offset, std::uint64_t bytes, std::uint64_t fileBytes)
{
  return offset <= fileBytes && bytes <= fileBytes - offset;
}

/// Its cell and its place, without counts.
ForeignNode entryAt(const std::byte* entry)
{
  ForeignNode found;
  found.level = loadNumber<std::int32_t>(entry);
  found.x = loadNumber<std::int32_t>(entry + 4);
  found.y = loadNumber<std::int32_t>(entry + 8);
  found.z = loadNumber<std::int32_t>(entry + 12);
  found.offset = loadNumber<std::uint64_t>(entry + 16);
  return found;
}

/// Several ranges of a source, together. A file that ends early still has what comes before.
std::vector<Result<RawBytes>> readTogether(
  const ByteSource& source, const std::vector<ForeignNode>& places, const ReadStop& stop)
{
  std::vector<Result<RawBytes>> fetched;
  std::vector<ByteRange> ranges;
  fetched.reserve(places.size());
  for (const ForeignNode& place : places)
  {
    RawBytes bytes(place.bytes);
    ranges.push_back({ place.offset, bytes.size, bytes.data.get() });
    fetched.emplace_back(std::move(bytes));
  }
  const Result<void> together =
    ranges.empty() ? Result<void>() : source.readUntil(stop, ranges.data(), ranges.size());
  for (std::size_t i = 0; !together && i < fetched.size(); ++i)
  {
    const bool alone = together.error().kind == Error::Kind::Truncated && fetched.size() > 1;
    const Result<void> done = alone ? source.readUntil(stop, &ranges[i], 1) : together;
    fetched[i] = done ? std::move(fetched[i]) : Result<RawBytes>(done.error());
  }
  return fetched;
}

/// Pages by the entries that refer to them, which lie in the file.
std::vector<Result<ForeignPage>> readCOPCPages(
  const ByteSource& source, const std::vector<ForeignNode>& places, const std::string& path)
{
  const ReadStop never{ false };
  std::vector<Result<RawBytes>> bytes = readTogether(source, places, never);
  std::vector<Result<ForeignPage>> pages;
  for (std::size_t p = 0; p < places.size(); ++p)
  {
    pages.push_back(bytes[p] ? parseCOPCPage({ bytes[p]->data.get(), bytes[p]->size },
                                 places[p].offset, source.bytes(), path)
                             : Result<ForeignPage>(bytes[p].error()));
  }
  return pages;
}

/// The chunks of a COPC file. Bytes are read at their places: a disk that goes away gives errors.
class COPCNodes final : public ForeignNodes
{
public:
  COPCNodes(LASFile file, LAZCompression compression, std::shared_ptr<const ByteSource> points)
    : file_(std::move(file))
    , compression_(std::move(compression))
    , points_(std::move(points))
  {
  }

  Result<RawBytes> fetch(const ForeignNode& node) const override
  {
    return points_->readAt(node.offset, node.bytes);
  }
  std::vector<Result<RawBytes>> fetchAll(
    const std::vector<ForeignNode>& nodes, const ReadStop& stop) const override
  {
    return readTogether(*points_, nodes, stop);
  }
  std::size_t storedBytes(const ForeignNode& node) const override { return node.bytes; }
  std::optional<std::uint64_t> place(const ForeignNode& node) const override { return node.offset; }
  std::vector<Result<ForeignPage>> readPages(const std::vector<ForeignNode>& pages) const override
  {
    return readCOPCPages(*points_, pages, file_.description.path);
  }
  std::uint64_t disk() const override { return points_->device(); }
  ReadCost readCost() const override { return points_->cost(); }
  std::vector<std::string> files() const override { return { file_.description.path }; }

  Result<void> decode(const Part& part, const RawBytes& bytes, PointBatch& batch) const override
  {
    const ForeignNode& node = part.node;
    const LASPointLayout& layout = file_.layout;
    const ByteSpan view{ bytes.data.get(), bytes.size };
    const LAZChunk found = parseLayeredChunk(view, layout.pointBytes, compression_);
    if (found.points != node.points || found.bytes != bytes.size ||
      !codesCanBegin(view, layout.pointBytes, compression_))
    {
      return corrupt(file_.description.path, node.offset,
        "the chunk is not one of " + std::to_string(node.points) + " points in " +
          std::to_string(bytes.size) + " bytes");
    }
    Result<LASzipReader> reader = LASzipReader::open(
      file_, compression_, view, node.points, laszipLayers(layout, part.columns));
    if (!reader)
    {
      return reader.error();
    }
    batch.positions.clear();
    batch.steps.resize(part.first);
    batch.columns.assign(layout.schema.size(), {});
    for (const std::uint32_t column : part.columns)
    {
      batch.columns[column].resize(part.first * layout.schema[column].bytes());
    }
    std::vector<std::byte> records(std::size_t{ recordsAtOnce } * layout.pointBytes);
    for (std::uint32_t done = 0; done < part.first;)
    {
      const std::uint32_t wanted = std::min(recordsAtOnce, part.first - done);
      if (reader->read(wanted, records.data()) < wanted)
      {
        return corrupt(
          file_.description.path, node.offset, "the points' bytes end or contradict themselves");
      }
      unpack(records.data(), done, wanted, part.columns, batch);
      done += wanted;
    }
    return {};
  }

private:
  void unpack(const std::byte* records, std::uint32_t first, std::uint32_t count,
    const ColumnSelection& columns, PointBatch& batch) const
  {
    const LASPointLayout& layout = file_.layout;
    for (std::uint32_t i = 0; i < count; ++i)
    {
      const std::byte* at = records + i * layout.pointBytes;
      for (int axis = 0; axis < 3; ++axis)
      {
        batch.steps[first + i][axis] = loadNumber<std::int32_t>(at + 4 * axis);
      }
    }
    for (const std::uint32_t column : columns)
    {
      decodeLASColumn(layout, column, records, count,
        batch.columns[column].data() + first * layout.schema[column].bytes());
    }
  }

  LASFile file_;
  LAZCompression compression_;
  std::shared_ptr<const ByteSource> points_;
};

/// Bytes of the record with all pages, wherever it says that they are; none if it is not there.
std::uint64_t hierarchyBytes(const LASFile& file)
{
  const auto found = std::find_if(file.records.begin(), file.records.end(),
    [](const LASRecord& record) { return record.is(copcOwner, copcHierarchyRecord); });
  return found != file.records.end() ? found->payload.size : 0;
}

/// Where the first page is. Errors  Corrupt: not in the file.
Result<ForeignNode> rootPage(const LASFile& file, const COPCInfo& info)
{
  if (!inside(info.rootOffset, info.rootBytes, file.map.size()) || info.rootBytes > mostPageBytes ||
    info.rootBytes % entryBytes != 0)
  {
    return corrupt(file.description.path, info.rootOffset,
      "the first page of the hierarchy does not lie in the file");
  }
  ForeignNode root;
  root.offset = info.rootOffset;
  root.bytes = static_cast<std::uint32_t>(info.rootBytes);
  return root;
}

/// Parts of a file that were read, and may be read once.
class PartsSeen
{
public:
  /// False: some of the bytes were seen before.
  bool add(const ForeignNode& page)
  {
    const auto behind = ends_.lower_bound(page.offset);
    const bool fresh = (behind == ends_.end() || page.offset + page.bytes <= behind->first) &&
      (behind == ends_.begin() || std::prev(behind)->second <= page.offset);
    return fresh && ends_.emplace(page.offset, page.offset + page.bytes).second;
  }

private:
  std::map<std::uint64_t, std::uint64_t> ends_; ///< by beginning
};

/// The pages below one that was read join it, level by level.
Result<void> readFurtherPages(
  const ByteSource& source, const ForeignNode& first, ForeignPage& all, const std::string& path)
{
  PartsSeen seen;
  seen.add(first);
  std::vector<ForeignNode> level = std::exchange(all.pages, {});
  while (!level.empty())
  {
    for (const ForeignNode& page : level)
    {
      if (!seen.add(page)) // pages that overlap would give entries without end
      {
        return corrupt(path, page.offset, "a page of the hierarchy is referred to twice");
      }
    }
    std::vector<ForeignNode> below;
    for (Result<ForeignPage>& page : readCOPCPages(source, level, path))
    {
      if (!page)
      {
        return page.error();
      }
      all.nodes.insert(all.nodes.end(), page->nodes.begin(), page->nodes.end());
      below.insert(below.end(), page->pages.begin(), page->pages.end());
    }
    level = std::move(below);
  }
  return {};
}

/// All but the reader.
ForeignTreeContent contentOf(const LASFile& file, const COPCInfo& info, ForeignPage first)
{
  ForeignTreeContent content;
  content.source = file.description;
  content.source.format = "COPC of " + content.source.format;
  std::uint64_t sum = 0;
  for (const ForeignNode& node : first.nodes)
  {
    sum += node.points;
  }
  if (first.pages.empty() && sum != file.header.pointCount)
  {
    content.source.warnings.push_back("The header promises " +
      std::to_string(file.header.pointCount) + " points, the nodes of the octree have " +
      std::to_string(sum) + ": these are shown.");
  }
  content.first = std::move(first);
  content.fileBytes = file.map.size();
  content.low = info.centre - glm::dvec3(info.halfSize);
  content.side = 2.0 * info.halfSize;
  content.spacing = info.spacing;
  return content;
}
} // namespace

Result<COPCInfo> readCOPCInfo(const LASFile& file)
{
  for (const LASRecord& record : file.records)
  {
    if (!record.is(copcOwner, copcInfoRecord))
    {
      continue;
    }
    if (record.payload.size < infoBytes)
    {
      return makeError(Error::Kind::Corrupt,
        file.description.path + ": its COPC record has " + std::to_string(record.payload.size) +
          " bytes, not 160");
    }
    const std::byte* at = record.payload.data;
    COPCInfo info;
    for (int axis = 0; axis < 3; ++axis)
    {
      info.centre[axis] = loadNumber<double>(at + 8 * axis);
    }
    info.halfSize = loadNumber<double>(at + 24);
    info.spacing = loadNumber<double>(at + 32);
    info.rootOffset = loadNumber<std::uint64_t>(at + 40);
    info.rootBytes = loadNumber<std::uint64_t>(at + 48);
    return info;
  }
  return makeError(Error::Kind::Unsupported, file.description.path + ": is no COPC file");
}

Result<ForeignPage> parseCOPCPage(
  ByteSpan page, std::uint64_t offset, std::uint64_t fileBytes, const std::string& path)
{
  ForeignPage found;
  for (std::size_t at = 0; at + entryBytes <= page.size; at += entryBytes)
  {
    ForeignNode entry = entryAt(page.data + at);
    const auto bytes = loadNumber<std::int32_t>(page.data + at + 24);
    const auto points = loadNumber<std::int32_t>(page.data + at + 28);
    const bool there =
      bytes >= 0 && inside(entry.offset, static_cast<std::uint64_t>(bytes), fileBytes);
    const bool refers = points == -1 && bytes > 0;
    if (refers &&
      (!there || bytes % std::int32_t(entryBytes) != 0 || std::uint64_t(bytes) > mostPageBytes))
    {
      return corrupt(path, offset + at, "a page of the hierarchy does not lie in the file");
    }
    if (!refers && (points < 0 || bytes < 0 || (points > 0 && (bytes == 0 || !there))))
    {
      return corrupt(path, offset + at, "a node's points do not lie in the file");
    }
    entry.bytes = static_cast<std::uint32_t>(bytes);
    entry.points = refers ? 0 : static_cast<std::uint32_t>(points);
    (refers ? found.pages : found.nodes).push_back(entry);
  }
  return found;
}

bool COPCFormat::accepts(const std::string& path) const
{
  constexpr std::size_t ownerAt = lasHeaderBytes14 + 2; // in the first record behind the header
  const std::string beginning = beginningOf(path, ownerAt + 18);
  std::uint16_t id = 0;
  if (beginning.size() != ownerAt + 18 || beginning.compare(0, 4, "LASF") != 0 ||
    beginning.compare(ownerAt, 5, copcOwner, 5) != 0)
  {
    return false;
  }
  std::memcpy(&id, beginning.data() + ownerAt + 16, sizeof id);
  return id == copcInfoRecord;
}

Result<std::shared_ptr<const StoredCloud>> COPCFormat::open(const std::string& path) const
{
  return openTree(path, smallHierarchy);
}

Result<std::shared_ptr<const StoredCloud>> COPCFormat::openWhole(const std::string& path) const
{
  return openTree(path, std::numeric_limits<std::uint64_t>::max());
}

Result<std::shared_ptr<const StoredCloud>> COPCFormat::openTree(
  const std::string& path, std::uint64_t mostBytes)
{
  Result<LASFile> file = LASFile::open(path, MemoryMap::Access::Random);
  if (!file)
  {
    return file.error();
  }
  const Result<COPCInfo> info = readCOPCInfo(*file);
  if (!info)
  {
    return info.error();
  }
  Result<LAZCompression> compression = LAZCompression::of(*file);
  if (!compression)
  {
    return compression.error();
  }
  if (compression->scheme != LAZCompression::Scheme::Layered)
  {
    return makeError(Error::Kind::Unsupported,
      path + ": a COPC file of a point format below 6; build a store from it");
  }
  Result<std::shared_ptr<const ByteSource>> points =
    file->far ? file->far->source() : openBytes(path);
  if (!points)
  {
    return points.error();
  }
  const Result<ForeignNode> root = rootPage(*file, *info);
  if (!root)
  {
    return root.error();
  }
  Result<ForeignPage> first =
    root->bytes == 0 ? ForeignPage() : std::move(readCOPCPages(**points, { *root }, path).front());
  if (!first)
  {
    return first.error();
  }
  if (hierarchyBytes(*file) <= mostBytes || file->header.pointCount == 0)
  {
    if (Result<void> read = readFurtherPages(**points, *root, *first, path); !read)
    {
      return read.error();
    }
  }
  ForeignTreeContent content = contentOf(*file, *info, std::move(*first));
  content.reader = std::make_shared<const COPCNodes>(
    std::move(*file), std::move(*compression), std::move(*points));
  return ForeignTree::make(std::move(content));
}

} // namespace pointfront
