#include "pointfront/Views/HierarchyPiece.h"

#include <gtest/gtest.h>

#include <set>

using namespace pointfront;

namespace
{

/// Four levels: a root, 4, 16 and 64 nodes of 10 points each, breadth first.
std::shared_ptr<const HierarchyTable> fourLevels(Refinement refinement = Refinement::Add)
{
  std::vector<Node> nodes(85);
  NodeIndex next = 1;
  for (NodeIndex i = 0; i < 21; ++i)
  {
    nodes[i].firstChild = next;
    nodes[i].childCount = 4;
    for (int child = 0; child < 4; ++child, ++next)
    {
      nodes[next].parent = i;
      nodes[next].level = static_cast<std::uint8_t>(nodes[i].level + 1);
    }
  }
  for (NodeIndex i = 85; i-- > 0;)
  {
    nodes[i].pointCount = 10;
    nodes[i].pointsBelow += originalPoints(nodes[i], refinement);
    if (i > 0)
    {
      nodes[nodes[i].parent].pointsBelow += nodes[i].pointsBelow;
    }
  }
  return std::make_shared<HierarchyTable>(
    std::move(nodes), std::vector<NodeIndex>{ 0 }, refinement);
}

/// The nodes that one meets walking down, each parent naming its children.
std::vector<NodeIndex> nodesOf(const Hierarchy& part)
{
  std::vector<NodeIndex> nodes(part.roots());
  for (std::size_t at = 0; at < nodes.size(); ++at)
  {
    part.appendChildren(nodes[at], part.node(nodes[at]), nodes);
  }
  return nodes;
}

/// A table that counts how many rows were asked for.
class CountingTable final : public Hierarchy
{
public:
  explicit CountingTable(std::shared_ptr<const Hierarchy> table)
    : table_(std::move(table))
  {
  }
  NodeIndex nodeCount() const override { return table_->nodeCount(); }
  const std::vector<NodeIndex>& roots() const override { return table_->roots(); }
  Refinement refinement() const override { return table_->refinement(); }
  Node node(NodeIndex index) const override
  {
    ++asked;
    return table_->node(index);
  }
  mutable int asked = 0;

private:
  std::shared_ptr<const Hierarchy> table_;
};

TEST(HierarchyPiece, OneOfOneIsTheHierarchyItself)
{
  const auto whole = fourLevels();
  const HierarchyPiece piece(whole, 0, 1);
  EXPECT_EQ(piece.hierarchy(), whole);
}

TEST(HierarchyPiece, KnowsWhatItHas)
{
  for (const int pieces : { 1, 3, 200 })
  {
    const auto whole = fourLevels();
    for (int number = 0; number < pieces; ++number)
    {
      const HierarchyPiece piece(whole, number, pieces);
      std::set<NodeIndex> met;
      for (const NodeIndex i : nodesOf(*piece.hierarchy()))
      {
        if (piece.hierarchy()->node(i).pointCount > 0)
        {
          met.insert(i);
        }
      }
      for (NodeIndex i = 0; i < whole->nodeCount(); ++i)
      {
        EXPECT_EQ(piece.has(i), met.count(i) > 0) << i << ", piece " << number << " of " << pieces;
      }
    }
  }
}

TEST(HierarchyPiece, PiecesHaveEachPointOnceAndAreBalanced)
{
  const auto whole = fourLevels();
  std::set<NodeIndex> owned;
  std::uint64_t points = 0;
  for (int number = 0; number < 3; ++number)
  {
    const HierarchyPiece piece(whole, number, 3);
    const Hierarchy& part = *piece.hierarchy();
    std::uint64_t mine = 0;
    for (const NodeIndex i : nodesOf(part))
    {
      const Node node = part.node(i);
      EXPECT_EQ(node.level, whole->node(i).level);
      EXPECT_EQ(node.parent, whole->node(i).parent);
      EXPECT_EQ(node.firstPoint, whole->node(i).firstPoint);
      if (node.pointCount > 0)
      {
        EXPECT_TRUE(owned.insert(i).second) << "twice: " << i;
        mine += node.pointCount;
      }
    }
    EXPECT_EQ(part.node(0).pointsBelow, mine);
    EXPECT_NEAR(static_cast<double>(mine), 850.0 / 3, 60.0);
    points += mine;
  }
  EXPECT_EQ(owned.size(), 85u);
  EXPECT_EQ(points, 850u);
}

TEST(HierarchyPiece, RepresentativesStandInEveryPieceThatHasSomethingBelow)
{
  const auto whole = fourLevels(Refinement::Replace);
  std::set<NodeIndex> leaves;
  for (int number = 0; number < 3; ++number)
  {
    const HierarchyPiece piece(whole, number, 3);
    std::uint64_t mine = 0;
    for (const NodeIndex i : nodesOf(*piece.hierarchy()))
    {
      const Node node = piece.hierarchy()->node(i);
      EXPECT_EQ(node.pointCount, 10u);
      EXPECT_EQ(node.leaf(), whole->node(i).leaf()) << "no node lost all children";
      if (node.leaf())
      {
        EXPECT_TRUE(leaves.insert(i).second) << "twice: " << i;
        mine += node.pointCount;
      }
    }
    EXPECT_EQ(piece.hierarchy()->node(0).pointsBelow, mine);
    EXPECT_NEAR(static_cast<double>(mine), 640.0 / 3, 60.0);
  }
  EXPECT_EQ(leaves.size(), 64u) << "every leaf is in a piece";
}

TEST(HierarchyPiece, DoesNotReadTheWholeTable)
{
  const auto whole = std::make_shared<CountingTable>(fourLevels());
  const HierarchyPiece piece(whole, 1, 2);
  EXPECT_LT(whole->asked, 30) << "the 64 nodes of the last level are in whole subtrees";
}

TEST(HierarchyPiece, MorePiecesThanNodesLeavesSomeEmpty)
{
  std::vector<Node> nodes(1);
  nodes[0].pointCount = 5;
  nodes[0].pointsBelow = 5;
  const auto whole = std::make_shared<HierarchyTable>(
    std::move(nodes), std::vector<NodeIndex>{ 0 }, Refinement::Add);
  int withPoints = 0;
  for (int number = 0; number < 4; ++number)
  {
    withPoints += HierarchyPiece(whole, number, 4).hierarchy()->roots().empty() ? 0 : 1;
  }
  EXPECT_EQ(withPoints, 1);
}

} // namespace
