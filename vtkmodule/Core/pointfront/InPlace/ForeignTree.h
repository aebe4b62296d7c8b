#pragma once

#include "pointfront/Store/StoredCloud.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace pointfront
{

/// A node of an octree that somebody else wrote. Cell x, y, z of 2^level cells along each side of
/// the root's cube.
struct ForeignNode
{
  std::int32_t level = 0;
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;
  std::uint32_t points = 0;
  std::uint64_t chunk = 0; ///< where its points are, for ForeignNodes; of no meaning without points
};

/// Reads the nodes of such a tree. Threads  all functions from any thread.
class ForeignNodes
{
public:
  virtual ~ForeignNodes() = default;
  /// Bytes of a chunk as they lie on the disk.
  virtual Result<RawBytes> fetch(std::uint64_t chunk) const = 0;
  /// Several chunks, in as few round trips as possible; one after the other if there is no better
  /// way.
  virtual std::vector<Result<RawBytes>> fetchAll(
    const std::vector<std::uint64_t>& chunks, const ReadStop& stop) const;
  virtual std::size_t storedBytes(std::uint64_t chunk) const = 0;
  /// The part of a chunk that is wanted.
  struct Part
  {
    std::uint64_t chunk = 0;
    std::uint32_t points = 0; ///< that the hierarchy says it has
    std::uint32_t first = 0; ///< so many of them are enough, those that come first in the file
    const ColumnSelection& columns;
  };
  /// Points in the file's order, as positions or as steps, with the wanted columns. Other columns
  /// may be filled or empty.
  virtual Result<void> decode(const Part& part, const RawBytes& bytes, PointBatch& batch) const = 0;
  virtual std::uint64_t disk() const { return 0; }
  virtual ReadCost readCost() const { return {}; }
  virtual std::vector<std::string> files() const = 0;
};

/// The facts about such a tree that are known before its points are read.
struct ForeignTreeContent
{
  SourceDescription source; ///< with a grid
  std::uint64_t fileBytes = 0;
  glm::dvec3 low{ 0.0 }; ///< lowest corner of the root's cube
  double side = 0.0; ///< side of the root's cube
  double spacing = 0.0; ///< between points of the root; not positive: a 128th of the side
  std::vector<ForeignNode> nodes; ///< in any order
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
/// Memory   the table is held whole, some 100 bytes a node, and the first node with points.
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
  std::uint64_t disk() const override { return reader_->disk(); }
  ReadCost readCost() const override { return reader_->readCost(); }
  /// Every node is read: its points are as many as the hierarchy says, and lie in its box.
  Result<VerifyReport> verify(const ProgressFunction& progress = {}) const override;

private:
  ForeignTree() = default;
  void describe(const ForeignTreeContent& content);
  Result<void> lookAtFirstPoints();
  Result<NodeColumns> decodeNow(const FetchedNode& fetched) const;
  Error damaged(NodeIndex node, const std::string& what) const;

  std::shared_ptr<const ForeignNodes> reader_;
  std::vector<std::uint64_t> chunks_; ///< by node
  StoreDescription description_;
  std::shared_ptr<const Hierarchy> hierarchy_;
  NodeIndex first_ = noNode; ///< with points
  RawBytes firstBytes_; ///< its chunk in a far tree, which was read to describe the tree
  /// The first node, with the columns of the last request. Colours are chosen from its points
  /// before it is drawn, and reading it again would take as long as the rest of the first picture.
  mutable std::unique_ptr<const NodeColumns> kept_;
  mutable std::mutex mutex_; ///< guards kept_
};

} // namespace pointfront
