#include "vtkPointFrontRepresentation.h"

#include "CloudActor.h"
#include "RankExchange.h"
#include "StyleChoice.h"
#include "UpstreamReader.h"

#include "pointfront/Style/QualityPreset.h"

#include "vtkActorCollection.h"
#include "vtkCommand.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPointFrontMapper.h"
#include "vtkPointFrontStore.h"
#include "vtkPolyData.h"
#include "vtkProcessModule.h"
#include "vtkProperty.h"
#include "vtkPVLODActor.h"
#include "vtkPVRenderView.h"
#include "vtkRenderer.h"
#include "vtkRenderWindow.h"
#include "vtkScalarsToColors.h"
#include "vtkStdString.h"
#include "vtkTransform.h"

#include <algorithm>

vtkStandardNewMacro(vtkPointFrontRepresentation);

namespace
{
/// Frames per second above which a render is interactive: ParaView sets 5 (interactive) and 0.002
/// (still).
constexpr double StillRate = 0.01;

/// Opens the protected getter of the one fact that tells a screenshot from any other still render.
/// ParaView sets it on all processes (vtkSMViewProxy::CaptureWindow).
struct CaptureState : vtkPVView
{
  static bool Of(vtkPVView* view) { return (view->*&CaptureState::GetInCaptureScreenshot)(); }
};

/// The same of the one that tells what a selection renders.
struct SelectionState : vtkPVRenderView
{
  static bool Of(vtkPVRenderView* view) { return (view->*&SelectionState::GetMakingSelection)(); }
};
} // namespace

//------------------------------------------------------------------------------
vtkPointFrontRepresentation::vtkPointFrontRepresentation()
  : Actor(vtkSmartPointer<pointfront::CloudActor>::New())
  , Choice(new pointfront::StyleChoice)
  , Exchange(new pointfront::RankExchange)
{
  this->Property->SetRepresentationToPoints();
  this->Property->LightingOff();
  this->Actor->SetProperty(this->Property);
  this->Actor->SetMapper(this->Mapper);
  this->Actor->SetEnableLOD(0); // the mapper has its own levels of detail
}

//------------------------------------------------------------------------------
vtkPointFrontRepresentation::~vtkPointFrontRepresentation() = default;

//------------------------------------------------------------------------------
int vtkPointFrontRepresentation::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  // The client and the render server have the representation, but no pipeline.
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkPointFrontRepresentation::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->Overview->Initialize();
  this->Store = nullptr;
  if (inputVector[0]->GetNumberOfInformationObjects() == 1)
  {
    // Without a store nothing is drawn, and one error says why: no failure of the pipeline's.
    vtkPolyData* overview = vtkPolyData::GetData(inputVector[0], 0);
    const vtkStdString name = vtkPointFrontStore::GetStoreName(overview);
    vtkStdString error;
    if (!pointfront::upstreamReaderOf(this) || name.empty())
    {
      // A filter passes the store's name on, and its points may be others than the store's.
      error = name.empty() ? "this input comes from no store" : "this input is a filter's output";
      error = "Point Front draws the whole cloud of a store, and " + error +
        ": choose another representation for it. (To move, turn or scale a store, use the "
        "properties under Transforming.)";
    }
    else
    {
      this->Store = vtkPointFrontStore::Open(name.c_str(), error);
    }
    if (this->Store)
    {
      this->Overview->ShallowCopy(overview);
    }
    else if (!name.empty() || !pointfront::upstreamReaderOf(this))
    {
      vtkErrorMacro(<< error); // a reader without a store has said why
    }
  }
  return this->Superclass::RequestData(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
int vtkPointFrontRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo)
{
  auto* view = vtkPVRenderView::SafeDownCast(inInfo->Get(vtkPVView::VIEW()));
  if (request == vtkPVView::REQUEST_RENDER() && view)
  {
    this->PrepareMarks(view);
  }
  if (!this->Superclass::ProcessViewRequest(request, inInfo, outInfo))
  {
    return 0; // hidden
  }
  if (request == vtkPVView::REQUEST_UPDATE())
  {
    this->ProvideData(inInfo);
  }
  else if (request == vtkPVView::REQUEST_UPDATE_LOD())
  {
    vtkPVView::SetPieceLOD(inInfo, this, this->Overview);
    vtkPVRenderView::SetRequiresDistributedRenderingLOD(inInfo, this, true);
  }
  else if (request == vtkPVView::REQUEST_RENDER() && view)
  {
    this->PrepareFrame(inInfo, view);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::PrepareMarks(vtkPVRenderView* view)
{
  // Out of the renderer, not invisible: who made them goes on updating them and decides whether
  // they are shown.
  for (const auto& mark : this->HiddenMarks)
  {
    mark ? view->GetRenderer()->AddActor(mark) : void();
  }
  this->HiddenMarks.clear();
  if (!SelectionState::Of(view) || !this->GetVisibility())
  {
    return;
  }
  vtkActorCollection* actors = view->GetRenderer()->GetActors();
  for (int i = 0; i < actors->GetNumberOfItems(); ++i)
  {
    auto* actor = vtkPVLODActor::SafeDownCast(actors->GetItemAsObject(i));
    if (actor && !actor->GetPickable())
    {
      this->HiddenMarks.emplace_back(actor);
    }
  }
  for (const auto& mark : this->HiddenMarks)
  {
    view->GetRenderer()->RemoveActor(mark);
  }
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SuspendFXAA(vtkPVRenderView* view)
{
  this->ResumeFXAA(); // a frame that was not rendered here
  if (this->CrispPoints && view->GetUseFXAA())
  {
    view->SetUseFXAA(false);
    this->SuspendedView = view;
    this->EndObserver = view->GetRenderer()->AddObserver(
      vtkCommand::EndEvent, this, &vtkPointFrontRepresentation::ResumeFXAA);
  }
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::ResumeFXAA()
{
  if (this->SuspendedView)
  {
    this->SuspendedView->GetRenderer()->RemoveObserver(this->EndObserver);
    this->SuspendedView->SetUseFXAA(true);
    this->SuspendedView = nullptr;
  }
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::ProvideData(vtkInformation* inInfo)
{
  vtkPVView::SetPiece(inInfo, this, this->Overview);
  vtkPVRenderView::SetRequiresDistributedRendering(inInfo, this, true);
  if (this->Store)
  {
    // Bounds of the whole cloud on every rank: they set the camera's reset and its clipping range.
    double bounds[6];
    this->Store->GetBounds(bounds);
    vtkNew<vtkMatrix4x4> matrix;
    this->Actor->GetMatrix(matrix);
    vtkPVRenderView::SetGeometryBounds(inInfo, this, bounds, matrix);
  }
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::PrepareFrame(vtkInformation* inInfo, vtkPVRenderView* view)
{
  const bool lod = inInfo->Has(vtkPVRenderView::USE_LOD()) != 0;
  this->Mapper->SetInputDataObject(lod ? vtkPVView::GetDeliveredPieceLOD(inInfo, this)
                                       : vtkPVView::GetDeliveredPiece(inInfo, this));
  // A cloud without a store to draw has been told of, or was cancelled.
  const bool named =
    !vtkPointFrontStore::GetStoreName(this->Mapper->GetInputDataObject(0, 0)).empty();
  this->Actor->SetVisibility(named && this->GetVisibility());

  const bool distributed = lod ? view->GetUseDistributedRenderingForLODRender()
                               : view->GetUseDistributedRenderingForRender();
  auto* controller = vtkMultiProcessController::GetGlobalController();
  const bool shared = distributed && controller;
  this->Mapper->SetNumberOfStorePieces(shared ? controller->GetNumberOfProcesses() : 1);
  this->Mapper->SetStorePiece(shared ? controller->GetLocalProcessId() : 0);

  const double rate = view->GetRenderWindow()->GetDesiredUpdateRate();
  const bool interactive = rate > StillRate;
  this->InMotion = interactive;
  this->Mapper->SetComplete(!interactive && this->WantsComplete(view));
  // vtkPVLODActor draws through an actor of its own, whose allotted time nobody sets: hand the time
  // on here.
  const double frameTime =
    this->TargetFrameTime > 0.0 || !interactive ? this->TargetFrameTime : 1000.0 / rate;
  this->Mapper->SetTargetFrameTime(frameTime);
  const auto* preset = pointfront::qualityPresetOf(this->Choice->look.quality);
  this->Mapper->SetTargetError(preset ? preset->errorPx : this->TargetError);

  this->PrepareClasses();
  this->PrepareColors();
  this->SuspendFXAA(view);
}

//------------------------------------------------------------------------------
bool vtkPointFrontRepresentation::WantsComplete(vtkPVRenderView* view) const
{
  if (this->CompleteStillRenders != WHEN_UNATTENDED)
  {
    return this->CompleteStillRenders == ALWAYS;
  }
  return vtkProcessModule::GetProcessType() == vtkProcessModule::PROCESS_BATCH ||
    CaptureState::Of(view);
}

//------------------------------------------------------------------------------
bool vtkPointFrontRepresentation::AddToView(vtkView* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  if (!renderView)
  {
    return false;
  }
  renderView->GetRenderer()->AddActor(this->Actor);
  renderView->RegisterPropForHardwareSelection(this, this->Actor);
  // With a server, pictures in motion have fewer pixels than the window: ParaView sets the viewport
  // when the renderer starts, with priority 0. Behind that a lens knows its place.
  this->StartObserver = renderView->GetRenderer()->AddObserver(
    vtkCommand::StartEvent, this, &vtkPointFrontRepresentation::BeginFrame, -1.0f);
  this->UncoverObserver = renderView->GetRenderer()->AddObserver(
    vtkCommand::EndEvent, this, &vtkPointFrontRepresentation::UncoverView);
  return this->Superclass::AddToView(view);
}

//------------------------------------------------------------------------------
bool vtkPointFrontRepresentation::RemoveFromView(vtkView* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  if (!renderView)
  {
    return false;
  }
  this->ResumeFXAA();
  renderView->GetRenderer()->RemoveObserver(this->StartObserver);
  renderView->GetRenderer()->RemoveObserver(this->UncoverObserver);
  renderView->GetRenderer()->RemoveActor(this->Actor);
  renderView->UnRegisterPropForHardwareSelection(this, this->Actor);
  return this->Superclass::RemoveFromView(view);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::BeginFrame()
{
  this->PlaceLens();
  this->AgreeOnExchange();
  this->CoverView();
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::CoverView()
{
  auto* view = vtkPVRenderView::SafeDownCast(this->GetView());
  const bool shared = view && this->GetVisibility() && this->Mapper->GetNumberOfStorePieces() > 1;
  this->Actor->CoverView(shared ? view->GetRenderer() : nullptr);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::UncoverView()
{
  this->Actor->CoverView(nullptr);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::AgreeOnExchange()
{
  this->Mapper->SetPictureExchange(nullptr);
  auto* view = vtkPVRenderView::SafeDownCast(this->GetView());
  if (!view || !this->GetVisibility() || this->Mapper->GetNumberOfStorePieces() < 2)
  {
    return; // alike on all ranks
  }
  const bool seen = this->Actor->GetVisibility() && !SelectionState::Of(view);
  const bool oneSurface = this->Actor->HasTranslucentPolygonalGeometry() != 0;
  const bool wanted = seen && !oneSurface &&
    this->Mapper->NeedsPictureExchange(this->Actor, this->InMotion) &&
    pointfront::isSurelyInView(view->GetRenderer(), this->Actor->GetCloudBounds());
  const bool agreed =
    this->Exchange->agreed(vtkMultiProcessController::GetGlobalController(), wanted);
  if (agreed)
  {
    this->Mapper->SetPictureExchange(this->Exchange.get());
  }
  if (seen)
  {
    this->TellLensOfRanks(oneSurface);
  }
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetVisibility(bool visible)
{
  this->Actor->SetVisibility(visible);
  this->Superclass::SetVisibility(visible);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "CompleteStillRenders: " << this->CompleteStillRenders << "\n"
     << indent << "TargetError: " << this->TargetError << " px\n"
     << indent << "TargetFrameTime: " << this->TargetFrameTime << " ms\n"
     << indent << "HiddenClasses: " << this->HiddenClasses.size() << "\n"
     << indent << "MapScalars: " << this->MapScalars << "\n"
     << indent << "DirectColors: " << this->DirectColors << "\n";
  this->Mapper->PrintSelf(os, indent.GetNextIndent());
}
