#include "pointfront/Store/StoreWriter.h"

#include "pointfront/Codec/Checksum.h"
#include "pointfront/Disk/TemporaryFile.h"
#include "pointfront/Payload/BufferedOutput.h"
#include "pointfront/Store/ColumnStatistics.h"
#include "pointfront/Store/DescriptionSection.h"
#include "pointfront/Store/NodePage.h"
#include "pointfront/Store/NodeRangesSection.h"
#include "pointfront/Store/NodeTableSection.h"
#include "pointfront/Store/PayloadDirectory.h"
#include "pointfront/Store/PayloadElsewhere.h"
#include "pointfront/Store/StoreAssembly.h"
#include "pointfront/Store/StoreFormat.h"

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <optional>
#include <utility>

namespace pointfront
{
namespace
{
Error wrongTable(const std::string& path, const std::string& why)
{
  return makeError(
    Error::Kind::BadArgument, "the node table of '" + path + "' is not sound: " + why);
}

/// Points of the cloud that nodes hold: those of all payloads together.
std::uint64_t originalPointsOf(const std::vector<Node>& nodes, Refinement refinement)
{
  std::uint64_t sum = 0;
  for (const Node& node : nodes)
  {
    sum += originalPoints(node, refinement);
  }
  return sum;
}

std::vector<BlockToWrite> blocksOf(const EncodedNode& node)
{
  std::vector<BlockToWrite> blocks;
  const auto add = [&blocks](const EncodedNode::Block& block)
  {
    blocks.push_back({ block.bytes.data(), static_cast<std::uint32_t>(block.bytes.size()),
      block.checksum, static_cast<BlockCodec>(block.codec) });
  };
  add(node.positions);
  std::for_each(node.columns.begin(), node.columns.end(), add);
  return blocks;
}

std::vector<BlockToWrite> blocksOf(const StoredPayload& payload)
{
  std::vector<BlockToWrite> blocks;
  for (std::size_t b = 0; b < payload.is.blocks.size(); ++b)
  {
    const BlockDirectory::Block& block = payload.is.blocks[b];
    blocks.push_back({ payload.blocks[b], block.bytes, block.checksum, block.codec });
  }
  return blocks;
}

class FileStoreWriter final : public StoreWriter
{
public:
  FileStoreWriter(std::unique_ptr<OutputFile> file, const AttributeSchema& schema,
    std::optional<WrittenPayloads> elsewhere)
    : file_(std::move(file))
    , schema_(schema)
    , payloads_(elsewhere
          ? std::move(elsewhere->places)
          : PayloadPlaces(chooseColumnPieces(schema), folderOf(file_.file().path())))
    , nodeRanges_(schema)
  {
    if (elsewhere)
    {
      refer(std::move(*elsewhere));
      return;
    }
    for (const Attribute& attribute : schema)
    {
      ranges_.push_back(emptyRange(attribute));
    }
  }

  /// The header's place; its bytes come last, so an unfinished file never looks like a store.
  Result<void> begin() { return file_.put(std::vector<std::byte>(storeHeaderBytes)); }

  Result<PayloadId> append(const EncodedNode& node) override;
  Result<PayloadId> appendLate(const EncodedNode& node) override;
  Result<PayloadId> append(const StoredPayload& payload, const GridBounds& bounds,
    const std::vector<ColumnRange>& ranges) override;
  Result<void> commit(StoreDescription description, const std::vector<Node>& nodes,
    const std::vector<NodeIndex>& roots, const std::vector<PayloadId>& payloads) override;
  std::uint64_t bytesWritten() const override { return file_.end(); }
  Result<WrittenPayloads> written() override;

private:
  void refer(WrittenPayloads elsewhere);
  void takeFacts(
    std::uint32_t points, const GridBounds& bounds, const std::vector<ColumnRange>& ranges);
  Result<PayloadId> take(const EncodedNode& node, bool late);
  Result<void> putWhole(SectionKind kind, const std::vector<std::byte>& bytes, StoreFooter& footer);
  Result<void> putParts(SectionKind kind, const std::vector<std::byte>& bytes, StoreFooter& footer);
  Result<void> finish(const StoreFooter& footer);
  std::string payloadFault(
    const std::vector<Node>& nodes, const std::vector<PayloadId>& payloads) const;
  std::string nodesFault(const StoreDescription& description, const std::vector<Node>& nodes,
    const std::vector<NodeIndex>& roots, const std::vector<PayloadId>& payloads) const;
  StoredDescription describe(StoreDescription description, const std::vector<Node>& nodes,
    const std::vector<NodeIndex>& roots) const;
  Result<void> putPayloadFacts(
    const std::vector<Node>& nodes, const std::vector<PayloadId>& payloads, StoreFooter& footer);

  BufferedOutput file_;
  AttributeSchema schema_;
  PayloadPlaces payloads_; // by PayloadId
  std::vector<std::uint32_t> pointCounts_; // likewise
  NodeRangesWriter nodeRanges_; // likewise; not of payloads that are elsewhere
  GridBounds bounds_;
  std::vector<ColumnRange> ranges_;
  std::string nameElsewhere_; // empty: all payloads are in this file
  std::string nameMeanwhile_;
  std::uint64_t bytesElsewhere_ = 0;
  std::uint32_t features_ = 0; // the bits of the header that the description asks for
};

void FileStoreWriter::refer(WrittenPayloads elsewhere)
{
  assert(elsewhere.ranges.size() == schema_.size());
  payloads_.goElsewhere();
  pointCounts_ = std::move(elsewhere.pointCounts);
  bounds_ = elsewhere.bounds;
  ranges_ = std::move(elsewhere.ranges);
  nameElsewhere_ = std::move(elsewhere.storeName);
  nameMeanwhile_ = std::move(elsewhere.nameMeanwhile);
  bytesElsewhere_ = elsewhere.bytes;
}

Result<WrittenPayloads> FileStoreWriter::written()
{
  Result<void> done = file_.flush();
  done = done ? file_.file().settle() : done;
  if (!done)
  {
    return done.error();
  }
  WrittenPayloads result;
  result.storeName = std::filesystem::path(file_.file().path()).filename().string();
  result.nameMeanwhile = std::filesystem::path(file_.file().pathMeanwhile()).filename().string();
  result.bytes = file_.end();
  result.places = payloads_;
  result.pointCounts = pointCounts_;
  result.bounds = bounds_;
  result.ranges = ranges_;
  return result;
}

Result<StoreWriter::PayloadId> FileStoreWriter::take(const EncodedNode& node, bool late)
{
  assert(node.columns.size() == schema_.size());
  if (node.pointCount > maxNodePoints)
  {
    return makeError(Error::Kind::BadArgument,
      "a node of " + std::to_string(node.pointCount) + " points is too large for '" +
        file_.file().path() + "'; use smaller nodes");
  }
  const Result<void> done = late ? payloads_.appendLate(node.origin, blocksOf(node))
                                 : payloads_.append(file_, node.origin, blocksOf(node));
  takeFacts(node.pointCount, node.bounds, node.ranges);
  return done ? Result<PayloadId>(static_cast<PayloadId>(pointCounts_.size() - 1)) : done.error();
}

Result<StoreWriter::PayloadId> FileStoreWriter::append(const EncodedNode& node)
{
  return take(node, false);
}

Result<StoreWriter::PayloadId> FileStoreWriter::appendLate(const EncodedNode& node)
{
  return take(node, true);
}

Result<StoreWriter::PayloadId> FileStoreWriter::append(
  const StoredPayload& payload, const GridBounds& bounds, const std::vector<ColumnRange>& ranges)
{
  assert(payload.is.blocks.size() == schema_.size() + 1);
  const auto id = static_cast<PayloadId>(pointCounts_.size());
  if (Result<void> done = payloads_.append(file_, payload.is.origin, blocksOf(payload)); !done)
  {
    return done.error();
  }
  takeFacts(payload.is.pointCount, bounds, ranges);
  return id;
}

void FileStoreWriter::takeFacts(
  std::uint32_t points, const GridBounds& bounds, const std::vector<ColumnRange>& ranges)
{
  for (std::size_t c = 0; c < ranges.size(); ++c)
  {
    addRange(ranges_[c], ranges[c]);
  }
  pointCounts_.push_back(points);
  nodeRanges_.add(bounds, ranges);
  bounds_.add(bounds);
}

std::string FileStoreWriter::payloadFault(
  const std::vector<Node>& nodes, const std::vector<PayloadId>& payloads) const
{
  if (nodes.size() != payloads.size())
  {
    return std::to_string(nodes.size()) + " nodes, " + std::to_string(payloads.size()) +
      " payloads named, " + std::to_string(pointCounts_.size()) + " appended";
  }
  std::vector<bool> used(pointCounts_.size(), false);
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    const PayloadId id = payloads[i];
    if (id >= used.size() || (used[id] && pointCounts_[id] > 0))
    {
      return "node " + std::to_string(i) + ": its payload does not exist or is another node's";
    }
    used[id] = true;
    if (pointCounts_[id] != nodes[i].pointCount)
    {
      return "node " + std::to_string(i) + " has " + std::to_string(nodes[i].pointCount) +
        " points, its payload " + std::to_string(pointCounts_[id]);
    }
  }
  const auto unused = std::find(used.begin(), used.end(), false);
  return unused == used.end()
    ? std::string()
    : "payload " + std::to_string(unused - used.begin()) + " is of no node";
}

std::string FileStoreWriter::nodesFault(const StoreDescription& description,
  const std::vector<Node>& nodes, const std::vector<NodeIndex>& roots,
  const std::vector<PayloadId>& payloads) const
{
  std::string fault = payloadFault(nodes, payloads);
  if (fault.empty())
  {
    fault = nodeTableFault(nodes, description.layers.size(),
      originalPointsOf(nodes, description.refinement), description.refinement);
  }
  if (fault.empty() && roots != rootsOf(nodes))
  {
    fault = "the list of roots is not that of the nodes without a parent, ascending";
  }
  return fault;
}

/// With what only the appended nodes tell.
StoredDescription FileStoreWriter::describe(StoreDescription description,
  const std::vector<Node>& nodes, const std::vector<NodeIndex>& roots) const
{
  const Refinement refinement = description.refinement;
  StoredDescription stored{ std::move(description), bounds_, roots };
  stored.description.schema = schema_;
  stored.description.ranges = ranges_;
  countLayers(BorrowedTable(nodes, refinement), stored.description);
  return stored;
}

/// Writes facts of payloads beside their places: the ranges of those that are here, the
/// file that holds those that are not.
Result<void> FileStoreWriter::putPayloadFacts(
  const std::vector<Node>& nodes, const std::vector<PayloadId>& payloads, StoreFooter& footer)
{
  if (nameElsewhere_.empty())
  {
    return putParts(SectionKind::NodeRanges, nodeRanges_.encode(nodes, payloads), footer);
  }
  const PayloadElsewhere elsewhere = describeElsewhere(
    { nameElsewhere_, nameMeanwhile_, bytesElsewhere_, {} }, payloads_.directory());
  return putWhole(SectionKind::Elsewhere, encodeElsewhere(elsewhere), footer);
}

Result<void> FileStoreWriter::commit(StoreDescription description, const std::vector<Node>& nodes,
  const std::vector<NodeIndex>& roots, const std::vector<PayloadId>& payloads)
{
  assert(description.schema == schema_);
  std::string fault = nodesFault(description, nodes, roots, payloads);
  if (Result<void> done = fault.empty() ? payloads_.finish(file_, payloads) : Result<void>(); !done)
  {
    return done;
  }
  bool unknownCodec = false;
  const BlockDirectory& directory = payloads_.directory();
  fault = fault.empty()
    ? directory.fault({ storeHeaderBytes, file_.end(), bytesElsewhere_ }, unknownCodec)
    : fault;
  if (!fault.empty())
  {
    return wrongTable(file_.file().path(), fault);
  }
  const StoredDescription stored = describe(std::move(description), nodes, roots);
  features_ = collectionRecordIn(stored.description.metadata) != nullptr ? headsOfCollection : 0;
  StoreFooter footer;
  footer.pointCount = originalPointsOf(nodes, stored.description.refinement);
  footer.nodeCount = static_cast<std::uint32_t>(nodes.size());
  footer.columnCount = static_cast<std::uint32_t>(schema_.size());
  footer.pieces = directory.pieces();
  Result<void> done = putParts(SectionKind::NodeTable, encodeNodePages(nodes), footer);
  if (done)
  {
    done = putParts(SectionKind::BlockDirectory, encodePayloadRecords(directory, payloads), footer);
  }
  if (done)
  {
    done = putWhole(SectionKind::Description, encodeDescription(stored), footer);
  }
  if (done)
  {
    done = putPayloadFacts(nodes, payloads, footer);
  }
  return done ? finish(footer) : done;
}

/// A section that is read as a whole.
Result<void> FileStoreWriter::putWhole(
  SectionKind kind, const std::vector<std::byte>& bytes, StoreFooter& footer)
{
  footer.sections.push_back(
    { kind, checksumOf(bytes.data(), bytes.size()), file_.end(), bytes.size() });
  return file_.put(bytes);
}

/// A section whose parts have checksums of their own.
Result<void> FileStoreWriter::putParts(
  SectionKind kind, const std::vector<std::byte>& bytes, StoreFooter& footer)
{
  footer.sections.push_back({ kind, 0, file_.end(), bytes.size() });
  return file_.put(bytes);
}

Result<void> FileStoreWriter::finish(const StoreFooter& footer)
{
  const std::vector<std::byte> footerBytes = encodeFooter(footer);
  StoreHeader header;
  header.footerOffset = file_.end();
  header.footerBytes = static_cast<std::uint32_t>(footerBytes.size());
  header.fileBytes = file_.end() + footerBytes.size();
  header.requiredFeatures = (nameElsewhere_.empty() ? 0 : payloadElsewhere) | features_;
  Result<void> done = file_.put(footerBytes);
  if (done)
  {
    done = file_.flush();
  }
  if (done)
  {
    const std::vector<std::byte> headerBytes = encodeHeader(header);
    done = file_.file().overwrite(0, headerBytes.data(), headerBytes.size());
  }
  return done ? file_.file().publish() : done;
}
} // namespace

Result<std::unique_ptr<StoreWriter>> assembleStore(std::unique_ptr<OutputFile> file,
  const AttributeSchema& schema, std::optional<WrittenPayloads> elsewhere)
{
  if (Result<void> possible = checkColumnCount(schema); !possible)
  {
    return possible.error();
  }
  auto writer = std::make_unique<FileStoreWriter>(std::move(file), schema, std::move(elsewhere));
  if (Result<void> done = writer->begin(); !done)
  {
    return done.error();
  }
  return std::unique_ptr<StoreWriter>(std::move(writer));
}

Result<std::unique_ptr<StoreWriter>> StoreWriter::create(
  const std::string& path, const AttributeSchema& schema)
{
  Result<std::unique_ptr<OutputFile>> file = OutputFile::create(path);
  if (!file)
  {
    return file.error();
  }
  return assembleStore(std::move(*file), schema);
}

Result<std::unique_ptr<StoreWriter>> StoreWriter::createReferring(
  const std::string& path, const AttributeSchema& schema, WrittenPayloads elsewhere)
{
  Result<std::unique_ptr<OutputFile>> file = OutputFile::create(path, OutputFile::Durability::None);
  if (!file)
  {
    return file.error();
  }
  return assembleStore(std::move(*file), schema, std::move(elsewhere));
}

} // namespace pointfront
