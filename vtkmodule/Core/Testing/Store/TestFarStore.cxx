#include "CountedBytes.h"
#include "SampleStore.h"

#include "pointfront/Disk/HeldBytes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

namespace pointfront
{
namespace
{

std::vector<std::byte> rowOfBytes(std::size_t count)
{
  std::vector<std::byte> bytes(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    bytes[i] = std::byte(i * 7 % 251);
  }
  return bytes;
}

TEST(HeldBytes, ReadsOnlyWhatIsNotHeld)
{
  const std::string path = temporaryPath("held");
  const std::vector<std::byte> all = rowOfBytes(1000);
  writeFile(path, all);
  const auto line = CountedBytes::add();
  const auto source = openBytes(CountedBytes::addressOf(path));
  ASSERT_TRUE(source);
  const auto held = HeldBytes::hold(*source, { { 100, 50 }, { 900, 100 } });
  ASSERT_TRUE(held);
  EXPECT_EQ(line->reads, 1u);
  std::vector<std::byte> in(50), at(10), over(20);
  const ByteRange ranges[] = { { 100, 50, in.data() }, { 145, 10, at.data() },
    { 890, 20, over.data() } };
  line->reset();
  ASSERT_TRUE((*held)->read(ranges, 1));
  EXPECT_EQ(line->reads, 0u);
  ASSERT_TRUE((*held)->read(ranges, 3));
  EXPECT_EQ(line->reads, 1u);
  EXPECT_EQ(line->ranges, 2u);
  EXPECT_EQ(std::memcmp(in.data(), &all[100], 50), 0);
  EXPECT_EQ(std::memcmp(at.data(), &all[145], 10), 0);
  EXPECT_EQ(std::memcmp(over.data(), &all[890], 20), 0);
  EXPECT_FALSE((*held)->readAt(990, 20)) << "beyond the end";
  EXPECT_FALSE(HeldBytes::hold(*source, { { 990, 20 } }));
}

/// A sample that is larger than the first bytes.
class FarStore : public testing::Test
{
protected:
  void SetUp() override
  {
    path_ = temporaryPath("far.pfront");
    sample_ = makeSample(5000);
    writeSample(sample_, path_);
    line_ = CountedBytes::add();
    line_->cost = { 0.05, 12.5e6, 8, std::size_t(1) << 20 };
  }
  std::vector<WantedNode> allNodes() const
  {
    std::vector<WantedNode> wanted;
    for (NodeIndex n = 0; n < sample_.nodes.size(); ++n)
    {
      wanted.push_back({ n, everyColumn(sample_.description.schema) });
    }
    return wanted;
  }
  std::string path_;
  SampleStore sample_;
  std::shared_ptr<CountedBytes> line_;
};

/// First bytes, tables, then the root: what lies in the first bytes costs nothing.
TEST_F(FarStore, OpensAndShowsItsRootWithThreeRoundTrips)
{
  const auto store = PointStore::open(CountedBytes::addressOf(path_));
  ASSERT_TRUE(store) << store.error().what;
  ASSERT_TRUE((*store)->readCost().far());
  const NodeIndex root = (*store)->hierarchy()->roots().front();
  ASSERT_TRUE((*store)->read(root, {}));
  EXPECT_LE(line_->rounds(), 3u);
  EXPECT_FALSE((*PointStore::open(path_))->readCost().far());
}

TEST_F(FarStore, ReadsAllNodesOfAWishWithOneRoundTrip)
{
  const auto near = PointStore::open(path_);
  const auto far = PointStore::open(CountedBytes::addressOf(path_));
  ASSERT_TRUE(near && far);
  line_->reset();
  const std::vector<WantedNode> wanted = allNodes();
  const auto fetched = (*far)->fetchAll(wanted, ReadStop{ false });
  ASSERT_EQ(fetched.size(), wanted.size());
  EXPECT_EQ(line_->rounds(), 1u);
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    ASSERT_TRUE(fetched[i]) << fetched[i].error().what;
    const auto points = (*far)->decode(*fetched[i]);
    const auto expected = (*near)->read(wanted[i].node, wanted[i].columns);
    ASSERT_TRUE(points && expected);
    EXPECT_EQ(points->positions, expected->positions);
    EXPECT_EQ(points->columns, expected->columns);
    EXPECT_EQ(points->parent, expected->parent);
    EXPECT_EQ(fetched[i]->bytesRead, (*near)->fetch(wanted[i].node, wanted[i].columns)->bytesRead);
  }
}

TEST_F(FarStore, ADamagedNodeLeavesTheOthersAlone)
{
  std::vector<std::byte> bytes = fileBytes(path_);
  bytes[70] ^= std::byte(1); // in the payload of the first node that was written
  writeFile(path_, bytes);
  const auto far = PointStore::open(CountedBytes::addressOf(path_));
  ASSERT_TRUE(far);
  std::size_t broken = 0;
  for (const auto& fetched : (*far)->fetchAll(allNodes(), ReadStop{ false }))
  {
    ASSERT_TRUE(fetched);
    broken += (*far)->decode(*fetched) ? 0 : 1;
  }
  EXPECT_EQ(broken, 1u);
}

TEST_F(FarStore, WhatIsStoppedIsCancelled)
{
  const auto far = PointStore::open(CountedBytes::addressOf(path_));
  const auto near = PointStore::open(path_);
  ASSERT_TRUE(far && near);
  for (const auto& store : { *far, *near })
  {
    const auto fetched = store->fetchAll({ { 0, {} } }, ReadStop{ true });
    ASSERT_FALSE(fetched.front());
    EXPECT_EQ(fetched.front().error().kind, Error::Kind::Cancelled);
  }
}

} // namespace
} // namespace pointfront
