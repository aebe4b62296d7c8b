#include "pointfront/Views/HierarchyPiece.h"

#include <algorithm>
#include <cassert>
#include <unordered_map>
#include <utility>
#include <vector>

namespace pointfront
{
namespace
{

/// Subtrees are cut until none holds more than this share of a piece: pieces then differ by little.
constexpr std::uint64_t unitsPerPiece = 8;

using ChangedRows = std::unordered_map<NodeIndex, Node>;

} // namespace

/// A table seen through some changed rows.
class HierarchyPiece::ChangedTable final : public Hierarchy
{
public:
  ChangedTable(
    std::shared_ptr<const Hierarchy> whole, ChangedRows changed, std::vector<NodeIndex> roots)
    : whole_(std::move(whole))
    , changed_(std::move(changed))
    , roots_(std::move(roots))
  {
  }
  NodeIndex nodeCount() const override { return whole_->nodeCount(); }
  const std::vector<NodeIndex>& roots() const override { return roots_; }
  Refinement refinement() const override { return whole_->refinement(); }
  Node node(NodeIndex index) const override
  {
    const auto row = changed_.find(index);
    return row != changed_.end() ? row->second : whole_->node(index);
  }
  Node childOf(NodeIndex parent, const Node& row, std::uint8_t child) const override
  {
    const auto changed = changed_.find(row.firstChild + child);
    return changed != changed_.end() ? changed->second : whole_->childOf(parent, row, child);
  }
  RowState peek(NodeIndex index, Node& row) const override
  {
    const auto changed = changed_.find(index);
    if (changed != changed_.end())
    {
      row = changed->second;
      return RowState::Here;
    }
    return whole_->peek(index, row);
  }
  RowState peekChild(
    NodeIndex parent, const Node& row, std::uint8_t child, Node& found) const override
  {
    const auto changed = changed_.find(row.firstChild + child);
    if (changed != changed_.end())
    {
      found = changed->second;
      return RowState::Here;
    }
    return whole_->peekChild(parent, row, child, found);
  }
  std::uint64_t arrivals() const override { return whole_->arrivals(); }
  using Hierarchy::waitForArrival;
  bool waitForArrival(std::uint64_t seen, std::chrono::steady_clock::time_point end) const override
  {
    return whole_->waitForArrival(seen, end);
  }
  std::optional<Error> fault() const override { return whole_->fault(); }
  std::vector<Error> takeFaults() const override { return whole_->takeFaults(); }

  /// Up from a node to the first changed row, or a root: all below is the piece's, or nothing.
  bool has(NodeIndex index) const
  {
    const auto own = changed_.find(index);
    if (own != changed_.end())
    {
      return own->second.pointCount > 0;
    }
    Node row;
    while (whole_->peek(index, row) == RowState::Here)
    {
      if (row.parent == noNode)
      {
        return std::find(roots_.begin(), roots_.end(), index) != roots_.end();
      }
      const auto above = changed_.find(row.parent);
      if (above != changed_.end())
      {
        const Node& kept = above->second;
        return kept.childCount > 0 && index >= kept.firstChild &&
          index - kept.firstChild < kept.childCount;
      }
      index = row.parent;
    }
    return false;
  }

private:
  std::shared_ptr<const Hierarchy> whole_;
  ChangedRows changed_;
  std::vector<NodeIndex> roots_;
};

namespace
{

/// Walks depth first and gives every unit (a small subtree, or the own points of a node above them)
/// to the piece in which its middle point lies. Pieces follow each other in that order, so those
/// children of a node that have something of a piece are neighbours. Representatives above the
/// units go to every piece that has something below them: each needs them until its own children
/// are there.
class PieceChoice
{
public:
  PieceChoice(const Hierarchy& whole, int piece, int pieces)
    : whole_(whole)
    , piece_(static_cast<std::uint64_t>(piece))
    , pieces_(static_cast<std::uint64_t>(pieces))
  {
    for (const NodeIndex root : whole.roots())
    {
      total_ += whole.node(root).pointsBelow;
    }
    for (const NodeIndex root : whole.roots())
    {
      if (visit(root, whole.node(root)).any)
      {
        roots.push_back(root);
      }
    }
  }

  ChangedRows rows;
  std::vector<NodeIndex> roots;

private:
  struct Share
  {
    bool any = false;
    std::uint64_t pointsBelow = 0;
  };

  bool mine(std::uint64_t points)
  {
    const std::uint64_t middle = before_ + points / 2;
    before_ += points;
    const std::uint64_t owner = middle * pieces_ / std::max<std::uint64_t>(total_, 1);
    return std::min(owner, pieces_ - 1) == piece_;
  }

  Share visit(NodeIndex index, const Node& node)
  {
    if (node.leaf() || node.pointsBelow * pieces_ * unitsPerPiece <= total_)
    {
      const bool whole = mine(node.pointsBelow);
      return { whole, whole ? node.pointsBelow : 0 };
    }
    const bool representatives = whole_.refinement() == Refinement::Replace;
    Node row = node;
    Share share;
    share.any = !representatives && mine(node.pointCount);
    const bool own = share.any;
    share.pointsBelow = own ? node.pointCount : 0;
    row.firstChild = noNode;
    row.childCount = 0;
    for (std::uint32_t c = 0; c < node.childCount; ++c)
    {
      const Node child = whole_.childOf(index, node, static_cast<std::uint8_t>(c));
      const Share below = visit(node.firstChild + c, child);
      share.pointsBelow += below.pointsBelow;
      if (below.any)
      {
        share.any = true;
        row.firstChild = std::min(row.firstChild, node.firstChild + c);
        row.childCount = static_cast<std::uint8_t>(node.firstChild + c + 1 - row.firstChild);
      }
    }
    row.pointCount = own || (representatives && share.any) ? node.pointCount : 0;
    row.pointsBelow = share.pointsBelow;
    rows.emplace(index, row);
    return share;
  }

  const Hierarchy& whole_;
  std::uint64_t piece_;
  std::uint64_t pieces_;
  std::uint64_t total_ = 0;
  std::uint64_t before_ = 0;
};

} // namespace

HierarchyPiece::HierarchyPiece(std::shared_ptr<const Hierarchy> whole, int piece, int pieces)
  : whole_(std::move(whole))
  , part_(whole_)
{
  assert(pieces >= 1 && piece >= 0 && piece < pieces);
  if (pieces > 1)
  {
    PieceChoice choice(*whole_, piece, pieces);
    changed_ =
      std::make_shared<ChangedTable>(whole_, std::move(choice.rows), std::move(choice.roots));
    part_ = changed_;
  }
}

bool HierarchyPiece::has(NodeIndex node) const
{
  return !changed_ || changed_->has(node);
}

} // namespace pointfront
