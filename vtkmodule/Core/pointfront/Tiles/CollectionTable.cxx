#include "pointfront/Tiles/CollectionTable.h"

#include "pointfront/Tiles/CollectionRows.h"

#include <algorithm>
#include <cassert>
#include <map>

namespace pointfront
{

CollectionTable::CollectionTable(std::shared_ptr<const CollectionTiles> tiles)
  : tiles_(std::move(tiles))
  , missing_(std::make_unique<CollectionRows>(tiles_))
{
}

CollectionTable::~CollectionTable() = default;

Result<std::shared_ptr<const CollectionTable>> CollectionTable::make(const std::string& path,
  const Hierarchy& heads, std::shared_ptr<const CollectionTiles> tiles,
  const std::optional<std::string>& epoch)
{
  std::shared_ptr<CollectionTable> table(new CollectionTable(std::move(tiles)));
  std::string fault = table->takeHeads(heads);
  fault = fault.empty() ? table->nameTrees() : fault;
  fault = fault.empty() ? table->joinRoots() : fault;
  if (!fault.empty())
  {
    return makeError(Error::Kind::Corrupt,
      "'" + path + "' is damaged: " + fault + "; copy the file again or create it again");
  }
  if (Result<void> numbered = table->number(path); !numbered)
  {
    return numbered.error();
  }
  if (const Result<void> chosen = epoch ? table->chooseRoots(path, *epoch) : Result<void>();
      !chosen)
  {
    return chosen.error();
  }
  return std::shared_ptr<const CollectionTable>(std::move(table));
}

/// Reads the rows of the tree of heads and checks that they are one tree for each root.
std::string CollectionTable::takeHeads(const Hierarchy& heads)
{
  const std::vector<HeadNode>& known = tiles_->record().heads;
  if (heads.nodeCount() != known.size() || known.empty())
  {
    return "its record has " + std::to_string(known.size()) + " heads, the table " +
      std::to_string(heads.nodeCount());
  }
  const NodeIndex count = heads.nodeCount();
  rows_.reserve(count);
  for (NodeIndex i = 0; i < count; ++i)
  {
    rows_.push_back(heads.node(i));
  }
  if (const std::optional<Error> fault = heads.fault())
  {
    return fault->what;
  }
  roots_ = heads.roots();
  std::size_t linked = roots_.size();
  for (const NodeIndex root : roots_)
  {
    if (root >= count || rows_[root].parent != noNode)
    {
      return "a root has a parent";
    }
  }
  for (NodeIndex i = 0; i < count; ++i)
  {
    const Node& row = rows_[i];
    if (known[i].root ? !row.leaf() || row.pointCount > 0 : row.leaf())
    {
      return "head " + std::to_string(i) + " is both a group and a tile's root";
    }
    for (std::uint32_t c = 0; c < row.childCount; ++c, ++linked)
    {
      const NodeIndex child = row.firstChild + c; // behind it and inside: rowFault()
      if (child >= count || child <= i || rows_[child].parent != i ||
        rows_[child].level != row.level + 1 || rows_[child].layer != row.layer)
      {
        return "head " + std::to_string(i) + " and its children are not linked";
      }
    }
  }
  return linked == count ? "" : "heads are not one tree for each layer";
}

/// Finds the layer of the whole and the epoch of each tree, by the tiles below it.
std::string CollectionTable::nameTrees()
{
  const CollectionRecord& record = tiles_->record();
  std::map<std::uint16_t, HeadTreeKey> trees; // by layer of the heads' store
  for (std::size_t i = 0; i < rows_.size(); ++i)
  {
    if (const auto& root = record.heads[i].root)
    {
      HeadTreeKey key = record.treeOf(record.tiles[root->first], root->second);
      const HeadTreeKey& known = trees.try_emplace(rows_[i].layer, key).first->second;
      const bool mixes = known.epoch != key.epoch;
      if (known.layer != key.layer || key.layer >= record.whole.layers.size() ||
        (mixes && record.version > 1))
      {
        return "a tree of heads has tiles of several layers or epochs";
      }
      mixesEpochs_ = mixesEpochs_ || mixes;
    }
  }
  for (const NodeIndex root : roots_)
  {
    const auto tree = trees.find(rows_[root].layer);
    if (tree == trees.end())
    {
      return "a tree of heads has no tile";
    }
    epochs_.push_back(tree->second.epoch);
  }
  for (Node& row : rows_)
  {
    row.layer = trees.at(row.layer).layer; // that of its root
  }
  return {};
}

Result<void> CollectionTable::chooseRoots(const std::string& path, const std::string& epoch)
{
  std::vector<NodeIndex> chosen;
  for (std::size_t r = 0; r < roots_.size(); ++r)
  {
    if (epochs_[r] == epoch)
    {
      chosen.push_back(roots_[r]);
    }
  }
  if (mixesEpochs_)
  {
    return makeError(Error::Kind::Unsupported,
      path +
        ": an older version wrote it, with several epochs in one tree; 'pointfront collection "
        "compact' makes a tree of each");
  }
  if (chosen.empty())
  {
    std::string known;
    for (const std::string& other : tiles_->record().epochs())
    {
      known += (known.empty() ? "" : ", ") + (other.empty() ? "one without a name" : other);
    }
    return makeError(
      Error::Kind::NotFound, path + ": has no epoch '" + epoch + "'; it has: " + known);
  }
  roots_ = std::move(chosen);
  return {};
}

/// Makes the leaves of the tree of heads the roots of the tiles.
std::string CollectionTable::joinRoots()
{
  const CollectionRecord& record = tiles_->record();
  for (const CollectedTile& tile : record.tiles)
  {
    leaves_.emplace_back(tile.roots.size(), noNode);
  }
  for (std::size_t i = rows_.size(); i-- > 0;)
  {
    Node& row = rows_[i];
    if (!record.heads[i].root)
    {
      std::uint64_t below = row.pointCount;
      for (std::uint32_t c = 0; c < row.childCount; ++c)
      {
        below += rows_[row.firstChild + c].pointsBelow;
      }
      row.pointsBelow = below;
      continue;
    }
    const auto [tile, number] = *record.heads[i].root;
    const TileRoot& root = record.tiles[tile].roots[number];
    leaves_[tile][number] = static_cast<NodeIndex>(i);
    const Node links = row;
    row = root.row;
    row.parent = links.parent;
    row.level = links.level;
    row.layer = links.layer;
    row.pointCount -= root.head;
    row.pointsBelow -= root.head;
  }
  return {};
}

Result<void> CollectionTable::number(const std::string& path)
{
  const CollectionRecord& record = tiles_->record();
  std::uint64_t nodes = rows_.size();
  std::uint64_t points = 0;
  for (Node& row : rows_)
  {
    row.firstPoint = points;
    points += row.pointCount;
  }
  for (const CollectedTile& tile : record.tiles)
  {
    firstNodes_.push_back(static_cast<NodeIndex>(nodes));
    firstPoints_.push_back(points);
    nodes += tile.nodes - tile.roots.size();
    points += tile.ownPoints;
    for (const TileRoot& root : tile.roots)
    {
      points -= root.row.pointCount;
    }
    if (nodes >= noNode)
    {
      return makeError(Error::Kind::NoMemory,
        path + ": its tiles have more nodes together than 32 bits count; make it of fewer tiles");
    }
  }
  firstNodes_.push_back(static_cast<NodeIndex>(nodes));
  firstPoints_.push_back(points);
  for (std::size_t t = 0; t < record.tiles.size(); ++t)
  {
    for (std::size_t r = 0; r < leaves_[t].size(); ++r)
    {
      Node& row = rows_[leaves_[t][r]];
      const NodeIndex own = record.tiles[t].roots[r].row.firstChild;
      row.firstChild = own == noNode ? noNode : indexOf(t, own);
    }
  }
  return {};
}

std::size_t CollectionTable::tileOf(NodeIndex node) const
{
  const auto behind = std::upper_bound(firstNodes_.begin(), firstNodes_.end(), node);
  return static_cast<std::size_t>(behind - firstNodes_.begin()) - 1;
}

std::optional<CollectionTable::TileNode> CollectionTable::tileNodeOf(NodeIndex node) const
{
  if (node < rows_.size())
  {
    const auto& root = tiles_->record().heads[node].root;
    if (!root)
    {
      return std::nullopt;
    }
    const TileRoot& is = known(root->first).roots[root->second];
    return TileNode{ root->first, is.node, is.head };
  }
  const std::size_t tile = tileOf(node);
  NodeIndex own = node - firstNodes_[tile];
  for (const TileRoot& root : known(tile).roots)
  {
    own += root.node <= own ? 1 : 0;
  }
  return TileNode{ tile, own, 0 };
}

NodeIndex CollectionTable::indexOf(std::size_t tile, NodeIndex own) const
{
  const std::vector<TileRoot>& roots = known(tile).roots;
  NodeIndex before = 0;
  for (std::size_t r = 0; r < roots.size() && roots[r].node <= own; ++r)
  {
    if (roots[r].node == own)
    {
      return leaves_[tile][r];
    }
    ++before;
  }
  return firstNodes_[tile] + own - before;
}

const Node& CollectionTable::leafOfLayer(std::size_t tile, std::uint16_t layer) const
{
  const std::vector<TileRoot>& roots = known(tile).roots;
  for (std::size_t r = 0; r < roots.size(); ++r)
  {
    if (roots[r].row.layer == layer)
    {
      return rows_[leaves_[tile][r]];
    }
  }
  return rows_[leaves_[tile].front()];
}

Node CollectionTable::shifted(const TileNode& at, Node row) const
{
  const NodeIndex index = indexOf(at.tile, at.node);
  if (index < rows_.size())
  {
    return rows_[index];
  }
  const Node& root = leafOfLayer(at.tile, row.layer);
  std::uint64_t before = 0;
  for (const TileRoot& other : known(at.tile).roots)
  {
    before += other.node < at.node ? other.row.pointCount : 0;
  }
  row.parent = row.parent == noNode ? noNode : indexOf(at.tile, row.parent);
  row.firstChild = row.firstChild == noNode ? noNode : indexOf(at.tile, row.firstChild);
  row.firstPoint = firstPoints_[at.tile] + row.firstPoint - before;
  row.level = static_cast<std::uint8_t>(row.level + root.level);
  row.layer = root.layer;
  return row;
}

Result<const CollectionTiles::Tile*> CollectionTable::openTile(std::size_t tile) const
{
  return missing_->open(tile);
}

Node CollectionTable::node(NodeIndex index) const
{
  if (index < rows_.size())
  {
    return rows_[index];
  }
  const TileNode at = *tileNodeOf(index);
  const Result<const CollectionTiles::Tile*> tile = openTile(at.tile);
  return tile ? shifted(at, (*tile)->cloud->hierarchy()->node(at.node)) : Node();
}

/// The parent's row as its tile's table needs it to find a child, whose row is `child`. A caller's
/// row of a parent may have no more than its first child and its level.
Node CollectionTable::parentOf(NodeIndex firstChild, const Node& child) const
{
  Node row;
  row.firstChild = tileNodeOf(firstChild)->node;
  row.level = static_cast<std::uint8_t>(child.level > 0 ? child.level - 1 : 0);
  return row;
}

Node CollectionTable::childOf(NodeIndex parent, const Node& row, std::uint8_t child) const
{
  const std::optional<TileNode> at = tileNodeOf(parent);
  if (!at)
  {
    return rows_[row.firstChild + child];
  }
  const Result<const CollectionTiles::Tile*> tile = openTile(at->tile);
  if (!tile)
  {
    return Node();
  }
  const Hierarchy& table = *(*tile)->cloud->hierarchy();
  const Node own = parentOf(row.firstChild, table.node(tileNodeOf(row.firstChild + child)->node));
  const Node found = table.childOf(at->node, own, child);
  return found.parent == at->node ? shifted({ at->tile, own.firstChild + child, 0 }, found)
                                  : Node();
}

RowState CollectionTable::peek(NodeIndex index, Node& row) const
{
  if (index < rows_.size())
  {
    row = rows_[index];
    return RowState::Here;
  }
  const TileNode at = *tileNodeOf(index);
  const CollectionTiles::Tile* const tile = tiles_->opened(at.tile);
  if (tile == nullptr)
  {
    return tiles_->failed(at.tile) ? RowState::Lost : missing_->ask(at.tile);
  }
  const RowState state = missing_->asked(tile->cloud->hierarchy()->peek(at.node, row));
  if (state == RowState::Here)
  {
    row = shifted(at, row);
  }
  return state;
}

RowState CollectionTable::peekChild(
  NodeIndex parent, const Node& row, std::uint8_t child, Node& found) const
{
  const std::optional<TileNode> at = tileNodeOf(parent);
  if (!at)
  {
    found = rows_[row.firstChild + child];
    return RowState::Here;
  }
  const CollectionTiles::Tile* const tile = tiles_->opened(at->tile);
  if (tile == nullptr)
  {
    return tiles_->failed(at->tile) ? RowState::Lost : missing_->ask(at->tile);
  }
  const Hierarchy& table = *tile->cloud->hierarchy();
  RowState state = table.peek(tileNodeOf(row.firstChild + child)->node, found);
  const Node own = parentOf(row.firstChild, found);
  state = state == RowState::Here ? table.peekChild(at->node, own, child, found) : state;
  if (missing_->asked(state) == RowState::Here)
  {
    found = shifted({ at->tile, own.firstChild + child, 0 }, found);
  }
  return state;
}

std::pair<NodeIndex, NodeIndex> CollectionTable::nodesAround(std::uint64_t point) const
{
  if (point < firstPoints_.front())
  {
    return { 0, headCount() };
  }
  const auto behind = std::upper_bound(firstPoints_.begin(), firstPoints_.end(), point);
  const auto tile = static_cast<std::size_t>(behind - firstPoints_.begin()) - 1;
  return tile + 1 < firstNodes_.size() && firstNodes_[tile] < firstNodes_[tile + 1]
    ? std::pair(firstNodes_[tile], firstNodes_[tile + 1])
    : std::pair(NodeIndex(0), nodeCount());
}

MissingRows* CollectionTable::missingRows() const
{
  return missing_.get();
}

std::uint64_t CollectionTable::arrivals() const
{
  return missing_->arrivals();
}

bool CollectionTable::waitForArrival(
  std::uint64_t seen, std::chrono::steady_clock::time_point end) const
{
  return missing_->wait(seen, end);
}

std::optional<Error> CollectionTable::fault() const
{
  return missing_->fault();
}

std::vector<Error> CollectionTable::takeFaults() const
{
  return missing_->takeFaults();
}

} // namespace pointfront
