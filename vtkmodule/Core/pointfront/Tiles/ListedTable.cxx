#include "pointfront/Tiles/ListedTable.h"

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Disk/StopOfReads.h"
#include "pointfront/Threads/WaitingWork.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <utility>

namespace pointfront
{

namespace
{
constexpr std::size_t bytesOfAnOpening = 4096;

/// Opens a tile, or reads rows of one that is open.
std::size_t readTile(const ListedTable& table, const ListedTiles& tiles, std::size_t tile)
{
  if (const ListedTiles::Tile* open = tiles.opened(tile))
  {
    MissingRows* const rows = open->cloud->hierarchy()->missingRows();
    return rows != nullptr ? rows->readNext() : 0;
  }
  return table.openTile(tile) ? bytesOfAnOpening : 0;
}
} // namespace

ListedTable::ListedTable(std::shared_ptr<const ListedTiles> tiles)
  : tiles_(std::move(tiles))
  , wanted_(std::make_unique<WantedParts>(WantedParts::Reading{ [this](std::size_t tile)
      { return isAddress(tiles_->listed(tile).address) ? ListedTiles::openingsAtOnce : 1; },
      [this](const std::vector<std::size_t>& wanted, const WantedParts::Ended& ended)
      { return readTiles(wanted, ended); } }))
{
}

std::size_t ListedTable::readTiles(
  const std::vector<std::size_t>& tiles, const WantedParts::Ended& ended) const
{
  std::atomic<std::size_t> bytes{ 0 };
  runWaiting(tiles.size(), tiles.size(),
    [&](std::size_t i)
    {
      const StopOfReads stop([this] { return wanted_->abandoned(); });
      bytes += readTile(*this, *tiles_, tiles[i]);
      ended(tiles[i]);
    });
  return bytes;
}

ListedTable::~ListedTable() = default;

Result<std::shared_ptr<const ListedTable>> ListedTable::make(
  std::shared_ptr<const ListedTiles> tiles)
{
  std::shared_ptr<ListedTable> table(new ListedTable(std::move(tiles)));
  std::uint64_t nodes = 0;
  std::uint64_t points = 0;
  for (std::size_t t = 0; t < table->tiles_->size(); ++t)
  {
    const ListedTiles::Tile* const open = table->tiles_->opened(t);
    table->closed_.push_back(open == nullptr);
    table->firstNodes_.push_back(static_cast<NodeIndex>(nodes));
    table->firstPoints_.push_back(points);
    if (open == nullptr || !open->cloud->hierarchy()->roots().empty())
    {
      table->roots_.push_back(static_cast<NodeIndex>(nodes));
    }
    nodes += open != nullptr ? open->cloud->hierarchy()->nodeCount()
                             : std::uint64_t(1) + table->tiles_->mostNodes(t);
    points += table->tiles_->listed(t).points;
    if (nodes >= noNode)
    {
      return makeError(Error::Kind::NoMemory,
        table->tiles_->whole().path +
          ": its tiles may have more nodes together than 32 bits count; open fewer of them");
    }
  }
  table->firstNodes_.push_back(static_cast<NodeIndex>(nodes));
  table->firstPoints_.push_back(points);
  return std::shared_ptr<const ListedTable>(std::move(table));
}

ListedTable::TileNode ListedTable::tileNodeOf(NodeIndex node) const
{
  const auto behind = std::upper_bound(firstNodes_.begin(), firstNodes_.end(), node);
  const auto tile = static_cast<std::size_t>(behind - firstNodes_.begin()) - 1;
  assert(tile < tiles_->size());
  const NodeIndex local = node - firstNodes_[tile];
  return { tile, closed_[tile] ? (local == 0 ? noNode : local - 1) : local };
}

/// It is refined as soon as the tile could be told from nothing.
Node ListedTable::boxOf(std::size_t tile) const
{
  const ListedTile& listed = tiles_->listed(tile);
  // And floats round.
  const glm::dvec3 half = 1.000001 * (0.5 * listed.bounds.size() + listed.rounding());
  Node row;
  row.centre = listed.bounds.centre();
  row.halfSize = glm::vec3(half);
  row.radius = static_cast<float>(glm::length(half));
  row.spacing = 2.0f * row.radius;
  row.pointsBelow = listed.points;
  row.firstPoint = firstPoints_[tile];
  if (listed.points > 0)
  {
    row.firstChild = firstNodes_[tile] + 1;
    row.childCount = 1;
  }
  return row;
}

/// For a number that no node has; numbers of points ascend nevertheless.
Node ListedTable::hollow(std::size_t tile) const
{
  Node row;
  row.firstPoint = firstPoints_[tile + 1];
  return row;
}

Node ListedTable::shifted(const TileNode& at, Node row) const
{
  const NodeIndex above = closed_[at.tile] ? firstNodes_[at.tile] : noNode;
  row.parent = row.parent == noNode ? above : indexOf(at.tile, row.parent);
  row.firstChild = row.firstChild == noNode ? noNode : indexOf(at.tile, row.firstChild);
  row.firstPoint += firstPoints_[at.tile];
  row.level = static_cast<std::uint8_t>(row.level + (closed_[at.tile] ? 1 : 0));
  const ListedTiles::Tile* const open = tiles_->opened(at.tile);
  const std::vector<std::uint16_t>& layers = open->part.layers;
  row.layer = row.layer < layers.size() ? layers[row.layer] : std::uint16_t(0);
  return row;
}

/// Links and level only: what a table needs to find a row's child.
Node ListedTable::unshifted(const TileNode& at, Node row) const
{
  row.level = static_cast<std::uint8_t>(row.level - (closed_[at.tile] ? 1 : 0));
  row.parent = row.parent == noNode ? noNode : tileNodeOf(row.parent).node;
  row.firstChild = row.firstChild == noNode ? noNode : tileNodeOf(row.firstChild).node;
  row.firstPoint -= firstPoints_[at.tile];
  return row;
}

Result<const ListedTiles::Tile*> ListedTable::openTile(std::size_t tile) const
{
  Result<const ListedTiles::Tile*> open = tiles_->open(tile);
  if (!open && tiles_->failed(tile))
  {
    wanted_->noteFault(tile, open.error());
  }
  return open;
}

Node ListedTable::node(NodeIndex index) const
{
  const TileNode at = tileNodeOf(index);
  if (at.node == noNode)
  {
    return boxOf(at.tile);
  }
  const Result<const ListedTiles::Tile*> open = openTile(at.tile);
  return open && at.node < (*open)->cloud->hierarchy()->nodeCount()
    ? shifted(at, (*open)->cloud->hierarchy()->node(at.node))
    : hollow(at.tile);
}

Node ListedTable::childOf(NodeIndex parent, const Node& row, std::uint8_t child) const
{
  const TileNode at = tileNodeOf(parent);
  if (at.node == noNode)
  {
    return node(row.firstChild);
  }
  const Result<const ListedTiles::Tile*> open = openTile(at.tile);
  return open ? shifted({ at.tile, tileNodeOf(row.firstChild + child).node },
                  (*open)->cloud->hierarchy()->childOf(at.node, unshifted(at, row), child))
              : hollow(at.tile);
}

RowState ListedTable::peek(NodeIndex index, Node& row) const
{
  const TileNode at = tileNodeOf(index);
  if (at.node == noNode)
  {
    row = boxOf(at.tile);
    return RowState::Here;
  }
  const ListedTiles::Tile* const open = tiles_->opened(at.tile);
  RowState state = RowState::Coming;
  if (open != nullptr && at.node < open->cloud->hierarchy()->nodeCount())
  {
    state = open->cloud->hierarchy()->peek(at.node, row);
  }
  else if (open != nullptr || tiles_->failed(at.tile))
  {
    state = RowState::Lost;
    static_cast<void>(openTile(at.tile)); // its fault is told
  }
  if (state == RowState::Here)
  {
    row = shifted(at, row);
  }
  else if (state == RowState::Coming)
  {
    wanted_->want(at.tile);
  }
  else
  {
    row = hollow(at.tile);
  }
  return state;
}

RowState ListedTable::peekChild(
  NodeIndex parent, const Node& row, std::uint8_t child, Node& found) const
{
  const TileNode at = tileNodeOf(parent);
  const ListedTiles::Tile* const open = tiles_->opened(at.tile);
  if (at.node == noNode || open == nullptr)
  {
    return peek(row.firstChild + child, found);
  }
  const RowState state =
    open->cloud->hierarchy()->peekChild(at.node, unshifted(at, row), child, found);
  if (state == RowState::Here)
  {
    found = shifted({ at.tile, tileNodeOf(row.firstChild + child).node }, found);
  }
  else if (state == RowState::Coming)
  {
    wanted_->want(at.tile);
  }
  return state;
}

std::pair<NodeIndex, NodeIndex> ListedTable::nodesAround(std::uint64_t point) const
{
  const auto behind = std::upper_bound(firstPoints_.begin(), firstPoints_.end() - 1, point);
  const auto tile = static_cast<std::size_t>(behind - firstPoints_.begin()) - 1;
  return { firstNodes_[tile], firstNodes_[tile + 1] };
}

MissingRows* ListedTable::missingRows() const
{
  return wanted_.get();
}

std::uint64_t ListedTable::arrivals() const
{
  return wanted_->arrivals();
}

bool ListedTable::waitForArrival(
  std::uint64_t seen, std::chrono::steady_clock::time_point end) const
{
  return wanted_->wait(seen, end);
}

std::optional<Error> ListedTable::fault() const
{
  if (std::optional<Error> first = wanted_->fault())
  {
    return first;
  }
  for (std::size_t t = 0; t < tiles_->size(); ++t)
  {
    const ListedTiles::Tile* const open = tiles_->opened(t);
    if (std::optional<Error> own =
          open != nullptr ? open->cloud->hierarchy()->fault() : std::nullopt)
    {
      return own;
    }
  }
  return std::nullopt;
}

std::vector<Error> ListedTable::takeFaults() const
{
  std::vector<Error> all = wanted_->takeFaults();
  for (std::size_t t = 0; t < tiles_->size(); ++t)
  {
    if (const ListedTiles::Tile* const open = tiles_->opened(t))
    {
      const std::vector<Error> own = open->cloud->hierarchy()->takeFaults();
      all.insert(all.end(), own.begin(), own.end());
    }
  }
  return all;
}

} // namespace pointfront
