#include "vtkPointFrontMapper.h"

#include "MapperProperties.h"
#include "PerWindow.h"
#include "pointfront/Style/ClassHeights.h"
#include "pointfront/Style/PointColouring.h"
#include "RenderTimer.h"
#include "RendererView.h"
#include "StoreSuccession.h"
#include "pointfront/Views/ViewFront.h"

#include "pointfront/Front/DetailLevel.h"
#include "vtkPointFrontStore.h"

#include <vtkActor.h>
#include <vtkCommand.h>
#include <vtkIndent.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkScalarsToColors.h>
#include <vtkWeakPointer.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <string>

vtkAbstractObjectFactoryNewMacro(vtkPointFrontMapper);

namespace
{

/// VTK and ParaView set rates of 5 and more in motion, of 0.002 and less at rest.
constexpr double interactiveRate = 0.01;

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point begin)
{
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

pointfront::LayerLimits limitsOf(
  const std::map<int, pointfront::LayerLimits>& all, int objectClass)
{
  const auto found = all.find(objectClass);
  return found != all.end() ? found->second : pointfront::LayerLimits();
}

} // namespace

struct vtkPointFrontMapper::Content
{
  explicit Content(vtkPointFrontMapper* owner)
      : Owner(owner), Timer([owner] { return owner->Announce(); })
  {
  }

  vtkPointFrontMapper* Owner;
  vtkSmartPointer<vtkPointFrontStore> Store; // before the views: their fronts refer to it
  std::string StoreName;
  vtkMTimeType InputTime = 0;
  std::shared_ptr<const pointfront::HierarchyPiece> Piece;
  int PieceNumber = 0;
  int Pieces = 1;
  std::map<vtkRenderer*, pointfront::RendererView> Views;
  std::map<int, pointfront::LayerLimits> ClassLimits;
  std::unique_ptr<pointfront::StoreSuccession> Succession; ///< from Store, while it is a preview
  std::string UnknownArray; ///< that has been warned of
  std::shared_ptr<const pointfront::ClassHeights> Heights; ///< once they were asked for

  pointfront::RenderTimer Timer;

  std::shared_ptr<const pointfront::ClassHeights> HeightsOf(
    const std::shared_ptr<const pointfront::StoredCloud>& store)
  {
    if (!this->Heights || this->Heights->store() != store)
    {
      this->Heights = std::make_shared<pointfront::ClassHeights>(store);
    }
    return this->Heights;
  }

  pointfront::RendererView& ViewOf(vtkRenderer* renderer)
  {
    for (auto view = this->Views.begin(); view != this->Views.end();)
    {
      view = view->second.Renderer ? std::next(view) : this->Views.erase(view);
    }
    const auto found = this->Views.find(renderer);
    if (found != this->Views.end())
    {
      return found->second;
    }
    // A map's elements stay where they are.
    return this->Views.try_emplace(renderer, renderer, [this] { this->LeaveScreen(); })
      .first->second;
  }

  bool IsSeen() const
  {
    return std::any_of(this->Views.begin(), this->Views.end(),
      [](const auto& view) { return view.second.Renderer && view.second.Seen; });
  }
  void LeaveScreen()
  {
    if (!this->IsSeen())
    {
      this->Owner->LeaveScreen();
    }
  }

  std::vector<pointfront::LayerLimits> LayersOf(vtkPointFrontStore& store) const
  {
    std::vector<pointfront::LayerLimits> limits;
    const int classes = this->ClassLimits.empty() ? 0 : store.GetNumberOfObjectClasses();
    for (int i = 0; i < classes; ++i)
    {
      limits.push_back(limitsOf(this->ClassLimits, store.GetObjectClassNumber(i)));
    }
    return limits;
  }
};

vtkPointFrontMapper::vtkPointFrontMapper() : Internals(new Content(this)) {}

vtkPointFrontMapper::~vtkPointFrontMapper()
{
  this->Internals->Timer.stop();
}

void vtkPointFrontMapper::SetClassVisibility(int objectClass, bool visible)
{
  if (visible != this->GetClassVisibility(objectClass))
  {
    this->Internals->ClassLimits[objectClass].visible = visible;
    this->Modified();
  }
}

bool vtkPointFrontMapper::GetClassVisibility(int objectClass) const
{
  return limitsOf(this->Internals->ClassLimits, objectClass).visible;
}

void vtkPointFrontMapper::SetClassTargetErrorFactor(int objectClass, double factor)
{
  const double kept = std::clamp(factor, 0.01, 100.0);
  if (kept != this->GetClassTargetErrorFactor(objectClass))
  {
    this->Internals->ClassLimits[objectClass].errorFactor = kept;
    this->Modified();
  }
}

double vtkPointFrontMapper::GetClassTargetErrorFactor(int objectClass) const
{
  return limitsOf(this->Internals->ClassLimits, objectClass).errorFactor;
}

void vtkPointFrontMapper::SetClassBudgetShare(int objectClass, double share)
{
  const double kept = std::clamp(share, 0.0, 1.0);
  if (kept != this->GetClassBudgetShare(objectClass))
  {
    this->Internals->ClassLimits[objectClass].share = kept;
    this->Modified();
  }
}

double vtkPointFrontMapper::GetClassBudgetShare(int objectClass) const
{
  return limitsOf(this->Internals->ClassLimits, objectClass).share;
}

void vtkPointFrontMapper::ClearClassLimits()
{
  if (!this->Internals->ClassLimits.empty())
  {
    this->Internals->ClassLimits.clear();
    this->Modified();
  }
}

vtkPointFrontStore* vtkPointFrontMapper::GetStore()
{
  Content& content = *this->Internals;
  vtkPolyData* input = this->GetNumberOfInputConnections(0) > 0 ? this->GetInput() : nullptr;
  const std::string name = vtkPointFrontStore::GetStoreName(input);
  const vtkMTimeType inputTime = input ? input->GetMTime() : 0;
  if (name == content.StoreName && (inputTime == content.InputTime || name.empty()))
  {
    return content.Store;
  }
  content.StoreName = name;
  content.InputTime = inputTime;
  vtkStdString reason;
  auto store = name.empty() ? nullptr : vtkPointFrontStore::Open(name.c_str(), reason);
  if (!store && !name.empty())
  {
    vtkErrorMacro(<< reason);
  }
  if (store != content.Store)
  {
    content.Succession.reset();
    content.Views.clear();
    content.Piece.reset();
    content.Store = store;
  }
  return content.Store;
}

double* vtkPointFrontMapper::GetBounds()
{
  this->Superclass::GetBounds(); // brings the input, and with it the store's name, up to date
  if (vtkPointFrontStore* store = this->GetStore())
  {
    store->GetBounds(this->Bounds);
  }
  return this->Bounds;
}

bool vtkPointFrontMapper::IsInteracting(vtkRenderer* renderer)
{
  vtkRenderWindow* window = renderer->GetRenderWindow();
  return window && window->GetDesiredUpdateRate() > interactiveRate;
}

pointfront::PointColouring vtkPointFrontMapper::GetColouring()
{
  vtkPointFrontStore* store = this->GetStore();
  if (!store || !this->ScalarVisibility)
  {
    return {};
  }
  const pointfront::StoreDescription& description = store->GetStore()->description();
  const pointfront::ColourRequest request = pointfront::colourRequestOf(*this, description);
  std::shared_ptr<const pointfront::ClassHeights> heights;
  if (pointfront::PointColouring::wantsHeights(description, request))
  {
    heights = this->Internals->HeightsOf(store->GetStore());
  }
  const auto colouring = pointfront::PointColouring::choose(description, request, heights);
  if (!colouring && this->Internals->UnknownArray != request.name)
  {
    this->Internals->UnknownArray = request.name;
    vtkWarningMacro(<< "the store " << store->GetFileName() << " has no attribute \""
                    << request.name << "\"; its points are drawn in the property's colour");
  }
  return colouring.value_or(pointfront::PointColouring{});
}

bool vtkPointFrontMapper::HasTranslucentPolygonalGeometry()
{
  const pointfront::PointColouring colouring = this->GetColouring();
  vtkScalarsToColors* table = this->GetLookupTable();
  if (!colouring.usesTable() || !table)
  {
    return false;
  }
  table->Build();
  return table->IsOpaque() == 0;
}

pointfront::FrameDemand vtkPointFrontMapper::GetDemand(vtkRenderer* renderer, vtkActor* actor)
{
  pointfront::FrameDemand demand;
  demand.view = pointfront::viewOf(renderer, actor);
  demand.columns = this->GetColouring().columns();
  demand.targetErrorPx = this->TargetError;
  demand.pointBudget = static_cast<std::uint64_t>(this->PointBudget);
  demand.gpuBytes = this->GPUMemoryBudget;
  demand.method = this->DetailSelection == VIEW_SPECIFIC
                    ? pointfront::DetailMethod::ViewSpecific
                    : pointfront::DetailMethod::RenderingFront;
  if (this->DetailSelection == VIEW_SPECIFIC) // it looks at every open store
  {
    demand.overviewPoints =
      pointfront::overviewShare(static_cast<std::uint64_t>(this->OverviewPoints),
        static_cast<std::uint64_t>(this->GetStore()->GetNumberOfPoints()),
        static_cast<std::uint64_t>(vtkPointFrontStore::GetNumberOfPointsOfAllStores()));
  }
  demand.interacting = IsInteracting(renderer);
  demand.frameMs = this->TargetFrameTime;
  demand.cloudMs = 1000.0 * actor->GetAllocatedRenderTime();
  demand.complete = this->Complete && !demand.interacting;
  demand.layers = this->Internals->LayersOf(*this->GetStore());
  return demand;
}

void vtkPointFrontMapper::FollowPreview(vtkRenderer* renderer, vtkActor* actor)
{
  Content& content = *this->Internals;
  vtkPointFrontStore* store = this->GetStore();
  // Between frames only: the fronts of a frame refer to their store. At rest only: a frame in
  // motion has no time for a second front, nor for bringing all points to the GPU again.
  if (!store || !store->IsPreview() || !content.ViewOf(renderer).NewFrame ||
    renderer->GetSelector() || IsInteracting(renderer))
  {
    return;
  }
  if (!content.Succession)
  {
    auto next = store->GetSuccessor();
    if (!next)
    {
      return;
    }
    const int piece = std::clamp(this->StorePiece, 0, this->NumberOfStorePieces - 1);
    content.Succession = std::make_unique<pointfront::StoreSuccession>(
      next, *store, piece, this->NumberOfStorePieces);
  }
  pointfront::StoreSuccession& succession = *content.Succession;
  for (auto& [viewing, view] : content.Views) // others may not be rendered for a while
  {
    if (view.Front || viewing == renderer)
    {
      pointfront::FrameDemand demand =
        viewing == renderer ? this->GetDemand(renderer, actor) : view.Demand;
      demand.layers = content.LayersOf(*succession.store());
      succession.advance(viewing, std::move(demand));
    }
  }
  const auto shown = [&](const auto& view)
  { return !view.second.Front || !view.second.Renderer || succession.ready(view.first); };
  if (std::all_of(content.Views.begin(), content.Views.end(), shown))
  {
    this->TakeSuccessor();
  }
}

void vtkPointFrontMapper::TakeSuccessor()
{
  Content& content = *this->Internals;
  const std::unique_ptr<pointfront::StoreSuccession> succession = std::move(content.Succession);
  for (auto& [renderer, view] : content.Views)
  {
    view.Front = succession->take(renderer);
    view.Announced = false;
    if (view.Front && view.Renderer)
    {
      view.Front->enterWindow(
        pointfront::perWindow<pointfront::WindowDemand>(view.Renderer->GetRenderWindow()));
    }
  }
  content.Piece = succession->piece();
  content.Store = succession->store();
  this->Modified();
}

pointfront::ViewFront* vtkPointFrontMapper::PrepareFrame(vtkRenderer* renderer, vtkActor* actor)
{
  this->FollowPreview(renderer, actor);
  vtkPointFrontStore* store = this->GetStore();
  if (!store)
  {
    if (this->Internals->StoreName.empty())
    {
      vtkErrorMacro("the input names no store (field data \""
                    << vtkPointFrontStore::FieldName() << "\"); connect a vtkPointFrontReader");
    }
    return nullptr;
  }
  Content& content = *this->Internals;
  if (!content.Piece || content.PieceNumber != this->StorePiece ||
      content.Pieces != this->NumberOfStorePieces)
  {
    content.Succession.reset();
    content.Views.clear();
    content.PieceNumber = this->StorePiece;
    content.Pieces = this->NumberOfStorePieces;
    const int piece = std::clamp(this->StorePiece, 0, this->NumberOfStorePieces - 1);
    content.Piece = std::make_shared<pointfront::HierarchyPiece>(
      store->GetStore()->hierarchy(), piece, this->NumberOfStorePieces);
  }
  pointfront::RendererView& view = content.ViewOf(renderer);
  if (!view.Front)
  {
    view.Front = std::make_unique<pointfront::ViewFront>(
      content.Piece, store->GetResidencyShare(), store->GetStore()->description().schema,
      pointfront::perWindow<pointfront::WindowDemand>(renderer->GetRenderWindow()));
  }
  else if (!view.NewFrame || renderer->GetSelector())
  {
    return view.Front.get(); // a further drawing of the same frame
  }
  view.NewFrame = false;
  view.FirstDrawing = true;

  const auto begin = Clock::now();
  const pointfront::FrameDemand demand = this->GetDemand(renderer, actor);
  view.Announced = view.Announced && view.Demand.view == demand.view;
  view.Demand = demand;
  const pointfront::FrontDelta& delta = view.Front->update(demand);
  this->LastFrontTime = millisecondsSince(begin);
  this->LastFrontLength = delta.frontLength;
  this->LastMoves = delta.moves;
  this->LastRequests = static_cast<vtkIdType>(delta.requests.size());
  this->LastError = delta.errorPx;
  this->LastThreshold = delta.thresholdPx;
  for (const pointfront::Error& error : store->GetResidency().takeErrors())
  {
    vtkErrorMacro(<< error.what);
  }
  for (const pointfront::Error& error : store->GetStore()->hierarchy()->takeFaults())
  {
    vtkErrorMacro(<< error.what);
  }
  return view.Front.get();
}

bool vtkPointFrontMapper::IsFirstDrawing(vtkRenderer* renderer) const
{
  const auto view = this->Internals->Views.find(renderer);
  return view != this->Internals->Views.end() && view->second.FirstDrawing;
}

void vtkPointFrontMapper::FinishFrame(
  vtkRenderer* renderer, vtkIdType points, bool uploadsLeft)
{
  pointfront::RendererView& view = this->Internals->ViewOf(renderer);
  const pointfront::FrontDelta& delta = view.Front->last();
  view.FirstDrawing = false;
  view.Ahead = false;
  view.Due = false;
  view.DrawnAt = Clock::now();
  view.UploadsLeft = uploadsLeft;
  // In motion the frame time limits the front: at rest the same view may show more.
  view.Complete = delta.complete && !uploadsLeft &&
                  (!IsInteracting(renderer) || delta.errorPx <= this->TargetError);
  this->LastPointsDrawn = points;
  this->LastNodesDrawn = static_cast<vtkIdType>(delta.draw.size());
  this->LastComplete = view.Complete;
  this->LastLimitedByPoints = delta.limitedByBudget;
  this->LastLimitedByGPUMemory = delta.limitedByGpu;
  this->LastLimitedByMemory = delta.limitedByMemory;
  this->LastFailedNodes = static_cast<vtkIdType>(delta.failedNodes);
  const bool announce = view.Complete && !view.Announced;
  view.Announced = view.Complete;
  if (announce)
  {
    this->InvokeEvent(ViewCompleteEvent);
  }
}

void vtkPointFrontMapper::RecordFrame(
  vtkRenderer* renderer, vtkIdType points, vtkIdType moves, double milliseconds)
{
  const auto view = this->Internals->Views.find(renderer);
  if (view != this->Internals->Views.end() && view->second.Front)
  {
    view->second.DrawingMs = milliseconds;
    view->second.Front->recordFrame(static_cast<std::uint64_t>(points),
      static_cast<std::uint32_t>(moves), milliseconds);
  }
}

/// The last frame showed nothing of it, and that is all there is to show.
void vtkPointFrontMapper::LeaveScreen()
{
  this->LastPointsDrawn = 0;
  this->LastNodesDrawn = 0;
  this->LastMoves = 0;
  this->LastRequests = 0;
  this->LastError = 0.0;
  this->LastFrontTime = 0.0;
  this->LastComplete = true;
  this->LastLimitedByPoints = false;
  this->LastLimitedByGPUMemory = false;
  this->LastLimitedByMemory = false;
  this->LastFailedNodes = 0;
}

vtkIdType vtkPointFrontMapper::GetPointsOnGPU() const
{
  std::uint64_t points = 0;
  for (const auto& [renderer, view] : this->Internals->Views)
  {
    points += view.Front && this->PointBudget > 0
      ? view.Front->pointsOnGpu(static_cast<std::uint64_t>(this->PointBudget))
      : 0;
  }
  return this->PointBudget > 0 ? std::max<vtkIdType>(1, static_cast<vtkIdType>(points)) : 0;
}

std::uint32_t vtkPointFrontMapper::GetNumberOfViews() const
{
  return static_cast<std::uint32_t>(this->Internals->Views.size());
}

bool vtkPointFrontMapper::IsAheadOfFrame(vtkRenderer* renderer) const
{
  const auto view = this->Internals->Views.find(renderer);
  return view != this->Internals->Views.end() && view->second.Ahead;
}

bool vtkPointFrontMapper::NeedsRender()
{
  if (!this->Internals->Views.empty() && !this->Internals->IsSeen())
  {
    return false;
  }
  const std::unique_ptr<pointfront::StoreSuccession>& succession = this->Internals->Succession;
  if (succession ? succession->wantsUpdate()
                 : this->Internals->Store && this->Internals->Store->HasSuccessor())
  {
    return true;
  }
  bool needed = false;
  for (auto& [renderer, view] : this->Internals->Views)
  {
    needed = (view.Renderer && view.NeedsRender()) || needed;
  }
  return needed;
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

void vtkPointFrontMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "TargetError: " << this->TargetError << "\n";
  os << indent << "PointBudget: " << this->PointBudget << "\n";
  os << indent << "GPUMemoryBudget: " << this->GPUMemoryBudget << "\n";
  os << indent << "DetailSelection: " << this->DetailSelection << "\n";
  os << indent << "OverviewPoints: " << this->OverviewPoints << "\n";
  os << indent << "PointSize: " << this->PointSize << "\n";
  os << indent << "Complete: " << this->Complete << "\n";
  os << indent << "TargetFrameTime: " << this->TargetFrameTime << "\n";
  os << indent << "UploadLimit: " << this->UploadLimit << "\n";
  os << indent << "StorePiece: " << this->StorePiece << " of " << this->NumberOfStorePieces << "\n";
  os << indent << "LastPointsDrawn: " << this->LastPointsDrawn << "\n";
  os << indent << "LastError: " << this->LastError << "\n";
  os << indent << "LastComplete: " << this->LastComplete << "\n";
  os << indent << "LastLimitedByPoints: " << this->LastLimitedByPoints << "\n";
  os << indent << "LastLimitedByGPUMemory: " << this->LastLimitedByGPUMemory << "\n";
  os << indent << "LastLimitedByMemory: " << this->LastLimitedByMemory << "\n";
  os << indent << "LastFailedNodes: " << this->LastFailedNodes << "\n";
}
