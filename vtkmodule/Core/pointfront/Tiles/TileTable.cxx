#include "pointfront/Tiles/TileTable.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <utility>

namespace pointfront
{

/// The signal that all tables wait for; one page after another, whichever asked.
/// Cost  nothing while nobody has asked: a reader looks here before each node that it takes, and
///       there may be ten thousand tables.
class TileTable::Rows final : public MissingRows
{
public:
  explicit Rows(std::vector<MissingRows*> tables)
    : tables_(std::move(tables))
  {
  }
  /// After a table said that a row is coming.
  void ask() { asked_ = true; }
  bool waiting() const override
  {
    // Taken back before it is looked whether it is so: who asks meanwhile sets it again.
    if (asked_.exchange(false) &&
      std::any_of(
        tables_.begin(), tables_.end(), [](const MissingRows* rows) { return rows->waiting(); }))
    {
      asked_ = true;
    }
    return asked_;
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
      rows->attach(reader,
        [this, wanted]
        {
          ask();
          wanted();
        });
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
  mutable std::atomic<bool> asked_{ true };
};

TileTable::TileTable(std::vector<Tile> tiles, std::uint32_t headPoints)
  : tiles_(std::move(tiles))
  , headPoints_(headPoints)
{
  assert(!tiles_.empty());
  const auto hasNodes = [](const Tile& tile) { return tile.table->nodeCount() > 0; };
  const auto filled = std::find_if(tiles_.begin(), tiles_.end(), hasNodes);
  refinement_ = (filled == tiles_.end() ? tiles_.front() : *filled).table->refinement();
  NodeIndex nodes = 0;
  std::uint64_t points = 0;
  std::vector<MissingRows*> waiting;
  for (const Tile& tile : tiles_)
  {
    assert(!hasNodes(tile) || tile.table->refinement() == refinement_);
    firstNodes_.push_back(nodes);
    firstPoints_.push_back(points);
    cut_.push_back(rootsToCut(*tile.table));
    for (const NodeIndex root : tile.table->roots())
    {
      roots_.push_back(indexOf(cut_.size() - 1, root));
    }
    headCount_ += static_cast<NodeIndex>(cut_.back().size());
    nodes += tile.table->nodeCount() + static_cast<NodeIndex>(cut_.back().size());
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

/// All roots of a table or none, so that all nodes of it are a level deeper, or none; but for roots
/// of few points with nothing below.
TileTable::CutRoots TileTable::rootsToCut(const Hierarchy& table) const
{
  CutRoots cut;
  bool large = false;
  for (const NodeIndex root : table.roots())
  {
    const Node row = table.node(root);
    const bool many = row.pointCount / 2 >= headPoints_;
    large = large || many;
    if (many || !row.leaf())
    {
      cut.push_back(root);
    }
  }
  std::sort(cut.begin(), cut.end());
  return large && refinement_ == Refinement::Add ? cut : CutRoots();
}

NodeIndex TileTable::indexOf(std::size_t tile, NodeIndex own) const
{
  const CutRoots& cut = cut_[tile];
  const auto before = std::lower_bound(cut.begin(), cut.end(), own) - cut.begin();
  return firstNodes_[tile] + own + static_cast<NodeIndex>(before);
}

NodeIndex TileTable::bodyIndexOf(std::size_t tile, NodeIndex own) const
{
  const CutRoots& cut = cut_[tile];
  return indexOf(tile, own) + (std::binary_search(cut.begin(), cut.end(), own) ? 1 : 0);
}

TileTable::TileNode TileTable::tileNodeOf(NodeIndex node) const
{
  const auto behind = std::upper_bound(firstNodes_.begin(), firstNodes_.end(), node);
  const auto tile = static_cast<std::size_t>(behind - firstNodes_.begin()) - 1;
  assert(tile < tiles_.size());
  const NodeIndex local = node - firstNodes_[tile];
  const CutRoots& cut = cut_[tile];
  // Heads before this node: head number k stands at cut[k] + k, its body right behind it.
  std::size_t low = 0;
  std::size_t high = cut.size();
  while (low < high)
  {
    const std::size_t middle = (low + high) / 2;
    if (cut[middle] + middle < local)
    {
      low = middle + 1;
    }
    else
    {
      high = middle;
    }
  }
  const auto heads = static_cast<NodeIndex>(low);
  if (heads > 0 && local == cut[heads - 1] + heads)
  {
    return { tile, cut[heads - 1], Cut::Body };
  }
  const bool head = heads < cut.size() && cut[heads] + heads == local;
  return { tile, local - heads, head ? Cut::Head : Cut::Whole };
}

Node TileTable::shifted(const TileNode& at, Node row) const
{
  const std::size_t tile = at.tile;
  const NodeIndex index = indexOf(tile, at.node);
  row.parent = row.parent == noNode ? noNode : bodyIndexOf(tile, row.parent);
  row.firstChild = row.firstChild == noNode ? noNode : indexOf(tile, row.firstChild);
  row.firstPoint += firstPoints_[tile];
  const std::vector<std::uint16_t>& layers = tiles_[tile].layers;
  row.layer = row.layer < layers.size() ? layers[row.layer] : std::uint16_t(0);
  if (cut_[tile].empty())
  {
    return row;
  }
  const std::uint32_t head = std::min(row.pointCount, headPoints_);
  if (at.cut == Cut::Head)
  {
    // Fewer points of the same surface lie that much further apart.
    const auto sparser =
      static_cast<float>(head > 0 ? std::sqrt(static_cast<double>(row.pointCount) / head) : 1.0);
    row.spacing *= sparser;
    row.splatRadius *= sparser;
    row.pointCount = head;
    row.firstChild = index + 1;
    row.childCount = 1;
    return row;
  }
  if (at.cut == Cut::Body)
  {
    row.parent = index;
    row.pointCount -= head;
    row.pointsBelow -= head;
    row.firstPoint += head;
  }
  row.level = static_cast<std::uint8_t>(row.level + (row.parent == noNode ? 0 : 1));
  return row;
}

/// Links and level only: what a table needs to find a row's child.
Node TileTable::unshifted(const TileNode& at, Node row) const
{
  const bool below = !cut_[at.tile].empty() && row.parent != noNode;
  row.level = static_cast<std::uint8_t>(row.level - (below ? 1 : 0));
  row.parent = at.cut == Cut::Body || row.parent == noNode ? noNode : tileNodeOf(row.parent).node;
  row.firstChild = row.firstChild == noNode ? noNode : tileNodeOf(row.firstChild).node;
  row.firstPoint -= firstPoints_[at.tile];
  return row;
}

Node TileTable::node(NodeIndex index) const
{
  const TileNode at = tileNodeOf(index);
  return shifted(at, tiles_[at.tile].table->node(at.node));
}

Node TileTable::childOf(NodeIndex parent, const Node& row, std::uint8_t child) const
{
  const TileNode at = tileNodeOf(parent);
  if (at.cut == Cut::Head)
  {
    return node(parent + 1);
  }
  const Node found = tiles_[at.tile].table->childOf(at.node, unshifted(at, row), child);
  return shifted(tileNodeOf(row.firstChild + child), found);
}

RowState TileTable::asked(RowState state) const
{
  if (state == RowState::Coming && rows_)
  {
    rows_->ask();
  }
  return state;
}

RowState TileTable::peek(NodeIndex index, Node& row) const
{
  const TileNode at = tileNodeOf(index);
  const RowState state = asked(tiles_[at.tile].table->peek(at.node, row));
  if (state == RowState::Here)
  {
    row = shifted(at, row);
  }
  return state;
}

RowState TileTable::peekChild(
  NodeIndex parent, const Node& row, std::uint8_t child, Node& found) const
{
  const TileNode at = tileNodeOf(parent);
  if (at.cut == Cut::Head)
  {
    return peek(parent + 1, found);
  }
  const RowState state =
    asked(tiles_[at.tile].table->peekChild(at.node, unshifted(at, row), child, found));
  if (state == RowState::Here)
  {
    found = shifted(tileNodeOf(row.firstChild + child), found);
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
