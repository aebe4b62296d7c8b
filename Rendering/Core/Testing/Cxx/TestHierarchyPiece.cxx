#include "HierarchyPiece.h"

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
    std::move(nodes), std::vector<NodeIndex>{0}, refinement);
}

TEST(HierarchyPiece, OneOfOneIsTheHierarchyItself)
{
  const auto whole = fourLevels();
  const HierarchyPiece piece(whole, 0, 1);
  EXPECT_EQ(piece.hierarchy(), whole);
  EXPECT_EQ(piece.toStore(17), 17u);
  EXPECT_EQ(piece.fromStore(17), 17u);
}

TEST(HierarchyPiece, PiecesHaveEachPointOnceAndAreBalanced)
{
  const auto whole = fourLevels();
  std::set<NodeIndex> owned;
  std::uint64_t points = 0;
  for (int number = 0; number < 3; ++number)
  {
    const HierarchyPiece piece(whole, number, 3);
    std::uint64_t mine = 0;
    for (NodeIndex i = 0; i < piece.hierarchy()->nodeCount(); ++i)
    {
      const Node& node = piece.hierarchy()->node(i);
      EXPECT_EQ(piece.fromStore(piece.toStore(i)), i);
      EXPECT_EQ(node.level, whole->node(piece.toStore(i)).level);
      if (node.parent != noNode)
      {
        EXPECT_EQ(piece.toStore(node.parent), whole->node(piece.toStore(i)).parent);
        const Node& parent = piece.hierarchy()->node(node.parent);
        EXPECT_GE(i, parent.firstChild);
        EXPECT_LT(i, parent.firstChild + parent.childCount);
      }
      if (node.pointCount > 0)
      {
        EXPECT_TRUE(owned.insert(piece.toStore(i)).second) << "twice: " << piece.toStore(i);
        mine += node.pointCount;
      }
    }
    EXPECT_EQ(piece.hierarchy()->node(0).pointsBelow, mine);
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
    for (NodeIndex i = 0; i < piece.hierarchy()->nodeCount(); ++i)
    {
      const Node& node = piece.hierarchy()->node(i);
      EXPECT_EQ(node.pointCount, 10u);
      EXPECT_EQ(node.leaf(), whole->node(piece.toStore(i)).leaf()) << "no node lost all children";
      if (node.leaf())
      {
        EXPECT_TRUE(leaves.insert(piece.toStore(i)).second) << "twice: " << piece.toStore(i);
        mine += node.pointCount;
      }
    }
    EXPECT_EQ(piece.hierarchy()->node(0).pointsBelow, mine);
    EXPECT_NEAR(static_cast<double>(mine), 640.0 / 3, 60.0);
  }
  EXPECT_EQ(leaves.size(), 64u) << "every leaf is in a piece";
}

TEST(HierarchyPiece, MorePiecesThanNodesLeavesSomeEmpty)
{
  std::vector<Node> nodes(1);
  nodes[0].pointCount = 5;
  nodes[0].pointsBelow = 5;
  const auto whole =
    std::make_shared<HierarchyTable>(std::move(nodes), std::vector<NodeIndex>{0}, Refinement::Add);
  int withPoints = 0;
  for (int number = 0; number < 4; ++number)
  {
    withPoints += HierarchyPiece(whole, number, 4).hierarchy()->nodeCount() > 0 ? 1 : 0;
  }
  EXPECT_EQ(withPoints, 1);
}

} // namespace
