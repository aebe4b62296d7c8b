// A mapper's work in a frame: it asks the front for points, and makes the plan for the back end.
#include "CloudLook.h"
#include "InputPoints.h"
#include "MapperContent.h"
#include "MapperProperties.h"
#include "PosterTile.h"
#include "RendererClouds.h"
#include "RendererLights.h"
#include "RoomWarning.h"

#include "pointfront/Detail/DetailLevel.h"
#include "pointfront/Plan/FramePlanner.h"
#include "pointfront/Plan/LensWindows.h"
#include "pointfront/Quality/QualityCurve.h"
#include "pointfront/Style/GpuStreams.h"
#include "pointfront/Views/SplatReach.h"
#include "pointfront/Views/WallReach.h"

#include <vtkActor.h>
#include <vtkCommand.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace
{

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point begin)
{
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

std::string techniqueOf(const pointfront::FramePlan& plan)
{
  pointfront::MeasuredTechnique technique;
  for (const pointfront::DrawBatch& batch : plan.batches)
  {
    technique.add(*batch.style);
  }
  return technique.name();
}

/// The margin that is drawn around the viewport. Plain points go straight into it.
pointfront::ViewportMargin marginOf(vtkRenderer* renderer, const pointfront::CloudLook& look)
{
  if (look.plain || !look.shading)
  {
    return {};
  }
  pointfront::FrameShading shading = *look.shading;
  const pointfront::PosterTile tile(renderer);
  tile.enlarge(shading);
  return tile.margin(shading);
}

/// Sets camera and shading of the part of the picture that is drawn.
void place(vtkRenderer* renderer, vtkActor* actor, const pointfront::CloudLook& look,
  pointfront::PlanRequest& request)
{
  request.camera = pointfront::cameraOf(renderer, actor);
  if (look.shading)
  {
    request.shading = *look.shading;
    const pointfront::PosterTile tile(renderer);
    tile.enlarge(request.shading);
    tile.place(request, marginOf(renderer, look));
  }
}

} // namespace

std::vector<pointfront::LayerStyling> vtkPointFrontMapper::GetStyling(vtkActor* actor)
{
  Content& content = *this->Internals;
  const auto sheet = this->GetStyleSheet();
  auto layers = content.Style.layersOf(
    *this, actor, this->PointSize, sheet.get(), this->GetStore()->GetStore());
  const std::string error = content.Style.takeError();
  if (!error.empty())
  {
    vtkErrorMacro(<< error);
  }
  const std::string warning = content.Style.takeWarning();
  if (!warning.empty())
  {
    vtkWarningMacro(<< warning);
  }
  content.Limits.hide(*this->GetStore(), layers);
  return layers;
}

pointfront::CloudLook vtkPointFrontMapper::GetLook(vtkRenderer* renderer, vtkActor* actor)
{
  pointfront::CloudLook look;
  look.layers = this->GetStyling(actor);
  if (const auto sheet = this->GetStyleSheet())
  {
    look.shading = sheet->frameShading();
    look.plain = pointfront::hasPlainPointsOnly(*look.shading, look.layers);
  }
  look.inHostMemory = this->DrawsFromHostMemory(renderer, actor, look);
  return look;
}

pointfront::PlanRequest vtkPointFrontMapper::GetRequest(
  vtkRenderer* renderer, vtkActor* actor, const pointfront::CloudLook& look)
{
  pointfront::PlanRequest request;
  place(renderer, actor, look, request);
  request.clippingPlanes = pointfront::clippingPlanesOf(*this, actor);
  request.composited = this->NumberOfStorePieces > 1 || pointfront::hasSeveralClouds(renderer);
  request.exchange = this->Exchange;
  if (look.shading)
  {
    request.shading.lights = pointfront::lightsOf(renderer, request.camera);
  }
  for (const pointfront::LayerStyling& layer : look.layers)
  {
    request.styles.emplace_back();
    request.styles.back().assign(layer.styles.begin(), layer.styles.end());
  }
  return request;
}

pointfront::FrameRequest vtkPointFrontMapper::GetFrameRequest(
  vtkRenderer* renderer, vtkActor* actor, const pointfront::CloudLook& look)
{
  pointfront::FrameRequest request;
  const std::vector<pointfront::LayerStyling>& styling = look.layers;
  const double walls =
    pointfront::tallestWall(this->GetStore()->GetStore()->description(), styling);
  const double splats = pointfront::largestSplat(styling);
  const pointfront::PosterTile tile(renderer);
  const pointfront::ViewportMargin margin = marginOf(renderer, look);
  const auto viewWith = [&](const pointfront::ViewportMargin& around)
  {
    return pointfront::withSplatsFromAside(
      pointfront::withWallsFromAbove(pointfront::viewOf(renderer, actor, around), walls), splats);
  };
  request.view = viewWith(tile.sight(margin, styling));
  request.layers = this->Internals->Limits.layersOf(*this->GetStore(), styling,
    look.shading ? this->Internals->Style.pruning()
                 : std::vector<std::shared_ptr<const pointfront::NodePruning>>());
  if (look.shading && !look.shading->lenses.empty())
  {
    pointfront::PlanRequest placed;
    place(renderer, actor, look, placed);
    pointfront::limitToLenses(styling, placed.shading, placed.camera,
      std::max(this->TargetError, this->GetStatistics().thresholdPx), walls, request.layers);
  }
  tile.limit(viewWith, margin, styling, request.layers);
  pointfront::GpuStreams streams;
  for (const pointfront::LayerStyling& layer : styling)
  {
    request.columns.layers.push_back(layer.columns());
    streams.add(pointfront::GpuStreams::of(layer.styles));
  }
  request.gpuStreams = streams.count();
  request.targetErrorPx = this->TargetError;
  request.pointBudget = static_cast<std::uint64_t>(this->PointBudget);
  request.gpuBytes = look.inHostMemory ? 0 : this->GPUMemoryBudget;
  request.method = this->DetailSelection == VIEW_SPECIFIC
    ? pointfront::DetailMethod::ViewSpecific
    : pointfront::DetailMethod::RenderingFront;
  if (this->DetailSelection == VIEW_SPECIFIC) // it looks at every open store
  {
    request.overviewPoints =
      pointfront::overviewShare(static_cast<std::uint64_t>(this->OverviewPoints),
        static_cast<std::uint64_t>(this->GetStore()->GetNumberOfPoints()),
        static_cast<std::uint64_t>(vtkPointFrontStore::GetNumberOfPointsOfAllStores()));
  }
  request.interacting = IsInteracting(renderer);
  request.frameMs = this->TargetFrameTime;
  request.cloudMs = 1000.0 * actor->GetAllocatedRenderTime();
  request.complete = this->Complete && !request.interacting;
  if (vtkRenderWindow* const window = renderer->GetRenderWindow())
  {
    request.aborted = [window] { return window->CheckAbortStatus() != 0; };
  }
  return request;
}

/// Once a frame. True when it did.
bool vtkPointFrontMapper::MoveFront(
  vtkRenderer* renderer, vtkActor* actor, const pointfront::CloudLook& look)
{
  Content& content = *this->Internals;
  vtkPointFrontStore* store = this->GetStore();
  content.Views.setPiece(this->StorePiece, this->NumberOfStorePieces);
  pointfront::RendererFront& view = content.Views.of(renderer, actor);
  if (!content.Views.openFront(renderer, view) && (!view.NewFrame || renderer->GetSelector()))
  {
    return false; // a further drawing of the same frame
  }
  view.NewFrame = false;
  view.FirstDrawing = true;
  view.Plan.reset(); // the nodes that it pins may be released

  const auto begin = Clock::now();
  pointfront::FrameRequest request = this->GetFrameRequest(renderer, actor, look);
  view.Announced = view.Announced && view.View.request().view == request.view;
  const pointfront::FrontDelta& delta = view.View.update(std::move(request));
  content.Statistics.take(delta);
  content.Statistics.frontMilliseconds = millisecondsSince(begin);
  for (const pointfront::Error& error : store->GetResidency().takeErrors())
  {
    vtkErrorMacro(<< error.what);
  }
  for (const pointfront::Error& error : store->GetStore()->hierarchy()->takeFaults())
  {
    vtkErrorMacro(<< error.what);
  }
  return true;
}

std::optional<pointfront::CloudLook> vtkPointFrontMapper::BeginFrame(
  vtkRenderer* renderer, vtkActor* actor)
{
  Content& content = *this->Internals;
  if (!this->GetStore())
  {
    if (content.StoreName.empty() && !std::exchange(content.MissingTold, true))
    {
      vtkErrorMacro("the input names no store (field data \""
        << vtkPointFrontStore::FieldName()
        << "\"); connect a vtkPointFrontReader. vtkPolyDataMapper draws points in memory");
    }
    return std::nullopt;
  }
  const bool others = pointfront::hasOtherPoints(*this, *this->GetStore());
  if (others && !content.OtherPointsTold)
  {
    vtkWarningMacro("a filter has changed the points of the input, and the whole store is drawn as "
                    "it is: an actor's position, orientation and scale move it, a style's filters "
                    "and classes choose points. vtkPolyDataMapper draws points in memory");
  }
  content.OtherPointsTold = others;
  pointfront::CloudLook look = this->GetLook(renderer, actor);
  // A frame in motion has no time for a second front, nor for bringing all points to the GPU again.
  if (!renderer->GetSelector() && !IsInteracting(renderer) &&
    content.Views.follow(
      renderer, actor, [&] { return this->GetFrameRequest(renderer, actor, look); },
      [&](vtkPointFrontStore& next) { return content.Limits.layersOf(next); }))
  {
    this->Modified();
    look = this->GetLook(renderer, actor); // the next version's layers
  }
  return look;
}

pointfront::FramePlan& vtkPointFrontMapper::PlanFrame(
  vtkRenderer* renderer, vtkActor* actor, const pointfront::CloudLook& look)
{
  const bool moved = this->MoveFront(renderer, actor, look);
  pointfront::RendererFront& view = this->Internals->Views.of(renderer, actor);
  pointfront::PlanRequest request = this->GetRequest(renderer, actor, look);
  if (moved || !view.Plan)
  {
    // VTK's template draws plain points. OpenGL draws no stand-ins for a selection; where children
    // take their parents' places there would be nothing to find before they come.
    const bool replaces = view.View.front()->refinement() == pointfront::Refinement::Replace;
    const bool lacksStandIns = replaces && renderer->GetSelector();
    request.refines = look.inHostMemory || (look.shading && !lacksStandIns);
    request.moment.seconds = std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
    request.moment.duration = 1e-3 * this->GrowthTime;
    view.Plan = view.View.plan(this->GetStore()->GetStore()->description(), std::move(request));
    return *view.Plan;
  }
  // The same nodes, as another eye or pass sees them.
  view.Plan->camera = request.camera;
  view.Plan->shading = std::move(request.shading); // lights in view space, lenses in pixels
  view.Plan->exchange = request.exchange;
  view.Plan->clippingPlanes = std::move(request.clippingPlanes);
  pointfront::restyle(*view.Plan, request.styles);
  return *view.Plan;
}

bool vtkPointFrontMapper::IsFirstDrawing(vtkRenderer* renderer, vtkActor* actor) const
{
  const pointfront::RendererFront* view = this->Internals->Views.find(renderer, actor);
  return view && view->FirstDrawing;
}

void vtkPointFrontMapper::FinishFrame(
  vtkRenderer* renderer, vtkActor* actor, vtkIdType points, vtkIdType keptPoints, bool uploadsLeft)
{
  pointfront::RendererFront& view = this->Internals->Views.of(renderer, actor);
  const pointfront::FrontDelta& delta = view.View.front()->last();
  view.View.drew(static_cast<std::uint64_t>(keptPoints));
  view.FirstDrawing = false;
  view.UploadsLeft = uploadsLeft;
  // The front counts on room for one node at least.
  const bool noRoom = this->GPUMemoryBudget > 0 && this->GetStatistics().gpuBytes == 0 &&
    points == 0 && !uploadsLeft && view.Plan && view.Plan->pointCount() > 0;
  view.LeftOutBefore = view.LeftOut;
  view.LeftOut = noRoom || !delta.layersLeftOut.empty();
  // In motion the frame time limits the front: at rest the same view may show more.
  view.Complete = delta.complete && !uploadsLeft && view.View.isGrown() &&
    (!view.LeftOut || view.LeftOutBefore) &&
    (!IsInteracting(renderer) || delta.errorPx <= this->TargetError);
  pointfront::FrameStatistics& statistics = this->GetStatistics();
  const double frontMilliseconds = statistics.frontMilliseconds;
  statistics.take(delta);
  statistics.frontMilliseconds = frontMilliseconds;
  statistics.points = static_cast<std::uint64_t>(points);
  statistics.layerPoints =
    view.Plan ? view.Plan->layerPoints() : std::vector<std::uint64_t>(); // wanted of each
  statistics.technique = view.Plan ? techniqueOf(*view.Plan) : std::string();
  statistics.keptPoints = static_cast<std::uint64_t>(keptPoints);
  statistics.limitedByGpuMemory = statistics.limitedByGpuMemory || noRoom;
  for (std::size_t layer = 0; noRoom && layer < statistics.layerPoints.size(); ++layer)
  {
    if (statistics.layerPoints[layer] > 0)
    {
      statistics.layersLeftOut.push_back(static_cast<std::uint16_t>(layer));
    }
  }
  statistics.complete = view.Complete;
  view.Statistics = statistics;
  statistics = this->Internals->Views.statisticsOf(renderer);
  const auto budgets = std::make_pair(this->GPUMemoryBudget, this->PointBudget);
  if (view.Complete && view.LeftOut && !this->Internals->LeftOutIgnored &&
    std::exchange(this->Internals->LeftOutTold, budgets) != budgets)
  {
    vtkWarningMacro(<< pointfront::roomWarning(this->GetStore()->GetStore()->description(),
                      view.Statistics.layersLeftOut, view.Statistics.limitedByGpuMemory));
  }
  const bool announce = view.Complete && !view.Announced;
  view.Announced = view.Complete;
  if (announce)
  {
    this->InvokeEvent(ViewCompleteEvent);
  }
}

void vtkPointFrontMapper::RecordFrame(
  vtkRenderer* renderer, vtkActor* actor, vtkIdType points, vtkIdType moves, double milliseconds)
{
  pointfront::RendererFront* view = this->Internals->Views.find(renderer, actor);
  if (view && view->View.front())
  {
    view->View.took(
      static_cast<std::uint64_t>(points), static_cast<std::uint32_t>(moves), milliseconds);
  }
}

/// The last frame showed nothing of it, and that is all there is to show.
void vtkPointFrontMapper::LeaveScreen()
{
  pointfront::FrameStatistics left;
  left.frontLength = this->GetStatistics().frontLength;
  left.thresholdPx = this->GetStatistics().thresholdPx;
  left.complete = true;
  this->GetStatistics() = left;
}

vtkIdType vtkPointFrontMapper::GetPointsOnGPU(vtkWindow* window) const
{
  const auto budget = static_cast<std::uint64_t>(this->PointBudget);
  return budget == 0
    ? 0
    : std::max<vtkIdType>(
        1, static_cast<vtkIdType>(this->Internals->Views.pointsOnGpu(window, budget)));
}

std::uint32_t vtkPointFrontMapper::GetNumberOfViews(vtkWindow* window) const
{
  return this->Internals->Views.countIn(window);
}

bool vtkPointFrontMapper::IsAheadOfFrame(vtkRenderer* renderer, vtkActor* actor) const
{
  const pointfront::RendererFront* view = this->Internals->Views.find(renderer, actor);
  return view && view->View.isAhead();
}

bool vtkPointFrontMapper::IsSeen() const
{
  return this->Internals->Views.isSeen();
}

bool vtkPointFrontMapper::NeedsRender()
{
  return this->Internals->Views.needsRender();
}

void vtkPointFrontMapper::RenderWhenDataArrives(vtkRenderWindowInteractor* interactor)
{
  this->Internals->Timer.stop();
  if (interactor)
  {
    this->Internals->Timer.start(interactor);
  }
}

/// Whether a render is due; who observes is told before it.
bool vtkPointFrontMapper::Announce()
{
  const bool due = this->NeedsRender();
  if (due)
  {
    this->InvokeEvent(vtkCommand::UpdateDataEvent);
  }
  return due;
}

pointfront::FrameStatistics& vtkPointFrontMapper::GetStatistics() const
{
  return this->Internals->Statistics;
}

// A definition each, which takes no semicolon.
// clang-format off
#define pointfrontGetLast(Name, Type, field)                                                       \
  Type vtkPointFrontMapper::GetLast##Name() const                                                  \
  {                                                                                                \
    return static_cast<Type>(this->GetStatistics().field);                                         \
  }
pointfrontGetLast(PointsDrawn, vtkIdType, points)
pointfrontGetLast(PointsKept, vtkIdType, keptPoints)
pointfrontGetLast(NodesDrawn, vtkIdType, nodes)
pointfrontGetLast(FrontLength, vtkIdType, frontLength)
pointfrontGetLast(Moves, vtkIdType, moves)
pointfrontGetLast(Requests, vtkIdType, requests)
pointfrontGetLast(Error, double, errorPx)
pointfrontGetLast(Threshold, double, thresholdPx)
pointfrontGetLast(FrontTime, double, frontMilliseconds)
pointfrontGetLast(GPUBytes, vtkTypeInt64, gpuBytes)
pointfrontGetLast(WindowGPUBytes, vtkTypeInt64, windowGpuBytes)
pointfrontGetLast(Complete, bool, complete)
pointfrontGetLast(LimitedByPoints, bool, limitedByPoints)
pointfrontGetLast(LimitedByGPUMemory, bool, limitedByGpuMemory)
pointfrontGetLast(LimitedByMemory, bool, limitedByMemory)
pointfrontGetLast(FailedNodes, vtkIdType, failedNodes)
#undef pointfrontGetLast
  // clang-format on
