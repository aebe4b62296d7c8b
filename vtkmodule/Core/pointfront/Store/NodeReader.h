#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Points/QuantisationGrid.h"
#include "pointfront/Store/Hierarchy.h"
#include "pointfront/Store/MissingRows.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront
{

/// Which attribute columns of the store's schema are wanted, by column number, ascending.
/// Positions always come. "Model only what a scene requires": what is not named is not read.
using ColumnSelection = std::vector<std::uint32_t>;

/// The decoded points of one node.
/// Shapes   positions[n] are grid steps from `origin`; world = grid.toWorld(origin + positions[i]).
///          columns[k] belongs to selection[k] and holds n * attribute bytes.
/// Order    every prefix is a fair subset of the node (batches that double, each in Morton order).
struct NodeColumns
{
  NodeIndex node = noNode;
  GridPosition origin{ 0 };
  // As the node's row in the table says: who draws it need not ask a table that may be on a disk.
  std::uint64_t firstPoint = 0;
  glm::vec3 halfSize{ 0.0f };
  float spacing = 0.0f;
  float splatRadius = 0.0f; ///< world units; 0 where it was not measured
  std::uint16_t layer = 0;
  NodeIndex parent = noNode;
  bool leaf = false;
  std::vector<glm::u32vec3> positions;
  ColumnSelection selection;
  std::vector<std::vector<std::byte>> columns;

  void describe(const Node& row)
  {
    firstPoint = row.firstPoint;
    halfSize = row.halfSize;
    spacing = row.spacing;
    splatRadius = row.splatRadius;
    layer = row.layer;
    parent = row.parent;
    leaf = row.leaf();
  }
  std::size_t size() const { return positions.size(); }
  /// Host memory held, for budgets.
  std::size_t bytes() const
  {
    std::size_t sum = sizeof(NodeColumns) + positions.capacity() * sizeof(glm::u32vec3);
    for (const auto& c : columns)
    {
      sum += c.capacity() + sizeof(c);
    }
    return sum;
  }
};

/// Bytes that are written before they are read: not cleared.
struct RawBytes
{
  RawBytes() = default;
  explicit RawBytes(std::size_t bytes)
    : data(new std::byte[bytes])
    , size(bytes)
  {
  }
  std::unique_ptr<std::byte[]> data;
  std::size_t size = 0;
};

/// What of a node came from the disk, as it lies there: on the way from fetch() to decode().
struct FetchedNode
{
  NodeIndex node = noNode;
  ColumnSelection columns;
  std::vector<RawBytes> runs; ///< their meaning is the reader's
  std::size_t bytesRead = 0; ///< from the disk
  Node row{}; ///< of the node table
  /// Instead of runs: what a cloud that is made of others has fetched from one of them.
  std::shared_ptr<const FetchedNode> inner = nullptr;
};

/// Where nodes come from: a store, or a made-up one in tests. In two steps, so that the disk serves
/// one at a time while processors decode others (SMOOTH-8).
/// Threads  all functions are called from several loader threads at once.
class NodeReader
{
public:
  virtual ~NodeReader() = default;
  /// The disk's part: reads bytes, and does no more with them than it must. May take long. Without
  /// a disk there is nothing to fetch.
  virtual Result<FetchedNode> fetch(NodeIndex node, const ColumnSelection& columns) const
  {
    return FetchedNode{ node, columns, {}, 0 };
  }
  /// The processor's part: checks and decodes. Touches no file.
  virtual Result<NodeColumns> decode(const FetchedNode& fetched) const = 0;
  /// Both, one after the other.
  Result<NodeColumns> read(NodeIndex node, const ColumnSelection& columns) const
  {
    const Result<FetchedNode> fetched = fetch(node, columns);
    if (!fetched)
    {
      return fetched.error();
    }
    return decode(*fetched);
  }

  /// Host bytes that the node's points will need, `points` as its row says: known before, so that a
  /// budget can hold. Does not wait.
  virtual std::size_t decodedBytes(
    NodeIndex node, std::uint32_t points, const ColumnSelection& columns) const = 0;
  /// Bytes that fetch() reads from the disk.
  virtual std::size_t storedBytes(NodeIndex node, const ColumnSelection& columns) const = 0;
  /// A number that readers on the same disk (file system) share.
  virtual std::uint64_t disk() const { return 0; }
  /// Rows of its table that are read when somebody asks for them; null where all are in memory.
  virtual MissingRows* missingRows() const { return nullptr; }
};

} // namespace pointfront
