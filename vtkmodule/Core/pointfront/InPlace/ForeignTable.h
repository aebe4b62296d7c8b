#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/InPlace/ForeignPages.h"
#include "pointfront/Store/Hierarchy.h"
#include "pointfront/Tiles/WantedParts.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <shared_mutex>
#include <string>
#include <utility>
#include <vector>

namespace pointfront
{

struct ForeignTreeContent;

/// The rows of a foreign octree. Pages of its hierarchy that were not read when it was opened are
/// read when somebody looks into them: by who reads missing rows, several at a time.
/// Numbers   those of ForeignPages.
/// Points below  a node are exact where all pages below it were read with it, else estimated: what
///           a page does not tell of the points that the file claims, evenly for each further page.
/// Damage    a page that cannot be read is a fault; its rows are Lost. A hierarchy with fewer
/// points
///           than the file claims, once all of its pages are read, is one for fault() alone: what
///           there is can be drawn.
/// Threads   all functions are safe from any thread; cutTo() before others.
class ForeignTable final : public Hierarchy
{
public:
  /// Cells above others that the hierarchy does not name become nodes without points. Boxes are
  /// `margin` wider than the cells. Errors  as ForeignTree::make().
  static Result<std::shared_ptr<ForeignTable>> make(
    const ForeignTreeContent& content, const glm::dvec3& margin);
  ~ForeignTable() override;

  /// Cells outside of the box belong to no node.
  void cutTo(const Bounds& box);

  /// All rows were read when it was opened.
  bool whole() const { return whole_; }
  /// Levels of the part that was read first.
  std::uint32_t levels() const { return levels_; }
  /// The rows of that part, in the order of their numbers.
  const std::vector<ForeignRow>& firstRows() const { return *firstRows_; }
  /// A node's row and where its points are; nothing for a number that no node has, or whose page is
  /// lost. May wait for the disk.
  std::optional<ForeignRow> find(NodeIndex index) const;
  /// Reads all pages. Errors  the first fault; Cancelled.
  Result<void> readAll() const;
  /// Numbers of the nodes that were read, ascending.
  std::vector<NodeIndex> nodes() const;

  NodeIndex nodeCount() const override { return nodeCount_; }
  Node node(NodeIndex index) const override;
  const std::vector<NodeIndex>& roots() const override { return roots_; }
  Refinement refinement() const override { return Refinement::Add; }
  Node childOf(NodeIndex parent, const Node& row, std::uint8_t child) const override;
  RowState peek(NodeIndex index, Node& row) const override;
  RowState peekChild(
    NodeIndex parent, const Node& row, std::uint8_t child, Node& found) const override;
  /// The node that has the point of that number, if there is one.
  std::pair<NodeIndex, NodeIndex> nodesAround(std::uint64_t point) const override;
  MissingRows* missingRows() const override { return whole_ ? nullptr : wanted_.get(); }
  std::uint64_t arrivals() const override { return wanted_->arrivals(); }
  using Hierarchy::waitForArrival;
  bool waitForArrival(std::uint64_t seen, std::chrono::steady_clock::time_point end) const override
  {
    return wanted_->wait(seen, end);
  }
  std::optional<Error> fault() const override;
  std::vector<Error> takeFaults() const override { return wanted_->takeFaults(); }

private:
  ForeignTable(const ForeignTreeContent& content, const ForeignCells& cells, ForeignPageRows first);
  std::size_t readPages(const std::vector<std::size_t>& pages) const;
  bool isUnread(std::size_t page) const;
  /// Null: the row is not in the part that was read first. Needs no lock.
  const ForeignRow* firstRow(NodeIndex index) const
  {
    const std::vector<ForeignRow>& rows = *firstRows_;
    return index < rows.size() && !rows[index].page ? &rows[index] : nullptr;
  }

  const std::shared_ptr<const ForeignNodes> reader_;
  const std::string path_;
  const std::uint64_t claimed_; ///< points
  ForeignCells cells_;
  const std::unique_ptr<WantedParts> wanted_;

  mutable std::shared_mutex mutex_; ///< guards `pages_`, but for the first page
  mutable ForeignPages pages_;

  std::vector<ForeignRow>* firstRows_ = nullptr;
  bool whole_ = true;
  std::uint32_t levels_ = 0;
  NodeIndex nodeCount_ = 0;
  std::vector<NodeIndex> roots_;
};

} // namespace pointfront
