#include "HierarchyPiece.h"

#include <algorithm>
#include <cassert>

namespace pointfront
{
namespace
{

/// Subtrees are cut until none holds more than this share of a piece: pieces then differ by little.
constexpr std::uint64_t unitsPerPiece = 8;

/// Walks depth first and gives every unit (a small subtree, or the own points of a node above them)
/// to the piece in which its middle point lies. Representatives above the units go to every piece
/// that has something below them: each piece needs them until its own children are there.
class PieceChoice
{
public:
  PieceChoice(const Hierarchy& whole, int piece, int pieces)
      : whole_(whole), piece_(static_cast<std::uint64_t>(piece)),
        pieces_(static_cast<std::uint64_t>(pieces)), kept_(whole.nodeCount(), 0),
        owned_(whole.nodeCount(), 0)
  {
    for (const NodeIndex root : whole.roots())
    {
      total_ += whole.node(root).pointsBelow;
    }
    for (const NodeIndex root : whole.roots())
    {
      visit(root);
    }
  }
  bool kept(NodeIndex node) const { return kept_[node] != 0; }
  bool owned(NodeIndex node) const { return owned_[node] != 0; }

private:
  bool mine(std::uint64_t points)
  {
    const std::uint64_t middle = before_ + points / 2;
    before_ += points;
    const std::uint64_t owner = middle * pieces_ / std::max<std::uint64_t>(total_, 1);
    return std::min(owner, pieces_ - 1) == piece_;
  }

  void keepAll(NodeIndex index)
  {
    kept_[index] = owned_[index] = 1;
    const Node& node = whole_.node(index);
    for (std::uint32_t child = 0; child < node.childCount; ++child)
    {
      keepAll(node.firstChild + child);
    }
  }

  bool visit(NodeIndex index)
  {
    const Node& node = whole_.node(index);
    if (node.leaf() || node.pointsBelow * pieces_ * unitsPerPiece <= total_)
    {
      const bool whole = mine(node.pointsBelow);
      if (whole)
      {
        keepAll(index);
      }
      return whole;
    }
    const bool representatives = whole_.refinement() == Refinement::Replace;
    const bool own = !representatives && mine(node.pointCount);
    bool any = own;
    for (std::uint32_t child = 0; child < node.childCount; ++child)
    {
      any = visit(node.firstChild + child) || any;
    }
    owned_[index] = own || (representatives && any) ? 1 : 0;
    kept_[index] = any ? 1 : 0;
    return any;
  }

  const Hierarchy& whole_;
  std::uint64_t piece_;
  std::uint64_t pieces_;
  std::uint64_t total_ = 0;
  std::uint64_t before_ = 0;
  std::vector<char> kept_;
  std::vector<char> owned_;
};

} // namespace

HierarchyPiece::HierarchyPiece(std::shared_ptr<const Hierarchy> whole, int piece, int pieces)
{
  assert(pieces >= 1 && piece >= 0 && piece < pieces);
  if (pieces == 1)
  {
    part_ = std::move(whole);
    return;
  }
  const PieceChoice choice(*whole, piece, pieces);
  std::vector<Node> nodes;
  std::vector<NodeIndex> roots;
  fromStore_.assign(whole->nodeCount(), noNode);
  const auto append = [&](NodeIndex index, NodeIndex parent)
  {
    Node node = whole->node(index);
    node.parent = parent;
    node.pointCount = choice.owned(index) ? node.pointCount : 0;
    fromStore_[index] = static_cast<NodeIndex>(nodes.size());
    toStore_.push_back(index);
    nodes.push_back(node);
  };
  for (const NodeIndex root : whole->roots())
  {
    if (choice.kept(root))
    {
      roots.push_back(static_cast<NodeIndex>(nodes.size()));
      append(root, noNode);
    }
  }
  for (NodeIndex at = 0; at < nodes.size();
       ++at) // breadth first: appended children stay neighbours
  {
    const Node original = whole->node(toStore_[at]);
    nodes[at].firstChild = noNode;
    nodes[at].childCount = 0;
    for (std::uint32_t child = 0; child < original.childCount; ++child)
    {
      const NodeIndex index = original.firstChild + child;
      if (!choice.kept(index))
      {
        continue;
      }
      if (nodes[at].childCount++ == 0)
      {
        nodes[at].firstChild = static_cast<NodeIndex>(nodes.size());
      }
      append(index, at);
    }
  }
  for (std::size_t at = nodes.size(); at-- > 0;) // children come after their parent
  {
    nodes[at].pointsBelow = originalPoints(nodes[at], whole->refinement());
    for (std::uint32_t child = 0; child < nodes[at].childCount; ++child)
    {
      nodes[at].pointsBelow += nodes[nodes[at].firstChild + child].pointsBelow;
    }
  }
  part_ = std::make_shared<HierarchyTable>(std::move(nodes), std::move(roots), whole->refinement());
}

} // namespace pointfront
