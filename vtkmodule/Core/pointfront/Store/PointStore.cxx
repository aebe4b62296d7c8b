#include "pointfront/Store/PointStore.h"

#include "pointfront/Codec/Checksum.h"
#include "pointfront/Disk/HeldBytes.h"
#include "pointfront/Disk/SmallFile.h"
#include "pointfront/Store/ColumnStatistics.h"
#include "pointfront/Store/NodePage.h"
#include "pointfront/Store/PreviewRecord.h"
#include "pointfront/Store/StoreContent.h"
#include "pointfront/Store/StoreFormat.h"
#include "pointfront/Store/StoreVerification.h"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace pointfront
{
namespace
{
/// Bytes of each table of a far store that are read with its description and kept: all of a small
/// store, the rows of the upper levels of a large one, since nodes lie breadth first.
constexpr std::uint64_t heldTableBytes = std::uint64_t(64) * nodePageBytes;
/// Likewise of the payloads before the tables: builders put roots and the nodes below them there.
constexpr std::uint64_t heldPayloadBytes = std::uint64_t(256) << 10;

/// Bytes at its end that a far store is asked for when it is opened: in most of them they hold all
/// that is needed before the first node.
constexpr std::size_t tailBytes = std::size_t(256) << 10;

Result<RawBytes> readSection(const ByteSource& file, const SectionEntry& section, const char* name)
{
  // At most the file's size: the footer was checked.
  Result<RawBytes> bytes = file.readAt(section.offset, static_cast<std::size_t>(section.bytes));
  if (bytes && !matchesChecksum(bytes->data.get(), bytes->size, section.checksum))
  {
    return corruptStore(
      file.path(), section.offset, std::string("the ") + name + "'s checksum does not match");
  }
  return bytes;
}

Result<StoreHeader> readHeader(const ByteSource& file)
{
  std::byte bytes[storeHeaderBytes] = {};
  const auto size =
    static_cast<std::size_t>(std::min<std::uint64_t>(file.bytes(), storeHeaderBytes));
  if (Result<void> done = file.readAt(0, bytes, size); !done)
  {
    return done.error();
  }
  return decodeHeader(bytes, size, file.bytes(), file.path());
}

Result<StoreFooter> readFooter(const ByteSource& file, const StoreHeader& header)
{
  const Result<RawBytes> bytes = file.readAt(header.footerOffset, header.footerBytes);
  return bytes ? decodeFooter(bytes->data.get(), header, file.path()) : bytes.error();
}

Result<StoredDescription> readDescription(
  const ByteSource& file, const StoreHeader& header, const StoreFooter& footer)
{
  const SectionEntry& section = *footer.find(SectionKind::Description);
  Result<RawBytes> bytes = readSection(file, section, "description");
  if (!bytes)
  {
    return bytes.error();
  }
  std::optional<StoredDescription> stored =
    decodeDescription(bytes->data.get(), bytes->size, header.version);
  if (!stored || stored->description.schema.size() != footer.columnCount)
  {
    return corruptStore(file.path(), section.offset, "the description contradicts itself");
  }
  return std::move(*stored);
}

Result<std::optional<PayloadElsewhere>> readElsewhere(
  const ByteSource& file, const StoreHeader& header, const StoreFooter& footer)
{
  if ((header.requiredFeatures & payloadElsewhere) == 0)
  {
    return std::optional<PayloadElsewhere>();
  }
  const SectionEntry* section = footer.find(SectionKind::Elsewhere);
  if (section == nullptr)
  {
    return corruptStore(file.path(), header.footerOffset, "the name of its second file is missing");
  }
  Result<RawBytes> bytes = readSection(file, *section, "second file's name");
  if (!bytes)
  {
    return bytes.error();
  }
  std::optional<PayloadElsewhere> elsewhere = decodeElsewhere(bytes->data.get(), bytes->size);
  if (!elsewhere)
  {
    return corruptStore(file.path(), section->offset, "the second file's name is none");
  }
  return elsewhere;
}

/// Bytes of payloads to be held, with `behind` bytes up to the end of the file. The last bytes have
/// come: no more than they have, unless that is next to nothing.
std::uint64_t heldPayloads(std::uint64_t behind)
{
  constexpr std::uint64_t least = std::uint64_t(64) << 10;
  return behind + least <= PointStore::lastBytes
    ? std::min(heldPayloadBytes, PointStore::lastBytes - behind)
    : heldPayloadBytes;
}

/// A far store with its description, its second file's name, the beginnings of its tables and the
/// payloads before them in memory, by one read.
Result<std::shared_ptr<const ByteSource>> holdTables(
  std::shared_ptr<const ByteSource> file, const StoreFooter& footer)
{
  std::vector<HeldBytes::Part> parts;
  for (const SectionEntry& section : footer.sections)
  {
    const bool whole =
      section.kind == SectionKind::Description || section.kind == SectionKind::Elsewhere;
    const bool table =
      section.kind == SectionKind::NodeTable || section.kind == SectionKind::BlockDirectory;
    if (whole || table)
    {
      parts.push_back({ section.offset,
        static_cast<std::size_t>(
          whole ? section.bytes : std::min(section.bytes, heldTableBytes)) });
    }
  }
  const std::uint64_t payloadEnd = payloadEndOf(footer);
  const std::uint64_t held =
    std::min(heldPayloads(file->bytes() - payloadEnd), payloadEnd - storeHeaderBytes);
  parts.push_back({ payloadEnd - held, static_cast<std::size_t>(held) });
  return HeldBytes::hold(std::move(file), parts);
}

/// A file and the parts of it that are read before anything else can be.
struct OpenedFile
{
  std::shared_ptr<const ByteSource> file;
  StoreHeader header;
  StoreFooter footer;
};

Result<OpenedFile> openFile(const std::string& path)
{
  Result<std::shared_ptr<const ByteSource>> file = openBytes(path, { storeHeaderBytes, tailBytes });
  if (!file)
  {
    return file.error();
  }
  const Result<StoreHeader> header = readHeader(**file);
  if (!header)
  {
    return header.error();
  }
  const Result<StoreFooter> footer = readFooter(**file, *header);
  if (!footer)
  {
    return footer.error();
  }
  file = (*file)->cost().far() ? holdTables(*file, *footer) : std::move(file);
  return file ? Result<OpenedFile>({ *file, *header, *footer }) : file.error();
}

/// Checks and decodes one block; what is wrong, or an empty text.
std::string decodeFault(const BlockDirectory::Block& block, const std::byte* data,
  const BlockShape& shape, std::byte* values)
{
  if (!matchesChecksum(data, block.bytes, block.checksum))
  {
    return ": the checksum does not match";
  }
  return decodeBlock(block.codec, data, block.bytes, shape, values)
    ? ""
    : ": the block cannot be decoded";
}

/// "node 12, positions" or "node 12, attribute 'rgb'", for messages.
std::string blockName(const StoreDescription& description, NodeIndex node, std::uint32_t block)
{
  return "node " + std::to_string(node) +
    (block == 0 ? std::string(", positions")
                : ", attribute '" + description.schema[block - 1].name + "'");
}
} // namespace

PointStore::PointStore()
  : content_(std::make_unique<Content>())
{
}

PointStore::~PointStore() = default;

bool PointStore::looksLikeStore(const std::string& path)
{
  return beginsWith(path, storeMagic.data(), storeMagic.size());
}

bool PointStore::looksLikePreview(const std::string& path)
{
  const auto store = openTables(path);
  return store && previewRecordOf((*store)->description().metadata);
}

bool PointStore::looksLikeCollection(const std::string& path)
{
  std::byte bytes[storeHeaderBytes] = {};
  const std::string begin = beginningOf(path, storeHeaderBytes);
  std::memcpy(bytes, begin.data(), std::min(begin.size(), storeHeaderBytes));
  std::uint32_t features = 0;
  std::memcpy(&features, bytes + storeMagic.size() + sizeof(std::uint32_t), sizeof features);
  return std::memcmp(bytes, storeMagic.data(), storeMagic.size()) == 0 &&
    (features & headsOfCollection) != 0;
}

Result<std::shared_ptr<const PointStore>> PointStore::openHeads(const std::string& path)
{
  auto store = openTables(path);
  if (!store)
  {
    return store.error();
  }
  if (!(*store)->content_->isCollection)
  {
    return makeError(Error::Kind::BadFormat, "'" + path + "' is a store, not a collection");
  }
  return std::shared_ptr<const PointStore>(std::move(*store));
}

Result<std::shared_ptr<const PointStore>> PointStore::open(const std::string& path)
{
  auto store = openTables(path);
  if (!store)
  {
    return store.error();
  }
  Content& content = *(*store)->content_;
  if (content.isCollection)
  {
    return makeError(Error::Kind::Unsupported,
      "'" + path +
        "' is a collection of tiles, not a store; commands that draw and export take it");
  }
  const auto preview = previewRecordOf(content.description.metadata);
  const bool running = !preview || content.file->isLocked();
  content.description.wholeCount = preview ? preview->pointsExpected : 0;
  Result<void> whole;
  if (content.elsewhere)
  {
    auto file = openElsewhere(path, *content.elsewhere);
    content.fileElsewhere = file ? *file : nullptr;
    whole = file ? Result<void>{} : Result<void>(file.error());
  }
  if (whole && running)
  {
    return std::shared_ptr<const PointStore>(std::move(*store));
  }
  if (!content.file->isStillNamed() && openBytes(path))
  {
    return open(path); // the running build has just replaced it
  }
  if (running)
  {
    return whole.error();
  }
  return makeError(Error::Kind::Truncated,
    "'" + path + "' is the preview of a build that has ended; open '" + preview->storeName +
      "' if it is there, otherwise build again");
}

Result<std::shared_ptr<PointStore>> PointStore::openTables(const std::string& path)
{
  const Result<OpenedFile> opened = openFile(path);
  if (!opened)
  {
    return opened.error();
  }
  const auto& [shared, header, footer] = *opened;
  const ByteSource& file = *shared;
  Result<StoredDescription> stored = readDescription(file, header, footer);
  if (!stored)
  {
    return stored.error();
  }
  Result<std::shared_ptr<const Hierarchy>> table =
    openNodeTable(shared, header.version, footer, *stored);
  if (!table)
  {
    return table.error();
  }
  const auto elsewhere = readElsewhere(file, header, footer);
  if (!elsewhere)
  {
    return elsewhere.error();
  }
  auto directory =
    PayloadDirectory::open(file, header.version, footer, *elsewhere ? (*elsewhere)->bytes : 0);
  if (!directory)
  {
    return directory.error();
  }
  std::shared_ptr<PointStore> store(new PointStore);
  Content& content = *store->content_;
  content.description = std::move(stored->description);
  content.description.path = path;
  content.description.version = header.version;
  content.description.fileBytes = header.fileBytes;
  content.description.pointCount = footer.pointCount;
  content.isCollection = (header.requiredFeatures & headsOfCollection) != 0;
  if (content.isCollection != (collectionRecordIn(content.description.metadata) != nullptr))
  {
    return corruptStore(path, header.footerOffset, "it is half a collection");
  }
  content.gridBounds = stored->gridBounds;
  content.hierarchy = std::move(*table);
  content.directory = std::move(*directory);
  content.elsewhere = *elsewhere;
  if (const SectionEntry* ranges = footer.find(SectionKind::NodeRanges))
  {
    content.ranges.emplace(
      shared, *ranges, footer.nodeCount, rangeComponents(content.description.schema));
  }
  content.file = shared;
  return store;
}

const StoreDescription& PointStore::description() const
{
  return content_->description;
}

const std::shared_ptr<const Hierarchy>& PointStore::hierarchy() const
{
  return content_->hierarchy;
}

std::size_t PointStore::decodedBytes(
  NodeIndex, std::uint32_t points, const ColumnSelection& columns) const
{
  return decodedBytesOf(points, columns, content_->description.schema);
}

MissingRows* PointStore::missingRows() const
{
  return content_->hierarchy->missingRows();
}

std::size_t PointStore::storedBytes(NodeIndex node, const ColumnSelection& columns) const
{
  const Result<RawBytes> record = content_->directory->fetch(*content_->file, node, 0);
  if (!record)
  {
    return 0; // read() says why
  }
  const Result<NodePayload> payload = content_->directory->decode(node, *record);
  if (!payload)
  {
    return 0;
  }
  const std::vector<BlockRuns::Run> runs = BlockRuns(*payload, columns).runs;
  return std::accumulate(runs.begin(), runs.end(), std::size_t(0),
    [](std::size_t sum, const BlockRuns::Run& run) { return sum + run.bytes; });
}

std::optional<std::uint64_t> PointStore::place(NodeIndex node) const
{
  if (!content_->directory->holds(node))
  {
    return std::nullopt;
  }
  const Result<RawBytes> record = content_->directory->fetch(*content_->file, node, 0);
  const auto payload =
    record ? content_->directory->decode(node, *record) : Result<NodePayload>(record.error());
  return payload ? std::optional<std::uint64_t>(payload->blocks.front().offset) : std::nullopt;
}

std::uint64_t PointStore::disk() const
{
  return content_->file->device();
}

ReadCost PointStore::readCost() const
{
  return content_->file->cost();
}

Result<NodeColumns> PointStore::decode(const FetchedNode& fetched) const
{
  const NodeIndex node = fetched.node;
  const ColumnSelection& columns = fetched.columns;
  const StoreDescription& description = content_->description;
  const Result<NodePayload> payload = content_->directory->decode(node, fetched.runs[0]);
  if (!payload)
  {
    return payload.error();
  }
  const std::size_t points = payload->pointCount;
  const BlockRuns wanted(*payload, columns);
  NodeColumns result = emptyColumns(node, points, columns, description.schema);
  result.origin = payload->origin;
  result.describe(fetched.row);
  auto bytes = fetched.runs.begin() + 1;
  for (auto run = wanted.runs.begin(); run != wanted.runs.end(); ++run, ++bytes)
  {
    for (std::size_t b = run->first; b < run->end; ++b)
    {
      const auto& [block, number] = wanted.blocks[b];
      BlockShape shape = positionShape(points);
      auto* values = reinterpret_cast<std::byte*>(result.positions.data());
      if (number > 0)
      {
        shape = columnShape(description.schema[columns[number - 1]], points);
        values = result.columns[number - 1].data();
      }
      const std::byte* data = bytes->data.get() + (block.offset - run->offset);
      const std::string fault = decodeFault(block, data, shape, values);
      if (!fault.empty())
      {
        return corruptStore(content_->fileOf(block).path(), block.offset,
          blockName(description, node, number == 0 ? 0 : columns[number - 1] + 1) + fault);
      }
    }
  }
  return result;
}

Result<std::shared_ptr<const NodeRanges>> PointStore::nodeRanges(
  std::uint32_t component, NodeIndex most) const
{
  return content_->ranges ? content_->ranges->read(component, most)
                          : Result<std::shared_ptr<const NodeRanges>>(nullptr);
}

Result<VerifyReport> PointStore::verify(const ProgressFunction& progress) const
{
  return StoreVerification(*this, content_->gridBounds).run(progress);
}

} // namespace pointfront
