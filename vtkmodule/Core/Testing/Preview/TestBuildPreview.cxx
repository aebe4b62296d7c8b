#include "FilesInTheMaking.h"
#include "TestBuildClouds.h"

#include "pointfront/Preview/BuildPreview.h"
#include "pointfront/Store/PointStore.h"
#include "pointfront/Store/PreviewRecord.h"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <iterator>
#include <sys/wait.h>

namespace pointfront
{
namespace
{
namespace fs = std::filesystem;
constexpr std::size_t cloudPoints = 120000;

class BuildPreviews : public testing::Test
{
protected:
  void SetUp() override
  {
    folder_ = test::freshFolder("preview");
    build_.outputPath = (folder_ / "city.pfront").string();
    build_.threads = 2;
    build_.memoryBytes = std::uint64_t(1) << 30;
    wish_.leastPoints = 1000;
    wish_.leastSeconds = 0.0;
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// Builds as a program does: overview, watched sources, build.
  Result<BuildReport> buildWithPreview(const ProgressFunction& progress = {})
  {
    auto preview = BuildPreview::create(cloud_, build_, wish_);
    if (!preview)
    {
      return preview.error();
    }
    (*preview)->showOverview(cloud_, progress);
    Result<BuildReport> report = (*preview)->build(cloud_, build_, progress);
    EXPECT_TRUE((*preview)->warnings().empty()) << (*preview)->warnings().front();
    return report;
  }
  std::vector<std::string> entries() const
  {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_))
    {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
  /// Small parts, each of which is shown by the one thread that builds: another would go on
  /// meanwhile. But for the overview, no version that shows none: those come from a thread of their
  /// own, and while it writes one, finished parts are not shown.
  void everyVersion()
  {
    build_.nodePoints = 512;
    build_.threads = 1;
    wish_.shareOfTime = 1e9;
    wish_.leastSeconds = 1e9;
  }
  std::string previewPath() const { return (folder_ / "city.preview.pfront").string(); }
  /// Leaves what a build leaves that is killed once `condition` holds for its preview.
  void killWhen(bool (*condition)(const PreviewRecord&))
  {
    const pid_t child = fork();
    if (child == 0)
    {
      wish_.shown = [condition](const std::string& path)
      {
        const auto store = PointStore::open(path);
        if (store && condition(*previewRecordOf((*store)->description().metadata)))
        {
          raise(SIGKILL); // no destructor runs
        }
      };
      const auto never = buildWithPreview();
      _exit(1);
    }
    int status = -1;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    ASSERT_TRUE(fs::exists(previewPath()));
  }

  fs::path folder_;
  BuildOptions build_;
  PreviewOptions wish_;
  PointSources cloud_ = test::one(test::hills(cloudPoints, 1e6));
};

std::string bytesOf(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

TEST_F(BuildPreviews, OpenWhileTheBuildRunsAndGrow)
{
  std::vector<PreviewRecord> versions;
  std::vector<std::shared_ptr<const PointStore>> stores;
  std::mutex mutex;
  wish_.shown = [&](const std::string& path)
  {
    const std::lock_guard<std::mutex> lock(mutex);
    EXPECT_EQ(path, previewPath());
    auto store = PointStore::open(path);
    ASSERT_TRUE(store) << store.error().what;
    const auto record = previewRecordOf((*store)->description().metadata);
    ASSERT_TRUE(record);
    versions.push_back(*record);
    stores.push_back(*store);
  };
  const auto report = buildWithPreview();
  ASSERT_TRUE(report) << report.error().what;
  EXPECT_EQ(entries(), std::vector<std::string>{ "city.pfront" });
  ASSERT_FALSE(versions.empty());
  EXPECT_EQ(versions.front().pointsRead, 0u);
  for (std::size_t v = 0; v < versions.size(); ++v)
  {
    EXPECT_EQ(versions[v].storeName, "city.pfront");
    EXPECT_EQ(versions[v].pointsExpected, cloudPoints);
    EXPECT_LE(versions[v].pointsRead, cloudPoints); // although some chunks are read twice
    // Held by us, the version stays readable although it has been replaced and removed.
    const auto verified = stores[v]->verify();
    ASSERT_TRUE(verified);
    EXPECT_TRUE(verified->ok) << verified->firstError;
    EXPECT_GT(verified->pointsChecked, 1000u);
    // A slow build finds the time for versions that show finished parts in full.
    EXPECT_GE(verified->pointsChecked, versions[v].pointsFinished);
    EXPECT_LT(verified->pointsChecked, versions[v].pointsFinished + 30000u);
    const auto state = [&](std::size_t version)
    { return std::make_pair(versions[version].pointsRead, versions[version].pointsFinished); };
    EXPECT_TRUE(v == 0 || state(v) > state(v - 1));
  }
  // The first shows the whole extent already.
  const Bounds all = (*PointStore::open(build_.outputPath))->description().bounds;
  const Bounds first = stores.front()->description().bounds;
  EXPECT_GT(first.size().x, 0.8 * all.size().x);
  EXPECT_GT(first.size().y, 0.8 * all.size().y);
}

TEST_F(BuildPreviews, ComeAgainWhenEverythingIsRead)
{
  std::atomic<std::uint64_t> last{ 0 };
  std::atomic<int> versions{ 0 };
  wish_.shown = [&](const std::string& path)
  {
    const auto store = PointStore::open(path);
    ASSERT_TRUE(store);
    last = previewRecordOf(store.value()->description().metadata)->pointsRead;
    ++versions;
  };
  auto preview = BuildPreview::create(cloud_, build_, wish_);
  ASSERT_TRUE(preview);
  (*preview)->showOverview(cloud_);
  const PointSources watched = (*preview)->watched(cloud_);
  PointBatch batch;
  for (std::uint64_t chunk = 0; chunk < watched[0]->chunkCount(); ++chunk)
  {
    ASSERT_TRUE(watched[0]->read(chunk, batch));
  }
  for (int wait = 0; wait < 600 && last < cloudPoints; ++wait)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_EQ(last, cloudPoints);
  EXPECT_GE(versions, 2);
}

TEST_F(BuildPreviews, CountAChunkThatIsReadAgainOnce)
{
  std::atomic<std::uint64_t> last{ 0 };
  wish_.shown = [&](const std::string& path)
  {
    const auto store = PointStore::open(path);
    ASSERT_TRUE(store);
    last = previewRecordOf(store.value()->description().metadata)->pointsRead;
  };
  auto preview = BuildPreview::create(cloud_, build_, wish_);
  ASSERT_TRUE(preview);
  const PointSources watched = (*preview)->watched(cloud_);
  PointBatch batch;
  for (std::uint64_t again = 0; again < watched[0]->chunkCount(); ++again)
  {
    ASSERT_TRUE(watched[0]->read(0, batch));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(100)); // enough to show too early
  EXPECT_EQ(last, 0u);
  for (std::uint64_t chunk = 0; chunk < watched[0]->chunkCount(); ++chunk)
  {
    ASSERT_TRUE(watched[0]->readSteps(chunk, batch));
  }
  for (int wait = 0; wait < 600 && last == 0; ++wait)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_EQ(last, cloudPoints); // without an overview the one version comes at the end
}

TEST_F(BuildPreviews, DoNotChangeTheStore)
{
  ASSERT_TRUE(buildWithPreview());
  const std::string with = bytesOf(build_.outputPath);
  build_.overwrite = true;
  ASSERT_TRUE(buildStore(cloud_, build_));
  EXPECT_TRUE(with == bytesOf(build_.outputPath));
}

TEST_F(BuildPreviews, AreNotThereForSmallInputsOrWithoutAWish)
{
  wish_.shown = [](const std::string& path) { ADD_FAILURE() << path; };
  wish_.leastPoints = cloudPoints + 1;
  ASSERT_TRUE(buildWithPreview());
  wish_ = {};
  wish_.wanted = false;
  wish_.leastPoints = 0;
  build_.overwrite = true;
  ASSERT_TRUE(buildWithPreview());
}

TEST_F(BuildPreviews, LeaveNothingWhenTheBuildIsCancelled)
{
  const auto report =
    buildWithPreview([](const Progress& state) { return std::string(state.phase) != "sorting"; });
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().kind, Error::Kind::Cancelled);
  EXPECT_TRUE(entries().empty());
}

TEST_F(BuildPreviews, RefineAsPartsFinish)
{
  everyVersion();
  std::vector<PreviewRecord> versions;
  std::vector<std::shared_ptr<const PointStore>> stores;
  std::mutex mutex;
  wish_.shown = [&](const std::string& path)
  {
    const std::lock_guard<std::mutex> lock(mutex);
    auto store = PointStore::open(path);
    ASSERT_TRUE(store) << store.error().what;
    versions.push_back(*previewRecordOf((*store)->description().metadata));
    stores.push_back(*store);
  };
  const auto report = buildWithPreview();
  ASSERT_TRUE(report) << report.error().what;
  EXPECT_EQ(entries(), std::vector<std::string>{ "city.pfront" });
  EXPECT_GT(versions.back().pointsFinished, cloudPoints / 2);
  std::size_t finishing = 0;
  for (std::size_t v = 1; v < versions.size(); ++v)
  {
    const bool more = versions[v].pointsFinished > versions[v - 1].pointsFinished;
    EXPECT_TRUE(more || versions[v].pointsFinished == 0);
    finishing += more ? 1u : 0u;
    // Finished parts in full, and of the others no more than the sample, of 10,000 points.
    const std::uint64_t points = stores[v]->description().pointCount;
    EXPECT_GE(points, versions[v].pointsFinished);
    EXPECT_LE(points, versions[v].pointsFinished + 10300);
    const auto verified = stores[v]->verify();
    ASSERT_TRUE(verified);
    EXPECT_TRUE(verified->ok) << verified->firstError;
  }
  EXPECT_GT(finishing, 5u);
}

TEST_F(BuildPreviews, KeepToTheirShareOfTheTime)
{
  build_.nodePoints = 512;
  build_.threads = 1;
  wish_.shareOfTime = 0.0;
  std::atomic<int> finishing{ 0 };
  wish_.shown = [&](const std::string& path)
  {
    const auto store = PointStore::open(path);
    ASSERT_TRUE(store);
    const auto record = previewRecordOf((*store)->description().metadata);
    finishing += record->pointsFinished > 0 ? 1 : 0;
  };
  ASSERT_TRUE(buildWithPreview());
  EXPECT_EQ(finishing, 0);
  wish_.shareOfTime = 1.0; // a version may take as long as what was built since the one before
  build_.overwrite = true;
  ASSERT_TRUE(buildWithPreview());
  EXPECT_GE(finishing, 1);
  EXPECT_LT(finishing, 20); // there are some 60 parts
}

TEST_F(BuildPreviews, OfAKilledBuildWithFinishedPartsGoWithTheNext)
{
  everyVersion();
  killWhen([](const PreviewRecord& record) { return record.pointsFinished > cloudPoints / 3; });
  const std::vector<std::string> killed = filesInTheMaking(build_.outputPath);
  ASSERT_EQ(killed.size(), 1u);
  EXPECT_EQ(entries(),
    (std::vector<std::string>{ fs::path(killed[0]).filename().string(), "city.preview.pfront" }));
  const auto left = PointStore::open(previewPath());
  ASSERT_FALSE(left);
  EXPECT_EQ(left.error().kind, Error::Kind::Truncated);
  EXPECT_NE(left.error().what.find("preview of a build that has ended"), std::string::npos);
  EXPECT_FALSE(PointStore::open(killed[0]));
  ASSERT_TRUE(buildWithPreview());
  EXPECT_EQ(entries(), std::vector<std::string>{ "city.pfront" });
}

TEST_F(BuildPreviews, OfAKilledBuildDoNotOpenAndGoWithTheNext)
{
  killWhen([](const PreviewRecord&) { return true; });
  const auto left = PointStore::open(previewPath());
  ASSERT_FALSE(left);
  EXPECT_EQ(left.error().kind, Error::Kind::Truncated);
  EXPECT_NE(left.error().what.find("preview of a build that has ended"), std::string::npos);
  wish_.wanted = false; // also a build that shows none cleans up
  ASSERT_TRUE(buildWithPreview());
  EXPECT_EQ(entries(), std::vector<std::string>{ "city.pfront" });
}

TEST_F(BuildPreviews, OfARunningBuildAreLeftAlone)
{
  auto first = BuildPreview::create(cloud_, build_, wish_);
  ASSERT_TRUE(first);
  (*first)->showOverview(cloud_);
  ASSERT_TRUE(fs::exists(previewPath()));
  const auto second = BuildPreview::create(cloud_, build_, wish_);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().kind, Error::Kind::Unwritable);
  EXPECT_NE(second.error().what.find("another build"), std::string::npos);
  EXPECT_TRUE(PointStore::open(previewPath()));
}

TEST_F(BuildPreviews, NeverReplaceWhatIsNoPreview)
{
  std::ofstream(previewPath()) << "mine";
  const auto refused = BuildPreview::create(cloud_, build_, wish_);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("city.preview.pfront"), std::string::npos);
  EXPECT_EQ(bytesOf(previewPath()), "mine");
  fs::rename(previewPath(), previewPath() + ".next");
  EXPECT_FALSE(BuildPreview::create(cloud_, build_, wish_));
  EXPECT_EQ(bytesOf(previewPath() + ".next"), "mine");
}

TEST_F(BuildPreviews, ThatCannotBeWrittenAreAWarning)
{
  build_.outputPath = (folder_ / "none" / "city.pfront").string();
  const auto preview = BuildPreview::create(cloud_, build_, wish_);
  ASSERT_TRUE(preview);
  (*preview)->showOverview(cloud_);
  ASSERT_EQ((*preview)->warnings().size(), 1u);
  EXPECT_NE((*preview)->warnings().front().find("does not exist"), std::string::npos);
}

TEST(PreviewRecord, TravelsAsMetadata)
{
  const PreviewRecord record{ "city.pfront", std::uint64_t(1) << 40, 12345, 678 };
  const auto back = previewRecordOf({ { "LASF_Projection", 1, "", {} }, previewMetadata(record) });
  ASSERT_TRUE(back);
  EXPECT_EQ(back->storeName, record.storeName);
  EXPECT_EQ(back->pointsExpected, record.pointsExpected);
  EXPECT_EQ(back->pointsRead, record.pointsRead);
  EXPECT_EQ(back->pointsFinished, record.pointsFinished);
  EXPECT_FALSE(previewRecordOf({}));
  EXPECT_FALSE(previewRecordOf({ { "pointfront", 1, "", std::vector<std::byte>(23) } }));
}

TEST(PreviewRecord, HasANameBesideTheStore)
{
  EXPECT_EQ(previewPathOf("a/city.pfront"), "a/city.preview.pfront");
  EXPECT_EQ(previewPathOf("city"), "city.preview.pfront");
  EXPECT_EQ(storePathOfPreview("a/city.preview.pfront"), "a/city.pfront");
  EXPECT_FALSE(storePathOfPreview("a/city.pfront"));
}

} // namespace
} // namespace pointfront
