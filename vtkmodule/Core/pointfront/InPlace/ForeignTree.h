#pragma once

#include "pointfront/InPlace/ForeignTable.h"
#include "pointfront/Store/StoredCloud.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// The facts about such a tree that are known before its points are read.
struct ForeignTreeContent
{
  SourceDescription source; ///< with a grid
  std::uint64_t fileBytes = 0;
  glm::dvec3 low{ 0.0 }; ///< lowest corner of the root's cube
  double side = 0.0; ///< side of the root's cube
  double spacing = 0.0; ///< between points of the root; not positive: a 128th of the side
  /// The part of the hierarchy that was read, from the root's cell on: all, or what its first page
  /// tells. The file claims `source.headerPointCount` points then.
  ForeignPage first;
  std::shared_ptr<const ForeignNodes> reader;

  /// The root's cube begins at the lowest corner of the box, and is as long as its longest side.
  void setCube(const Bounds& box)
  {
    const glm::dvec3 size = box.empty() ? glm::dvec3(0.0) : box.size();
    low = box.empty() ? glm::dvec3(0.0) : box.low;
    side = std::max({ size.x, size.y, size.z });
  }
};

/// An octree of someone else (COPC, EPT), drawn as it is: its own hierarchy, each node's points
/// brought into an order of which every prefix is a fair subset.
/// Boxes    are the cells, a step of the grid wider; cut down to the header's box if the points
///          of the root keep to it. A node with a point outside of its box is Corrupt: a query that
///          left it out would have been wrong.
/// Ranges   of attributes are those of some points of the first level that has any: a guess for
///          colours.
/// Pages    of the hierarchy that `first` does not have are read when somebody looks into them; the
///          numbers of nodes and levels are then not known (ForeignTable).
/// Memory   the table is held as far as it was read, and the first node with points.
/// Threads  all functions are safe from any thread.
class ForeignTree final : public StoredCloud
{
public:
  /// Errors  BadFormat: an invalid cube or cell, a cell that appears twice, a node with more points
  ///         than maxNodePoints; and the errors of the nodes that are read.
  static Result<std::shared_ptr<const StoredCloud>> make(ForeignTreeContent content);

  const StoreDescription& description() const override { return description_; }
  const std::shared_ptr<const Hierarchy>& hierarchy() const override { return hierarchy_; }
  std::vector<std::string> files() const override { return reader_->files(); }
  Result<FetchedNode> fetch(NodeIndex node, const ColumnSelection& columns) const override;
  std::vector<Result<FetchedNode>> fetchAll(
    const std::vector<WantedNode>& wanted, const ReadStop& stop) const override;
  Result<NodeColumns> decode(const FetchedNode& fetched) const override;
  std::size_t decodedBytes(
    NodeIndex node, std::uint32_t points, const ColumnSelection& columns) const override;
  std::size_t storedBytes(NodeIndex node, const ColumnSelection& columns) const override;
  std::optional<std::uint64_t> place(NodeIndex node) const override;
  std::uint64_t disk() const override { return reader_->disk(); }
  ReadCost readCost() const override { return reader_->readCost(); }
  MissingRows* missingRows() const override { return table_->missingRows(); }
  /// Every node is read, with all columns: its points are as many as the hierarchy says, and lie in
  /// its box.
  Result<VerifyReport> verify(const ProgressFunction& progress = {}) const override;

private:
  ForeignTree() = default;
  void describe(const ForeignTreeContent& content);
  Result<void> lookAtFirstPoints();
  void lookForColours(
    const std::vector<ForeignNode>& nodes, const std::vector<Result<RawBytes>>& bytes);
  void addRanges(const PointBatch& batch, const ColumnSelection& columns);
  ColumnSelection allColumns() const;
  void cutBoxes(const Bounds& declared, const glm::dvec3& margin);
  Result<NodeColumns> decodeNow(const FetchedNode& fetched) const;
  Error damaged(NodeIndex node, const std::string& what) const;
  Error lost(NodeIndex node) const;

  std::shared_ptr<const ForeignNodes> reader_;
  StoreDescription description_;
  std::shared_ptr<ForeignTable> table_;
  std::shared_ptr<const Hierarchy> hierarchy_; ///< the same
  NodeIndex first_ = noNode; ///< with points
  RawBytes firstBytes_; ///< its chunk in a far tree, which was read to describe the tree
  /// The first node, with the columns of the last request. Colours are chosen from its points
  /// before it is drawn, and reading it again would take as long as the rest of the first picture.
  mutable std::unique_ptr<const NodeColumns> kept_;
  mutable std::mutex mutex_; ///< guards kept_
};

} // namespace pointfront
