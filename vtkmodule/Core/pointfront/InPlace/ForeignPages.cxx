#include "pointfront/InPlace/ForeignPages.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace pointfront
{
namespace
{
/// Numbers of a hierarchy that is not known as a whole: of nodes, and of points, which pictures
/// carry in 48 bits. The last quarter and half are for pages for which too few were set aside.
constexpr NodeIndex mostNodes = NodeIndex(1) << 31;
constexpr NodeIndex nodesSetAside = mostNodes / 4 * 3;
constexpr std::uint64_t pointNumbers = std::uint64_t(1) << 48;
constexpr std::uint64_t pointsSetAside = pointNumbers / 2;

/// Gives so many numbers: of its own, or else of the further ones. False: there are too few.
template <typename Numbers, typename Count>
bool give(Numbers& own, Numbers& further, Count count)
{
  if (count > own.behind - own.first)
  {
    own = { further.first, further.first };
    own.behind += std::min<Count>(count, further.behind - further.first);
    further.first = own.behind;
  }
  return count <= own.behind - own.first;
}

/// An even part of the numbers that are left: part `number` of so many.
template <typename Numbers, typename Count>
Numbers shareOf(const Numbers& all, Count used, std::size_t number, std::size_t parts)
{
  const Count each = (all.behind - all.first - used) / static_cast<Count>(parts);
  const Count first = all.first + used + each * static_cast<Count>(number);
  return { first, static_cast<Count>(first + each) };
}

NodeIndex nodesBelowRoot(const ForeignPageRows& rows)
{
  return static_cast<NodeIndex>(rows.rows.size() - 1);
}
} // namespace

ForeignPages::ForeignPages(ForeignPageRows first)
{
  const bool whole = first.pages.empty();
  const auto count = static_cast<NodeIndex>(first.rows.size());
  nodeCount_ = whole ? count : mostNodes;
  furtherNodes_ = { nodesSetAside, mostNodes };
  furtherPoints_ = { pointsSetAside, pointNumbers };
  Page& page = pages_.emplace_back();
  page.nodes = { 1, whole ? std::max<NodeIndex>(count, 1) : nodesSetAside };
  page.ids = { 0, whole ? first.points : pointsSetAside };
  if (first.rows.empty())
  {
    page.state = State::Here;
    unread_ = 0;
    return;
  }
  take(0, std::move(first));
}

/// Gives the nodes and points of a page numbers. False: there are none left.
bool ForeignPages::number(Page& page)
{
  if (!give(page.nodes, furtherNodes_, nodesBelowRoot(page.rows)) ||
    !give(page.ids, furtherPoints_, page.rows.points))
  {
    return false;
  }
  for (ForeignRow& row : page.rows.rows) // places within the page become numbers
  {
    Node& node = row.row;
    node.parent = node.parent == noNode ? page.parent : numberOf(page, node.parent);
    node.firstChild = node.childCount > 0 ? numberOf(page, node.firstChild) : noNode;
    node.firstPoint += page.ids.first;
  }
  return true;
}

/// Lists the pages that a page refers to. Each has its share of the numbers that are left.
void ForeignPages::refer(Page& page)
{
  page.firstPage = pages_.size();
  const std::size_t parts = page.rows.pages.size();
  for (std::size_t row = 0; row < page.rows.rows.size(); ++row)
  {
    const ForeignRow& is = page.rows.rows[row];
    if (is.page)
    {
      Page below;
      below.at = page.rows.pages[*is.page];
      below.root = numberOf(page, row);
      below.parent = is.row.parent;
      below.points = is.row.pointsBelow;
      below.nodes = shareOf(page.nodes, nodesBelowRoot(page.rows), *is.page, parts);
      below.ids = shareOf(page.ids, page.rows.points, *is.page, parts);
      pages_.push_back(std::move(below));
    }
  }
}

bool ForeignPages::take(std::size_t place, ForeignPageRows rows)
{
  Page& page = pages_[place]; // stays where it is while others are added
  page.rows = std::move(rows);
  if (!number(page))
  {
    page.rows = {};
    lose(place);
    return false;
  }
  refer(page);
  unread_ += page.rows.pages.size();
  --unread_;
  points_ += page.rows.points;
  page.state = State::Here;
  if (nodesBelowRoot(page.rows) > 0)
  {
    byNode_[page.nodes.first] = place;
  }
  if (page.rows.points > 0)
  {
    byPoint_[page.ids.first] = place;
  }
  return true;
}

template <typename Number>
std::size_t ForeignPages::pageBelow(
  const Page& page, Numbers<Number> Page::*numbers, Number wanted) const
{
  // Shares ascend, and all are of one size.
  const auto begin = pages_.begin() + static_cast<std::ptrdiff_t>(page.firstPage);
  const auto end = begin + static_cast<std::ptrdiff_t>(page.rows.pages.size());
  const auto behind = std::upper_bound(begin, end, wanted,
    [numbers](Number number, const Page& below) { return number < (below.*numbers).first; });
  return behind != begin && ((*std::prev(behind)).*numbers).has(wanted)
    ? static_cast<std::size_t>(std::prev(behind) - pages_.begin())
    : noPage;
}

/// A row of a page that is here; those that have a page of their own are in that.
ForeignPages::Spot ForeignPages::rowOf(const Page& page, std::size_t row) const
{
  const ForeignRow& is = page.rows.rows[row];
  if (!is.page)
  {
    return { &is, noPage, numberOf(page, row) };
  }
  const std::size_t below = page.firstPage + *is.page;
  const Page& own = pages_[below];
  return own.state == State::Here ? Spot{ &own.rows.rows.front(), noPage, own.root }
                                  : Spot{ nullptr, below, own.root };
}

ForeignPages::Spot ForeignPages::find(NodeIndex node) const
{
  if (node == 0 && !pages_.front().rows.rows.empty())
  {
    return rowOf(pages_.front(), 0);
  }
  const auto behind = byNode_.upper_bound(node);
  if (behind != byNode_.begin())
  {
    const Page& page = pages_[std::prev(behind)->second];
    const std::size_t row = node - page.nodes.first + std::size_t(1);
    if (row < page.rows.rows.size())
    {
      return rowOf(page, row);
    }
  }
  std::size_t page = 0;
  while (page != noPage && pages_[page].state == State::Here)
  {
    page = pageBelow(pages_[page], &Page::nodes, node);
  }
  return { nullptr, page };
}

ForeignPages::Spot ForeignPages::findPoint(std::uint64_t point) const
{
  const auto behind = byPoint_.upper_bound(point);
  if (behind != byPoint_.begin())
  {
    const Page& page = pages_[std::prev(behind)->second];
    const std::vector<ForeignRow>& rows = page.rows.rows;
    const auto after = std::upper_bound(rows.begin(), rows.end(), point,
      [](std::uint64_t number, const ForeignRow& row) { return number < row.row.firstPoint; });
    const auto row = static_cast<std::size_t>(after - rows.begin()) - 1;
    const Node& node = rows[row].row;
    if (!rows[row].page && point - node.firstPoint < node.pointCount)
    {
      return rowOf(page, row);
    }
  }
  std::size_t page = 0;
  while (page != noPage && pages_[page].state == State::Here)
  {
    page = pageBelow(pages_[page], &Page::ids, point);
  }
  return { nullptr, page };
}

std::vector<NodeIndex> ForeignPages::nodes() const
{
  std::vector<NodeIndex> all;
  if (!pages_.front().rows.rows.empty())
  {
    all.push_back(0);
  }
  for (const auto& [first, number] : byNode_)
  {
    const Page& page = pages_[number];
    for (std::size_t row = 1; row < page.rows.rows.size(); ++row)
    {
      const Spot spot = rowOf(page, row);
      if (spot.row != nullptr)
      {
        all.push_back(spot.node);
      }
    }
  }
  return all;
}

} // namespace pointfront
