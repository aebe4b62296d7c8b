#include "vtkOpenGLPointFrontMapper.h"

#include "CloudLook.h"
#include "DrawBatches.h"
#include "LayerStreams.h"
#include "SplatLights.h"
#include "WindowDrawing.h"

#include "pointfront/Plan/FramePlan.h"
#include "pointfront/Plan/FrameStatistics.h"
#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Style/StyleSheet.h"
#include "vtkPointFrontStore.h"

#include <vtkActor.h>
#include <vtkCommand.h>
#include <vtkIndent.h>
#include <vtkInformation.h>
#include <vtkInformationObjectBaseVectorKey.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLRenderPass.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkShadowMapBakerPass.h>
#include <vtkWindow.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkOpenGLPointFrontMapper);

namespace
{

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point begin)
{
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

bool hasOwnShaders(vtkActor* actor)
{
  vtkShaderProperty* const shaders = actor->GetShaderProperty();
  return shaders->HasVertexShaderCode() || shaders->HasFragmentShaderCode() ||
    shaders->HasGeometryShaderCode() || shaders->GetNumberOfShaderReplacements() > 0;
}

/// More translucent groups, outside of lenses or in one, than can be composed at once.
bool hasTooManyGroups(const std::vector<pointfront::LayerStyling>& layers)
{
  std::map<int, std::set<std::uint16_t>> groups; // by lens
  for (const pointfront::LayerStyling& layer : layers)
  {
    for (const auto& style : layer.styles)
    {
      if (style->group > 0)
      {
        groups[style->lens].insert(style->group);
      }
    }
  }
  return std::any_of(groups.begin(), groups.end(),
    [](const auto& ofLens)
    { return ofLens.second.size() > pointfront::SplatComposition::mostGroups; });
}

/// VTK draws such points itself, where no style says how points are drawn.
bool areSpheresOfVTK(vtkActor* actor, const pointfront::CloudLook& look)
{
  return !look.shading && actor->GetProperty()->GetRenderPointsAsSpheres();
}

/// VTK draws all from a light's place, for the shadows that things cast. It would be a view of its
/// own, and the frame's first one: the picture would have the detail that the light sees.
bool drawsShadows(vtkActor* actor)
{
  vtkInformation* const keys = actor->GetPropertyKeys();
  const int passes = keys ? keys->Length(vtkOpenGLRenderPass::RenderPasses()) : 0;
  for (int i = 0; i < passes; ++i)
  {
    if (vtkShadowMapBakerPass::SafeDownCast(keys->Get(vtkOpenGLRenderPass::RenderPasses(), i)))
    {
      return true;
    }
  }
  return false;
}

std::size_t lightsThatAreOn(vtkRenderer* renderer)
{
  std::size_t lights = 0;
  vtkLightCollection* const all = renderer->GetLights();
  vtkCollectionSimpleIterator at;
  all->InitTraversal(at);
  while (vtkLight* const light = all->GetNextLight(at))
  {
    lights += light->GetSwitch() ? 1 : 0;
  }
  return lights;
}

/// VTK's own template. A mapper without a style draws as VTK's; an actor's shader code works there,
/// and every point of a translucent actor is translucent. It keeps nothing from frame to frame.
bool drawsInTemplate(vtkActor* actor, const pointfront::CloudLook& look)
{
  return look.plain &&
    (!look.shading || hasOwnShaders(actor) || actor->HasTranslucentPolygonalGeometry() != 0);
}

bool hasTooMuchLight(vtkRenderer* renderer, const pointfront::CloudLook& look)
{
  return look.shading &&
    (look.shading->lookCount() > pointfront::mostLooks ||
      (look.shading->anyLit() && lightsThatAreOn(renderer) > pointfront::mostLights));
}

/// Whether OpenGL draws the frame as the software back end does.
bool drawsByOpenGL(vtkRenderer* renderer, const pointfront::CloudLook& look)
{
  return !hasTooMuchLight(renderer, look) &&
    (!look.shading ||
      (!hasTooManyGroups(look.layers) &&
        std::all_of(look.layers.begin(), look.layers.end(),
          [](const pointfront::LayerStyling& layer)
          { return pointfront::LayerStreams::canDraw(layer.styles); })));
}

} // namespace

struct vtkOpenGLPointFrontMapper::Content
{
  std::map<vtkWindow*, std::unique_ptr<pointfront::WindowDrawing>> Windows;
  std::uint64_t UploadedBefore = 0; ///< by drawings that are gone
  bool FallBackTold = false;
  bool OwnShadersTold = false;

  pointfront::WindowDrawing& Of(vtkOpenGLRenderWindow* window)
  {
    auto& drawing = this->Windows[window];
    if (!drawing)
    {
      drawing = std::make_unique<pointfront::WindowDrawing>(window);
    }
    return *drawing;
  }
};

vtkOpenGLPointFrontMapper::vtkOpenGLPointFrontMapper()
  : Internals(new Content)
{
}

vtkOpenGLPointFrontMapper::~vtkOpenGLPointFrontMapper() = default;

/// Tells the front what an earlier frame cost, once.
void vtkOpenGLPointFrontMapper::ReadTimer(
  vtkRenderer* renderer, vtkActor* actor, pointfront::FrameTimer& timer)
{
  if (const auto frame = timer.take())
  {
    this->TimeToDraw = 1e-3 * frame->milliseconds;
    this->RecordFrame(renderer, actor, frame->points, frame->moves, frame->milliseconds);
  }
}

void vtkOpenGLPointFrontMapper::RenderPiece(vtkRenderer* renderer, vtkActor* actor)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!window || window->CheckAbortStatus() || drawsShadows(actor))
  {
    return;
  }
  this->InvokeEvent(vtkCommand::StartEvent, nullptr);
  if (!this->Static && this->GetNumberOfInputConnections(0) > 0)
  {
    this->GetInputAlgorithm()->Update();
  }
  this->InvokeEvent(vtkCommand::EndEvent, nullptr);

  pointfront::WindowDrawing& drawing = this->Internals->Of(window);
  drawing.enter(renderer, actor);
  const auto begin = Clock::now();
  this->ReadTimer(renderer, actor, drawing.timerOf(renderer, actor));
  const std::optional<pointfront::CloudLook> look = this->BeginFrame(renderer, actor);
  if (!look)
  {
    return;
  }
  pointfront::FramePlan& plan = this->PlanFrame(renderer, actor, *look);
  drawing.setStore(this->GetStore());
  const bool first = this->IsFirstDrawing(renderer, actor);
  const bool host = look->inHostMemory;
  std::uint64_t kept = 0;
  if (host)
  {
    const bool ids = renderer->GetSelector() != nullptr;
    kept = drawing.softwarePicture().draw(window, renderer, actor, plan, ids).keptVisible;
  }
  const bool uploadsLeft = !host && this->Upload(renderer, actor, drawing, plan);
  pointfront::FrameTimer& timer = drawing.timerOf(renderer, actor);
  const bool timed =
    first && plan.pointCount() > 0 && timer.begin(millisecondsSince(begin), this->GetLastMoves());
  const auto drawn = Clock::now();
  const vtkIdType points = host
    ? this->HandOver(renderer, actor, drawing, plan)
    : this->DrawPoints(renderer, actor, *look, drawing, plan, uploadsLeft);
  if (!host && !drawsInTemplate(actor, *look))
  {
    kept = static_cast<std::uint64_t>(drawing.splats().keptPoints());
  }
  if (timed)
  {
    timer.end(millisecondsSince(drawn), points + static_cast<std::int64_t>(kept));
  }
  if (first)
  {
    this->GetStatistics().gpuBytes = drawing.pool().memory().bytes();
    this->GetStatistics().windowGpuBytes = drawing.pool().memory().windowBytes();
    this->FinishFrame(renderer, actor, points, static_cast<vtkIdType>(kept), uploadsLeft);
  }
  this->UpdateProgress(1.0);
}

/// Hands over the picture that threads have drawn.
vtkIdType vtkOpenGLPointFrontMapper::HandOver(vtkRenderer* renderer, vtkActor* actor,
  pointfront::WindowDrawing& drawing, const pointfront::FramePlan& plan)
{
  const auto points = static_cast<vtkIdType>(plan.pointCount());
  if (points > 0 || !plan.standIns.empty())
  {
    drawing.softwarePicture().handOver(
      static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow()), renderer, actor, plan,
      this->GetStore()->GetNumberOfPoints(), this);
  }
  return points;
}

/// Draws the points of the plan that are on the GPU.
vtkIdType vtkOpenGLPointFrontMapper::DrawPoints(vtkRenderer* renderer, vtkActor* actor,
  const pointfront::CloudLook& look, pointfront::WindowDrawing& drawing,
  pointfront::FramePlan& plan, bool uploadsLeft)
{
  if (drawing.pool().takeRefused())
  {
    vtkWarningMacro("the GPU has less memory than the budget of this window: not all points of the "
                    "view are drawn; set a smaller GPUMemoryBudget");
  }
  const vtkIdType storePoints = this->GetStore()->GetNumberOfPoints();
  if (drawsInTemplate(actor, look))
  {
    const vtkIdType points = drawing.list(plan);
    if (points > 0)
    {
      drawing.draw(renderer, actor, this, plan, storePoints);
    }
    return points;
  }
  const vtkIdType points =
    drawing.drawSplats(renderer, plan, renderer->GetSelector() != nullptr, uploadsLeft);
  if (points == pointfront::SplatPicture::noTarget)
  {
    vtkErrorMacro("OpenGL cannot draw splats into textures of "
      << plan.camera.width << " x " << plan.camera.height
      << " pixels (32-bit floats); use a smaller window or the software back end");
    return 0;
  }
  if (points > 0 || !plan.standIns.empty())
  {
    drawing.splats().handOver(renderer, actor, plan, storePoints, this);
  }
  return points;
}

/// Uploads points for a frame's first drawing. True when something is left over.
bool vtkOpenGLPointFrontMapper::Upload(vtkRenderer* renderer, vtkActor* actor,
  pointfront::WindowDrawing& drawing, const pointfront::FramePlan& plan)
{
  // A still picture waits for all of its points.
  const bool still = this->Complete && !IsInteracting(renderer);
  const std::int64_t limit = still ? std::numeric_limits<std::int64_t>::max() : this->UploadLimit;
  if (!this->IsFirstDrawing(renderer, actor))
  {
    // The plan of a selection has no stand-ins, and may have other nodes instead.
    if (this->IsAheadOfFrame(renderer, actor) || renderer->GetSelector())
    {
      drawing.upload(plan, limit);
    }
    return false;
  }
  vtkWindow* window = renderer->GetRenderWindow();
  drawing.pool().beginFrame({ static_cast<std::uint64_t>(this->GetPointsOnGPU(window)),
    this->GPUMemoryBudget, this->GetNumberOfViews(window) });
  return drawing.upload(plan, limit);
}

/// Says once what another back end draws than the one that was asked for.
void vtkOpenGLPointFrontMapper::TellFallBack(const char* what)
{
  if (this->Backend != AUTOMATIC && !std::exchange(this->Internals->FallBackTold, true))
  {
    vtkWarningMacro(<< what);
  }
}

/// Asked while the window's context is current.
bool vtkOpenGLPointFrontMapper::DrawsFromHostMemory(
  vtkRenderer* renderer, vtkActor* actor, const pointfront::CloudLook& look)
{
  if (this->Exchange)
  {
    return true; // sums of weights are those of the software back end
  }
  const bool ownShaders = look.plain && hasOwnShaders(actor);
  if (!look.plain && hasOwnShaders(actor) && !std::exchange(this->Internals->OwnShadersTold, true))
  {
    vtkWarningMacro("the actor's own shader code is not used: it draws points of a fixed number of "
                    "pixels, and the style asks for more (a technique, a filter, light, lenses)");
  }
  const bool spheres = areSpheresOfVTK(actor, look);
  const bool onlyOpenGL = ownShaders || spheres || actor->HasTranslucentPolygonalGeometry() != 0;
  const bool asked =
    this->Backend == SOFTWARE || (this->Backend == AUTOMATIC && pointfront::glIsAProgram());
  if (asked && onlyOpenGL)
  {
    this->TellFallBack(ownShaders
        ? "the software back end does not draw with an actor's own shader code: OpenGL does"
        : spheres ? "the software back end does not draw a property's points as spheres: OpenGL "
                    "does; a style "
                    "with the technique spheres is drawn by both"
                  : "the software back end does not draw translucent points: OpenGL does");
    return false;
  }
  if (onlyOpenGL && hasTooMuchLight(renderer, look))
  {
    this->TellFallBack("OpenGL has at most 48 lights and 32 kinds of light and eye-dome lighting "
                       "in a style, and draws what the software back end does not: further lights "
                       "do not shine, and further kinds are drawn as the last one");
  }
  if (!asked && !onlyOpenGL && !drawsByOpenGL(renderer, look))
  {
    this->TellFallBack("OpenGL has at most 4 lenses, 4 translucent styles, 48 lights and 32 kinds "
                       "of light and eye-dome lighting in a style, and draws at most 254 styles of "
                       "a layer with one attribute of sizes: this frame is drawn by the software "
                       "back end");
    return true;
  }
  return asked;
}

void vtkOpenGLPointFrontMapper::LeaveScreen()
{
  this->Superclass::LeaveScreen();
  for (const auto& [window, drawing] : this->Internals->Windows)
  {
    drawing->leaveScreen();
    this->GetStatistics().gpuBytes = drawing->pool().memory().bytes();
    this->GetStatistics().windowGpuBytes = drawing->pool().memory().windowBytes();
  }
}

vtkTypeInt64 vtkOpenGLPointFrontMapper::GetUploadedBytes() const
{
  std::uint64_t bytes = this->Internals->UploadedBefore;
  for (const auto& [window, drawing] : this->Internals->Windows)
  {
    bytes += drawing->pool().uploadedBytes();
  }
  return static_cast<vtkTypeInt64>(bytes);
}

void vtkOpenGLPointFrontMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  auto& windows = this->Internals->Windows;
  const auto drawing = windows.find(window);
  if (drawing != windows.end())
  {
    this->Internals->UploadedBefore += drawing->second->pool().uploadedBytes();
    windows.erase(drawing);
  }
  this->Superclass::ReleaseGraphicsResources(window);
}

void vtkOpenGLPointFrontMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "UploadedBytes: " << this->GetUploadedBytes() << "\n";
}
