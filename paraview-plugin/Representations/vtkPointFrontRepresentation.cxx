// Longer than 450 lines: ParaView sets some sixty properties, each by a method of this class.
#include "vtkPointFrontRepresentation.h"

#include "ClassSettings.h"
#include "CloudActor.h"
#include "CloudColors.h"
#include "FXAAPause.h"
#include "RankExchange.h"
#include "SelectionMarks.h"
#include "StyleChoice.h"
#include "UpstreamReader.h"
#include "vtkPVPointFilesReader.h"

#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPointFrontMapper.h"
#include "vtkPointFrontStore.h"
#include "vtkPointFrontStyle.h"
#include "vtkPolyData.h"
#include "vtkProcessModule.h"
#include "vtkProperty.h"
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

std::string textOf(const char* value)
{
  return value ? value : "";
}

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
  , Classes(new pointfront::ClassSettings)
  , Colors(new pointfront::CloudColors)
  , WithoutFXAA(new pointfront::FXAAPause)
  , Marks(new pointfront::SelectionMarks)
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
    this->Marks->putBack(view->GetRenderer());
    if (SelectionState::Of(view) && this->GetVisibility())
    {
      this->Marks->takeOut(view->GetRenderer());
    }
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
  const auto preset = this->Choice->look.preset(); // the style tells of one that is none
  this->Mapper->SetTargetError(preset && *preset ? (*preset)->errorPx : this->TargetError);

  this->Classes->apply(*this->Mapper);
  this->PrepareColors();
  this->WithoutFXAA->end();
  if (this->CrispPoints)
  {
    this->WithoutFXAA->begin(view);
  }
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
void vtkPointFrontRepresentation::PrepareColors()
{
  vtkInformation* info = this->GetInputArrayInformation(0);
  const char* array = info && info->Has(vtkDataObject::FIELD_NAME())
    ? info->Get(vtkDataObject::FIELD_NAME())
    : nullptr;
  const bool ofPoints = info && info->Has(vtkDataObject::FIELD_ASSOCIATION()) &&
    info->Get(vtkDataObject::FIELD_ASSOCIATION()) == vtkDataObject::FIELD_ASSOCIATION_POINTS;
  this->Tell(this->Colors->choose(
    *this->Mapper, array && ofPoints ? array : "", { this->MapScalars, this->DirectColors }));
  this->PrepareStyle();
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::PrepareStyle()
{
  auto* view = vtkPVRenderView::SafeDownCast(this->GetView());
  if (!view)
  {
    return;
  }
  pointfront::LookColour colour;
  this->Colors->describe(*this->Mapper, colour);
  std::copy_n(this->Property->GetColor(), 3, colour.flat.begin());
  pointfront::PointLook& look = this->Choice->look;
  look.pixels = this->PointSize;
  // By depth, which translucent actors do not write, ranks put their pictures together.
  look.opacity = this->Opacity;
  look.translucentSurface = this->Mapper->GetNumberOfStorePieces() > 1;
  this->Property->SetOpacity(look.translucentSurface ? 1.0 : this->Opacity);
  std::string error;
  const int* const size = view->GetRenderer()->GetSize();
  vtkPointFrontStyle* const style = this->Choice->style(colour, size[0], size[1], error);
  this->Mapper->SetStyle(style);
  this->Tell(this->Colors->lostOpacities(*this->Mapper, style != nullptr));
  if (!error.empty() && this->Mapper->GetStorePiece() == 0)
  {
    vtkErrorMacro(<< error);
  }
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
  this->WithoutFXAA->end();
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
void vtkPointFrontRepresentation::PlaceLens()
{
  if (this->GetVisibility() && this->Choice->lens.place.shape != pointfront::LensPlace::NONE)
  {
    this->PrepareStyle();
  }
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
void vtkPointFrontRepresentation::TellLensOfRanks(bool oneSurface)
{
  const pointfront::LensChoice& lens = this->Choice->lens;
  const bool parted =
    oneSurface && lens.shows() && lens.place.shape == pointfront::LensPlace::AROUND_CLASS;
  if (parted && !this->ToldOfRanks)
  {
    this->Tell("a lens around a class covers, on each rank, what that rank has of the class, "
               "because the cloud as a whole is translucent: where ranks meet it has gaps.");
  }
  this->ToldOfRanks = parted;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::Tell(const std::string& warning)
{
  if (!warning.empty() && this->Mapper->GetStorePiece() == 0)
  {
    vtkWarningMacro(<< warning);
  }
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetVisibility(bool visible)
{
  this->Actor->SetVisibility(visible);
  this->Superclass::SetVisibility(visible);
}

//------------------------------------------------------------------------------
bool vtkPointFrontRepresentation::IsColor(const std::string& array)
{
  return pointfront::CloudColors::isColour(array);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetPointBudget(vtkIdType points)
{
  this->Mapper->SetPointBudget(points);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetGPUMemoryBudget(int mebibytes)
{
  this->Mapper->SetGPUMemoryBudget(static_cast<vtkTypeInt64>(mebibytes) << 20);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetDetailSelection(int method)
{
  this->Mapper->SetDetailSelection(method);
}

//------------------------------------------------------------------------------
int vtkPointFrontRepresentation::GetHostMemoryBudget()
{
  return static_cast<int>(vtkPointFrontStore::GetProcessMemoryBudget() >> 20);
}

//------------------------------------------------------------------------------
int vtkPointFrontRepresentation::GetNumberOfClasses()
{
  return this->Store ? this->Store->GetNumberOfObjectClasses() : 0;
}

//------------------------------------------------------------------------------
const char* vtkPointFrontRepresentation::GetNameOfClass(int index)
{
  return this->Store ? this->Store->GetObjectClassName(index) : nullptr;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetClassVisibility(const char* name, int shown)
{
  if (shown != 0)
  {
    this->Classes->hidden.erase(name);
  }
  else
  {
    this->Classes->hidden.insert(name);
  }
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::ClearClassTargetErrorFactors()
{
  this->Classes->errorFactors.clear();
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetClassTargetErrorFactor(const char* name, double factor)
{
  this->Classes->errorFactors[name] = factor;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::ClearClassBudgetShares()
{
  this->Classes->budgetShares.clear();
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetClassBudgetShare(const char* name, double share)
{
  this->Classes->budgetShares[name] = share;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetLookupTable(vtkScalarsToColors* table)
{
  this->Colors->table = table;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetPointSize(double pixels)
{
  this->PointSize = pixels;
  this->Property->SetPointSize(static_cast<float>(pixels));
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetTechnique(const char* name)
{
  this->Choice->look.technique = name ? name : "";
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetQuality(const char* name)
{
  const std::string quality = name ? name : "";
  this->Choice->look.quality = quality == "custom" ? std::string() : quality;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetClosingSize(int closing)
{
  this->Choice->look.closing = closing;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetSizeFactor(double factor)
{
  this->Choice->look.factor = factor;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetEyeDomeStrength(double strength)
{
  this->Choice->look.eyeDomeStrength = strength;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetLit(int light)
{
  this->Choice->look.light = light;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetFillHoles(bool fill)
{
  this->Choice->look.fillHoles = fill;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetWhere(const char* condition)
{
  this->Choice->look.where = condition ? condition : "";
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetBackend(int backend)
{
  this->Mapper->SetBackend(backend);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetStyleFile(const char* fileName)
{
  this->Choice->setFile(fileName ? fileName : "");
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::ClearClassStyles()
{
  this->Choice->classes.clear();
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::AddClassStyle(
  const char* classCode, const char* technique, const char* color, const char* size)
{
  this->Choice->classes.add(textOf(classCode), textOf(technique), textOf(color), textOf(size));
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::ClearClassLights()
{
  this->Choice->lights.clear();
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::AddClassLight(
  const char* classCode, const char* light, const char* eyeDomeStrength)
{
  this->Choice->lights.addLight(textOf(classCode), textOf(light), textOf(eyeDomeStrength));
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetLensShape(int shape)
{
  this->Choice->lens.place.shape = shape;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetLensCenter(double x, double y)
{
  this->Choice->lens.place.centre = { { x, y } };
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetLensRadius(double radius)
{
  this->Choice->lens.place.radius = radius;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetLensSize(double width, double height)
{
  this->Choice->lens.place.size = { { width, height } };
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetLensMask(const char* fileName)
{
  this->Choice->lens.setMaskFile(textOf(fileName));
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetLensClass(int classCode)
{
  this->Choice->lens.place.aroundClass = classCode;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetLensClassRadius(double radius)
{
  this->Choice->lens.place.aroundRadius = radius;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::ClearLensStyles()
{
  this->Choice->lens.classes.clear();
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::AddLensStyle(
  const char* classCode, const char* technique, const char* color, const char* size)
{
  this->Choice->lens.classes.add(
    textOf(classCode), textOf(technique), textOf(color), textOf(size), true);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetGrowthTime(double milliseconds)
{
  this->Mapper->SetGrowthTime(milliseconds);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetOpacity(double opacity)
{
  this->Opacity = opacity;
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetAmbientColor(double r, double g, double b)
{
  this->Property->SetAmbientColor(r, g, b);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetDiffuseColor(double r, double g, double b)
{
  this->Property->SetDiffuseColor(r, g, b);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetPickable(int pickable)
{
  this->Actor->SetPickable(pickable);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetPosition(double x, double y, double z)
{
  this->Position = { x, y, z };
  this->Actor->SetPosition(
    x + this->Translation[0], y + this->Translation[1], z + this->Translation[2]);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetTranslation(double x, double y, double z)
{
  this->Translation = { x, y, z };
  this->SetPosition(this->Position[0], this->Position[1], this->Position[2]);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetScale(double x, double y, double z)
{
  this->Actor->SetScale(x, y, z);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetOrientation(double x, double y, double z)
{
  this->Actor->SetOrientation(x, y, z);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetOrigin(double x, double y, double z)
{
  this->Actor->SetOrigin(x, y, z);
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::SetUserTransform(const double matrix[16])
{
  vtkNew<vtkTransform> transform;
  transform->SetMatrix(matrix);
  this->Actor->SetUserTransform(transform);
}

//------------------------------------------------------------------------------
bool vtkPointFrontRepresentation::IsDrawing()
{
  return this->GetVisibility() && this->GetView() && this->Mapper->GetStore();
}

//------------------------------------------------------------------------------
bool vtkPointFrontRepresentation::IsSeen()
{
  return this->IsDrawing() && this->Mapper->IsSeen();
}

//------------------------------------------------------------------------------
vtkIdType vtkPointFrontRepresentation::GetPointsDrawn()
{
  return this->IsSeen() ? this->Mapper->GetLastPointsDrawn() : 0;
}

//------------------------------------------------------------------------------
vtkIdType vtkPointFrontRepresentation::GetNodesDrawn()
{
  return this->IsSeen() ? this->Mapper->GetLastNodesDrawn() : 0;
}

//------------------------------------------------------------------------------
double vtkPointFrontRepresentation::GetProjectedSpacing()
{
  return this->IsSeen() ? this->Mapper->GetLastError() : 0.0;
}

//------------------------------------------------------------------------------
std::string vtkPointFrontRepresentation::GetTechniqueDrawn()
{
  const bool draws = this->IsSeen() && this->Mapper->GetLastPointsDrawn() > 0;
  return draws ? this->Mapper->GetLastTechnique() : std::string();
}

//------------------------------------------------------------------------------
vtkIdType vtkPointFrontRepresentation::GetStorePoints()
{
  return this->IsDrawing() ? this->Mapper->GetStore()->GetNumberOfPoints() : 0;
}

//------------------------------------------------------------------------------
vtkIdType vtkPointFrontRepresentation::GetMissingNodes()
{
  return this->IsSeen() ? this->Mapper->GetLastFailedNodes() : 0;
}

//------------------------------------------------------------------------------
int vtkPointFrontRepresentation::GetFrameLimits()
{
  if (!this->IsSeen())
  {
    return 0;
  }
  const auto bit = [](bool set, int value) { return set ? value : 0; };
  const bool points = this->Mapper->GetLastLimitedByPoints();
  return bit(points && !this->InMotion, POINT_BUDGET) | bit(points && this->InMotion, FRAME_TIME) |
    bit(this->Mapper->GetLastLimitedByGPUMemory(), GPU_MEMORY) |
    bit(this->Mapper->GetLastLimitedByMemory(), HOST_MEMORY) |
    bit(!this->Mapper->GetLastComplete(), LOADING) |
    bit(this->Mapper->GetLastFailedNodes() > 0, UNREADABLE);
}

//------------------------------------------------------------------------------
bool vtkPointFrontRepresentation::GetFrameComplete()
{
  // A cloud that is out of view lacks nothing, but its build goes on.
  const bool loaded = !this->IsSeen() || this->Mapper->GetLastComplete();
  return !this->IsDrawing() || (loaded && this->GetBuildState().empty());
}

//------------------------------------------------------------------------------
std::string vtkPointFrontRepresentation::GetBuildState()
{
  auto* files = vtkPVPointFilesReader::SafeDownCast(pointfront::upstreamReaderOf(this));
  return files ? files->GetBuildState() : std::string();
}

//------------------------------------------------------------------------------
bool vtkPointFrontRepresentation::GetFrameOutdated()
{
  return this->IsDrawing() && this->Mapper->NeedsRender();
}

//------------------------------------------------------------------------------
void vtkPointFrontRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "CompleteStillRenders: " << this->CompleteStillRenders << "\n"
     << indent << "TargetError: " << this->TargetError << " px\n"
     << indent << "TargetFrameTime: " << this->TargetFrameTime << " ms\n"
     << indent << "HiddenClasses: " << this->Classes->hidden.size() << "\n"
     << indent << "MapScalars: " << this->MapScalars << "\n"
     << indent << "DirectColors: " << this->DirectColors << "\n";
  this->Mapper->PrintSelf(os, indent.GetNextIndent());
}
