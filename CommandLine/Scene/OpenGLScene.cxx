#include "OpenGLScene.h"

#include "CloudFormats.h"
#include "Ground.h"
#include "MappedStores.h"
#include "PeakMemory.h"
#include "ThreadReads.h"
#include "WindowPicture.h"
#include "XConnection.h"

#include "pointfront/Residency/LoadScheduler.h"
#include "pointfront/Residency/Residency.h"

#include "vtkPointFrontMapper.h"
#include "vtkPointFrontStore.h"

#include <vtkNew.h>
#include <vtkOpenGLRenderer.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>

#include <algorithm>
#include <chrono>
#include <string>

namespace pointfront
{

namespace
{

/// One store's arrivals are waited for that long before the others are looked at.
constexpr std::chrono::milliseconds lookAtOthers{ 20 };
constexpr double stillRate = 0.0001; // frames a second: VTK's value for a view at rest
constexpr double interactiveRate = 15.0; // VTK's value for a view in motion
constexpr int largestEdge = 16384; // pixels, of what OpenGL's drivers draw into
constexpr int emptyFrames = 3; // until a window has all that it ever makes by itself

class OffscreenScene final : public StoreScene
{
public:
  explicit OffscreenScene(const DrawingOptions& options)
    : options_(options)
  {
  }

  /// `empty`: draws it, and keeps what the process then holds.
  Result<void> openWindow(bool empty);
  Result<void> openStores() { return stores_.open(options_); }
  Result<void> setUpDrawing()
  {
    return stores_.show(options_, vtkPointFrontMapper::OPENGL, renderer_);
  }

  const char* backend() const override { return "opengl"; }
  const Bounds& bounds() const override { return stores_.bounds(); }
  std::vector<std::string> warnings() const override { return stores_.warnings(); }
  Result<double> ground() const override { return groundOf(*stores_.clouds().front()); }
  void setCamera(const Camera& camera) override
  {
    stores_.aim(camera, renderer_->GetActiveCamera());
  }
  void setInteractive(bool interactive) override
  {
    window_->SetDesiredUpdateRate(interactive ? interactiveRate : stillRate);
  }
  Result<FrameRecord> renderFrame() override { return render(false); }
  Result<FrameRecord> renderComplete() override { return render(true); }
  bool waitForArrival() override;
  std::vector<std::string> attributesRead() const override { return stores_.attributesRead(); }
  std::uint64_t budgetBytes() const override;
  std::uint64_t residentBytesMax() const override;
  LoadingRecord loading() const override;
  std::uint64_t emptySceneBytes() const override { return emptySceneBytes_; }
  Result<void> writePicture(const std::string& path) override
  {
    return writeWindowPicture(window_, path);
  }

private:
  Result<FrameRecord> render(bool complete);

  XConnection connection_; // outlives the window
  DrawingOptions options_;
  std::uint64_t emptySceneBytes_ = 0;
  ThreadReads reads_;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderer> renderer_;
  MappedStores stores_; // they leave the renderer while it has its window
};

Result<void> OffscreenScene::openWindow(bool empty)
{
  if (std::max(options_.size[0], options_.size[1]) > largestEdge)
  {
    return makeError(Error::Kind::Unsupported,
      "OpenGL draws pictures of up to " + std::to_string(largestEdge) +
        " pixels a side; use --backend software");
  }
  if (Result<void> connected = connection_.open("drawing", "run it under xvfb-run -a"); !connected)
  {
    return connected;
  }
  renderer_->SetBackground(options_.background.data());
  window_->SetOffScreenRendering(1);
  window_->SetMultiSamples(0);
  window_->SetSize(options_.size[0], options_.size[1]);
  window_->AddRenderer(renderer_);
  stores_.errors().observe(window_);
  setInteractive(false);
  for (int frame = 0; empty && frame < emptyFrames; ++frame)
  {
    window_->Render();
    window_->WaitForCompletion();
    emptySceneBytes_ = residentBytesNow();
  }
  return stores_.errors().outcome();
}

Result<FrameRecord> OffscreenScene::render(bool complete)
{
  if (complete && options_.pointBudget < 0)
  {
    stores_.setPointBudget(0); // all that the error asks for, as far as memory goes
  }
  reads_.since();
  const auto begin = std::chrono::steady_clock::now();
  stores_.draw(window_, complete);
  const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - begin;
  if (const Result<void> heard = stores_.errors().outcome(); !heard)
  {
    return heard.error();
  }
  FrameRecord frame = stores_.record();
  frame.showsPoints = complete && showsPoints(window_);
  frame.milliseconds = taken.count();
  frame.threadReadBytes = reads_.since();
  return frame;
}

bool OffscreenScene::waitForArrival()
{
  while (!stores_.needsRender())
  {
    const Residency* const residency = stores_.loading();
    if (residency == nullptr)
    {
      return false;
    }
    residency->waitForArrival(residency->arrivals(), lookAtOthers);
  }
  return true;
}

std::uint64_t OffscreenScene::budgetBytes() const
{
  return static_cast<std::uint64_t>(vtkPointFrontStore::GetProcessMemoryBudget());
}

LoadingRecord OffscreenScene::loading() const
{
  const LoadSchedulerStatistics s = stores_.scheduler().statistics();
  return { s.fetchedBytes, s.decodedBytes, s.fetchSeconds, s.decodeSeconds, s.lastLoaded };
}

std::uint64_t OffscreenScene::residentBytesMax() const
{
  return stores_.scheduler().statistics().residentBytesMax;
}

Result<std::unique_ptr<StoreScene>> openScene(const DrawingOptions& options)
{
  auto scene = std::make_unique<OffscreenScene>(options);
  // The window first where it is measured; else what is wrong with a store is told without one.
  if (Result<void> opened = options.measureEmptyScene ? scene->openWindow(true) : Result<void>();
      !opened)
  {
    return opened.error();
  }
  if (Result<void> opened = scene->openStores(); !opened)
  {
    return opened.error();
  }
  if (Result<void> opened = options.measureEmptyScene ? Result<void>() : scene->openWindow(false);
      !opened)
  {
    return opened.error();
  }
  if (Result<void> ready = scene->setUpDrawing(); !ready)
  {
    return ready.error();
  }
  return std::unique_ptr<StoreScene>(std::move(scene));
}

} // namespace

void pointfrontOpenOpenGLScene(
  const DrawingOptions& options, Result<std::unique_ptr<StoreScene>>& scene)
{
  // Where the kernel is a static library this module has a kernel of its own.
  addCloudFormats();
  scene = openScene(options);
}

} // namespace pointfront
