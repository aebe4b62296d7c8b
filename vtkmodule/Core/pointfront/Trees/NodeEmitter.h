#pragma once

#include "pointfront/Ingest/RecordColumns.h"
#include "pointfront/Points/AttributeSchema.h"
#include "pointfront/Records/RecordLayout.h"
#include "pointfront/Records/TreeSpace.h"
#include "pointfront/Store/StoreWriter.h"
#include "pointfront/Trees/BuiltTree.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace pointfront
{

/// How a record's column becomes a column of the store.
struct StoredColumn
{
  std::optional<std::size_t> offset; ///< in the record; nothing: it is not carried
  std::size_t bytes = 0; ///< size of one point in the store
  bool narrowed = false; ///< two bytes a component in the record, one in the store
};

/// Turns the final points of a node into what the store keeps: orders them, splits records into
/// columns, compresses them, and completes the node's row (box, counts).
/// Threads  const after construction; any number of threads.
class NodeEmitter
{
public:
  /// `stored` has the common columns, of which records carry `columns`; it differs from these only
  /// in columns whose 16-bit values all fit 8 bits.
  /// With Refinement::Replace the points of inner nodes do not count as points of the input.
  NodeEmitter(TreeSpace space, const RecordColumns& columns, AttributeSchema stored,
    Refinement refinement = Refinement::Add);

  /// `points` in Morton order; the children of `node` are finished.
  EncodedNode emit(
    BuiltNode& node, const RecordSpan& records, const std::vector<std::uint32_t>& points) const;

  const TreeSpace& space() const { return space_; }

private:
  NodeColumns gather(const RecordSpan& records, const std::vector<std::uint32_t>& order) const;

  TreeSpace space_;
  AttributeSchema schema_;
  Refinement refinement_;
  std::vector<StoredColumn> columns_;
  ColumnConstants constants_;
};

} // namespace pointfront
