#include "OpenGLScene.h"

#include "CloudFormats.h"
#include "ErrorListener.h"
#include "Frustum.h"
#include "Ground.h"
#include "MapperColour.h"
#include "MapperSheet.h"
#include "PeakMemory.h"
#include "ShownClasses.h"
#include "ThreadReads.h"
#include "WholeFile.h"
#include "XConnection.h"

#include "pointfront/Residency/LoadScheduler.h"
#include "pointfront/Residency/Residency.h"
#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Style/StyleSheet.h"

#include "vtkPointFrontMapper.h"
#include "vtkPointFrontReader.h"
#include "vtkPointFrontStore.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkOpenGLRenderer.h>
#include <vtkPNGWriter.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <string>

namespace pointfront
{

namespace
{

/// One store's arrivals are waited for that long before the others are looked at.
constexpr std::chrono::milliseconds lookAtOthers{ 20 };
constexpr int mostRounds = 64; // of a complete render
constexpr double stillRate = 0.0001; // frames a second: VTK's value for a view at rest
constexpr double interactiveRate = 15.0; // VTK's value for a view in motion
constexpr int largestEdge = 16384; // pixels, of what OpenGL's drivers draw into
constexpr int emptyFrames = 3; // until a window has all that it ever makes by itself

/// One store with what draws it.
struct DrawnStore
{
  vtkSmartPointer<vtkPointFrontStore> store;
  vtkNew<vtkPointFrontReader> reader;
  vtkNew<vtkPointFrontMapper> mapper;
  vtkNew<vtkActor> actor;
};

class OffscreenScene final : public StoreScene
{
public:
  explicit OffscreenScene(const DrawingOptions& options)
    : options_(options)
  {
  }
  ~OffscreenScene() override
  {
    for (const auto& drawn : stores_)
    {
      renderer_->RemoveActor(drawn->actor);
    }
  }

  /// `empty`: draws it, and keeps what the process then holds.
  Result<void> openWindow(bool empty);
  Result<void> openStores();
  Result<void> hideOtherClasses();
  Result<void> setUpDrawing();

  const char* backend() const override { return "opengl"; }
  const Bounds& bounds() const override { return bounds_; }
  std::vector<std::string> warnings() const override
  {
    std::vector<std::string> all;
    for (const auto& drawn : stores_)
    {
      const StoreDescription& description = drawn->store->GetStore()->description();
      for (const std::string& warning : description.warnings)
      {
        all.push_back(description.path + ": " + warning);
      }
    }
    return all;
  }
  Result<double> ground() const override { return groundOf(*stores_.front()->store->GetStore()); }
  void setCamera(const Camera& camera) override;
  void setInteractive(bool interactive) override
  {
    window_->SetDesiredUpdateRate(interactive ? interactiveRate : stillRate);
  }
  Result<FrameRecord> renderFrame() override { return render(false); }
  Result<FrameRecord> renderComplete() override { return render(true); }
  bool waitForArrival() override;
  std::vector<std::string> attributesRead() const override;
  std::uint64_t budgetBytes() const override;
  std::uint64_t residentBytesMax() const override;
  LoadingRecord loading() const override;
  std::uint64_t emptySceneBytes() const override { return emptySceneBytes_; }
  Result<void> writePicture(const std::string& path) override;

private:
  Result<FrameRecord> render(bool complete);
  FrameRecord record() const;
  bool needsRender() const;

  XConnection connection_; // outlives the window
  DrawingOptions options_;
  Bounds bounds_;
  std::uint64_t emptySceneBytes_ = 0;
  ThreadReads reads_;
  ErrorListener errors_;
  std::vector<std::unique_ptr<DrawnStore>> stores_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderWindow> window_;
};

Result<void> OffscreenScene::openStores()
{
  if (options_.memoryBytes > 0)
  {
    vtkPointFrontStore::SetProcessMemoryBudget(static_cast<vtkTypeInt64>(options_.memoryBytes));
  }
  for (const std::string& path : options_.stores)
  {
    auto drawn = std::make_unique<DrawnStore>();
    vtkStdString why;
    drawn->store = vtkPointFrontStore::Open(path.c_str(), why);
    if (!drawn->store)
    {
      return makeError(Error::Kind::BadFormat, why);
    }
    errors_.observe(drawn->reader);
    errors_.observe(drawn->mapper);
    drawn->reader->SetFileName(path.c_str());
    drawn->reader->SetOverviewPoints(0); // the mapper alone draws
    drawn->mapper->SetInputConnection(drawn->reader->GetOutputPort());
    drawn->actor->SetMapper(drawn->mapper);
    bounds_.add(drawn->store->GetStore()->description().bounds);
    stores_.push_back(std::move(drawn));
  }
  return {};
}

Result<void> OffscreenScene::hideOtherClasses()
{
  std::uint64_t points = 0;
  for (std::size_t i = 0; i < stores_.size() && !options_.classes.empty(); ++i)
  {
    const StoreDescription& store = stores_[i]->store->GetStore()->description();
    if (!isLayered(store))
    {
      points += store.pointCount; // its points are filtered, by the sheet
      continue;
    }
    const Result<ShownClasses> shown = ShownClasses::choose(options_.classes, store);
    if (!shown)
    {
      return shown.error();
    }
    for (std::size_t layer = 0; layer < store.layers.size(); ++layer)
    {
      stores_[i]->mapper->SetClassVisibility(
        store.layers[layer].objectClass, shown->layers[layer].visible);
    }
    points += shown->points;
  }
  return options_.classes.empty() || points > 0 ? Result<void>() : noClassShown();
}

Result<void> OffscreenScene::openWindow(bool empty)
{
  if (std::max(options_.size[0], options_.size[1]) > largestEdge)
  {
    return makeError(Error::Kind::Unsupported,
      "OpenGL draws pictures of up to " + std::to_string(largestEdge) +
        " pixels a side; use --backend software");
  }
  if (Result<void> connected = connection_.open(); !connected)
  {
    return connected;
  }
  renderer_->SetBackground(options_.background.data());
  window_->SetOffScreenRendering(1);
  window_->SetMultiSamples(0);
  window_->SetSize(options_.size[0], options_.size[1]);
  window_->AddRenderer(renderer_);
  errors_.observe(window_);
  setInteractive(false);
  for (int frame = 0; empty && frame < emptyFrames; ++frame)
  {
    window_->Render();
    window_->WaitForCompletion();
    emptySceneBytes_ = residentBytesNow();
  }
  return errors_.outcome();
}

Result<void> OffscreenScene::setUpDrawing()
{
  std::vector<std::shared_ptr<const StoredCloud>> stores;
  for (const auto& drawn : stores_)
  {
    stores.push_back(drawn->store->GetStore());
  }
  const std::string attribute = options_.colourBy.empty()
    ? defaultColourAttribute(stores.front()->description())
    : options_.colourBy;
  const Result<ColourChoice> colour = chooseColour(attribute, stores);
  if (!colour)
  {
    return colour.error();
  }
  const bool layered = std::all_of(stores.begin(), stores.end(),
    [](const auto& store) { return isLayered(store->description()); });
  const bool plain = isPlain(options_) && (options_.classes.empty() || layered);
  const auto sheet = plain ? nullptr : sheetOf(options_, stores);
  for (const auto& drawn : stores_)
  {
    drawn->mapper->SetBackendToOpenGL();
    drawn->mapper->SetStyleSheet(sheet);
    drawn->mapper->SetPointSize(options_.pointSizePx); // where there is no sheet
    applyColour(colour.value(), drawn->mapper);
    drawn->mapper->SetTargetError(options_.errorPx);
    drawn->mapper->SetDetailSelection(options_.detail == "view"
        ? vtkPointFrontMapper::VIEW_SPECIFIC
        : vtkPointFrontMapper::RENDERING_FRONT);
    if (options_.pointBudget > 0)
    {
      drawn->mapper->SetPointBudget(options_.pointBudget);
    }
    drawn->mapper->SetGPUMemoryBudget(static_cast<vtkTypeInt64>(options_.gpuBytes));
    drawn->mapper->SetTargetFrameTime(options_.frameMs);
    drawn->mapper->SetGrowthTime(options_.growthMs);
    drawn->actor->GetProperty()->LightingOff(); // colours are drawn as they are
    renderer_->AddActor(drawn->actor);
  }
  return {};
}

void OffscreenScene::setCamera(const Camera& camera)
{
  vtkCamera* const to = renderer_->GetActiveCamera();
  to->SetPosition(camera.position.x, camera.position.y, camera.position.z);
  to->SetFocalPoint(camera.focalPoint.x, camera.focalPoint.y, camera.focalPoint.z);
  to->SetViewUp(camera.viewUp.x, camera.viewUp.y, camera.viewUp.z);
  to->SetViewAngle(camera.viewAngleDegrees);
  to->SetParallelProjection(camera.parallelScale ? 1 : 0);
  to->SetParallelScale(camera.parallelScale.value_or(1.0));
  to->SetClippingRange(clippingRange(camera, bounds_).data());
}

FrameRecord OffscreenScene::record() const
{
  FrameRecord frame;
  frame.complete = true;
  for (const auto& drawn : stores_)
  {
    vtkPointFrontMapper* const mapper = drawn->mapper;
    const ResidencyStatistics residency = drawn->store->GetResidency().statistics();
    frame.frontMilliseconds += mapper->GetLastFrontTime();
    frame.points += mapper->GetLastPointsDrawn();
    frame.nodes += mapper->GetLastNodesDrawn();
    frame.frontLength += mapper->GetLastFrontLength();
    frame.moves += mapper->GetLastMoves();
    frame.requests += mapper->GetLastRequests();
    frame.thresholdPx = std::max(frame.thresholdPx, mapper->GetLastThreshold());
    frame.errorPx = std::max(frame.errorPx, mapper->GetLastError());
    frame.complete = frame.complete && mapper->GetLastComplete();
    frame.limitedByPoints = frame.limitedByPoints || mapper->GetLastLimitedByPoints();
    frame.limitedByGpu = frame.limitedByGpu || mapper->GetLastLimitedByGPUMemory();
    frame.limitedByMemory = frame.limitedByMemory || mapper->GetLastLimitedByMemory();
    frame.failedNodes += mapper->GetLastFailedNodes();
    frame.gpuBytes = std::max<std::int64_t>(frame.gpuBytes, mapper->GetLastWindowGPUBytes());
    frame.residentBytes += residency.residentBytes;
    frame.bytesRead += residency.bytesRead;
    frame.cancelled += residency.cancelled;
  }
  return frame;
}

Result<FrameRecord> OffscreenScene::render(bool complete)
{
  for (const auto& drawn : stores_)
  {
    drawn->mapper->SetComplete(complete);
    if (complete && options_.pointBudget < 0)
    {
      drawn->mapper->SetPointBudget(0); // all that the error asks for, as far as memory goes
    }
  }
  reads_.since();
  const auto begin = std::chrono::steady_clock::now();
  // Stores that share a budget come to one error within a few rounds.
  int rounds = 0;
  do
  {
    window_->Render();
  } while (complete && ++rounds < mostRounds && needsRender());
  window_->WaitForCompletion();
  const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - begin;
  if (const Result<void> heard = errors_.outcome(); !heard)
  {
    return heard.error();
  }
  FrameRecord frame = record();
  frame.milliseconds = taken.count();
  frame.threadReadBytes = reads_.since();
  return frame;
}

bool OffscreenScene::needsRender() const
{
  return std::any_of(
    stores_.begin(), stores_.end(), [](const auto& drawn) { return drawn->mapper->NeedsRender(); });
}

bool OffscreenScene::waitForArrival()
{
  while (true)
  {
    if (needsRender())
    {
      return true;
    }
    const auto loading = std::find_if(stores_.begin(), stores_.end(),
      [](const auto& drawn)
      {
        const ResidencyStatistics now = drawn->store->GetResidency().statistics();
        return now.loading > 0 || (now.pending > 0 && !drawn->store->GetResidency().exhausted());
      });
    if (loading == stores_.end())
    {
      return false;
    }
    const Residency& residency = (*loading)->store->GetResidency();
    residency.waitForArrival(residency.arrivals(), lookAtOthers);
  }
}

std::vector<std::string> OffscreenScene::attributesRead() const
{
  std::set<std::string> names;
  for (const auto& drawn : stores_)
  {
    const AttributeSchema& schema = drawn->store->GetStore()->description().schema;
    for (const std::uint32_t column : drawn->store->GetResidency().columns())
    {
      names.insert(schema[column].name);
    }
  }
  return { names.begin(), names.end() };
}

std::uint64_t OffscreenScene::budgetBytes() const
{
  return static_cast<std::uint64_t>(vtkPointFrontStore::GetProcessMemoryBudget());
}

LoadingRecord OffscreenScene::loading() const
{
  const LoadSchedulerStatistics s = stores_.front()->store->GetResidency().scheduler().statistics();
  return { s.fetchedBytes, s.decodedBytes, s.fetchSeconds, s.decodeSeconds, s.lastLoaded };
}

std::uint64_t OffscreenScene::residentBytesMax() const
{
  return stores_.front()->store->GetResidency().scheduler().statistics().residentBytesMax;
}

Result<void> OffscreenScene::writePicture(const std::string& path)
{
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window_);
  image->SetInputBufferTypeToRGB();
  image->ReadFrontBufferOff();
  image->ShouldRerenderOff();
  vtkNew<vtkPNGWriter> png;
  png->SetInputConnection(image->GetOutputPort());
  png->WriteToMemoryOn();
  png->Write();
  vtkUnsignedCharArray* const bytes = png->GetResult();
  return writeWholeFile(
    path, bytes->GetPointer(0), static_cast<std::size_t>(bytes->GetNumberOfValues()));
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
  if (Result<void> hidden = scene->hideOtherClasses(); !hidden)
  {
    return hidden.error();
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
