#include "vtkOpenGLPointFrontMapper.h"

#include "DrawBatches.h"
#include "WindowDrawing.h"

#include "pointfront/Plan/FramePlan.h"
#include "pointfront/Plan/FrameStatistics.h"
#include "pointfront/Store/StoredCloud.h"
#include "vtkPointFrontStore.h"

#include <vtkActor.h>
#include <vtkCommand.h>
#include <vtkIndent.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkWindow.h>

#include <chrono>
#include <limits>
#include <map>
#include <utility>

vtkStandardNewMacro(vtkOpenGLPointFrontMapper);

namespace
{

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point begin)
{
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

} // namespace

struct vtkOpenGLPointFrontMapper::Content
{
  std::map<vtkWindow*, std::unique_ptr<pointfront::WindowDrawing>> Windows;
  std::uint64_t UploadedBefore = 0; ///< by drawings that are gone
  bool FallBackTold = false;

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

vtkOpenGLPointFrontMapper::vtkOpenGLPointFrontMapper() : Internals(new Content) {}

vtkOpenGLPointFrontMapper::~vtkOpenGLPointFrontMapper() = default;

/// Tells the front what an earlier frame cost, once.
void vtkOpenGLPointFrontMapper::ReadTimer(vtkRenderer* renderer, pointfront::FrameTimer& timer)
{
  if (const auto frame = timer.take())
  {
    this->TimeToDraw = 1e-3 * frame->milliseconds;
    this->RecordFrame(renderer, frame->points, frame->moves, frame->milliseconds);
  }
}

void vtkOpenGLPointFrontMapper::RenderPiece(vtkRenderer* renderer, vtkActor* actor)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!window || window->CheckAbortStatus())
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
  this->ReadTimer(renderer, drawing.timerOf(renderer));
  pointfront::FramePlan* plan = this->PlanFrame(renderer, actor);
  if (!plan)
  {
    return;
  }
  drawing.setStore(this->GetStore());
  const bool host = this->DrawsFromHostMemory(actor);
  const bool first = this->IsFirstDrawing(renderer);
  bool uploadsLeft = false;
  std::uint64_t kept = 0;
  if (host)
  {
    kept = drawing.softwarePicture()
             .draw(window, renderer, *plan, renderer->GetSelector() != nullptr)
             .keptVisible;
  }
  else
  {
    uploadsLeft = this->Upload(renderer, drawing, *plan);
  }
  const auto points =
    host ? static_cast<std::int64_t>(plan->pointCount()) : drawing.list(*plan);
  pointfront::FrameTimer& timer = drawing.timerOf(renderer);
  const bool timed =
    first && points > 0 && timer.begin(
    millisecondsSince(begin), points + static_cast<std::int64_t>(kept), this->GetLastMoves());
  const auto drawn = Clock::now();
  if (points > 0 && host)
  {
    drawing.softwarePicture().handOver(
      window, renderer, actor, *plan, this->GetStore()->GetNumberOfPoints());
  }
  else if (points > 0)
  {
    drawing.draw(renderer, actor, this, *plan, this->GetStore()->GetNumberOfPoints());
  }
  if (timed)
  {
    timer.end(millisecondsSince(drawn));
  }
  if (first)
  {
    this->GetStatistics().gpuBytes = drawing.pool().bytes();
    this->GetStatistics().windowGpuBytes = drawing.pool().windowBytes();
    this->FinishFrame(renderer, points, static_cast<vtkIdType>(kept), uploadsLeft);
  }
  this->UpdateProgress(1.0);
}

/// What a frame's first drawing brings to the GPU. True when something is left over.
bool vtkOpenGLPointFrontMapper::Upload(vtkRenderer* renderer, pointfront::WindowDrawing& drawing,
  const pointfront::FramePlan& plan)
{
  constexpr std::int64_t noLimit = std::numeric_limits<std::int64_t>::max();
  if (!this->IsFirstDrawing(renderer))
  {
    if (this->IsAheadOfFrame(renderer))
    {
      drawing.upload(plan, noLimit);
    }
    return false;
  }
  vtkWindow* window = renderer->GetRenderWindow();
  drawing.pool().beginFrame({static_cast<std::uint64_t>(this->GetPointsOnGPU(window)),
    this->GPUMemoryBudget, this->GetNumberOfViews(window)});
  return drawing.upload(plan, IsInteracting(renderer) ? this->UploadLimit : noLimit);
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
bool vtkOpenGLPointFrontMapper::DrawsFromHostMemory(vtkActor* actor)
{
  vtkShaderProperty* shaders = actor->GetShaderProperty();
  const bool ownShaders = shaders->HasVertexShaderCode() || shaders->HasFragmentShaderCode() ||
    shaders->HasGeometryShaderCode() || shaders->GetNumberOfShaderReplacements() > 0;
  const bool onlyOpenGL = ownShaders || actor->HasTranslucentPolygonalGeometry() != 0;
  const bool asked =
    this->Backend == SOFTWARE || (this->Backend == AUTOMATIC && pointfront::glIsAProgram());
  if (asked && onlyOpenGL)
  {
    this->TellFallBack(ownShaders
        ? "the software back end does not draw with an actor's own shader code: OpenGL does"
        : "the software back end does not draw translucent points: OpenGL does");
    return false;
  }
  if (!asked && !onlyOpenGL && !this->HasPlainPointsOnly(actor))
  {
    this->TellFallBack("OpenGL draws points of some pixels, in one colour each, and without "
                       "filters: this style is drawn by the software back end");
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
    this->GetStatistics().gpuBytes = drawing->pool().bytes();
    this->GetStatistics().windowGpuBytes = drawing->pool().windowBytes();
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
