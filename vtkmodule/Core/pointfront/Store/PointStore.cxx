#include "pointfront/Store/PointStore.h"

#include "pointfront/Store/Checksum.h"
#include "pointfront/Store/ColumnStatistics.h"
#include "pointfront/Store/NodeTableSection.h"
#include "pointfront/Store/PreviewRecord.h"
#include "pointfront/Store/StoreContent.h"
#include "pointfront/Store/StoreFormat.h"
#include "pointfront/Store/StoreVerification.h"

#include <algorithm>
#include <cassert>

namespace pointfront
{
namespace
{
/// Blocks with at most this many unwanted bytes between them are fetched by one read: the disk
/// and the page cache hand out whole pages anyway.
constexpr std::uint64_t mergeGapBytes = 4096;

Result<RawBytes> readSection(const InputFile& file, const SectionEntry& section, const char* name)
{
  // At most the file's size: the footer was checked.
  RawBytes bytes(static_cast<std::size_t>(section.bytes));
  if (Result<void> done = file.readAt(section.offset, bytes.data.get(), bytes.size); !done)
  {
    return done.error();
  }
  if (!matchesChecksum(bytes.data.get(), bytes.size, section.checksum))
  {
    return corruptStore(
      file.path(), section.offset, std::string("the ") + name + "'s checksum does not match");
  }
  return bytes;
}

Result<StoreHeader> readHeader(const InputFile& file)
{
  std::byte bytes[storeHeaderBytes] = {};
  const auto size = static_cast<std::size_t>(
    std::min<std::uint64_t>(file.bytes(), storeHeaderBytes));
  if (Result<void> done = file.readAt(0, bytes, size); !done)
  {
    return done.error();
  }
  return decodeHeader(bytes, size, file.bytes(), file.path());
}

Result<StoreFooter> readFooter(const InputFile& file, const StoreHeader& header)
{
  const RawBytes bytes(static_cast<std::size_t>(header.footerBytes));
  if (Result<void> done = file.readAt(header.footerOffset, bytes.data.get(), bytes.size); !done)
  {
    return done.error();
  }
  return decodeFooter(bytes.data.get(), header, file.path());
}

Result<StoredDescription> readDescription(const InputFile& file, const StoreFooter& footer)
{
  const SectionEntry& section = *footer.find(SectionKind::Description);
  Result<RawBytes> bytes = readSection(file, section, "description");
  if (!bytes)
  {
    return bytes.error();
  }
  std::optional<StoredDescription> stored = decodeDescription(bytes->data.get(), bytes->size);
  if (!stored || stored->description.schema.size() != footer.columnCount)
  {
    return corruptStore(file.path(), section.offset, "the description contradicts itself");
  }
  return std::move(*stored);
}

Result<std::vector<Node>> readNodes(
  const InputFile& file, const StoreFooter& footer, const StoreDescription& description)
{
  const SectionEntry& section = *footer.find(SectionKind::NodeTable);
  if (section.bytes != std::uint64_t(footer.nodeCount) * nodeRowBytes)
  {
    return corruptStore(file.path(), section.offset, "the node table's size is wrong");
  }
  Result<RawBytes> bytes = readSection(file, section, "node table");
  if (!bytes)
  {
    return bytes.error();
  }
  std::vector<Node> nodes = decodeNodeTable(bytes->data.get(), footer.nodeCount);
  const std::string fault = nodeTableFault(
    nodes, description.layers.size(), footer.pointCount, description.refinement);
  if (!fault.empty())
  {
    return corruptStore(file.path(), section.offset, fault);
  }
  return nodes;
}

Result<BlockDirectory> readDirectory(const InputFile& file, const StoreFooter& footer)
{
  const SectionEntry& section = *footer.find(SectionKind::BlockDirectory);
  const std::uint32_t blocks = footer.columnCount + 1;
  if (section.bytes != BlockDirectory::encodedBytes(footer.nodeCount, blocks))
  {
    return corruptStore(file.path(), section.offset, "the block directory's size is wrong");
  }
  Result<RawBytes> bytes = readSection(file, section, "block directory");
  if (!bytes)
  {
    return bytes.error();
  }
  BlockDirectory directory =
    BlockDirectory::decode(bytes->data.get(), footer.nodeCount, blocks);
  std::uint64_t payloadEnd = section.offset;
  for (const SectionEntry& other : footer.sections)
  {
    payloadEnd = std::min(payloadEnd, other.offset);
  }
  bool unknownCodec = false;
  const std::string fault = directory.fault(storeHeaderBytes, payloadEnd, unknownCodec);
  if (unknownCodec)
  {
    return makeError(Error::Kind::Unsupported,
      "'" + file.path() + "' was written with " + fault +
        ", which this program does not know; update PointFront");
  }
  if (!fault.empty())
  {
    return corruptStore(file.path(), section.offset, fault);
  }
  return directory;
}

void countLayers(const std::vector<Node>& nodes, StoreDescription& description)
{
  for (const Node& node : nodes)
  {
    Layer& layer = description.layers[node.layer];
    layer.pointCount += originalPoints(node, description.refinement);
    ++layer.nodeCount;
    description.levels = std::max<std::uint32_t>(description.levels, node.level + 1u);
  }
}

/// The blocks of one node that are wanted: the positions and the columns selected.
std::vector<BlockDirectory::Block> wantedBlocks(
  const BlockDirectory& directory, NodeIndex node, const ColumnSelection& columns)
{
  std::vector<BlockDirectory::Block> blocks{ directory.block(node, 0) };
  for (const std::uint32_t column : columns)
  {
    assert(column + 1 < directory.blocksPerNode());
    blocks.push_back(directory.block(node, column + 1));
  }
  return blocks;
}

/// Past the last block of the run that begins at `first`: blocks that one read fetches.
std::size_t runEnd(const std::vector<BlockDirectory::Block>& blocks, std::size_t first)
{
  std::size_t end = first + 1;
  while (end < blocks.size() &&
    blocks[end].offset - (blocks[end - 1].offset + blocks[end - 1].bytes) <= mergeGapBytes)
  {
    ++end;
  }
  return end;
}

std::uint64_t runBytes(
  const std::vector<BlockDirectory::Block>& blocks, std::size_t first, std::size_t end)
{
  return blocks[end - 1].offset + blocks[end - 1].bytes - blocks[first].offset;
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
} // namespace

std::string blockName(const StoreDescription& description, NodeIndex node, std::uint32_t block)
{
  return "node " + std::to_string(node) +
    (block == 0 ? std::string(", positions")
                : ", attribute '" + description.schema[block - 1].name + "'");
}

PointStore::PointStore()
  : content_(std::make_unique<Content>())
{
}

PointStore::~PointStore() = default;

bool PointStore::looksLikeStore(const std::string& path)
{
  const Result<std::unique_ptr<const InputFile>> file = InputFile::open(path);
  std::array<unsigned char, storeMagic.size()> bytes{};
  return file && (*file)->bytes() >= bytes.size() &&
    (*file)->readAt(0, reinterpret_cast<std::byte*>(bytes.data()), bytes.size()) &&
    bytes == storeMagic;
}

bool PointStore::looksLikePreview(const std::string& path)
{
  const auto store = openAny(path);
  return store && previewRecordOf((*store)->description().metadata);
}

Result<std::shared_ptr<const PointStore>> PointStore::open(const std::string& path)
{
  auto store = openAny(path);
  const InputFile* file = store ? (*store)->content_->file.get() : nullptr;
  const auto preview =
    store ? previewRecordOf((*store)->description().metadata) : std::nullopt;
  if (!preview || file->isLocked())
  {
    return store;
  }
  if (!file->isStillNamed() && InputFile::open(path))
  {
    return open(path); // the running build has just replaced it
  }
  return makeError(Error::Kind::Truncated,
    "'" + path + "' is the preview of a build that has ended; open '" + preview->storeName +
      "' if it is there, otherwise build again");
}

Result<std::shared_ptr<const PointStore>> PointStore::openAny(const std::string& path)
{
  Result<std::unique_ptr<const InputFile>> opened = InputFile::open(path);
  if (!opened)
  {
    return opened.error();
  }
  const InputFile& file = **opened;
  const Result<StoreHeader> header = readHeader(file);
  if (!header)
  {
    return header.error();
  }
  const Result<StoreFooter> footer = readFooter(file, *header);
  if (!footer)
  {
    return footer.error();
  }
  Result<StoredDescription> stored = readDescription(file, *footer);
  if (!stored)
  {
    return stored.error();
  }
  Result<std::vector<Node>> nodes =
    readNodes(file, *footer, stored->description);
  if (!nodes)
  {
    return nodes.error();
  }
  Result<BlockDirectory> directory = readDirectory(file, *footer);
  if (!directory)
  {
    return directory.error();
  }
  std::shared_ptr<PointStore> store(new PointStore);
  Content& content = *store->content_;
  content.description = std::move(stored->description);
  content.description.path = path;
  content.description.version = header->version;
  content.description.fileBytes = header->fileBytes;
  content.description.pointCount = footer->pointCount;
  countLayers(*nodes, content.description);
  content.gridBounds = stored->gridBounds;
  std::vector<NodeIndex> roots = rootsOf(*nodes);
  content.hierarchy = std::make_shared<HierarchyTable>(
    std::move(*nodes), std::move(roots), content.description.refinement);
  content.directory = std::move(*directory);
  content.file = std::move(*opened);
  return std::shared_ptr<const PointStore>(std::move(store));
}

const StoreDescription& PointStore::description() const { return content_->description; }

const std::shared_ptr<const Hierarchy>& PointStore::hierarchy() const
{
  return content_->hierarchy;
}

std::size_t PointStore::decodedBytes(NodeIndex node, const ColumnSelection& columns) const
{
  return decodedBytesOf(
    content_->hierarchy->node(node).pointCount, columns, content_->description.schema);
}

std::size_t PointStore::storedBytes(NodeIndex node, const ColumnSelection& columns) const
{
  const auto blocks = wantedBlocks(content_->directory, node, columns);
  std::uint64_t sum = 0;
  for (std::size_t first = 0; first < blocks.size(); first = runEnd(blocks, first))
  {
    sum += runBytes(blocks, first, runEnd(blocks, first));
  }
  return static_cast<std::size_t>(sum);
}

std::uint64_t PointStore::disk() const
{
  return content_->file->device();
}

Result<FetchedNode> PointStore::fetch(NodeIndex node, const ColumnSelection& columns) const
{
  assert(node < content_->hierarchy->nodeCount());
  const auto blocks = wantedBlocks(content_->directory, node, columns);
  FetchedNode fetched{ node, columns, {} };
  for (std::size_t first = 0; first < blocks.size(); first = runEnd(blocks, first))
  {
    RawBytes run(static_cast<std::size_t>(runBytes(blocks, first, runEnd(blocks, first))));
    Result<void> done = content_->file->readAt(blocks[first].offset, run.data.get(), run.size);
    if (!done)
    {
      return done.error();
    }
    fetched.runs.push_back(std::move(run));
  }
  return fetched;
}

Result<NodeColumns> PointStore::decode(const FetchedNode& fetched) const
{
  const NodeIndex node = fetched.node;
  const ColumnSelection& columns = fetched.columns;
  const StoreDescription& description = content_->description;
  const std::size_t points = content_->hierarchy->node(node).pointCount;
  const auto blocks = wantedBlocks(content_->directory, node, columns);
  NodeColumns result = emptyColumns(node, points, columns, description.schema);
  result.origin = content_->directory.origin(node);
  auto run = fetched.runs.begin();
  for (std::size_t first = 0; first < blocks.size(); ++run)
  {
    const std::size_t end = runEnd(blocks, first);
    for (std::size_t b = first; b < end; ++b)
    {
      BlockShape shape = positionShape(points);
      auto* values = reinterpret_cast<std::byte*>(result.positions.data());
      if (b > 0)
      {
        shape = columnShape(description.schema[columns[b - 1]], points);
        values = result.columns[b - 1].data();
      }
      const std::byte* data = run->data.get() + (blocks[b].offset - blocks[first].offset);
      const std::string fault = decodeFault(blocks[b], data, shape, values);
      if (!fault.empty())
      {
        const std::uint32_t block = b == 0 ? 0 : columns[b - 1] + 1;
        return corruptStore(
          description.path, blocks[b].offset, blockName(description, node, block) + fault);
      }
    }
    first = end;
  }
  return result;
}

Result<VerifyReport> PointStore::verify(const ProgressFunction& progress) const
{
  return StoreVerification(*this, content_->gridBounds).run(progress);
}

} // namespace pointfront
