#include "COPCFile.h"
#include "CountedBytes.h"
#include "EPTTree.h"
#include "LASFormat.h"

#include "pointfront/Residency/LoadScheduler.h"
#include "pointfront/Residency/Residency.h"
#include "pointfront/Tiles/StoredCloudFormats.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

namespace pointfront
{
namespace
{
const std::string sharedData = std::string(POINTFRONT_SHARED_DATA) + "/";

/// The kinds of clouds that a program opens, and a line that counts.
class FarFormats : public testing::Test
{
protected:
  void SetUp() override
  {
    formats_.add(std::make_shared<COPCFormat>());
    formats_.add(std::make_shared<EPTTreeFormat>(&LASFormat::openBytes));
    StoredCloudFormats::ofProcess().add(std::make_shared<COPCFormat>()); // for lists
    line_ = CountedBytes::add();
    line_->cost = { 0.05, 12.5e6, 8, std::size_t(1) << 20 };
  }

  std::shared_ptr<const StoredCloud> open(const std::string& path) const
  {
    const auto cloud = formats_.open(path);
    EXPECT_TRUE(cloud) << cloud.error().what;
    return cloud ? *cloud : nullptr;
  }

  static ColumnSelection allColumns(const StoredCloud& cloud)
  {
    ColumnSelection all;
    for (std::uint32_t c = 0; c < cloud.description().schema.size(); ++c)
    {
      all.push_back(c);
    }
    return all;
  }

  /// All nodes and columns, one by one from the disk and all together from afar.
  void expectSame(const StoredCloud& near, const StoredCloud& far) const
  {
    const NodeIndex nodes = near.hierarchy()->nodeCount();
    ASSERT_EQ(far.hierarchy()->nodeCount(), nodes);
    EXPECT_EQ(far.description().pointCount, near.description().pointCount);
    EXPECT_EQ(far.description().bounds.low, near.description().bounds.low);
    EXPECT_EQ(far.description().crsWkt, near.description().crsWkt);
    EXPECT_FALSE(near.readCost().far());
    ASSERT_TRUE(far.readCost().far());
    std::vector<WantedNode> wanted;
    for (NodeIndex n = 0; n < nodes; ++n)
    {
      wanted.push_back({ n, allColumns(near) });
    }
    const auto fetched = far.fetchAll(wanted, ReadStop{ false });
    ASSERT_EQ(fetched.size(), wanted.size());
    for (NodeIndex n = 0; n < nodes; ++n)
    {
      ASSERT_TRUE(fetched[n]) << fetched[n].error().what;
      const auto found = far.decode(*fetched[n]);
      const auto expected = near.read(n, wanted[n].columns);
      ASSERT_TRUE(expected) << expected.error().what;
      ASSERT_TRUE(found) << found.error().what;
      EXPECT_EQ(found->origin, expected->origin);
      ASSERT_EQ(found->positions, expected->positions) << "node " << n;
      ASSERT_EQ(found->columns, expected->columns) << "node " << n;
    }
  }

  StoredCloudFormats formats_;
  std::shared_ptr<CountedBytes> line_;
};

TEST_F(FarFormats, COPCIsThatOfTheDisk)
{
  for (const char* name :
    { "1.2-with-color.copc.laz", "ellipsoid_200k.copc.laz", "lone-star.copc.laz" })
  {
    SCOPED_TRACE(name);
    const std::string path = sharedData + "copc/" + name;
    const auto near = open(path);
    line_->reset();
    const auto far = open(CountedBytes::addressOf(path));
    ASSERT_TRUE(near && far);
    EXPECT_EQ(line_->opened, 1u) << "detection and reading share it";
    ASSERT_TRUE(far->read(0, {}));
    EXPECT_LE(line_->rounds(), 3u);
    EXPECT_LT(line_->bytes, 1000000u);
    line_->reset();
    expectSame(*near, *far);
    EXPECT_LE(line_->rounds(), 1u);
  }
}

TEST_F(FarFormats, EPTIsThatOfTheDisk)
{
  for (const char* name : { "lone-star-laszip", "bcbf" })
  {
    SCOPED_TRACE(name);
    const std::string path = sharedData + "ept/" + name + "/ept.json";
    const auto near = open(path);
    line_->reset();
    const auto far = open(CountedBytes::addressOf(path));
    ASSERT_TRUE(near && far);
    ASSERT_TRUE(far->read(0, {}));
    // Description, first page and at most eight nodes, which are files beside each other.
    EXPECT_LE(line_->rounds(), 10u);
    line_->reset();
    expectSame(*near, *far);
    EXPECT_LE(line_->opened, near->hierarchy()->nodeCount());
    EXPECT_EQ(line_->reads, 0u) << "a node's file comes with its first answer";
  }
}

TEST_F(FarFormats, AListNamesAddresses)
{
  const std::filesystem::path folder =
    std::filesystem::path(testing::TempDir()) / ("far-list-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  for (const char* name : { "ellipsoid_200k.copc.laz", "lone-star.copc.laz" })
  {
    std::filesystem::create_symlink(sharedData + "copc/" + name, folder / name);
  }
  const std::string list = (folder / "some.pfronts").string();
  const std::string other = (folder / "ellipsoid_200k.copc.laz").string();
  std::ofstream(list) << "# far ones\n"
                      << CountedBytes::addressOf(other) << "\nlone-star.copc.laz\n";
  // Beside an address lie addresses.
  const auto near = open(list);
  const auto far = open(CountedBytes::addressOf(list));
  ASSERT_TRUE(near && far);
  EXPECT_EQ(near->description().pointCount, far->description().pointCount);
  EXPECT_TRUE(near->readCost().far()) << "one of its tiles is";
  const ColumnSelection columns = allColumns(*near);
  std::vector<WantedNode> wanted;
  for (NodeIndex n = 0; n < near->hierarchy()->nodeCount(); ++n)
  {
    wanted.push_back({ n, columns });
  }
  line_->reset();
  const auto fetched = far->fetchAll(wanted, ReadStop{ false });
  EXPECT_LE(line_->rounds(), 2u) << "one for each tile";
  for (NodeIndex n = 0; n < wanted.size(); ++n)
  {
    const auto expected = near->read(n, columns);
    ASSERT_TRUE(expected && fetched[n]);
    const auto found = far->decode(*fetched[n]);
    ASSERT_TRUE(found) << found.error().what;
    ASSERT_EQ(found->positions, expected->positions);
    ASSERT_EQ(found->columns, expected->columns);
  }
  std::filesystem::remove_all(folder);
}

/// All nodes of a tree through the scheduler, over a line of 20 ms.
TEST_F(FarFormats, ATreeLoadsInRoundsNotInNodes)
{
  line_->roundTrip = std::chrono::milliseconds(20);
  const auto cloud = open(CountedBytes::addressOf(sharedData + "copc/lone-star.copc.laz"));
  ASSERT_TRUE(cloud);
  const NodeIndex nodes = cloud->hierarchy()->nodeCount();
  std::vector<LoadRequest> all;
  for (NodeIndex n = 0; n < nodes; ++n)
  {
    const Node row = cloud->hierarchy()->node(n);
    all.push_back({ n, 1.0 / (1.0 + n), false, row.pointCount, row.layer });
  }
  line_->reset();
  Residency store(cloud, nodes, std::make_shared<LoadScheduler>(LoadSchedulerOptions()));
  store.request(all);
  store.waitUntilIdle();
  EXPECT_EQ(store.statistics().residentNodes, nodes);
  EXPECT_LE(line_->reads, 2u + line_->bytes / (500u << 10)) << nodes << " nodes";
  line_->roundTrip = std::chrono::milliseconds(0);
}

TEST_F(FarFormats, WhatIsNotThereIsAnError)
{
  const auto none = formats_.open(CountedBytes::addressOf(sharedData + "copc/none.copc.laz"));
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().kind, Error::Kind::NotFound);
  const auto tree = formats_.open(CountedBytes::addressOf(sharedData + "ept/none/ept.json"));
  ASSERT_FALSE(tree);
  EXPECT_EQ(tree.error().kind, Error::Kind::NotFound);
}

} // namespace
} // namespace pointfront
