#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Points/QuantisationGrid.h"
#include "pointfront/Store/Hierarchy.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
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
  std::vector<glm::u32vec3> positions;
  ColumnSelection selection;
  std::vector<std::vector<std::byte>> columns;

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

/// Where nodes are decoded from: a store, or a made-up one in tests.
/// Threads  both functions are called from several loader threads at once.
class NodeReader
{
public:
  virtual ~NodeReader() = default;
  virtual Result<NodeColumns> read(NodeIndex node, const ColumnSelection& columns) const = 0;
  /// Host bytes that read() of these columns will need: known before, so that a budget can hold.
  virtual std::size_t decodedBytes(NodeIndex node, const ColumnSelection& columns) const = 0;
  /// Bytes that read() fetches from the disk.
  virtual std::size_t storedBytes(NodeIndex node, const ColumnSelection& columns) const = 0;
};

} // namespace pointfront
