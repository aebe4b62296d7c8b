#include "Sanitizers.h"
#include "TestBuildClouds.h"

#include "pointfront/Store/PointStore.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <tuple>
#include <vector>

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
    folder_ = freshFolder(test->name());
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
    return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
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
    const auto columns = store.read(n, { 0, 1 });
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
  const auto report = buildStore(sources, options);
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
    const auto report = buildStore(sources, options_);
    EXPECT_TRUE(report) << report.error().what;
    return std::make_pair(report ? report->spilledBytes : 0, bytes());
  };
  const auto [spilledNot, reference] = build(1, 1u << 30);
  EXPECT_EQ(spilledNot, 0u);
  EXPECT_GT(reference.size(), 100000u);
  // ThreadSanitizer takes seconds for each build, and sees the same threads in fewer.
  using Numbers = std::vector<unsigned>;
  const bool few = test::underThreadSanitizer();
  for (const unsigned threads : few ? Numbers{ 4 } : Numbers{ 2, 4 })
  {
    EXPECT_TRUE(build(threads, 1u << 30).second == reference) << threads << " threads";
  }
  for (const std::uint64_t kibibytes : few ? Numbers{ 150, 1000 } : Numbers{ 150, 400, 1000 })
  {
    for (const unsigned threads : few ? Numbers{ 4 } : Numbers{ 1, 2, 4 })
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

TEST_F(StoreBuild, KeepsTinyAndHugeExtentsAndFarOrigins)
{
  expectSoundStore(hills(5000, 1000.0, { glm::dvec3(1e-9), glm::dvec3(0.5) }), options_); // 1e-6
  expectSoundStore(hills(5000, 1e9, { glm::dvec3(1.0), glm::dvec3(0.0) }), options_); // 1e9
  expectSoundStore(hills(5000, 1e6, millimetres(glm::dvec3(1e7, -2e7, 3e6))), options_);
}

TEST_F(StoreBuild, KeepsCubesOnAnisotropicGrids)
{
  const QuantisationGrid grid{ { 0.01, 0.01, 0.001 }, { 500000.0, 4000000.0, 0.0 } };
  expectSoundStore(hills(20000, 50000.0, grid), options_);
}

TEST_F(StoreBuild, KeepsAxesWhoseStepsAreTheirExtentDividedBy31Bits)
{
  const glm::dvec3 extent(1000.0, 700.0, 90.0);
  const QuantisationGrid grid{ extent / 2147483647.0, glm::dvec3(500000.0, 4000000.0, 100.0) };
  const auto cloud = [&]
  {
    return cloudOf(20000, grid, [](std::size_t i) { // the corners, and points all over
      constexpr std::int64_t end = 2147483647;
      const auto n = static_cast<std::int64_t>(i);
      const GridPosition inside(n * 104729 % end, n * 1299709 % end, n * 15485863 % end);
      return i == 0 ? GridPosition(0) : i == 1 ? GridPosition(end) : inside;
    });
  };
  expectSoundStore(cloud(), options_);
  auto lying = cloud(); // bounds that say nothing: known only when all points are read
  lying->editDescription().declaredBounds = Bounds{};
  expectSoundStore(std::move(lying), options_);
}

TEST_F(StoreBuild, TellsHowManyPointsAreLeftOutAndRefusesInputsWithNoneLeft)
{
  const auto none = []
  {
    auto cloud = std::make_unique<CloudSource>("nothing", AttributeSchema{}, std::nullopt);
    cloud->addPosition(glm::dvec3(std::nan("")));
    cloud->addPosition(glm::dvec3(1e300, 2.0, 3.0));
    return cloud;
  };
  const auto refused = buildStore(one(none()), options_);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("none of its 2 points"), std::string::npos)
    << refused.error().what;
  EXPECT_EQ(filesLeft(), 0u);

  std::vector<std::unique_ptr<PointSource>> sources;
  sources.push_back(hills(1000, 1000.0));
  sources.push_back(none());
  EXPECT_FALSE(buildStore(sources, options_));
  options_.onFault = OnFault::Skip;
  const auto report = buildStore(sources, options_);
  ASSERT_TRUE(report) << report.error().what;
  EXPECT_EQ(report->pointsStored, 1000u);
  ASSERT_EQ(report->inputsSkipped.size(), 1u);
  EXPECT_EQ(report->inputsSkipped[0].path, "nothing");
  const auto& warnings = report->warnings;
  EXPECT_NE(std::find(warnings.begin(), warnings.end(),
              "2 of 1002 points are left out: 1 not a number, 1 outside the grid's range."),
    warnings.end());
}

TEST_F(StoreBuild, RefusesAnExtentBeyondTheGridAndSaysWhatFits)
{
  const auto sources = one(cloudOf(
    2, millimetres(), [](std::size_t i) { return GridPosition(std::int64_t(i) << 33, 0, 0); }));
  const auto refused = buildStore(sources, options_);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, Error::Kind::BadArgument);
  EXPECT_NE(refused.error().what.find("a precision of 0.01 fits"), std::string::npos)
    << refused.error().what;
  EXPECT_EQ(filesLeft(), 0u);
  options_.precision = 0.01;
  EXPECT_TRUE(buildStore(sources, options_));
}

TEST_F(StoreBuild, RejectsWhatIsNoPositionAndCountsWhy)
{
  auto cloud = hills(5000, 10000.0);
  const double bad[] = { std::nan(""), HUGE_VAL, -HUGE_VAL, 1e300 };
  for (std::uint32_t i = 0; i < 40; ++i)
  {
    glm::dvec3 position(1.0);
    position[static_cast<int>(i % 3)] = bad[i % 4];
    cloud->addPosition(position);
    cloud->addValue(0, 5000 + i);
    cloud->addValue(1, std::uint16_t(0));
  }
  cloud->addPosition({ 1.0, 1.0, 0.0 });
  cloud->addValue(0, std::uint32_t(5040));
  cloud->addValue(1, std::uint16_t(9));
  const auto report = buildStore(one(std::move(cloud)), options_);
  ASSERT_TRUE(report) << report.error().what;
  EXPECT_EQ(report->pointsRead, 5041u);
  EXPECT_EQ(report->pointsStored, 5001u);
  const std::map<std::string, std::uint64_t> expected{ { "not a number", 10 }, { "infinite", 20 },
    { "outside the grid's range", 10 } };
  EXPECT_EQ(report->pointsRejected, expected);
  const auto points = pointsOf(**PointStore::open(options_.outputPath));
  EXPECT_EQ(points.back(), Identified(5040, 1000, 1000, 0, 9)); // values moved with their points
}

TEST_F(StoreBuild, LeavesNothingWhenCancelled)
{
  options_.memoryBytes = 400 << 10;
  const auto sources = one(hills(60000, 100000.0));
  for (const char* phase : { "reading", "sorting", "building" })
  {
    bool met = false;
    const auto cancelled = buildStore(sources, options_,
      [&](const Progress& progress)
      {
        met = met || std::string(progress.phase) == phase;
        return !met;
      });
    ASSERT_FALSE(cancelled) << phase;
    EXPECT_TRUE(met) << phase;
    EXPECT_EQ(cancelled.error().kind, Error::Kind::Cancelled);
    EXPECT_EQ(filesLeft(), 0u) << phase;
  }
}

TEST_F(StoreBuild, TellsProgressThatNeverFalls)
{
  double last = 0.0;
  std::vector<std::string> phases;
  const auto report = buildStore(one(hills(60000, 100000.0)), options_,
    [&](const Progress& progress)
    {
      EXPECT_GE(progress.fraction, last);
      EXPECT_LE(progress.fraction, 1.0);
      EXPECT_LE(progress.done, progress.total);
      last = progress.fraction;
      if (phases.empty() || phases.back() != progress.phase)
      {
        phases.push_back(progress.phase);
      }
      return true;
    });
  ASSERT_TRUE(report);
  EXPECT_EQ(phases, (std::vector<std::string>{ "reading", "sorting", "building" }));
}

TEST_F(StoreBuild, KeepsAnExistingOutputUnlessAllowed)
{
  std::ofstream(options_.outputPath) << "precious";
  options_.overwrite = false;
  const auto refused = buildStore(one(hills(1000, 1000.0)), options_);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("is there already"), std::string::npos);
  EXPECT_EQ(bytes(), "precious");
  options_.overwrite = true; // stores only
  EXPECT_FALSE(buildStore(one(hills(1000, 1000.0)), options_));
  EXPECT_EQ(bytes(), "precious");
  std::filesystem::remove(options_.outputPath);
  for (int i = 0; i < 2; ++i)
  {
    EXPECT_TRUE(buildStore(one(hills(1000, 1000.0)), options_));
    EXPECT_TRUE(PointStore::open(options_.outputPath));
  }
}

TEST_F(StoreBuild, SaysThatAFolderCannotBeWritten)
{
  options_.outputPath = (folder_ / "absent" / "cloud.pfront").string();
  const auto noFolder = buildStore(one(hills(1000, 1000.0)), options_);
  ASSERT_FALSE(noFolder);
  EXPECT_NE(noFolder.error().what.find("absent"), std::string::npos) << noFolder.error().what;
  options_.outputPath = "/proc/cloud.pfront"; // nobody, not even root, makes files there
  const auto readOnly = buildStore(one(hills(1000, 1000.0)), options_);
  ASSERT_FALSE(readOnly);
  EXPECT_EQ(readOnly.error().kind, Error::Kind::Unwritable);
  options_.outputPath = (folder_ / "cloud.pfront").string();
  options_.temporaryFolder = "/proc";
  options_.memoryBytes = 150 << 10;
  const auto noSpill = buildStore(one(hills(60000, 100000.0)), options_);
  ASSERT_FALSE(noSpill);
  EXPECT_EQ(noSpill.error().kind, Error::Kind::Unwritable);
  EXPECT_EQ(filesLeft(), 0u);
}

TEST_F(StoreBuild, StopsWhereASourceBreaks)
{
  for (const unsigned threads : { 1u, 4u })
  {
    auto cloud = hills(60000, 100000.0);
    cloud->failAt(37);
    options_.threads = threads;
    const auto failed = buildStore(one(std::move(cloud)), options_);
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().kind, Error::Kind::Truncated);
    EXPECT_NE(failed.error().what.find("byte 4711"), std::string::npos);
    EXPECT_EQ(filesLeft(), 0u);
  }
}

TEST_F(StoreBuild, RefusesImpossibleOptions)
{
  EXPECT_FALSE(buildStore({}, options_));
  options_.memoryBytes = 1000;
  const auto tooLittle = buildStore(one(hills(60000, 100000.0)), options_);
  ASSERT_FALSE(tooLittle);
  EXPECT_EQ(tooLittle.error().kind, Error::Kind::NoMemory);
  options_.memoryBytes = 0;
  options_.nodePoints = 1;
  EXPECT_FALSE(buildStore(one(hills(1000, 1000.0)), options_));
  options_.nodePoints = 256;
  options_.precision = -1.0;
  EXPECT_FALSE(buildStore(one(hills(1000, 1000.0)), options_));
  EXPECT_EQ(filesLeft(), 0u);
}

TEST_F(StoreBuild, DoesNotTrustDeclaredBounds)
{
  const auto reference = expectSoundStore(hills(20000, 100000.0), options_);
  ASSERT_TRUE(reference);
  const std::string expected = bytes();
  Bounds lies[3];
  lies[1].add(glm::dvec3(0.0));
  lies[2].add(glm::dvec3(-1e12));
  lies[2].add(glm::dvec3(1e12));
  for (const Bounds& lie : lies)
  {
    auto cloud = hills(20000, 100000.0);
    cloud->editDescription().declaredBounds = lie;
    ASSERT_TRUE(expectSoundStore(std::move(cloud), options_));
    EXPECT_TRUE(bytes() == expected);
  }
}

} // namespace
} // namespace pointfront
