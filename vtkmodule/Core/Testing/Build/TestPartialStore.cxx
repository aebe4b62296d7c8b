#include "TestBuildClouds.h"

#include "pointfront/Build/BuildWatch.h"
#include "pointfront/Store/PointStore.h"
#include "pointfront/Store/StoreWriter.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <memory>
#include <set>

namespace pointfront
{
namespace
{
namespace fs = std::filesystem;
constexpr std::size_t storePoints = 30000;

/// Hills whose points have one of three classes, in patches.
std::unique_ptr<test::CloudSource> classified()
{
  const auto plain = test::hills(storePoints, 1e6);
  AttributeSchema schema = test::idSchema();
  schema.add({ "classification", ScalarType::UInt8, 1 });
  auto cloud = std::make_unique<test::CloudSource>("cloud", schema, test::millimetres(), 1000);
  for (std::size_t i = 0; i < storePoints; ++i)
  {
    const glm::dvec3& p = plain->positions()[i];
    cloud->addPosition(p);
    cloud->addValue(0, static_cast<std::uint32_t>(i));
    cloud->addValue(1, std::uint16_t(7));
    cloud->addValue(2, static_cast<std::uint8_t>(p.x < 300.0 ? 2 : p.y < 500.0 ? 5 : 6));
  }
  return cloud;
}

/// The points that a store holds of a cloud with ids.
struct Contents
{
  std::set<std::uint32_t> ids;
  std::uint64_t points = 0; ///< points of the input; more than ids: some are there twice
};

Contents contentsOf(const PointStore& store)
{
  Contents contents;
  const Hierarchy& hierarchy = *store.hierarchy();
  for (NodeIndex node = 0; node < hierarchy.nodeCount(); ++node)
  {
    if (originalPoints(hierarchy.node(node), hierarchy.refinement()) == 0)
    {
      continue;
    }
    const auto points = store.read(node, { 0 });
    EXPECT_TRUE(points) << points.error().what;
    for (std::size_t i = 0; i < points->size(); ++i, ++contents.points)
    {
      std::uint32_t id = 0;
      std::memcpy(&id, points->columns[0].data() + i * sizeof(id), sizeof(id));
      contents.ids.insert(id);
    }
  }
  return contents;
}

struct Version
{
  std::uint64_t finished = 0;
  std::shared_ptr<const PointStore> store;
};

/// Looks at each moment that there is, with all points of the cloud as its sample, or with none.
class EveryMoment final : public BuildWatch
{
public:
  EveryMoment(std::string path, PointSources sample)
    : path_(std::move(path))
    , sample_(std::move(sample))
  {
  }
  PointSources sample() override { return std::move(sample_); }
  bool due(std::size_t) override { return true; }
  void show(PartialStore& partial) override
  {
    const Result<void> done = partial.write(path_, { "test", 7, "a moment", {} });
    ASSERT_TRUE(done) << done.error().what;
    auto store = PointStore::open(path_);
    ASSERT_TRUE(store) << store.error().what;
    versions.push_back({ partial.pointsFinished(), *store });
    fs::remove(path_); // whoever has it open keeps it
  }
  std::vector<Version> versions;

private:
  std::string path_;
  PointSources sample_;
};

PointSources nothingOf(const PointSources& cloud)
{
  auto empty = std::make_unique<test::CloudSource>(
    "cloud", cloud[0]->description().schema, test::millimetres());
  return test::one(std::move(empty));
}

struct Case
{
  const char* name;
  Structure structure;
  Refinement refinement;
  Layering layering;
};

class PartialStores : public testing::TestWithParam<Case>
{
protected:
  void SetUp() override
  {
    folder_ = test::freshFolder("partial");
    options_.outputPath = (folder_ / "city.pfront").string();
    options_.structure = GetParam().structure;
    options_.refinement = GetParam().refinement;
    options_.layering = GetParam().layering;
    options_.nodePoints = 256;
    options_.threads = 1; // so that nothing finishes while a moment is looked at
    options_.memoryBytes = std::uint64_t(1) << 30;
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string momentPath() const { return (folder_ / "moment.pfront").string(); }

  std::vector<Version> versionsWith(PointSources sample)
  {
    EveryMoment watch(momentPath(), std::move(sample));
    const auto report = buildStore(cloud_, options_, {}, &watch);
    EXPECT_TRUE(report) << report.error().what;
    EXPECT_GT(watch.versions.size(), 5u);
    return std::move(watch.versions);
  }
  static void expectSound(const Version& version)
  {
    const auto verified = version.store->verify();
    ASSERT_TRUE(verified);
    EXPECT_TRUE(verified->ok) << verified->firstError;
  }

  fs::path folder_;
  BuildOptions options_;
  PointSources cloud_ = test::one(classified());
};

TEST_P(PartialStores, HoldExactlyTheFinishedPartsWithoutASample)
{
  std::set<std::uint32_t> before;
  for (const Version& version : versionsWith(nothingOf(cloud_)))
  {
    expectSound(version); // after the build, through a file that has another name now
    const Contents contents = contentsOf(*version.store);
    EXPECT_EQ(contents.points, version.finished);
    EXPECT_EQ(contents.ids.size(), version.finished);
    EXPECT_EQ(version.store->description().pointCount, version.finished);
    EXPECT_GT(version.finished, before.size());
    EXPECT_TRUE(
      std::includes(contents.ids.begin(), contents.ids.end(), before.begin(), before.end()));
    before = contents.ids;
  }
  EXPECT_GT(before.size(), storePoints / 2);
}

TEST_P(PartialStores, HoldEachPointOnceWhateverIsFinished)
{
  for (const Version& version : versionsWith(test::one(classified())))
  {
    expectSound(version);
    const Contents contents = contentsOf(*version.store);
    EXPECT_EQ(contents.points, contents.ids.size()); // none twice
    if (GetParam().structure == Structure::Octree)
    {
      EXPECT_EQ(contents.ids.size(), storePoints); // none is missing
    }
    else // where a cell is divided among parts the sample says nothing once one is finished
    {
      EXPECT_GT(contents.ids.size(), storePoints * 8 / 10);
    }
  }
}

TEST_P(PartialStores, AreJoinedSoThatEveryLevelCoversTheCloud)
{
  const std::vector<Version> versions = versionsWith(test::one(classified()));
  const PointStore& middle = *versions[versions.size() / 2].store;
  const Hierarchy& hierarchy = *middle.hierarchy();
  EXPECT_EQ(hierarchy.roots().size(), options_.layering == Layering::None ? 1u : 3u);
  Bounds top;
  for (const NodeIndex root : hierarchy.roots())
  {
    EXPECT_GT(hierarchy.node(root).pointCount, 30u);
    const auto points = middle.read(root, {});
    ASSERT_TRUE(points);
    for (const glm::u32vec3& p : points->positions)
    {
      top.add(middle.description().grid.toWorld(points->origin + GridPosition(p)));
    }
  }
  EXPECT_GT(top.size().x, 800.0); // the cloud has 1000; representatives lie inside
  EXPECT_GT(top.size().y, 800.0);
}

TEST_P(PartialStores, DoNotChangeTheStore)
{
  const auto bytes = [this]
  {
    std::ifstream file(options_.outputPath, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  versionsWith(test::one(classified()));
  const std::string watched = bytes();
  options_.overwrite = true;
  ASSERT_TRUE(buildStore(cloud_, options_));
  EXPECT_TRUE(watched == bytes());
}

TEST_P(PartialStores, StayReadableWhenTheBuildIsCancelledAndDoNotOpenAgain)
{
  class Copy final : public BuildWatch
  {
  public:
    explicit Copy(fs::path folder)
      : folder_(std::move(folder))
    {
    }
    PointSources sample() override { return test::one(classified()); }
    bool due(std::size_t) override { return !open; }
    void show(PartialStore& partial) override
    {
      const std::string path = (folder_ / "kept.pfront").string();
      ASSERT_TRUE(partial.write(path, { "test", 7, "", {} }));
      auto store = PointStore::open(path);
      ASSERT_TRUE(store) << store.error().what;
      open = *store;
    }
    std::shared_ptr<const PointStore> open;

  private:
    fs::path folder_;
  } watch(folder_);
  const auto report = buildStore(
    cloud_, options_, [&](const Progress&) { return !watch.open; }, &watch);
  if (report) // the last report came before the first moment: nothing was cancelled
  {
    ASSERT_TRUE(PointStore::open((folder_ / "kept.pfront").string()));
    fs::remove(options_.outputPath);
  }
  ASSERT_TRUE(watch.open);
  const auto verified = watch.open->verify();
  ASSERT_TRUE(verified);
  EXPECT_TRUE(verified->ok) << verified->firstError;
  const auto again = PointStore::open((folder_ / "kept.pfront").string());
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().kind, Error::Kind::Truncated);
  EXPECT_NE(again.error().what.find("its build has ended"), std::string::npos);
  std::ofstream(options_.outputPath) << std::string(5000000, 'x'); // another file of that name
  EXPECT_FALSE(PointStore::open((folder_ / "kept.pfront").string()));
}

INSTANTIATE_TEST_SUITE_P(Trees, PartialStores,
  testing::Values(Case{ "add", Structure::Octree, Refinement::Add, Layering::None },
    Case{ "replace", Structure::Octree, Refinement::Replace, Layering::None },
    Case{ "addByClass", Structure::Octree, Refinement::Add, Layering::ObjectClass },
    Case{ "kdtree", Structure::KdTree, Refinement::Add, Layering::None },
    Case{ "kdtreeByClass", Structure::KdTree, Refinement::Add, Layering::ObjectClass }),
  [](const auto& test) { return std::string(test.param.name); });

} // namespace
} // namespace pointfront
