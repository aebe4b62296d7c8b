#include "pointfront/Store/BlockDirectory.h"

#include "pointfront/Codec/ByteStream.h"

#include <cstring>
#include <numeric>

namespace pointfront
{
namespace
{
constexpr std::uint64_t nodeBytes = 3 * 8 + 8;
constexpr std::uint64_t blockBytes = 4 + 4 + 1;

template <typename T>
void putArray(ByteWriter& out, const std::vector<T>& values)
{
  out.putBytes(values.data(), values.size() * sizeof(T));
}

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
  offsets_.push_back(offset);
}

void BlockDirectory::addBlock(std::uint32_t bytes, std::uint32_t checksum, BlockCodec codec)
{
  sizes_.push_back(bytes);
  checksums_.push_back(checksum);
  codecs_.push_back(static_cast<std::uint8_t>(codec));
}

void BlockDirectory::addNode(const BlockDirectory& other, std::uint32_t node)
{
  addNode(other.origin(node), other.offsets_[node]); // with the mark of its file
  const auto append = [&](auto& own, const auto& theirs)
  {
    const auto first = theirs.begin() + static_cast<std::ptrdiff_t>(node) * blocksPerNode_;
    own.insert(own.end(), first, first + blocksPerNode_);
  };
  append(sizes_, other.sizes_);
  append(checksums_, other.checksums_);
  append(codecs_, other.codecs_);
}

void BlockDirectory::reserve(std::size_t nodes)
{
  origins_.reserve(nodes);
  offsets_.reserve(nodes);
  sizes_.reserve(nodes * blocksPerNode_);
  checksums_.reserve(nodes * blocksPerNode_);
  codecs_.reserve(nodes * blocksPerNode_);
}

std::byte* BlockDirectory::putRecord(std::uint32_t node, std::byte* target) const
{
  const auto put = [&target](const auto& value)
  {
    std::memcpy(target, &value, sizeof value);
    target += sizeof value;
  };
  put(origins_[node]);
  put(offsets_[node]); // with the mark of its file
  const std::size_t first = std::size_t(node) * blocksPerNode_;
  for (std::size_t b = first; b < first + blocksPerNode_; ++b)
  {
    put(sizes_[b]);
    put(checksums_[b]);
    put(codecs_[b]);
  }
  return target;
}

void BlockDirectory::addElsewhere(const BlockDirectory& other)
{
  for (std::uint32_t node = 0; node < other.nodeCount(); ++node)
  {
    addNode(other, node);
    offsets_.back() |= elsewhereBit;
  }
}

std::uint64_t BlockDirectory::payloadBytes(std::uint32_t node) const
{
  const auto first = sizes_.begin() + static_cast<std::ptrdiff_t>(node) * blocksPerNode_;
  return std::accumulate(first, first + blocksPerNode_, std::uint64_t(0));
}

BlockDirectory::Block BlockDirectory::block(std::uint32_t node, std::uint32_t block) const
{
  const std::size_t first = std::size_t(node) * blocksPerNode_;
  Block result;
  result.offset = offset(node);
  for (std::size_t i = first; i < first + block; ++i)
  {
    result.offset += sizes_[i];
  }
  result.bytes = sizes_[first + block];
  result.checksum = checksums_[first + block];
  result.codec = static_cast<BlockCodec>(codecs_[first + block]);
  return result;
}

std::vector<std::byte> BlockDirectory::encode() const
{
  ByteWriter out;
  putArray(out, origins_);
  putArray(out, offsets_);
  putArray(out, sizes_);
  putArray(out, checksums_);
  putArray(out, codecs_);
  return out.bytes();
}

std::uint64_t BlockDirectory::encodedBytes(std::uint64_t nodeCount, std::uint32_t blocksPerNode)
{
  return nodeCount * (nodeBytes + blockBytes * blocksPerNode);
}

BlockDirectory BlockDirectory::decode(
  const std::byte* data, std::uint32_t nodeCount, std::uint32_t blocksPerNode)
{
  ByteReader in(data, static_cast<std::size_t>(encodedBytes(nodeCount, blocksPerNode)));
  BlockDirectory directory(blocksPerNode);
  const std::size_t blocks = std::size_t(nodeCount) * blocksPerNode;
  getArray(in, directory.origins_, nodeCount);
  getArray(in, directory.offsets_, nodeCount);
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
    const std::uint64_t at = offset(node);
    const std::uint64_t end = isElsewhere(node) ? limits.endElsewhere : limits.end;
    if (at < limits.begin || at > end || payloadBytes(node) > end - at)
    {
      return "node " + std::to_string(node) + ": its payload lies outside the file";
    }
    if (!inRange(origins_[node]))
    {
      return "node " + std::to_string(node) + ": its origin is out of range";
    }
  }
  return {};
}

} // namespace pointfront
