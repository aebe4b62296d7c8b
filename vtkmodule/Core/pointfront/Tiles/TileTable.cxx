#include "pointfront/Tiles/TileTable.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace pointfront
{

/// What all tables wait for; one page after another, whichever asked.
class TileTable::Rows final : public MissingRows
{
public:
  explicit Rows(std::vector<MissingRows*> tables)
    : tables_(std::move(tables))
  {
  }
  bool waiting() const override
  {
    return std::any_of(
      tables_.begin(), tables_.end(), [](const MissingRows* rows) { return rows->waiting(); });
  }
  std::size_t readNext() override
  {
    for (MissingRows* const rows : tables_)
    {
      if (const std::size_t bytes = rows->waiting() ? rows->readNext() : 0; bytes > 0)
      {
        return bytes;
      }
    }
    return 0;
  }
  void attach(const void* reader, std::function<void()> wanted) override
  {
    for (MissingRows* const rows : tables_)
    {
      rows->attach(reader, wanted);
    }
  }
  void detach(const void* reader) override
  {
    for (MissingRows* const rows : tables_)
    {
      rows->detach(reader);
    }
  }

private:
  std::vector<MissingRows*> tables_;
};

TileTable::TileTable(std::vector<Tile> tiles)
  : tiles_(std::move(tiles))
{
  assert(!tiles_.empty());
  refinement_ = tiles_.front().table->refinement();
  NodeIndex nodes = 0;
  std::uint64_t points = 0;
  std::vector<MissingRows*> waiting;
  for (const Tile& tile : tiles_)
  {
    assert(tile.table->refinement() == refinement_);
    firstNodes_.push_back(nodes);
    firstPoints_.push_back(points);
    for (const NodeIndex root : tile.table->roots())
    {
      roots_.push_back(nodes + root);
    }
    nodes += tile.table->nodeCount();
    points += tile.points;
    if (MissingRows* const rows = tile.table->missingRows())
    {
      waiting.push_back(rows);
    }
  }
  firstNodes_.push_back(nodes);
  if (!waiting.empty())
  {
    rows_ = std::make_unique<Rows>(std::move(waiting));
  }
}

TileTable::~TileTable() = default;

TileTable::Place TileTable::placeOf(NodeIndex node) const
{
  const auto behind = std::upper_bound(firstNodes_.begin(), firstNodes_.end(), node);
  const auto tile = static_cast<std::size_t>(behind - firstNodes_.begin()) - 1;
  assert(tile < tiles_.size());
  return { tile, node - firstNodes_[tile] };
}

Node TileTable::shifted(std::size_t tile, Node row) const
{
  const NodeIndex first = firstNodes_[tile];
  row.parent = row.parent == noNode ? noNode : row.parent + first;
  row.firstChild = row.firstChild == noNode ? noNode : row.firstChild + first;
  row.firstPoint += firstPoints_[tile];
  const std::vector<std::uint16_t>& layers = tiles_[tile].layers;
  row.layer = row.layer < layers.size() ? layers[row.layer] : std::uint16_t(0);
  return row;
}

/// Links only: what a table needs to find a row's child.
Node TileTable::unshifted(std::size_t tile, Node row) const
{
  const NodeIndex first = firstNodes_[tile];
  row.parent = row.parent == noNode ? noNode : row.parent - first;
  row.firstChild = row.firstChild == noNode ? noNode : row.firstChild - first;
  row.firstPoint -= firstPoints_[tile];
  return row;
}

Node TileTable::node(NodeIndex index) const
{
  const Place at = placeOf(index);
  return shifted(at.tile, tiles_[at.tile].table->node(at.node));
}

Node TileTable::childOf(NodeIndex parent, const Node& row, std::uint8_t child) const
{
  const Place at = placeOf(parent);
  return shifted(at.tile, tiles_[at.tile].table->childOf(at.node, unshifted(at.tile, row), child));
}

RowState TileTable::peek(NodeIndex index, Node& row) const
{
  const Place at = placeOf(index);
  const RowState state = tiles_[at.tile].table->peek(at.node, row);
  if (state == RowState::Here)
  {
    row = shifted(at.tile, row);
  }
  return state;
}

RowState TileTable::peekChild(
  NodeIndex parent, const Node& row, std::uint8_t child, Node& found) const
{
  const Place at = placeOf(parent);
  const RowState state =
    tiles_[at.tile].table->peekChild(at.node, unshifted(at.tile, row), child, found);
  if (state == RowState::Here)
  {
    found = shifted(at.tile, found);
  }
  return state;
}

MissingRows* TileTable::missingRows() const
{
  return rows_.get();
}

std::uint64_t TileTable::arrivals() const
{
  std::uint64_t sum = 0;
  for (const Tile& tile : tiles_)
  {
    sum += tile.table->arrivals();
  }
  return sum;
}

bool TileTable::waitForArrival(std::uint64_t seen, std::chrono::steady_clock::time_point end) const
{
  std::vector<std::uint64_t> each;
  std::uint64_t sum = 0;
  for (const Tile& tile : tiles_)
  {
    each.push_back(tile.table->arrivals());
    sum += each.back();
  }
  // None of them shrinks: a sum that is what was seen means that each is what was seen.
  bool coming = false;
  for (std::size_t t = 0; t < tiles_.size() && sum == seen; ++t)
  {
    coming = tiles_[t].table->waitForArrival(each[t], end) || coming;
    sum = arrivals();
  }
  return coming || sum != seen;
}

std::optional<Error> TileTable::fault() const
{
  for (const Tile& tile : tiles_)
  {
    if (std::optional<Error> fault = tile.table->fault())
    {
      return fault;
    }
  }
  return std::nullopt;
}

std::vector<Error> TileTable::takeFaults() const
{
  std::vector<Error> all;
  for (const Tile& tile : tiles_)
  {
    const std::vector<Error> faults = tile.table->takeFaults();
    all.insert(all.end(), faults.begin(), faults.end());
  }
  return all;
}

} // namespace pointfront
