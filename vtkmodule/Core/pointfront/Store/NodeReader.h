#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/RawBytes.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Disk/ByteSource.h"
#include "pointfront/Points/QuantisationGrid.h"
#include "pointfront/Store/Hierarchy.h"
#include "pointfront/Store/MissingRows.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace pointfront
{

/// Which attribute columns of the store's schema are wanted, by column number, ascending. Positions
/// always come. Columns that are not named are not read.
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
  glm::dvec3 centre{ 0.0 }; ///< world; `origin` need not be the low corner of the row's box
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
    centre = row.centre;
    halfSize = row.halfSize;
    spacing = row.spacing;
    splatRadius = row.splatRadius;
    layer = row.layer;
    parent = row.parent;
    leaf = row.leaf();
  }
  /// The box of the row: of these points and all below.
  Bounds box() const { return { centre - glm::dvec3(halfSize), centre + glm::dvec3(halfSize) }; }
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

/// The bytes of a node as they lie on the disk, on their way from fetch() to decode().
struct FetchedNode
{
  NodeIndex node = noNode;
  ColumnSelection columns;
  std::vector<RawBytes> runs; ///< their meaning is the reader's
  std::size_t bytesRead = 0; ///< from the disk
  Node row{}; ///< row of the node table
  /// Instead of runs: the bytes that a cloud made of others has fetched from one of them.
  std::shared_ptr<const FetchedNode> inner = nullptr;
};

/// A node and the columns that are wanted of it.
struct WantedNode
{
  NodeIndex node = noNode;
  ColumnSelection columns;
};

/// Reads nodes of a store, or makes them up in tests. It works in two steps, so that the disk
/// serves one node at a time while processors decode others (SMOOTH-8).
/// Threads  all functions are called from several loader threads at once.
class NodeReader
{
public:
  virtual ~NodeReader() = default;
  /// The disk's part: reads bytes and does as little else as possible. May take long. A reader
  /// without a disk fetches nothing.
  virtual Result<FetchedNode> fetch(NodeIndex node, const ColumnSelection& columns) const
  {
    return FetchedNode{ node, columns, {}, 0 };
  }
  /// The same for several nodes, in as few round trips as the reader can: the answers are in the
  /// order of `wanted`. An error of one node leaves the others alone; Cancelled where `stop` was
  /// set before the node was read. One after the other if the reader has no better way.
  virtual std::vector<Result<FetchedNode>> fetchAll(
    const std::vector<WantedNode>& wanted, const ReadStop& stop) const;
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

  /// Host bytes that the node's points will need; `points` is the number in its row. The number is
  /// known before the node is read, so that a budget can hold. Does not wait.
  virtual std::size_t decodedBytes(
    NodeIndex node, std::uint32_t points, const ColumnSelection& columns) const = 0;
  /// Bytes that fetch() reads from the disk.
  virtual std::size_t storedBytes(NodeIndex node, const ColumnSelection& columns) const = 0;
  /// Where the bytes of a node begin in its file, if that is known without a read: nodes that lie
  /// near each other cost fewer round trips if they are fetched together.
  virtual std::optional<std::uint64_t> place(NodeIndex) const { return std::nullopt; }
  /// The number of the disk (file system) or server: equal for readers on the same one.
  virtual std::uint64_t disk() const { return 0; }
  /// The cost of its reads: a disk's, or those of a far source, which is better read by fetchAll().
  virtual ReadCost readCost() const { return {}; }
  /// The rows of its table that are read on demand; null if all rows are in memory.
  virtual MissingRows* missingRows() const { return nullptr; }
};

} // namespace pointfront
