#include "TestBuildClouds.h"

#include "pointfront/Disk/DiskEstimate.h"
#include "pointfront/Disk/SpillFile.h"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <functional>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace pointfront
{
namespace
{
namespace fs = std::filesystem;

constexpr std::uint64_t mega = 1u << 20;

/// "/a..." and "/b..." are two disks.
struct TwoDisks
{
  std::uint64_t freeOnA = 0;
  std::uint64_t freeOnB = 0;
  DiskSpace operator()(const std::string& folder) const
  {
    return folder[1] == 'a' ? DiskSpace{ 1, freeOnA } : DiskSpace{ 2, freeOnB };
  }
};

DiskEstimate estimateOf(const char* spill, std::uint64_t spillBytes)
{
  return { spill, spillBytes, "/a/out", 100 * mega, 250 * mega };
}

TEST(DiskEstimate, SpillAndStoreOnOneDiskNeedTheirSum)
{
  EXPECT_TRUE(checkDiskSpace(estimateOf("/a/tmp", 300 * mega), TwoDisks{ 400 * mega, 0 }));
  const auto refused =
    checkDiskSpace(estimateOf("/a/tmp", 300 * mega), TwoDisks{ 400 * mega - 1, 0 });
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, Error::Kind::Unwritable);
  for (const char* part : { "100 MiB, perhaps 250 MiB, in '/a/out'", "300 MiB in '/a/tmp'",
         "400 MiB are free", "--temp", "--memory" })
  {
    EXPECT_NE(refused.error().what.find(part), std::string::npos) << refused.error().what;
  }
}

TEST(DiskEstimate, EachDiskIsAskedForItsShare)
{
  const DiskEstimate estimate = estimateOf("/b/tmp", 300 * mega);
  EXPECT_TRUE(checkDiskSpace(estimate, TwoDisks{ 100 * mega, 300 * mega }));
  const auto noSpill = checkDiskSpace(estimate, TwoDisks{ 1000 * mega, 299 * mega });
  ASSERT_FALSE(noSpill);
  EXPECT_NE(noSpill.error().what.find("299 MiB are free in '/b/tmp'"), std::string::npos);
  const auto noStore = checkDiskSpace(estimate, TwoDisks{ 99 * mega, 300 * mega });
  ASSERT_FALSE(noStore);
  EXPECT_NE(noStore.error().what.find("99 MiB are free in '/a/out'"), std::string::npos);
}

TEST(DiskEstimate, WithoutSpillOnlyTheStoreCounts)
{
  EXPECT_TRUE(checkDiskSpace(estimateOf("", 0), TwoDisks{ 100 * mega, 0 }));
  EXPECT_FALSE(checkDiskSpace(estimateOf("", 0), TwoDisks{ 99 * mega, 0 }));
}

TEST(DiskEstimate, WarnsWhereTheStoreMayNotFit)
{
  const DiskEstimate estimate = estimateOf("/a/tmp", 300 * mega);
  EXPECT_EQ(diskSpaceWarning(estimate, TwoDisks{ 550 * mega, 0 }), "");
  const std::string told = diskSpaceWarning(estimate, TwoDisks{ 550 * mega - 1, 0 });
  for (const char* part : { "may not suffice", "perhaps 250 MiB", "550 MiB are free in '/a/tmp'" })
  {
    EXPECT_NE(told.find(part), std::string::npos) << told;
  }
  EXPECT_EQ(diskSpaceWarning(estimateOf("/b/tmp", 9 * mega), TwoDisks{ 250 * mega, 9 * mega }), "");
  EXPECT_NE(diskSpaceWarning(estimateOf("", 0), TwoDisks{ 249 * mega, 0 }), "");
}

TEST(DiskEstimate, EstimatesTheStoreFromBothSides)
{
  DiskEstimate estimate;
  estimateStore(estimate, 1'000'000'000, 30);
  EXPECT_EQ(estimate.storeBytes, 5'000'000'000u);
  EXPECT_EQ(estimate.likelyStoreBytes, 15'000'000'000u);
}

TEST(DiskEstimate, KnowsTheRealDisk)
{
  const DiskSpace space = diskSpaceOf(testing::TempDir());
  EXPECT_GT(space.freeBytes, 0u);
  EXPECT_LT(space.freeBytes, UINT64_MAX);
  EXPECT_EQ(diskSpaceOf("/no/such/folder").freeBytes, UINT64_MAX);
}

TEST(DiskEstimate, AddsWhatIsNeededToErrorsOfWritingOnly)
{
  const DiskEstimate estimate = estimateOf("/b/tmp", 300 * mega);
  const Error full = withEstimate(makeError(Error::Kind::Unwritable, "disk full"), estimate);
  EXPECT_NE(full.what.find("disk full (the store needs at least 100 MiB"), std::string::npos);
  EXPECT_EQ(withEstimate(makeError(Error::Kind::Cancelled, "stop"), estimate).what, "stop");
}

/// Runs `work` where no file may grow beyond `bytes`; its exit status.
int withFileLimit(rlim_t bytes, const std::function<int()>& work)
{
  const pid_t child = fork();
  if (child == 0)
  {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{ bytes, bytes };
    setrlimit(RLIMIT_FSIZE, &limit);
    _exit(work());
  }
  int status = -1;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Spills so many bytes where no file may grow beyond a third of them.
void spillMeetsTheLimit(std::size_t bytes, SpillFile::Way way)
{
  const fs::path folder = test::freshFolder("spill-limit");
  const int status = withFileLimit(bytes / 3,
    [&]
    {
      auto file = SpillFile::create(folder.string(), 3 * mega, way);
      const std::vector<std::byte> data(bytes);
      const Result<void> done = file ? (*file)->write(0, data.data(), data.size()) : file.error();
      const bool told = !done && done.error().kind == Error::Kind::Unwritable &&
        done.error().what.find("needs 3 MiB") != std::string::npos &&
        done.error().what.find(folder.string()) != std::string::npos;
      return told ? 0 : 1;
    });
  EXPECT_EQ(status, 0);
  EXPECT_TRUE(fs::is_empty(folder));
  fs::remove_all(folder);
}

TEST(SpillFile, SaysWhatWasNeededWhenTheDiskEnds)
{
  for (const std::size_t bytes : { 30000u, 2000000u })
  {
    spillMeetsTheLimit(bytes, SpillFile::Way::PastCache);
    spillMeetsTheLimit(bytes, SpillFile::Way::ThroughCache);
  }
}

/// A build whose store, or whose spill file, cannot grow: an Error with the need, nothing left.
void buildMeetsTheLimit(std::uint64_t memory, const char* need)
{
  const fs::path folder = test::freshFolder("build-limit");
  const auto cloud = test::one(test::hills(200000, 1e6));
  const int status = withFileLimit(100000,
    [&]
    {
      BuildOptions options;
      options.outputPath = (folder / "x.pfront").string();
      options.memoryBytes = memory;
      options.threads = 2;
      const auto built = buildStore(cloud, options);
      if (built || built.error().kind != Error::Kind::Unwritable)
      {
        return 1;
      }
      return built.error().what.find(need) == std::string::npos ? 2 : 0;
    });
  EXPECT_EQ(status, 0);
  EXPECT_TRUE(fs::is_empty(folder));
  fs::remove_all(folder);
}

TEST(DiskEstimate, SaysWhatWasNeededWhenTheStoreCannotGrow)
{
  buildMeetsTheLimit(std::uint64_t(1) << 30, "the store needs at least 1 MiB");
}

TEST(DiskEstimate, SaysWhatWasNeededWhenTheSpillCannotGrow)
{
  buildMeetsTheLimit(std::uint64_t(12) << 20, "do not fit in memory need");
}

} // namespace
} // namespace pointfront
