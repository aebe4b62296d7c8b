#pragma once

#include "pointfront/Codec/BlockCodec.h"
#include "pointfront/Payload/ColumnPieces.h"
#include "pointfront/Points/QuantisationGrid.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pointfront
{

/// Where every block of every node lies. A node has 1 + columns blocks: block 0 holds the
/// positions, block 1 + c column c. They lie in two pieces; within a piece they follow each other
/// in this order. A piece without bytes begins where the first ends. Threads  const functions are
/// safe from any thread.
class BlockDirectory
{
public:
  struct Block
  {
    std::uint64_t offset = 0; ///< in the file
    std::uint32_t bytes = 0;
    std::uint32_t checksum = 0;
    BlockCodec codec = BlockCodec::Raw;
    bool elsewhere = false; ///< in the store's second file (PayloadElsewhere.h)
  };

  /// `pieces`: of each column.
  explicit BlockDirectory(ColumnPieces pieces)
    : pieces_(std::move(pieces))
    , blocksPerNode_(static_cast<std::uint32_t>(1 + pieces_.size()))
  {
  }

  /// Appends a node whose pieces begin at `offset`; its blocks follow by addBlock().
  void addNode(const GridPosition& origin, std::uint64_t offset);
  void addBlock(std::uint32_t bytes, std::uint32_t checksum, BlockCodec codec);
  /// A piece of a node lies there, in the file of this directory.
  void setOffset(std::uint32_t node, std::size_t piece, std::uint64_t offset)
  {
    offsets_[node][piece] = offset;
  }
  /// All payloads so far lie in another file.
  void markElsewhere();

  const ColumnPieces& pieces() const { return pieces_; }
  std::uint8_t pieceOf(std::size_t block) const { return block == 0 ? 0 : pieces_[block - 1]; }
  std::uint32_t nodeCount() const { return static_cast<std::uint32_t>(offsets_.size()); }
  std::uint32_t blocksPerNode() const { return blocksPerNode_; }
  const GridPosition& origin(std::uint32_t node) const { return origins_[node]; }
  /// Where a piece of the node begins in its file, and how long it is.
  std::uint64_t offset(std::uint32_t node, std::size_t piece) const
  {
    return begin(node, piece) & ~elsewhereBit;
  }
  /// True if that is not the file of this directory but the one that its store names.
  bool isElsewhere(std::uint32_t node, std::size_t piece) const
  {
    return (begin(node, piece) & elsewhereBit) != 0;
  }
  std::uint64_t pieceBytes(std::uint32_t node, std::size_t piece) const;
  Block block(std::uint32_t node, std::uint32_t block) const;

  /// Puts the facts that a file has of a node since version 4, recordBytes() of them; its checksum
  /// follows.
  std::byte* putRecord(std::uint32_t node, std::byte* target) const;
  /// Bytes of those, and of those that files of version 2 and 3 have: one offset.
  static constexpr std::size_t recordBytes(std::uint32_t blocksPerNode, bool inPieces = true)
  {
    return 3 * 8 + (inPieces ? payloadPieces : 1) * 8 + std::size_t(9) * blocksPerNode;
  }

  /// The section's bytes in version 1: origins, offsets, sizes, checksums, codecs, each as one
  /// array.
  static std::uint64_t encodedBytes(std::uint64_t nodeCount, std::uint32_t blocksPerNode);
  static BlockDirectory decode(
    const std::byte* data, std::uint32_t nodeCount, std::uint32_t blocksPerNode);

  /// Where payloads may lie: from `begin` on, up to a different end in each of the two files.
  struct Limits
  {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
    std::uint64_t endElsewhere = 0;
  };
  /// The fault, or an empty text: every payload lies within the limits, no origin is out of
  /// range. `unknownCodec` is set when the fault is a codec that this program lacks.
  std::string fault(const Limits& limits, bool& unknownCodec) const;

  /// Marks the offset of a node whose payload is elsewhere, in files too.
  static constexpr std::uint64_t elsewhereBit = std::uint64_t(1) << 63;

private:
  /// With the mark of its file.
  std::uint64_t begin(std::uint32_t node, std::size_t piece) const;

  ColumnPieces pieces_;
  std::uint32_t blocksPerNode_;
  std::vector<GridPosition> origins_;
  std::vector<std::array<std::uint64_t, payloadPieces>> offsets_;
  std::vector<std::uint32_t> sizes_; // node * blocksPerNode + block
  std::vector<std::uint32_t> checksums_; // likewise
  std::vector<std::uint8_t> codecs_; // likewise
};

/// Grid positions beyond this (2^51 steps) would not survive double coordinates.
constexpr std::int64_t maxGridPosition = std::int64_t(1) << 51;

inline bool inRange(const GridPosition& p)
{
  return std::all_of(
    &p[0], &p[0] + 3, [](std::int64_t v) { return v >= -maxGridPosition && v <= maxGridPosition; });
}

} // namespace pointfront
