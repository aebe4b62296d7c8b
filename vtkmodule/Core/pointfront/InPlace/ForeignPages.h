#pragma once

#include "pointfront/InPlace/ForeignPageRows.h"
#include "pointfront/Store/Hierarchy.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

namespace pointfront
{

/// The pages of a foreign hierarchy, those that were read and those that others refer to, and the
/// numbers of their nodes and points.
/// Numbers   of nodes: breadth first within a page. Without further pages they have no gaps. Else a
///           page gets numbers of nodes and of points set aside: what its own nodes leave is
///           shared out evenly among the pages that it refers to. So numbers do not depend on the
///           order in which pages are read, and have gaps. A page for which too few were set aside
///           gets numbers behind all others; those hold as long as this object.
/// Memory    some 140 bytes a node of the pages that were read, which stay.
/// Threads   who has it locks. The first page, and the place of each page in memory, do not change.
class ForeignPages
{
public:
  /// Numbers that were set aside, from `first` to before `behind`.
  template <typename Number>
  struct Numbers
  {
    Number first = 0;
    Number behind = 0;
    bool has(Number number) const { return number >= first && number < behind; }
  };
  enum class State : std::uint8_t
  {
    Unread,
    Here,
    Lost
  };
  /// A page, from when another refers to it.
  struct Page
  {
    ForeignNode at; ///< its root's cell, and where it is
    NodeIndex root = 0; ///< number of its root, which lies among its siblings
    NodeIndex parent = noNode;
    std::uint64_t points = 0; ///< estimated, with all below
    Numbers<NodeIndex> nodes; ///< numbers of all nodes but the root, with those of pages below
    Numbers<std::uint64_t> ids; ///< numbers of points, those of the root first
    State state = State::Unread;
    // The rest is known when it was read.
    ForeignPageRows rows; ///< the root's first
    std::size_t firstPage = 0; ///< number of the first page that it refers to; others follow
  };
  static constexpr std::size_t noPage = ~std::size_t(0);
  /// Where a number is: a row that is here, or a page that is not, or neither.
  struct Spot
  {
    const ForeignRow* row = nullptr;
    std::size_t page = noPage;
    NodeIndex node = 0; ///< the row's
  };

  /// The first page. Pages that it refers to are Unread.
  explicit ForeignPages(ForeignPageRows first);

  const Page& operator[](std::size_t page) const { return pages_[page]; }
  std::size_t size() const { return pages_.size(); }
  NodeIndex nodeCount() const { return nodeCount_; } ///< with those that no node has
  /// Takes the rows of a page that was Unread in. False: there are no numbers left, it is Lost.
  bool take(std::size_t page, ForeignPageRows rows);
  std::vector<ForeignRow>& firstRows() { return pages_.front().rows.rows; }
  void lose(std::size_t page) { pages_[page].state = State::Lost; }

  Spot find(NodeIndex node) const;
  Spot findPoint(std::uint64_t point) const;
  std::vector<NodeIndex> nodes() const; ///< those whose rows are here, ascending
  bool complete() const { return unread_ == 0; } ///< all pages are here
  std::uint64_t points() const { return points_; } ///< those of pages that are here

private:
  bool number(Page& page);
  void refer(Page& page);
  template <typename Number>
  std::size_t pageBelow(const Page& page, Numbers<Number> Page::*numbers, Number wanted) const;
  Spot rowOf(const Page& page, std::size_t row) const;
  static NodeIndex numberOf(const Page& page, std::size_t row)
  {
    return row == 0 ? page.root : page.nodes.first + static_cast<NodeIndex>(row - 1);
  }

  std::deque<Page> pages_;
  NodeIndex nodeCount_ = 0;
  std::map<NodeIndex, std::size_t> byNode_; ///< pages that are here, by their first number
  std::map<std::uint64_t, std::size_t> byPoint_;
  Numbers<NodeIndex> furtherNodes_; ///< behind all that was set aside
  Numbers<std::uint64_t> furtherPoints_;
  std::uint64_t points_ = 0;
  std::size_t unread_ = 1;
};

} // namespace pointfront
