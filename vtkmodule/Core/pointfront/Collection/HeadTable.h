#pragma once

#include "pointfront/Collection/HeadTree.h"
#include "pointfront/Collection/PayloadCopy.h"
#include "pointfront/Store/PointStore.h"
#include "pointfront/Store/StoreWriter.h"

#include <string>
#include <vector>

namespace pointfront
{

/// The heads of the state before.
struct StoredHeads
{
  const PointStore* store = nullptr; ///< null: there is none
  std::vector<HeadNode> facts = {}; ///< by its nodes
};

/// The trees of heads as the node table of a store, and their payloads.
class HeadTable
{
public:
  /// Each root is the one of the store's layer of its number.
  explicit HeadTable(const std::vector<const HeadItem*>& roots);

  /// Appends the payloads: of stored points as they lie in the state `before`, of others coded now.
  /// Takes the facts of the former.
  /// Errors  those of reading and writing; Unsupported: the tiles lie too far apart for their grid.
  Result<void> append(StoreWriter& writer, const AttributeSchema& schema, StoredHeads before,
    const std::string& path);

  const std::vector<Node>& rows() const { return rows_; }
  const std::vector<NodeIndex>& roots() const { return roots_; }
  const std::vector<StoreWriter::PayloadId>& payloads() const { return payloads_; }
  std::uint64_t points() const;
  /// The record's part about the nodes; after append(). Leaves name tiles by their place in
  /// `tiles`.
  std::vector<HeadNode> takeFacts(const std::vector<CollectedTile>& tiles);

private:
  Result<std::vector<EncodedNode>> encodeChanged(
    const AttributeSchema& schema, const std::string& path) const;
  void describeRow(NodeIndex node, double areaAbove, double pointsAbove);

  Result<StoreWriter::PayloadId> appendStored(
    StoreWriter& writer, const HeadItem& group, PayloadCopy& copy, HeadNode& facts);

  std::vector<const HeadItem*> items_; ///< by node
  std::vector<Node> rows_;
  std::vector<NodeIndex> roots_;
  std::vector<StoreWriter::PayloadId> payloads_;
  std::vector<HeadNode> facts_;
};

} // namespace pointfront
