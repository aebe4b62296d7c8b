#pragma once

#include "pointfront/Codec/BlockCodec.h"
#include "pointfront/Points/QuantisationGrid.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{

/// Where every block of every node lies. A node has 1 + columns blocks, one after another in the
/// file: block 0 holds the positions, block 1 + c column c.
/// Threads  const functions are safe from any thread.
class BlockDirectory
{
public:
  struct Block
  {
    std::uint64_t offset = 0; ///< in the file
    std::uint32_t bytes = 0;
    std::uint32_t checksum = 0;
    BlockCodec codec = BlockCodec::Raw;
  };

  explicit BlockDirectory(std::uint32_t blocksPerNode)
    : blocksPerNode_(blocksPerNode)
  {
  }

  /// Appends a node whose payload begins at `offset`; its blocks follow by addBlock().
  void addNode(const GridPosition& origin, std::uint64_t offset);
  void addBlock(std::uint32_t bytes, std::uint32_t checksum, BlockCodec codec);
  /// Appends a node of another directory.
  void addNode(const BlockDirectory& other, std::uint32_t node);
  /// The payload of a node lies there, in the file of this directory.
  void setOffset(std::uint32_t node, std::uint64_t offset) { offsets_[node] = offset; }
  void reserve(std::size_t nodes);
  /// Appends all nodes of another directory as nodes whose payload lies in that other file.
  void addElsewhere(const BlockDirectory& other);

  std::uint32_t nodeCount() const { return static_cast<std::uint32_t>(offsets_.size()); }
  std::uint32_t blocksPerNode() const { return blocksPerNode_; }
  const GridPosition& origin(std::uint32_t node) const { return origins_[node]; }
  /// Where the node's payload begins in its file, and how long it is.
  std::uint64_t offset(std::uint32_t node) const { return offsets_[node] & ~elsewhereBit; }
  /// True if that is not the file of this directory but the one that its store names.
  bool isElsewhere(std::uint32_t node) const { return (offsets_[node] & elsewhereBit) != 0; }
  std::uint64_t payloadBytes(std::uint32_t node) const;
  Block block(std::uint32_t node, std::uint32_t block) const;

  /// Puts the facts that a file of version 2 and later has of a node, recordBytes() of them; its
  /// checksum follows.
  std::byte* putRecord(std::uint32_t node, std::byte* target) const;
  static constexpr std::size_t recordBytes(std::uint32_t blocksPerNode)
  {
    return 3 * 8 + 8 + std::size_t(9) * blocksPerNode;
  }

  /// The section's bytes: origins, offsets, sizes, checksums, codecs, each as one array.
  std::vector<std::byte> encode() const;
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
  std::uint32_t blocksPerNode_;
  std::vector<GridPosition> origins_;
  std::vector<std::uint64_t> offsets_;
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
