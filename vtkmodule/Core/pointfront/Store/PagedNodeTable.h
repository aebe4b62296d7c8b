#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Store/Hierarchy.h"
#include "pointfront/Store/NodePage.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace pointfront
{

/// The source of a paged table's pages: a store's file, or a rule that makes them up.
/// Threads  read() is called from several threads at once.
class NodePageSource
{
public:
  virtual ~NodePageSource() = default;
  virtual NodeIndex nodeCount() const = 0;
  /// Rows of each page but the last: at most those of a NodePage.
  virtual std::uint32_t pageRows() const { return nodePageRows; }
  /// Fills the page's rows, each of them sound by itself (rowFault). May wait for the disk.
  virtual Result<void> read(std::uint32_t page, NodePage& rows) const = 0;
  /// How many pages it reads in the time of one: 1 on a disk.
  virtual std::size_t pagesAtOnce() const { return 1; }
  /// Several pages; `rows` has as many. An error of one leaves the others alone.
  virtual std::vector<Result<void>> readAll(
    const std::vector<std::uint32_t>& pages, std::vector<NodePage>& rows) const;
};

/// A node table of any size of which only the pages that were touched last are in memory.
/// Memory      `cacheBytes` at most, taken page by page as they are touched; then the page of a set
///             that was not used for longest makes room (12-way set associative).
/// peek()      does not wait: a page that is not here is asked for (MissingRows) and read by who
///             reads for the store. At most 1,024 pages wait; who does not get what it asked for
///             asks again.
/// Damage      a page that cannot be read is not tried again; its rows are Lost.
/// Threads     all functions from any thread. The lock of a set is held for the copy of a row or a
///             page only, never while a page is read.
class PagedNodeTable final : public Hierarchy
{
public:
  static constexpr std::size_t defaultCacheBytes = std::size_t(16) << 20;

  PagedNodeTable(std::unique_ptr<const NodePageSource> source, std::vector<NodeIndex> roots,
    Refinement refinement, std::size_t cacheBytes = defaultCacheBytes);
  ~PagedNodeTable() override;
  PagedNodeTable(const PagedNodeTable&) = delete;
  PagedNodeTable& operator=(const PagedNodeTable&) = delete;

  /// Keeps the rows of the roots in memory from now on, for those who must not wait for them at any
  /// time. Before the table is shared; may wait for the disk.
  void keepRoots();

  NodeIndex nodeCount() const override;
  Node node(NodeIndex index) const override;
  const std::vector<NodeIndex>& roots() const override;
  Refinement refinement() const override;
  Node childOf(NodeIndex parent, const Node& row, std::uint8_t child) const override;
  RowState peek(NodeIndex index, Node& row) const override;
  RowState peekChild(
    NodeIndex parent, const Node& row, std::uint8_t child, Node& found) const override;
  MissingRows* missingRows() const override;
  std::uint64_t arrivals() const override;
  using Hierarchy::waitForArrival;
  bool waitForArrival(std::uint64_t seen, std::chrono::steady_clock::time_point end) const override;
  std::optional<Error> fault() const override;
  std::vector<Error> takeFaults() const override;

  /// Pages that were read from the source, by either way.
  std::uint64_t pagesRead() const;
  /// Memory of the pages held.
  std::size_t cachedBytes() const;

private:
  struct Content;
  std::unique_ptr<Content> content_;
};

} // namespace pointfront
