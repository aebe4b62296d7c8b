#include "pointfront/InPlace/ForeignTable.h"

#include "pointfront/Disk/StopOfReads.h"
#include "pointfront/InPlace/ForeignTree.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

namespace pointfront
{
namespace
{
constexpr double usualTicks = 128.0; ///< points along the root's side
/// Pages that are read together from a far source.
constexpr std::size_t pagesAtOnce = 32;
} // namespace

ForeignTable::ForeignTable(
  const ForeignTreeContent& content, const ForeignCells& cells, ForeignPageRows first)
  : reader_(content.reader)
  , path_(content.source.path)
  , claimed_(content.source.headerPointCount.value_or(0))
  , cells_(cells)
  , wanted_(std::make_unique<WantedParts>(WantedParts::Reading{ [this](std::size_t)
      { return reader_->readCost().far() ? pagesAtOnce : 1; },
      [this](const std::vector<std::size_t>& pages, const WantedParts::Ended& ended)
      {
        const StopOfReads stop([this] { return wanted_->abandoned(); });
        const std::size_t bytes = readPages(pages);
        std::for_each(pages.begin(), pages.end(), ended);
        return bytes;
      } }))
  , pages_(std::move(first))
{
  firstRows_ = &pages_.firstRows();
  whole_ = pages_.complete();
  levels_ = pages_[0].rows.levels;
  nodeCount_ = pages_.nodeCount();
  if (!firstRows_->empty())
  {
    roots_.push_back(0);
  }
}

ForeignTable::~ForeignTable() = default;

Result<std::shared_ptr<ForeignTable>> ForeignTable::make(
  const ForeignTreeContent& content, const glm::dvec3& margin)
{
  const std::string& path = content.source.path;
  const glm::dvec3 reach = glm::abs(content.low) + glm::dvec3(content.side);
  if (!(content.side > 0.0) || !(std::max({ reach.x, reach.y, reach.z }) <= farthestCoordinate))
  {
    return makeError(Error::Kind::BadFormat, path + ": the cube of its octree is none");
  }
  const bool spaced = content.spacing > 0.0 && std::isfinite(content.spacing);
  const double spacing = spaced ? content.spacing : content.side / usualTicks;
  const ForeignCells cells{ content.low, content.side, spacing, margin, std::nullopt };
  Result<ForeignPageRows> rows = ForeignPageRows();
  if (!content.first.nodes.empty() || !content.first.pages.empty())
  {
    rows = ForeignPageRows::make(
      content.first, {}, content.source.headerPointCount.value_or(0), cells, path);
  }
  if (!rows)
  {
    return rows.error();
  }
  return std::shared_ptr<ForeignTable>(new ForeignTable(content, cells, std::move(*rows)));
}

void ForeignTable::cutTo(const Bounds& box)
{
  cells_.cut = box;
  for (ForeignRow& row : *firstRows_)
  {
    cells_.cutRow(row.row);
  }
}

/// Returns the bytes that the rows take, for want of those that were read.
std::size_t ForeignTable::readPages(const std::vector<std::size_t>& pages) const
{
  using State = ForeignPages::State;
  std::vector<std::size_t> unread;
  std::vector<ForeignNode> places;
  std::vector<std::uint64_t> claimed;
  {
    const std::shared_lock<std::shared_mutex> lock(mutex_);
    for (const std::size_t page : pages)
    {
      if (pages_[page].state == State::Unread)
      {
        unread.push_back(page);
        places.push_back(pages_[page].at);
        claimed.push_back(pages_[page].points);
      }
    }
  }
  std::vector<Result<ForeignPage>> read = reader_->readPages(places);
  std::size_t rows = 0;
  for (std::size_t i = 0; i < unread.size(); ++i)
  {
    Result<ForeignPageRows> made = read[i]
      ? ForeignPageRows::make(*read[i], places[i], claimed[i], cells_, path_)
      : Result<ForeignPageRows>(read[i].error());
    const std::unique_lock<std::shared_mutex> lock(mutex_);
    if (pages_[unread[i]].state != State::Unread)
    {
      continue; // another thread was faster
    }
    if (made)
    {
      rows += made->rows.size();
      if (!pages_.take(unread[i], std::move(*made)))
      {
        wanted_->noteFault(unread[i],
          makeError(Error::Kind::NoMemory,
            path_ +
              ": its octree has more nodes or points than can be numbered; build a store from it"));
      }
    }
    else if (made.error().kind != Error::Kind::Cancelled)
    {
      pages_.lose(unread[i]);
      wanted_->noteFault(unread[i], made.error());
    }
  }
  return rows * sizeof(ForeignRow);
}

std::optional<Error> ForeignTable::fault() const
{
  if (std::optional<Error> first = wanted_->fault())
  {
    return first;
  }
  const std::shared_lock<std::shared_mutex> lock(mutex_);
  if (whole_ || !pages_.complete() || pages_.points() >= claimed_)
  {
    return std::nullopt;
  }
  return makeError(Error::Kind::Corrupt,
    "'" + path_ + "': its octree lacks " + std::to_string(claimed_ - pages_.points()) + " of the " +
      std::to_string(claimed_) +
      " points; build a store from the file, which does not need its tree");
}

bool ForeignTable::isUnread(std::size_t page) const
{
  const std::shared_lock<std::shared_mutex> lock(mutex_);
  return pages_[page].state == ForeignPages::State::Unread;
}

Result<void> ForeignTable::readAll() const
{
  for (std::size_t first = 0;;)
  {
    std::vector<std::size_t> unread;
    {
      const std::shared_lock<std::shared_mutex> lock(mutex_);
      for (; first < pages_.size() && unread.size() < pagesAtOnce; ++first)
      {
        if (pages_[first].state == ForeignPages::State::Unread)
        {
          unread.push_back(first);
        }
      }
    }
    if (unread.empty())
    {
      const std::optional<Error> none = fault();
      return none ? Result<void>(*none) : Result<void>();
    }
    readPages(unread);
    if (std::any_of(unread.begin(), unread.end(), [this](std::size_t p) { return isUnread(p); }))
    {
      return makeError(
        Error::Kind::Cancelled, "reading the hierarchy of '" + path_ + "' was cancelled");
    }
  }
}

std::vector<NodeIndex> ForeignTable::nodes() const
{
  const std::shared_lock<std::shared_mutex> lock(mutex_);
  return pages_.nodes();
}

std::optional<ForeignRow> ForeignTable::find(NodeIndex index) const
{
  if (const ForeignRow* first = firstRow(index))
  {
    return *first;
  }
  for (std::size_t page = ForeignPages::noPage;;)
  {
    {
      const std::shared_lock<std::shared_mutex> lock(mutex_);
      const ForeignPages::Spot spot = pages_.find(index);
      if (spot.row != nullptr)
      {
        return *spot.row;
      }
      // The same again: its reading was stopped.
      if (spot.page == page || spot.page == ForeignPages::noPage ||
        pages_[spot.page].state == ForeignPages::State::Lost)
      {
        return std::nullopt;
      }
      page = spot.page;
    }
    readPages({ page });
  }
}

std::pair<NodeIndex, NodeIndex> ForeignTable::nodesAround(std::uint64_t point) const
{
  for (std::size_t page = ForeignPages::noPage;;)
  {
    {
      const std::shared_lock<std::shared_mutex> lock(mutex_);
      const ForeignPages::Spot spot = pages_.findPoint(point);
      if (spot.row != nullptr || spot.page == page || spot.page == ForeignPages::noPage ||
        pages_[spot.page].state == ForeignPages::State::Lost)
      {
        return { spot.node, spot.node + 1 };
      }
      page = spot.page;
    }
    readPages({ page });
  }
}

Node ForeignTable::node(NodeIndex index) const
{
  const std::optional<ForeignRow> found = find(index);
  return found ? found->row : Node();
}

Node ForeignTable::childOf(NodeIndex parent, const Node& row, std::uint8_t child) const
{
  const Node found = node(row.firstChild + child);
  return found.parent == parent ? found : Node();
}

RowState ForeignTable::peek(NodeIndex index, Node& row) const
{
  if (const ForeignRow* first = firstRow(index))
  {
    row = first->row;
    return RowState::Here;
  }
  std::size_t page = ForeignPages::noPage;
  {
    const std::shared_lock<std::shared_mutex> lock(mutex_);
    const ForeignPages::Spot spot = pages_.find(index);
    if (spot.row != nullptr)
    {
      row = spot.row->row;
      return RowState::Here;
    }
    page = spot.page;
    if (page == ForeignPages::noPage || pages_[page].state == ForeignPages::State::Lost)
    {
      row = Node();
      return RowState::Lost;
    }
  }
  wanted_->want(page);
  return RowState::Coming;
}

RowState ForeignTable::peekChild(
  NodeIndex parent, const Node& row, std::uint8_t child, Node& found) const
{
  const RowState state = peek(row.firstChild + child, found);
  if (state == RowState::Here && found.parent != parent)
  {
    found = Node();
    return RowState::Lost;
  }
  return state;
}

} // namespace pointfront
