#include "TestBuildClouds.h"

#include "pointfront/Store/PointStore.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <tuple>

namespace pointfront
{
namespace
{
using namespace pointfront::test;
namespace fs = std::filesystem;

/// A fresh folder for each test; nothing may be left in it but the store.
class StoreBuild : public testing::Test
{
protected:
  void SetUp() override
  {
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / ("pointfront-build-" + std::string(test->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    options_.outputPath = (folder_ / "cloud.pfront").string();
    options_.nodePoints = 256;
    options_.threads = 2;
    options_.overwrite = true;
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::size_t filesLeft() const
  {
    return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}));
  }
  std::string bytes() const
  {
    std::ifstream file(options_.outputPath, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }

  fs::path folder_;
  BuildOptions options_;
};

using Identified = std::tuple<std::uint32_t, std::int64_t, std::int64_t, std::int64_t, unsigned>;

/// All points of a store of idSchema(), sorted by id.
std::vector<Identified> pointsOf(const PointStore& store)
{
  std::vector<Identified> points;
  for (NodeIndex n = 0; n < store.hierarchy()->nodeCount(); ++n)
  {
    const auto columns = store.read(n, {0, 1});
    EXPECT_TRUE(columns) << columns.error().what;
    for (std::size_t i = 0; i < columns->size(); ++i)
    {
      std::uint32_t id;
      std::uint16_t intensity;
      std::memcpy(&id, columns->columns[0].data() + 4 * i, 4);
      std::memcpy(&intensity, columns->columns[1].data() + 2 * i, 2);
      const GridPosition p = columns->origin + GridPosition(columns->positions[i]);
      points.emplace_back(id, p.x, p.y, p.z, intensity);
    }
  }
  std::sort(points.begin(), points.end());
  return points;
}

std::vector<Identified> pointsOf(const CloudSource& cloud, const QuantisationGrid& grid)
{
  std::vector<Identified> points;
  for (std::size_t i = 0; i < cloud.positions().size(); ++i)
  {
    const GridPosition p = grid.toGrid(cloud.positions()[i]);
    points.emplace_back(static_cast<std::uint32_t>(i), p.x, p.y, p.z, (i * 7) & 0xffff);
  }
  return points;
}

/// Builds, opens and verifies; checks that every point is there once, and nothing else in the
/// folder.
std::shared_ptr<const PointStore> expectSoundStore(
  std::unique_ptr<CloudSource> cloud, const BuildOptions& options)
{
  const QuantisationGrid grid = *cloud->description().grid;
  const std::vector<Identified> expected = pointsOf(*cloud, grid);
  const auto sources = one(std::move(cloud));
  const auto report = buildOctreeStore(sources, options);
  EXPECT_TRUE(report) << report.error().what;
  if (!report)
  {
    return nullptr;
  }
  EXPECT_EQ(report->pointsRead, expected.size());
  EXPECT_EQ(report->pointsStored, expected.size());
  EXPECT_TRUE(report->pointsRejected.empty());
  const auto store = PointStore::open(options.outputPath);
  EXPECT_TRUE(store) << store.error().what;
  const auto verified = (*store)->verify();
  EXPECT_TRUE(verified && verified->ok)
    << (verified ? verified->firstError : verified.error().what);
  EXPECT_TRUE(pointsOf(**store) == expected);
  return *store;
}

TEST_F(StoreBuild, KeepsEveryPointOnce)
{
  const auto store = expectSoundStore(hills(20000, 100000.0), options_);
  ASSERT_TRUE(store);
  EXPECT_EQ(store->description().pointCount, 20000u);
  EXPECT_EQ(store->description().structure, "octree");
  EXPECT_GT(store->description().levels, 3u);
  EXPECT_EQ(filesLeft(), 1u);
}

TEST_F(StoreBuild, SameBytesForAnyThreadsAndMemory)
{
  const auto build = [&](unsigned threads, std::uint64_t memory)
  {
    options_.threads = threads;
    options_.memoryBytes = memory;
    const auto sources = one(hills(60000, 100000.0));
    const auto report = buildOctreeStore(sources, options_);
    EXPECT_TRUE(report) << report.error().what;
    return std::make_pair(report ? report->spilledBytes : 0, bytes());
  };
  const auto [spilledNot, reference] = build(1, 1u << 30);
  EXPECT_EQ(spilledNot, 0u);
  EXPECT_GT(reference.size(), 100000u);
  for (const unsigned threads : {2u, 4u})
  {
    EXPECT_TRUE(build(threads, 1u << 30).second == reference) << threads << " threads";
  }
  for (const std::uint64_t kibibytes : {150u, 400u, 1000u})
  {
    for (const unsigned threads : {1u, 2u, 4u})
    {
      const auto [spilled, store] = build(threads, kibibytes << 10);
      EXPECT_EQ(spilled, 60000u * 18) << kibibytes << " KiB";
      EXPECT_TRUE(store == reference) << threads << " threads, " << kibibytes << " KiB";
    }
  }
  EXPECT_EQ(filesLeft(), 1u);
}

TEST_F(StoreBuild, StoresAnEmptyCloud)
{
  const auto store = expectSoundStore(cloudOf(0, millimetres(), {}), options_);
  ASSERT_TRUE(store);
  EXPECT_EQ(store->hierarchy()->nodeCount(), 0u);
}

TEST_F(StoreBuild, StoresOnePoint)
{
  const auto store = expectSoundStore(
    cloudOf(1, millimetres(), [](std::size_t) { return GridPosition(-7, 3, 123456789); }),
    options_);
  ASSERT_TRUE(store);
  EXPECT_EQ(store->hierarchy()->nodeCount(), 1u);
}

TEST_F(StoreBuild, ChainsEqualPoints)
{
  const auto equal = []
  { return cloudOf(30000, millimetres(), [](std::size_t) { return GridPosition(5, 6, 7); }); };
  const auto store = expectSoundStore(equal(), options_);
  ASSERT_TRUE(store);
  for (NodeIndex n = 0; n < store->hierarchy()->nodeCount(); ++n)
  {
    EXPECT_LE(store->hierarchy()->node(n).pointCount, options_.nodePoints);
  }
  const std::string inMemory = bytes();
  options_.memoryBytes = 150 << 10;
  expectSoundStore(equal(), options_);
  EXPECT_TRUE(bytes() == inMemory);
}

TEST_F(StoreBuild, StoresLinesPlanesAndBlocks)
{
  expectSoundStore(cloudOf(20000, millimetres(),
                     [](std::size_t i) { return GridPosition(std::int64_t(i) * 3, 0, 0); }),
    options_);
  expectSoundStore(
    cloudOf(20000, millimetres(), [](std::size_t i) { return GridPosition(i % 141, 0, i / 141); }),
    options_);
  expectSoundStore(cloudOf(32768, millimetres(),
                     [](std::size_t i) { return GridPosition(i % 32, i / 32 % 32, i / 1024); }),
    options_);
}

TEST_F(StoreBuild, StoresAnOutlierFarAway)
{
  const auto cloud = [](std::size_t i)
  {
    return i == 777 ? GridPosition(3000000000, 0, 0)
                    : GridPosition(std::int64_t(i) % 100, std::int64_t(i) / 100, 0);
  };
  const auto store = expectSoundStore(cloudOf(5000, millimetres(), cloud), options_);
  ASSERT_TRUE(store);
  EXPECT_LT(store->description().levels, 8u); // no chain of nodes with one child each
}

} // namespace
} // namespace pointfront
