#include "BuiltStore.h"
#include "TestBuildClouds.h"

#include "pointfront/Build/StoreBuilder.h"
#include "pointfront/Preview/BuildPreview.h"
#include "pointfront/Tiles/StoredCloudFormats.h"
#include "vtkPointFrontStore.h"

#include <vtkNew.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

std::string build(const std::string& name, std::size_t points)
{
  return builtStore(name, hills(points, 1e6), BuildOptions());
}

TEST(StoreHandle, IsOneObjectForAFileUntilTheLastReferenceIsGone)
{
  const std::string path = build("one_object", 3000);
  vtkStdString error;
  auto first = vtkPointFrontStore::Open(path.c_str(), error);
  ASSERT_NE(first, nullptr) << error;
  EXPECT_EQ(first->GetNumberOfPoints(), 3000);
  EXPECT_EQ(first->GetNumberOfAttributes(), 2);
  EXPECT_STREQ(first->GetAttributeName(1), "intensity");
  EXPECT_EQ(first->GetAttributeName(2), nullptr);
  ASSERT_EQ(first->GetNumberOfObjectClasses(), 1);
  EXPECT_STREQ(first->GetObjectClassName(0), "all");
  EXPECT_EQ(first->GetObjectClassNumber(0), -1) << "as the mapper calls it";
  EXPECT_EQ(first->GetObjectClassName(1), nullptr);
  EXPECT_EQ(first->GetObjectClassNumber(1), -1);

  const std::string other =
    (std::filesystem::path(path).parent_path() / "." / std::filesystem::path(path).filename())
      .string();
  EXPECT_EQ(vtkPointFrontStore::Open(other.c_str(), error), first); // another spelling
  first->SetHostMemoryBudget(123456);
  first = nullptr;
  const auto again = vtkPointFrontStore::Open(path.c_str(), error);
  EXPECT_EQ(again->GetHostMemoryBudget(), vtkTypeInt64(1) << 30); // a new one
}

TEST(StoreHandle, AStoreThatIsBuiltAnewIsAnotherStore)
{
  const std::string path = build("anew", 3000);
  vtkStdString error;
  const auto old = vtkPointFrontStore::Open(path.c_str(), error);
  build("anew", 4000);
  const auto fresh = vtkPointFrontStore::Open(path.c_str(), error);
  ASSERT_NE(fresh, nullptr) << error;
  EXPECT_NE(fresh, old);
  EXPECT_EQ(old->GetNumberOfPoints(), 3000);
  EXPECT_EQ(fresh->GetNumberOfPoints(), 4000);
}

TEST(StoreHandle, SaysWhatIsWrongWithAFile)
{
  vtkStdString error;
  EXPECT_EQ(vtkPointFrontStore::Open(nullptr, error), nullptr);
  EXPECT_NE(error.find("file name"), std::string::npos);
  const std::string missing = ::testing::TempDir() + "nowhere.pfront";
  EXPECT_EQ(vtkPointFrontStore::Open(missing.c_str(), error), nullptr);
  EXPECT_NE(error.find("nowhere.pfront"), std::string::npos);
  const std::string folder = ::testing::TempDir() + "folder_without_stores";
  std::filesystem::create_directories(folder);
  EXPECT_EQ(vtkPointFrontStore::Open(folder.c_str(), error), nullptr);
  EXPECT_FALSE(error.empty());
  const std::string text = ::testing::TempDir() + "text.pfront";
  std::ofstream(text) << "x y z\n";
  EXPECT_EQ(vtkPointFrontStore::Open(text.c_str(), error), nullptr);
  EXPECT_NE(error.find("text.pfront"), std::string::npos);
}

TEST(StoreHandle, TheNameTravelsInFieldData)
{
  vtkNew<vtkPolyData> data;
  EXPECT_EQ(vtkPointFrontStore::GetStoreName(data), "");
  EXPECT_EQ(vtkPointFrontStore::GetStoreName(nullptr), "");
  vtkPointFrontStore::SetStoreName(data, "first.pfront");
  vtkPointFrontStore::SetStoreName(data, "a/b.pfront");
  vtkNew<vtkPolyData> shallow;
  shallow->ShallowCopy(data);
  vtkNew<vtkPolyData> deep;
  deep->DeepCopy(data);
  EXPECT_EQ(vtkPointFrontStore::GetStoreName(shallow), "a/b.pfront");
  EXPECT_EQ(vtkPointFrontStore::GetStoreName(deep), "a/b.pfront");
}

TEST(StoreHandle, BoundsAreTight)
{
  vtkStdString error;
  const std::string path = builtStore("tight",
    cloudOf(3, millimetres(),
      [](std::size_t i) { return GridPosition(1000 * i, -500 * static_cast<int>(i), 7); }));
  const auto store = vtkPointFrontStore::Open(path.c_str(), error);
  double bounds[6];
  store->GetBounds(bounds);
  const double expected[6] = { 0.0, 2.0, -1.0, 0.0, 0.007, 0.007 };
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_DOUBLE_EQ(bounds[i], expected[i]);
  }
}

TEST(StoreHandle, APreviewHasSuccessors)
{
  const std::filesystem::path folder = freshFolder("preview-handle");
  BuildOptions options;
  options.outputPath = (folder / "city.pfront").string();
  options.memoryBytes = std::uint64_t(1) << 30;
  PreviewOptions wish;
  wish.leastPoints = 1000;
  wish.leastSeconds = 0.0;
  const PointSources cloud = one(hills(40000, 1e6));
  auto preview = BuildPreview::create(cloud, options, wish);
  ASSERT_TRUE(preview);
  (*preview)->showOverview(cloud);
  const std::string name = (*preview)->path();
  vtkStdString error;
  const auto early = vtkPointFrontStore::Open(name.c_str(), error);
  ASSERT_NE(early, nullptr) << error;
  EXPECT_TRUE(early->IsPreview());
  EXPECT_LT(early->GetNumberOfPoints(), 40000);
  EXPECT_FALSE(early->HasSuccessor());
  EXPECT_EQ(early->GetSuccessor(), nullptr);

  std::filesystem::last_write_time(name,
    std::filesystem::last_write_time(name) -
      std::chrono::hours(1)); // a clock too coarse to tell two versions apart
  (*preview)->showOverview(cloud);
  const auto later = early->GetSuccessor();
  ASSERT_NE(later, nullptr);
  EXPECT_NE(later, early);
  EXPECT_TRUE(later->IsPreview());

  ASSERT_TRUE(buildStore(cloud, options));
  preview.value().reset();
  std::this_thread::sleep_for(std::chrono::milliseconds(300)); // it looks four times a second
  EXPECT_TRUE(early->HasSuccessor());
  const auto finished = later->GetSuccessor();
  ASSERT_NE(finished, nullptr);
  EXPECT_FALSE(finished->IsPreview());
  EXPECT_EQ(finished->GetNumberOfPoints(), 40000);
  EXPECT_EQ(vtkPointFrontStore::Open(name.c_str(), error), finished); // the name leads there
  EXPECT_FALSE(finished->HasSuccessor());
  EXPECT_EQ(finished->GetSuccessor(), nullptr);
}

TEST(StoreHandle, StoresShareTheMemoryOfTheProcess)
{
  const vtkTypeInt64 before = vtkPointFrontStore::GetProcessMemoryBudget();
  vtkStdString error;
  const auto one = vtkPointFrontStore::Open(build("share_one", 3000).c_str(), error);
  const auto two = vtkPointFrontStore::Open(build("share_two", 3000).c_str(), error);
  ASSERT_NE(one, nullptr);
  ASSERT_NE(two, nullptr);
  EXPECT_EQ(one->GetHostMemoryBudget(), before);
  // Never set: a store may ask for more than there would be, as programs did before.
  one->SetHostMemoryBudget(2 * before);
  EXPECT_EQ(vtkPointFrontStore::GetProcessMemoryBudget(), 2 * before);
  EXPECT_EQ(two->GetHostMemoryBudget(), 2 * before);
  // Set: it holds, whatever a store asks for.
  vtkPointFrontStore::SetProcessMemoryBudget(before);
  EXPECT_EQ(one->GetHostMemoryBudget(), before);
  two->SetHostMemoryBudget(3 * before);
  EXPECT_EQ(two->GetHostMemoryBudget(), before);
  two->SetHostMemoryBudget(before / 4);
  EXPECT_EQ(two->GetHostMemoryBudget(), before / 4);
  EXPECT_EQ(one->GetHostMemoryBudget(), before);
}

/// Stored clouds on a disk that answers only when it is let.
class Hanging final : public StoredCloudFormat
{
public:
  std::string name() const override { return "hanging (test)"; }
  bool accepts(const std::string& path) const override
  {
    return std::filesystem::path(path).extension() == ".hanging";
  }
  Result<std::shared_ptr<const StoredCloud>> open(const std::string&) const override
  {
    ++opened;
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [&] { return answers_; });
    return makeError(Error::Kind::Unreadable, "the share is gone");
  }
  void answer()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    answers_ = true;
    changed_.notify_all();
  }
  mutable std::atomic<int> opened{ 0 };

private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  bool answers_ = false;
};

TEST(StoreHandle, AHungShareStopsNobodyElse)
{
  const auto share = std::make_shared<Hanging>();
  StoredCloudFormats::ofProcess().add(share);
  const std::string hung = ::testing::TempDir() + "far.hanging";
  std::ofstream(hung) << "far";
  const std::string path = build("near", 3000);
  vtkStdString hungError;
  std::thread waiting(
    [&] { EXPECT_EQ(vtkPointFrontStore::Open(hung.c_str(), hungError), nullptr); });
  while (share->opened == 0)
  {
    std::this_thread::yield();
  }
  std::atomic<bool> done{ false };
  std::thread working(
    [&]
    {
      vtkStdString error;
      for (int i = 0; i < 3; ++i) // opens, is found again, closes
      {
        const auto store = vtkPointFrontStore::Open(path.c_str(), error);
        ASSERT_NE(store, nullptr) << error;
        EXPECT_EQ(vtkPointFrontStore::Open(path.c_str(), error), store);
        EXPECT_EQ(vtkPointFrontStore::GetNumberOfPointsOfAllStores(), 3000);
      }
      done = true;
    });
  for (int i = 0; i < 1000 && !done; ++i)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_TRUE(done) << "while another file is being opened";
  share->answer();
  working.join();
  waiting.join();
  EXPECT_EQ(hungError, "the share is gone");
}

TEST(StoreHandle, ManyThreadsOpenAndCloseOneFile)
{
  const std::string path = build("shared", 3000);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
  {
    threads.emplace_back(
      [&path]
      {
        vtkStdString error;
        for (int i = 0; i < 200; ++i)
        {
          const auto store = vtkPointFrontStore::Open(path.c_str(), error);
          ASSERT_NE(store, nullptr) << error;
          EXPECT_EQ(store->GetNumberOfPoints(), 3000);
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(vtkPointFrontStore::GetNumberOfPointsOfAllStores(), 0);
}

} // namespace
