#include "pointfront/Store/PayloadDirectory.h"

#include "pointfront/Codec/ByteStream.h"
#include "pointfront/Codec/Checksum.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <string>
#include <tuple>
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

/// Since version 2: a record is read when its node is.
class DirectoryInFile final : public PayloadDirectory
{
public:
  DirectoryInFile(const ByteSource& file, std::uint32_t version, const StoreFooter& footer,
    std::uint64_t bytesElsewhere)
    : file_(file)
    , offset_(footer.find(SectionKind::BlockDirectory)->offset)
    , recordBytes_(payloadRecordBytes(footer.columnCount + 1, version))
    , inPieces_(version >= 4)
    , pieces_(inPieces_ ? footer.pieces : ColumnPieces(footer.columnCount, 0))
    , payloadEnd_(payloadEndOf(footer))
    , bytesElsewhere_(bytesElsewhere)
  {
  }

  RawBytes prepare(
    std::uint32_t node, std::uint32_t pointCount, std::vector<ByteRange>& reads) const override
  {
    RawBytes bytes = begun(pointCount, recordBytes_);
    reads.push_back({ offsetOf(node), bytes.size - countBytes, bytes.data.get() + countBytes });
    return bytes;
  }
  bool holds(std::uint32_t node) const override
  {
    return file_.holds(offsetOf(node), recordBytes_);
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
    return offset_ + std::uint64_t(node) * recordBytes_;
  }

  /// Where the next block of a piece lies.
  struct Place
  {
    std::uint64_t begin = 0;
    std::uint64_t offset = 0;
    std::uint64_t end = 0; ///< payload in its file ends there at the latest
    bool elsewhere = false;
  };
  using Places = std::array<Place, payloadPieces>;

  Places getPlaces(ByteReader& in) const
  {
    Places places;
    for (std::size_t piece = 0; piece < (inPieces_ ? payloadPieces : 1); ++piece)
    {
      const auto begin = in.get<std::uint64_t>();
      Place& place = places[piece];
      place.elsewhere = (begin & BlockDirectory::elsewhereBit) != 0;
      place.begin = place.offset = begin & ~BlockDirectory::elsewhereBit;
      place.end = place.elsewhere ? bytesElsewhere_ : payloadEnd_;
    }
    return places;
  }

  /// An empty piece inside the other counts, too.
  static bool overlap(const Places& places)
  {
    const auto& [first, second] = places;
    return first.elsewhere == second.elsewhere && first.begin < second.offset &&
      second.begin < first.offset;
  }

  template <typename Damaged>
  Result<NodePayload> decodeRecord(ByteReader& in, const Damaged& damaged) const
  {
    NodePayload payload;
    for (int axis = 0; axis < 3; ++axis)
    {
      payload.origin[axis] = in.get<std::int64_t>();
    }
    if (!inRange(payload.origin))
    {
      return damaged("its origin is out of range");
    }
    Places places = getPlaces(in);
    for (std::size_t b = 0; b <= pieces_.size(); ++b)
    {
      Place& place = places[b == 0 ? 0 : pieces_[b - 1]];
      BlockDirectory::Block block;
      block.offset = place.offset;
      block.elsewhere = place.elsewhere;
      block.bytes = in.get<std::uint32_t>();
      block.checksum = in.get<std::uint32_t>();
      const auto codec = in.get<std::uint8_t>();
      if (!knownBlockCodec(codec))
      {
        return unknownCodecIn(file_.path(), "codec " + std::to_string(codec));
      }
      if (place.offset < storeHeaderBytes || place.offset > place.end ||
        block.bytes > place.end - place.offset)
      {
        return damaged("its payload lies outside the file");
      }
      block.codec = static_cast<BlockCodec>(codec);
      payload.blocks.push_back(block);
      place.offset += block.bytes;
    }
    return overlap(places) ? damaged("the pieces of its payload overlap")
                           : Result<NodePayload>(std::move(payload));
  }

  const ByteSource& file_;
  std::uint64_t offset_;
  std::size_t recordBytes_;
  bool inPieces_;
  ColumnPieces pieces_;
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
  : blocks{ { payload.blocks[0], 0 } }
{
  for (const std::uint32_t column : columns)
  {
    assert(column + 1 < payload.blocks.size());
    blocks.push_back({ payload.blocks[column + 1], blocks.size() });
  }
  std::stable_sort(blocks.begin(), blocks.end(),
    [](const Wanted& a, const Wanted& b)
    {
      return std::tie(a.block.elsewhere, a.block.offset) <
        std::tie(b.block.elsewhere, b.block.offset);
    });
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    const BlockDirectory::Block& block = blocks[b].block;
    const std::uint64_t end = runs.empty() ? 0 : runs.back().offset + runs.back().bytes;
    if (runs.empty() || runs.back().elsewhere != block.elsewhere ||
      block.offset - end > mergeGapBytes)
    {
      runs.push_back({ b, b, block.offset, 0, block.elsewhere });
    }
    Run& run = runs.back();
    run.end = b + 1;
    run.bytes = static_cast<std::size_t>(block.offset + block.bytes - run.offset);
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
    : std::uint64_t(footer.nodeCount) * payloadRecordBytes(blocks, version);
  if (section.bytes != expected)
  {
    return corruptStore(file.path(), section.offset, "the block directory's size is wrong");
  }
  if (version == 1)
  {
    return openInMemory(file, section, footer);
  }
  return std::unique_ptr<const PayloadDirectory>(
    std::make_unique<DirectoryInFile>(file, version, footer, bytesElsewhere));
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
