#include "pointfront/Store/PayloadDirectory.h"

#include "pointfront/Codec/ByteStream.h"
#include "pointfront/Codec/Checksum.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <string>
#include <utility>

namespace pointfront
{
namespace
{
/// Blocks with at most this many unwanted bytes between them are fetched by one read: the disk
/// and the page cache hand out whole pages anyway.
constexpr std::uint64_t mergeGapBytes = 4096;

Error unknownCodecIn(const std::string& path, const std::string& codec)
{
  return makeError(Error::Kind::Unsupported,
    "'" + path + "' was written with " + codec +
      ", which this program does not know; update PointFront");
}

constexpr std::size_t countBytes = sizeof(std::uint32_t);

/// Room for a record behind the number of points.
RawBytes begun(std::uint32_t pointCount, std::size_t recordBytes)
{
  RawBytes bytes(countBytes + recordBytes);
  std::memcpy(bytes.data.get(), &pointCount, countBytes);
  return bytes;
}

std::uint32_t pointCountOf(const RawBytes& fetched)
{
  std::uint32_t count = 0;
  std::memcpy(&count, fetched.data.get(), countBytes);
  return count;
}

/// Version 1: five arrays that were read when the store was opened.
class DirectoryInMemory final : public PayloadDirectory
{
public:
  explicit DirectoryInMemory(BlockDirectory directory)
    : directory_(std::move(directory))
  {
  }
  RawBytes prepare(std::uint32_t, std::uint32_t pointCount, std::vector<ByteRange>&) const override
  {
    return begun(pointCount, 0);
  }
  bool holds(std::uint32_t) const override { return true; }
  Result<NodePayload> decode(std::uint32_t node, const RawBytes& fetched) const override
  {
    NodePayload payload;
    payload.pointCount = pointCountOf(fetched);
    payload.origin = directory_.origin(node);
    for (std::uint32_t b = 0; b < directory_.blocksPerNode(); ++b)
    {
      payload.blocks.push_back(directory_.block(node, b));
    }
    return payload;
  }

private:
  BlockDirectory directory_;
};

/// Version 2: a record is read when its node is.
class DirectoryInFile final : public PayloadDirectory
{
public:
  DirectoryInFile(const ByteSource& file, std::uint64_t offset, std::uint32_t blocksPerNode,
    std::uint64_t payloadEnd, std::uint64_t bytesElsewhere)
    : file_(file)
    , offset_(offset)
    , blocksPerNode_(blocksPerNode)
    , payloadEnd_(payloadEnd)
    , bytesElsewhere_(bytesElsewhere)
  {
  }

  RawBytes prepare(
    std::uint32_t node, std::uint32_t pointCount, std::vector<ByteRange>& reads) const override
  {
    RawBytes bytes = begun(pointCount, payloadRecordBytes(blocksPerNode_));
    reads.push_back({ offsetOf(node), bytes.size - countBytes, bytes.data.get() + countBytes });
    return bytes;
  }
  bool holds(std::uint32_t node) const override
  {
    return file_.holds(offsetOf(node), payloadRecordBytes(blocksPerNode_));
  }

  Result<NodePayload> decode(std::uint32_t node, const RawBytes& fetched) const override
  {
    const std::byte* record = fetched.data.get() + countBytes;
    const std::size_t size = fetched.size - countBytes;
    const auto damaged = [&](const std::string& what)
    {
      return corruptStore(file_.path(), offsetOf(node),
        "block directory, node " + std::to_string(node) + ": " + what);
    };
    ByteReader end(record + size - 4, 4);
    if (!matchesChecksum(record, size - 4, end.get<std::uint32_t>()))
    {
      return damaged("the checksum does not match");
    }
    ByteReader in(record, size);
    Result<NodePayload> payload = decodeRecord(in, damaged);
    if (payload)
    {
      payload->pointCount = pointCountOf(fetched);
    }
    return payload;
  }

private:
  std::uint64_t offsetOf(std::uint32_t node) const
  {
    return offset_ + std::uint64_t(node) * payloadRecordBytes(blocksPerNode_);
  }

  template <typename Damaged>
  Result<NodePayload> decodeRecord(ByteReader& in, const Damaged& damaged) const
  {
    NodePayload payload;
    for (int axis = 0; axis < 3; ++axis)
    {
      payload.origin[axis] = in.get<std::int64_t>();
    }
    auto offset = in.get<std::uint64_t>();
    payload.elsewhere = (offset & BlockDirectory::elsewhereBit) != 0;
    offset &= ~BlockDirectory::elsewhereBit;
    const std::uint64_t payloadEnd = payload.elsewhere ? bytesElsewhere_ : payloadEnd_;
    if (!inRange(payload.origin))
    {
      return damaged("its origin is out of range");
    }
    for (std::uint32_t b = 0; b < blocksPerNode_; ++b)
    {
      BlockDirectory::Block block;
      block.offset = offset;
      block.bytes = in.get<std::uint32_t>();
      block.checksum = in.get<std::uint32_t>();
      const auto codec = in.get<std::uint8_t>();
      if (!knownBlockCodec(codec))
      {
        return unknownCodecIn(file_.path(), "codec " + std::to_string(codec));
      }
      if (offset < storeHeaderBytes || offset > payloadEnd || block.bytes > payloadEnd - offset)
      {
        return damaged("its payload lies outside the file");
      }
      block.codec = static_cast<BlockCodec>(codec);
      payload.blocks.push_back(block);
      offset += block.bytes;
    }
    return payload;
  }

  const ByteSource& file_;
  std::uint64_t offset_;
  std::uint32_t blocksPerNode_;
  std::uint64_t payloadEnd_;
  std::uint64_t bytesElsewhere_;
};

Result<std::unique_ptr<const PayloadDirectory>> openInMemory(
  const ByteSource& file, const SectionEntry& section, const StoreFooter& footer)
{
  std::vector<std::byte> bytes(static_cast<std::size_t>(section.bytes));
  if (Result<void> done = file.readAt(section.offset, bytes.data(), bytes.size()); !done)
  {
    return done.error();
  }
  if (!matchesChecksum(bytes.data(), bytes.size(), section.checksum))
  {
    return corruptStore(
      file.path(), section.offset, "the block directory's checksum does not match");
  }
  BlockDirectory directory =
    BlockDirectory::decode(bytes.data(), footer.nodeCount, footer.columnCount + 1);
  bool unknownCodec = false;
  const std::string fault =
    directory.fault({ storeHeaderBytes, payloadEndOf(footer), 0 }, unknownCodec);
  if (unknownCodec)
  {
    return unknownCodecIn(file.path(), fault);
  }
  if (!fault.empty())
  {
    return corruptStore(file.path(), section.offset, fault);
  }
  return std::unique_ptr<const PayloadDirectory>(
    std::make_unique<DirectoryInMemory>(std::move(directory)));
}
} // namespace

BlockRuns::BlockRuns(const NodePayload& payload, const ColumnSelection& columns)
  : blocks{ payload.blocks[0] }
{
  for (const std::uint32_t column : columns)
  {
    assert(column + 1 < payload.blocks.size());
    blocks.push_back(payload.blocks[column + 1]);
  }
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    const std::uint64_t end = runs.empty() ? 0 : runs.back().offset + runs.back().bytes;
    if (runs.empty() || blocks[b].offset - end > mergeGapBytes)
    {
      runs.push_back({ b, b, blocks[b].offset, 0 });
    }
    Run& run = runs.back();
    run.end = b + 1;
    run.bytes = static_cast<std::size_t>(blocks[b].offset + blocks[b].bytes - run.offset);
  }
}

Result<RawBytes> PayloadDirectory::fetch(
  const ByteSource& file, std::uint32_t node, std::uint32_t pointCount) const
{
  std::vector<ByteRange> reads;
  RawBytes bytes = prepare(node, pointCount, reads);
  const Result<void> done = file.read(reads.data(), reads.size());
  return done ? Result<RawBytes>(std::move(bytes)) : done.error();
}

Result<std::unique_ptr<const PayloadDirectory>> PayloadDirectory::open(const ByteSource& file,
  std::uint32_t version, const StoreFooter& footer, std::uint64_t bytesElsewhere)
{
  const SectionEntry& section = *footer.find(SectionKind::BlockDirectory);
  const std::uint32_t blocks = footer.columnCount + 1;
  const std::uint64_t expected = version == 1
    ? BlockDirectory::encodedBytes(footer.nodeCount, blocks)
    : std::uint64_t(footer.nodeCount) * payloadRecordBytes(blocks);
  if (section.bytes != expected)
  {
    return corruptStore(file.path(), section.offset, "the block directory's size is wrong");
  }
  if (version == 1)
  {
    return openInMemory(file, section, footer);
  }
  return std::unique_ptr<const PayloadDirectory>(std::make_unique<DirectoryInFile>(
    file, section.offset, blocks, payloadEndOf(footer), bytesElsewhere));
}

std::vector<std::byte> encodePayloadRecords(
  const BlockDirectory& directory, const std::vector<std::uint32_t>& nodes)
{
  std::vector<std::byte> bytes(nodes.size() * payloadRecordBytes(directory.blocksPerNode()));
  std::byte* record = bytes.data();
  for (const std::uint32_t node : nodes)
  {
    std::byte* const end = directory.putRecord(node, record);
    const std::uint32_t checksum = checksumOf(record, static_cast<std::size_t>(end - record));
    std::memcpy(end, &checksum, sizeof checksum);
    record = end + sizeof checksum;
  }
  return bytes;
}

} // namespace pointfront
