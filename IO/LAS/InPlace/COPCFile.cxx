#include "COPCFile.h"

#include "LASPointDecoder.h"
#include "LASzipReader.h"
#include "LAZChunk.h"

#include "pointfront/Disk/ByteSource.h"
#include "pointfront/Disk/SmallFile.h"

#include <algorithm>
#include <cstring>
#include <set>
#include <utility>

namespace pointfront
{
namespace
{
constexpr const char* copcOwner = "copc";
constexpr std::uint16_t copcInfoRecord = 1;
constexpr std::size_t infoBytes = 160;
constexpr std::size_t entryBytes = 32;
constexpr std::uint32_t recordsAtOnce = 1024; ///< decompressed, then decoded from the cache

Error corrupt(const LASFile& file, std::uint64_t byte, const std::string& what)
{
  return makeError(Error::Kind::Corrupt,
    file.description.path + ": its octree is damaged at byte " + std::to_string(byte) + ": " +
      what + "; build a store from the file, which does not need it");
}

/// Its cell and its place, without counts.
COPCEntry entryAt(const std::byte* entry)
{
  COPCEntry found;
  found.node.level = loadNumber<std::int32_t>(entry);
  found.node.x = loadNumber<std::int32_t>(entry + 4);
  found.node.y = loadNumber<std::int32_t>(entry + 8);
  found.node.z = loadNumber<std::int32_t>(entry + 12);
  found.offset = loadNumber<std::uint64_t>(entry + 16);
  return found;
}

/// The chunks of a COPC file. Bytes are read at their places: a disk that goes away gives errors.
class COPCNodes final : public ForeignNodes
{
public:
  COPCNodes(LASFile file, LAZCompression compression, std::shared_ptr<const ByteSource> points,
    std::vector<COPCEntry> entries)
    : file_(std::move(file))
    , compression_(std::move(compression))
    , points_(std::move(points))
    , entries_(std::move(entries))
  {
  }

  Result<RawBytes> fetch(std::uint64_t chunk) const override
  {
    const COPCEntry& entry = entries_[static_cast<std::size_t>(chunk)];
    return points_->readAt(entry.offset, entry.bytes);
  }
  std::vector<Result<RawBytes>> fetchAll(
    const std::vector<std::uint64_t>& chunks, const ReadStop& stop) const override
  {
    std::vector<Result<RawBytes>> fetched;
    std::vector<ByteRange> ranges;
    fetched.reserve(chunks.size());
    for (const std::uint64_t chunk : chunks)
    {
      const COPCEntry& entry = entries_[static_cast<std::size_t>(chunk)];
      RawBytes bytes(entry.bytes);
      ranges.push_back({ entry.offset, bytes.size, bytes.data.get() });
      fetched.emplace_back(std::move(bytes));
    }
    const Result<void> together = points_->readUntil(stop, ranges.data(), ranges.size());
    for (std::size_t i = 0; !together && i < fetched.size(); ++i)
    {
      // A file that ends early still has what comes before.
      const bool alone = together.error().kind == Error::Kind::Truncated && fetched.size() > 1;
      const Result<void> done = alone ? points_->readUntil(stop, &ranges[i], 1) : together;
      fetched[i] = done ? std::move(fetched[i]) : Result<RawBytes>(done.error());
    }
    return fetched;
  }
  std::size_t storedBytes(std::uint64_t chunk) const override
  {
    return entries_[static_cast<std::size_t>(chunk)].bytes;
  }
  std::uint64_t disk() const override { return points_->device(); }
  ReadCost readCost() const override { return points_->cost(); }
  std::vector<std::string> files() const override { return { file_.description.path }; }

  Result<void> decode(const Part& part, const RawBytes& bytes, PointBatch& batch) const override
  {
    const COPCEntry& entry = entries_[static_cast<std::size_t>(part.chunk)];
    const LASPointLayout& layout = file_.layout;
    const ByteSpan view{ bytes.data.get(), bytes.size };
    const LAZChunk found = parseLayeredChunk(view, layout.pointBytes, compression_);
    if (found.points != part.points || found.bytes != bytes.size ||
      !codesCanBegin(view, layout.pointBytes, compression_))
    {
      return corrupt(file_, entry.offset,
        "the chunk is not one of " + std::to_string(part.points) + " points in " +
          std::to_string(bytes.size) + " bytes");
    }
    Result<LASzipReader> reader = LASzipReader::open(
      file_, compression_, view, part.points, laszipLayers(layout, part.columns));
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
        return corrupt(file_, entry.offset, "the points' bytes end or contradict themselves");
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
  std::vector<COPCEntry> entries_;
};
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

Result<std::vector<COPCEntry>> readCOPCHierarchy(const LASFile& file, const COPCInfo& info)
{
  const ByteSpan bytes = file.bytes();
  const auto inside = [&bytes](std::uint64_t offset, std::uint64_t size)
  { return offset <= bytes.size && size <= bytes.size - offset; };
  std::vector<COPCEntry> entries;
  std::set<std::uint64_t> seen;
  std::vector<HeldBytes::Part> level{ { info.rootOffset,
    static_cast<std::size_t>(info.rootBytes) } };
  while (!level.empty())
  {
    for (const auto& [offset, size] : level)
    {
      if (!inside(offset, size) || size % entryBytes != 0)
      {
        return corrupt(file, offset, "a page of the hierarchy does not lie in the file");
      }
    }
    if (Result<void> there = file.want(level); !there)
    {
      return there.error();
    }
    std::vector<HeldBytes::Part> below;
    for (const auto& [offset, size] : level)
    {
      // Pages that overlap would give entries without end.
      for (std::uint64_t at = offset; at < offset + size; at += entryBytes)
      {
        if (!seen.insert(at).second)
        {
          return corrupt(file, at, "a page of the hierarchy is referred to twice");
        }
        COPCEntry found = entryAt(bytes.data + at);
        const auto byteCount = loadNumber<std::int32_t>(bytes.data + at + 24);
        const auto points = loadNumber<std::int32_t>(bytes.data + at + 28);
        if (points == -1 && byteCount > 0)
        {
          below.push_back({ found.offset, static_cast<std::size_t>(byteCount) });
          continue;
        }
        if (points < 0 || byteCount < 0 || (points > 0 && byteCount == 0) ||
          (points > 0 && !inside(found.offset, static_cast<std::uint64_t>(byteCount))))
        {
          return corrupt(file, at, "a node's points do not lie in the file");
        }
        found.bytes = static_cast<std::uint32_t>(byteCount);
        found.node.points = static_cast<std::uint32_t>(points);
        found.node.chunk = entries.size();
        entries.push_back(found);
      }
    }
    level = std::move(below);
  }
  return entries;
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
  Result<std::vector<COPCEntry>> entries = readCOPCHierarchy(*file, *info);
  if (!entries)
  {
    return entries.error();
  }
  Result<std::shared_ptr<const ByteSource>> points =
    file->far ? file->far->source() : openBytes(path);
  if (!points)
  {
    return points.error();
  }
  ForeignTreeContent content;
  std::uint64_t sum = 0;
  for (const COPCEntry& entry : *entries)
  {
    content.nodes.push_back(entry.node);
    sum += entry.node.points;
  }
  content.source = file->description;
  content.source.format = "COPC of " + content.source.format;
  if (sum != file->header.pointCount)
  {
    content.source.warnings.push_back("The header promises " +
      std::to_string(file->header.pointCount) + " points, the nodes of the octree have " +
      std::to_string(sum) + ": these are shown.");
  }
  content.fileBytes = file->map.size();
  content.low = info->centre - glm::dvec3(info->halfSize);
  content.side = 2.0 * info->halfSize;
  content.spacing = info->spacing;
  content.reader = std::make_shared<const COPCNodes>(
    std::move(*file), std::move(*compression), std::move(*points), std::move(*entries));
  return ForeignTree::make(std::move(content));
}

} // namespace pointfront
