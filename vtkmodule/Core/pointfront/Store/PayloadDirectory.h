#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Disk/ByteSource.h"
#include "pointfront/Payload/BlockDirectory.h"
#include "pointfront/Store/NodeReader.h"
#include "pointfront/Store/StoreFormat.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront
{

/// Where one node's blocks lie: block 0 the positions, block 1 + c column c.
struct NodePayload
{
  std::uint32_t pointCount = 0; ///< as its row in the node table says
  GridPosition origin{ 0 };
  std::vector<BlockDirectory::Block> blocks;
};

/// The payload of a node as it lies in a store.
struct StoredPayload
{
  NodePayload is;
  std::vector<const std::byte*> blocks; ///< bytes of each
};

/// The blocks of one node that are wanted, in the order of the file, and the runs of neighbours
/// among them: a run is read as a whole.
struct BlockRuns
{
  struct Wanted
  {
    BlockDirectory::Block block;
    std::size_t number = 0; ///< 0 the positions, 1 + k the k-th of the wanted columns
  };
  struct Run
  {
    std::size_t first = 0; ///< index of its first block
    std::size_t end = 0; ///< past the last
    std::uint64_t offset = 0; ///< in the file
    std::size_t bytes = 0;
    bool elsewhere = false; ///< in the store's second file
  };
  BlockRuns(const NodePayload& payload, const ColumnSelection& columns);

  std::vector<Wanted> blocks;
  std::vector<Run> runs;
};

/// Tells where nodes' payloads lie in the file of an open store.
/// Threads  from any thread.
class PayloadDirectory
{
public:
  virtual ~PayloadDirectory() = default;
  /// Room for what the file says of a node, with the number of points of its row in front of it.
  /// Appends to `reads` what is still to be read into it.
  virtual RawBytes prepare(
    std::uint32_t node, std::uint32_t pointCount, std::vector<ByteRange>& reads) const = 0;
  /// The same, read.
  Result<RawBytes> fetch(
    const ByteSource& file, std::uint32_t node, std::uint32_t pointCount) const;
  /// Checks and reads what fetch() gave. Touches no file.
  virtual Result<NodePayload> decode(std::uint32_t node, const RawBytes& fetched) const = 0;
  /// Whether fetch() is answered from memory.
  virtual bool holds(std::uint32_t node) const = 0;

  /// That of the store: read as a whole and checked for version 1, a record at a time from version
  /// 2 on. `file` must outlive it. `bytesElsewhere`: of a second file, from version 2 on.
  static Result<std::unique_ptr<const PayloadDirectory>> open(const ByteSource& file,
    std::uint32_t version, const StoreFooter& footer, std::uint64_t bytesElsewhere = 0);
};

/// Bytes of a node's record from version 2 on: origin, offsets of its pieces (one before version
/// 4), blocks, checksum.
constexpr std::size_t payloadRecordBytes(
  std::uint32_t blocksPerNode, std::uint32_t version = storeVersion)
{
  return BlockDirectory::recordBytes(blocksPerNode, version >= 4) + 4;
}

/// The section since version 4: a record for each of those nodes of a directory.
std::vector<std::byte> encodePayloadRecords(
  const BlockDirectory& directory, const std::vector<std::uint32_t>& nodes);

} // namespace pointfront
