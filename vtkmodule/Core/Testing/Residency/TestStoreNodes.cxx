#include "pointfront/Residency/StoreNodes.h"

#include "MadeUpReader.h"

#include <gtest/gtest.h>

#include <functional>

namespace pointfront
{
namespace
{

/// Says when it is asked for the bytes of a node.
class AskedReader final : public NodeReader
{
public:
  Result<FetchedNode> fetch(NodeIndex node, const ColumnSelection& columns) const override
  {
    return inner.fetch(node, columns);
  }
  Result<NodeColumns> decode(const FetchedNode& fetched) const override
  {
    return inner.decode(fetched);
  }
  std::size_t decodedBytes(
    NodeIndex node, std::uint32_t points, const ColumnSelection& columns) const override
  {
    if (asked)
    {
      asked();
    }
    return inner.decodedBytes(node, points, columns);
  }
  std::size_t storedBytes(NodeIndex node, const ColumnSelection& columns) const override
  {
    return inner.storedBytes(node, columns);
  }

  test::MadeUpReader inner;
  std::function<void()> asked;
};

} // namespace

/// A node's old points went to make room for its new ones; another store on the same memory was
/// faster and took that room. Who asked for the node then read through a null pointer.
TEST(StoreNodes, ANodeWhoseRoomIsTakenIsNotThere)
{
  const auto reader = std::make_shared<AskedReader>();
  const std::size_t before = reader->inner.trueBytes(0, {});
  const std::size_t after = reader->inner.trueBytes(0, { 0 });
  const auto budget = std::make_shared<MemoryBudget>(after);
  StoreNodes nodes(reader, 1, budget);
  nodes.request({ { 0, 1.0, false, 100 } });
  const auto first = nodes.begin();
  ASSERT_TRUE(first);
  EXPECT_TRUE(nodes.finish(*first, reader->read(0, {}), 1));
  nodes.leave(*first);
  ASSERT_TRUE(nodes.find(0));
  nodes.noteRelease(true);
  nodes.setColumns(ColumnSelection{ 0 });
  // The last look before the old points go is for the bytes of the read that begins.
  int looks = 0;
  reader->asked = [&]
  {
    if (++looks == 2)
    {
      EXPECT_TRUE(budget->reserve(after - before));
    }
  };
  EXPECT_FALSE(nodes.begin());
  EXPECT_EQ(looks, 2);
  EXPECT_EQ(nodes.find(0), nullptr);
  EXPECT_EQ(budget->used(), after - before);
}

} // namespace pointfront
