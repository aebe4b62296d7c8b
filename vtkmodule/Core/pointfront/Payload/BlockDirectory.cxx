#include "pointfront/Payload/BlockDirectory.h"

#include "pointfront/Codec/ByteStream.h"

#include <cstring>

namespace pointfront
{
namespace
{
constexpr std::uint64_t nodeBytes = 3 * 8 + 8;
constexpr std::uint64_t blockBytes = 4 + 4 + 1;

template <typename T>
void getArray(ByteReader& in, std::vector<T>& values, std::size_t count)
{
  values.resize(count);
  in.getBytes(values.data(), count * sizeof(T));
}
} // namespace

static_assert(sizeof(GridPosition) == 24, "origins are copied as they lie in memory");

void BlockDirectory::addNode(const GridPosition& origin, std::uint64_t offset)
{
  origins_.push_back(origin);
  offsets_.push_back({ offset, offset });
}

void BlockDirectory::addBlock(std::uint32_t bytes, std::uint32_t checksum, BlockCodec codec)
{
  sizes_.push_back(bytes);
  checksums_.push_back(checksum);
  codecs_.push_back(static_cast<std::uint8_t>(codec));
}

std::byte* BlockDirectory::putRecord(std::uint32_t node, std::byte* target) const
{
  const auto put = [&target](const auto& value)
  {
    std::memcpy(target, &value, sizeof value);
    target += sizeof value;
  };
  put(origins_[node]);
  for (std::size_t piece = 0; piece < payloadPieces; ++piece)
  {
    put(begin(node, piece));
  }
  const std::size_t first = std::size_t(node) * blocksPerNode_;
  for (std::size_t b = first; b < first + blocksPerNode_; ++b)
  {
    put(sizes_[b]);
    put(checksums_[b]);
    put(codecs_[b]);
  }
  return target;
}

void BlockDirectory::markElsewhere()
{
  for (auto& offsets : offsets_)
  {
    for (std::uint64_t& offset : offsets)
    {
      offset |= elsewhereBit;
    }
  }
}

std::uint64_t BlockDirectory::pieceBytes(std::uint32_t node, std::size_t piece) const
{
  const std::size_t first = std::size_t(node) * blocksPerNode_;
  std::uint64_t sum = 0;
  for (std::size_t b = 0; b < blocksPerNode_; ++b)
  {
    sum += pieceOf(b) == piece ? sizes_[first + b] : 0;
  }
  return sum;
}

std::uint64_t BlockDirectory::begin(std::uint32_t node, std::size_t piece) const
{
  return piece > 0 && pieceBytes(node, piece) == 0 ? offsets_[node][0] + pieceBytes(node, 0)
                                                   : offsets_[node][piece];
}

BlockDirectory::Block BlockDirectory::block(std::uint32_t node, std::uint32_t block) const
{
  const std::size_t first = std::size_t(node) * blocksPerNode_;
  const std::uint8_t piece = pieceOf(block);
  Block result;
  result.offset = offset(node, piece);
  result.elsewhere = isElsewhere(node, piece);
  for (std::uint32_t b = 0; b < block; ++b)
  {
    result.offset += pieceOf(b) == piece ? sizes_[first + b] : 0;
  }
  result.bytes = sizes_[first + block];
  result.checksum = checksums_[first + block];
  result.codec = static_cast<BlockCodec>(codecs_[first + block]);
  return result;
}

std::uint64_t BlockDirectory::encodedBytes(std::uint64_t nodeCount, std::uint32_t blocksPerNode)
{
  return nodeCount * (nodeBytes + blockBytes * blocksPerNode);
}

BlockDirectory BlockDirectory::decode(
  const std::byte* data, std::uint32_t nodeCount, std::uint32_t blocksPerNode)
{
  ByteReader in(data, static_cast<std::size_t>(encodedBytes(nodeCount, blocksPerNode)));
  BlockDirectory directory(ColumnPieces(blocksPerNode - 1, 0));
  const std::size_t blocks = std::size_t(nodeCount) * blocksPerNode;
  getArray(in, directory.origins_, nodeCount);
  std::vector<std::uint64_t> offsets;
  getArray(in, offsets, nodeCount);
  for (const std::uint64_t offset : offsets)
  {
    directory.offsets_.push_back({ offset, offset });
  }
  getArray(in, directory.sizes_, blocks);
  getArray(in, directory.checksums_, blocks);
  getArray(in, directory.codecs_, blocks);
  return directory;
}

std::string BlockDirectory::fault(const Limits& limits, bool& unknownCodec) const
{
  unknownCodec = false;
  for (std::uint8_t codec : codecs_)
  {
    if (!knownBlockCodec(codec))
    {
      unknownCodec = true;
      return "codec " + std::to_string(codec);
    }
  }
  for (std::uint32_t node = 0; node < nodeCount(); ++node)
  {
    for (std::size_t piece = 0; piece < payloadPieces; ++piece)
    {
      const std::uint64_t at = offset(node, piece);
      const std::uint64_t end = isElsewhere(node, piece) ? limits.endElsewhere : limits.end;
      if (at < limits.begin || at > end || pieceBytes(node, piece) > end - at)
      {
        return "node " + std::to_string(node) + ": its payload lies outside the file";
      }
    }
    if (!inRange(origins_[node]))
    {
      return "node " + std::to_string(node) + ": its origin is out of range";
    }
  }
  return {};
}

} // namespace pointfront
