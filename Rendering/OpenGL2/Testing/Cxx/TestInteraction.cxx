#include "Scene.h"

#include "TestBuildClouds.h"

#include "pointfront/Preview/BuildPreview.h"
#include "pointfront/Store/PointStore.h"
#include "pointfront/Store/PreviewRecord.h"

#include <vtkCallbackCommand.h>

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <thread>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

/// 250,000 points in some 200 nodes.
std::string terrain(const std::string& name)
{
  return planeStore(name, 500, 4);
}

/// Renders until the mapper has nothing more to show; at most 20 s.
int settle(Scene& scene)
{
  int frames = 0;
  const auto begin = std::chrono::steady_clock::now();
  do
  {
    scene.window->Render();
    ++frames;
    while (!scene.mapper->NeedsRender() && !scene.mapper->GetLastComplete() &&
      std::chrono::steady_clock::now() - begin < std::chrono::seconds(20))
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  } while (scene.mapper->NeedsRender() &&
    std::chrono::steady_clock::now() - begin < std::chrono::seconds(20));
  return frames;
}

TEST(Interaction, FramesRefineToTheCompletePicture)
{
  const auto store = terrain("refine");
  Scene scene(store);
  const Picture complete = scene.draw();
  EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), 250000);

  Scene live(store);
  live.mapper->CompleteOff();
  live.window->Render();
  const vtkIdType first = live.mapper->GetLastPointsDrawn();
  EXPECT_GT(first, 0); // no first frame is empty
  settle(live);
  EXPECT_TRUE(live.mapper->GetLastComplete());
  EXPECT_EQ(live.mapper->GetLastPointsDrawn(), 250000);
  EXPECT_EQ(differing(complete, live.read()), 0);
}

TEST(Interaction, AFrameInMotionUploadsNoMoreThanItsLimitAndLosesNothing)
{
  Scene scene(terrain("motion"));
  auto* gl = vtkOpenGLPointFrontMapper::SafeDownCast(scene.mapper);
  scene.window->SetDesiredUpdateRate(15.0);
  scene.mapper->SetTargetFrameTime(10000.0); // time is not what limits this test
  scene.mapper->SetUploadLimit(1 << 16);
  vtkIdType before = 0;
  for (int frame = 0; frame < 60; ++frame)
  {
    const auto uploaded = gl->GetUploadedBytes();
    scene.window->Render();
    EXPECT_LE(gl->GetUploadedBytes() - uploaded, (1 << 16) + 2000 * 4 + 12);
    EXPECT_GE(scene.mapper->GetLastPointsDrawn(), before);
    before = scene.mapper->GetLastPointsDrawn();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_GT(before, 10000);
}

// FRONT-8: also where all points are in memory already, and where other colours are wanted.
TEST(Interaction, AFrameAtRestUploadsNoMoreThanItsLimitAndEndsComplete)
{
  const auto store = terrain("rest");
  Scene scene(store);
  auto* gl = vtkOpenGLPointFrontMapper::SafeDownCast(scene.mapper);
  const Picture complete = scene.draw(); // all of it at once
  const vtkIdType all = scene.mapper->GetLastPointsDrawn();
  ASSERT_EQ(all, 250000);
  EXPECT_GE(gl->GetUploadedBytes(), all * 12);
  scene.mapper->CompleteOff();
  scene.mapper->SetUploadLimit(1 << 18);
  const auto frames = [&]
  {
    int count = 0;
    do
    {
      const auto uploaded = gl->GetUploadedBytes();
      scene.window->Render();
      EXPECT_LE(gl->GetUploadedBytes() - uploaded, (1 << 18) + 2000 * 4 + 12);
      ++count;
    } while (scene.mapper->NeedsRender() && count < 1000);
    EXPECT_TRUE(scene.mapper->GetLastComplete());
    EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), all);
    return count;
  };
  EXPECT_LT(frames(), 10) << "all of it is there";
  scene.mapper->ReleaseGraphicsResources(scene.window);
  EXPECT_GT(frames(), 10);
  EXPECT_EQ(differing(complete, scene.read()), 0);
}

TEST(Interaction, AViewIsAnnouncedOnceWhenItIsComplete)
{
  Scene scene(terrain("announced"));
  scene.mapper->CompleteOff();
  int announced = 0;
  vtkNew<vtkCallbackCommand> counter;
  counter->SetClientData(&announced);
  counter->SetCallback(
    [](vtkObject*, unsigned long, void* count, void*) { ++*static_cast<int*>(count); });
  scene.mapper->AddObserver(vtkPointFrontMapper::ViewCompleteEvent, counter);
  scene.window->Render();
  EXPECT_EQ(announced, scene.mapper->GetLastComplete() ? 1 : 0); // the roots, at least
  settle(scene);
  EXPECT_TRUE(scene.mapper->GetLastComplete());
  EXPECT_FALSE(scene.mapper->GetLastLimitedByPoints());
  EXPECT_FALSE(scene.mapper->GetLastLimitedByMemory());
  EXPECT_EQ(scene.mapper->GetLastFailedNodes(), 0);
  EXPECT_EQ(announced, 1);
  scene.window->Render();
  EXPECT_EQ(announced, 1); // nothing has changed
  scene.renderer->GetActiveCamera()->Azimuth(20.0);
  settle(scene);
  EXPECT_EQ(announced, 2); // another view
}

TEST(Interaction, WhatLimitsAViewIsTold)
{
  Scene few(terrain("few"));
  few.mapper->SetPointBudget(20000);
  few.draw();
  EXPECT_TRUE(few.mapper->GetLastLimitedByPoints());
  EXPECT_FALSE(few.mapper->GetLastLimitedByMemory());
  EXPECT_LE(few.mapper->GetLastPointsDrawn(), 20000);

  Scene small(terrain("small"));
  small.mapper->GetBounds();
  small.mapper->GetStore()->SetHostMemoryBudget(1200000);
  small.draw();
  EXPECT_TRUE(small.mapper->GetLastLimitedByMemory());
}

TEST(Interaction, AMotionFrameKeepsToTheTimeThatIsAllotted)
{
  Scene scene(terrain("rate"));
  scene.draw();
  const vtkIdType all = scene.mapper->GetLastPointsDrawn();
  // 250,000 points of 400 pixels: hundreds of ms without a GPU; .1 ms is too short for any GPU.
  scene.mapper->SetPointSize(20.0);
  scene.window->SetDesiredUpdateRate(10000.0);
  for (int frame = 0; frame < 12; ++frame)
  {
    scene.renderer->GetActiveCamera()->Azimuth(0.5);
    scene.window->Render();
    scene.read(); // waits for the GPU: its timer is ready at the next frame
  }
  EXPECT_LT(scene.mapper->GetLastPointsDrawn(), all / 2 + 1);
  EXPECT_FALSE(scene.mapper->GetLastComplete());
}

TEST(Interaction, AViewThatMotionLeftIncompleteRefinesOnceItRests)
{
  Scene scene(terrain("rest"));
  scene.draw();
  const vtkIdType all = scene.mapper->GetLastPointsDrawn();
  scene.mapper->CompleteOff();
  scene.mapper->SetPointSize(2.0);
  scene.mapper->SetTargetFrameTime(0.1); // too short for any GPU
  scene.window->SetDesiredUpdateRate(30.0);
  scene.renderer->GetActiveCamera()->Azimuth(0.5);
  int frames = 0;
  // Till the view in motion has all that its time allows. Points grow by the clock (SMOOTH-6): a
  // GPU draws hundreds of frames until they have grown.
  const auto begin = std::chrono::steady_clock::now();
  do
  {
    scene.window->Render();
  } while ((++frames < 12 || scene.mapper->NeedsRender()) &&
    std::chrono::steady_clock::now() - begin < std::chrono::seconds(20));
  EXPECT_FALSE(scene.mapper->NeedsRender());
  EXPECT_LT(scene.mapper->GetLastPointsDrawn(), all);
  EXPECT_FALSE(scene.mapper->GetLastComplete());

  scene.window->SetDesiredUpdateRate(0.0001);
  EXPECT_TRUE(scene.mapper->NeedsRender());
  settle(scene);
  EXPECT_TRUE(scene.mapper->GetLastComplete());
  EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), all);
}

TEST(Interaction, TheHostMemoryBudgetHoldsAndSettles)
{
  Scene scene(terrain("host_budget"));
  scene.mapper->GetBounds();
  constexpr std::size_t budget = 1200000; // memory of 250,000 points of 15 bytes
  scene.mapper->GetStore()->SetHostMemoryBudget(budget);
  scene.draw();
  const auto statistics = scene.mapper->GetStore()->GetResidency().statistics();
  EXPECT_LE(statistics.residentBytesMax, budget);
  EXPECT_GT(scene.mapper->GetLastPointsDrawn(), 20000);
  EXPECT_LT(scene.mapper->GetLastPointsDrawn(), 90000);
  EXPECT_TRUE(scene.mapper->GetLastComplete());
}

TEST(Interaction, PiecesTogetherDrawEachPointOnce)
{
  const auto store = terrain("pieces");
  vtkIdType sum = 0;
  for (int piece = 0; piece < 3; ++piece)
  {
    Scene scene(store);
    scene.mapper->SetNumberOfStorePieces(3);
    scene.mapper->SetStorePiece(piece);
    scene.draw();
    const vtkIdType drawn = scene.mapper->GetLastPointsDrawn();
    EXPECT_GT(drawn, 250000 / 6);
    const auto& residency = scene.mapper->GetStore()->GetResidency();
    EXPECT_LT(residency.statistics().residentBytes, std::size_t(250000) * 30 * 2 / 3);
    sum += drawn;
  }
  EXPECT_EQ(sum, 250000);
}

/// A build that waits after each version of its preview until it is let go on.
class SteppedBuild
{
public:
  explicit SteppedBuild(const std::string& name)
    : folder_(freshFolder(name))
  {
    options_.outputPath = (folder_ / "city.pfront").string();
    options_.memoryBytes = std::uint64_t(1) << 30;
    options_.nodePoints = 512;
    options_.threads = 1;
    wish_.leastPoints = 1000;
    wish_.leastSeconds = 1e9; // a version without parts would come from another
    wish_.shareOfTime = 1e9; // thread, and leave parts out while it is written
    wish_.shown = [this](const std::string& path)
    {
      const auto store = PointStore::open(path);
      std::unique_lock<std::mutex> lock(mutex_);
      const auto record = previewRecordOf(store.value()->description().metadata);
      finished_ = record->pointsFinished;
      ++version_;
      changed_.notify_all();
      const bool parts = finished_ > 0; // the overview does not wait
      changed_.wait(lock, [&] { return !parts || allowed_ >= version_; });
    };
    thread_ = std::thread([this] { run(); });
  }
  ~SteppedBuild()
  {
    while (next())
    {
    }
    thread_.join();
    std::filesystem::remove_all(folder_);
  }
  /// Goes on to the next version with more finished parts; false once the store is finished.
  bool next()
  {
    std::unique_lock<std::mutex> lock(mutex_);
    const std::uint64_t before = finished_;
    allowed_ = version_;
    changed_.notify_all();
    changed_.wait(lock, [&] { return ended_ || finished_ > before; });
    return !ended_;
  }
  std::string previewPath() const { return (folder_ / "city.preview.pfront").string(); }
  static constexpr std::size_t points = 60000;

private:
  void run()
  {
    const PointSources cloud = one(hills(points, 1e6));
    auto preview = BuildPreview::create(cloud, options_, wish_);
    EXPECT_TRUE(preview);
    (*preview)->showOverview(cloud);
    EXPECT_TRUE((*preview)->build(cloud, options_));
    preview.value().reset();
    const std::lock_guard<std::mutex> lock(mutex_);
    ended_ = true;
    changed_.notify_all();
  }

  std::filesystem::path folder_;
  BuildOptions options_;
  PreviewOptions wish_;
  std::thread thread_;
  std::mutex mutex_; // guards what follows
  std::condition_variable changed_;
  std::uint64_t finished_ = 0;
  int version_ = 0;
  int allowed_ = 0;
  bool ended_ = false;
};

TEST(Interaction, AViewOfABuildGetsFinerAndLosesNothingOnTheWay)
{
  SteppedBuild build("stepped-view");
  ASSERT_TRUE(build.next());
  Scene scene(build.previewPath());
  scene.mapper->SetTargetError(1e-6); // all that there is
  scene.mapper->CompleteOff();
  scene.renderer->ResetCamera();
  scene.renderer->GetActiveCamera()->Zoom(0.5); // later versions are a little wider
  settle(scene);
  vtkIdType before = scene.mapper->GetLastPointsDrawn();
  EXPECT_GT(before, 1000);
  int versions = 0;
  for (bool running = true; running;)
  {
    running = build.next();
    const vtkIdType seen = before;
    const auto begin = std::chrono::steady_clock::now();
    do // the mapper looks for a successor four times a second
    {
      scene.window->Render();
      EXPECT_GE(scene.mapper->GetLastPointsDrawn(), before);
      before = scene.mapper->GetLastPointsDrawn();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    } while ((scene.mapper->NeedsRender() || before == seen) &&
      std::chrono::steady_clock::now() - begin < std::chrono::seconds(20));
    EXPECT_GT(before, seen);
    ++versions;
  }
  EXPECT_GT(versions, 4);
  EXPECT_EQ(before, vtkIdType(SteppedBuild::points));
  EXPECT_FALSE(scene.mapper->GetStore()->IsPreview());
}

TEST(Interaction, AViewInMotionStaysWithItsPreview)
{
  SteppedBuild build("moving-view");
  ASSERT_TRUE(build.next());
  Scene scene(build.previewPath());
  scene.mapper->CompleteOff();
  settle(scene);
  const std::string before = scene.mapper->GetStore()->GetFileName();
  auto* const early = scene.mapper->GetStore();
  while (build.next())
  {
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  scene.window->SetDesiredUpdateRate(15.0);
  scene.window->Render();
  EXPECT_EQ(scene.mapper->GetStore(), early); // still readable, from a file that is gone
  EXPECT_GT(scene.mapper->GetLastPointsDrawn(), 1000);
  scene.window->SetDesiredUpdateRate(0.001);
  // The mapper looks for a successor four times a second and goes over when that is loaded.
  const auto begin = std::chrono::steady_clock::now();
  while (scene.mapper->GetStore()->GetFileName() == before &&
    std::chrono::steady_clock::now() - begin < std::chrono::seconds(20))
  {
    settle(scene);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_NE(scene.mapper->GetStore()->GetFileName(), before);
}

TEST(Interaction, AViewOfAPreviewGoesOverToTheFinishedStore)
{
  const std::filesystem::path folder = freshFolder("preview-view");
  BuildOptions options;
  options.outputPath = (folder / "city.pfront").string();
  options.memoryBytes = std::uint64_t(1) << 30;
  PreviewOptions wish;
  wish.leastPoints = 1000;
  wish.leastSeconds = 0.0;
  const PointSources cloud = one(hills(60000, 1e6));
  auto preview = BuildPreview::create(cloud, options, wish);
  ASSERT_TRUE(preview);
  (*preview)->showOverview(cloud);

  Scene scene((*preview)->path());
  scene.mapper->SetTargetError(0.01);
  scene.renderer->ResetCamera();
  scene.draw();
  const vtkIdType early = scene.mapper->GetLastPointsDrawn();
  EXPECT_GT(early, 1000);
  EXPECT_LT(early, 30000);

  ASSERT_TRUE(buildStore(cloud, options));
  preview.value().reset();
  std::this_thread::sleep_for(std::chrono::milliseconds(300)); // it looks four times a second
  EXPECT_TRUE(scene.mapper->NeedsRender());
  scene.draw();
  scene.renderer->ResetCamera(); // the whole is a little larger than what the preview showed
  scene.draw();
  EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), 60000);
  EXPECT_FALSE(scene.mapper->NeedsRender());
}

} // namespace
