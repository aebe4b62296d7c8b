#include "vtkOpenGLPointFrontMapper.h"

#include "ColourTable.h"
#include "GpuAccount.h"
#include "GpuPool.h"
#include "PerWindow.h"
#include "SlotRecords.h"
#include "pointfront/Views/ViewFront.h"

#include "pointfront/Store/StoredCloud.h"
#include "vtkOpenGLPointFrontPass.h"
#include "vtkPointFrontStore.h"

#include <vtkActor.h>
#include <vtkCommand.h>
#include <vtkIndent.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLRenderTimer.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarsToColors.h>
#include <vtkWeakPointer.h>
#include <vtkWindow.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>

vtkStandardNewMacro(vtkOpenGLPointFrontMapper);

namespace
{

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point begin)
{
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// GPU time of the last frame of one renderer, read when it is there: never waited for. With it
/// what that frame held.
struct FrameTimer
{
  vtkOpenGLRenderTimer Gpu;
  double CpuMs = 0.0;     ///< before the drawing
  double DrawingMs = 0.0; ///< of the CPU; the GPU draws meanwhile, or after
  vtkIdType Points = 0;
  vtkIdType Moves = 0;

  bool Known() { return this->Gpu.Started() && this->Gpu.Stopped() && this->Gpu.Ready(); }
  double Milliseconds()
  {
    return this->CpuMs + std::max<double>(this->DrawingMs, this->Gpu.GetElapsedMilliseconds());
  }
};

} // namespace

struct vtkOpenGLPointFrontMapper::Content
{
  pointfront::GpuPool Pool;
  pointfront::SlotRecords Records;
  pointfront::ColourTable Table;
  vtkNew<vtkOpenGLPointFrontPass> Pass;
  vtkWeakPointer<vtkWindow> Window;         ///< whose context has the pool
  vtkWeakPointer<vtkPointFrontStore> Store; ///< that the pool's nodes are of
  std::map<vtkRenderer*, FrameTimer> Timers;
  pointfront::PointDrawing Drawing;
  bool IndexedWarned = false;

  void SetStore(vtkPointFrontStore* store);
  bool Upload(const pointfront::ViewFront& front, std::int64_t bytes);
  vtkIdType List(const pointfront::ViewFront& front);
};

void vtkOpenGLPointFrontMapper::Content::SetStore(vtkPointFrontStore* store)
{
  if (this->Store == store)
  {
    return;
  }
  this->Pool.release();
  this->Store = store;
}

/// Brings to the GPU what the front draws, near to far, until `bytes` are used up. True when
/// something is left over.
bool vtkOpenGLPointFrontMapper::Content::Upload(
  const pointfront::ViewFront& front, std::int64_t bytes)
{
  const bool values = this->Drawing.colouring.hasValues();
  const pointfront::AttributeSchema& schema = this->Store->GetStore()->description().schema;
  const bool room = this->Pool.makeRoom(front.last().draw);
  bool left = false;
  for (const pointfront::DrawItem& item : front.last().draw)
  {
    const auto node = front.find(item.node);
    if (!node)
    {
      continue;
    }
    const auto* entry = this->Pool.bring(*node, item.pointCount, schema, bytes);
    left = left || !entry || entry->points < item.pointCount ||
           (values && entry->values < item.pointCount);
  }
  // What has no room does not come with another frame, unless clouds that are drawn after this one
  // have yet to come down to a budget that was lowered.
  return left && (room || bytes <= 0 || this->Pool.lowered());
}

/// Makes the runs of vertices and the slots' records of what is on the GPU of the front.
vtkIdType vtkOpenGLPointFrontMapper::Content::List(const pointfront::ViewFront& front)
{
  const pointfront::StoredCloud& store = *this->Store->GetStore();
  constexpr auto slotPoints = pointfront::GpuPool::slotPoints;
  this->Records.begin(this->Pool.slotCount());
  this->Drawing.runs.clear();
  vtkIdType drawn = 0;
  for (const pointfront::DrawItem& item : front.last().draw)
  {
    const auto* entry = this->Pool.find(item.node);
    const auto node = front.find(item.node);
    if (!entry || !node)
    {
      continue;
    }
    const std::uint32_t points = std::min(item.pointCount, entry->points);
    const bool coloured = this->Drawing.colouring.hasValues() && entry->values >= points;
    this->Records.set(entry->slots,
      pointfront::SlotOrigin::of(
        store.description().grid, node->halfSize, node->origin, this->Drawing.reference),
      coloured, node->firstPoint);
    for (std::uint32_t first = 0; first < points; first += slotPoints)
    {
      const std::uint32_t slot = entry->slots[first / slotPoints];
      const std::size_t block = this->Pool.blockOf(slot);
      const std::uint32_t inBlock = slot - this->Pool.blocks()[block].first();
      this->Drawing.runs.add(block, static_cast<int>(inBlock * slotPoints),
        static_cast<int>(std::min(slotPoints, points - first)));
    }
    drawn += points;
  }
  return drawn;
}

vtkOpenGLPointFrontMapper::vtkOpenGLPointFrontMapper() : Internals(new Content) {}

vtkOpenGLPointFrontMapper::~vtkOpenGLPointFrontMapper() = default;

/// The pool's objects belong to one context.
void vtkOpenGLPointFrontMapper::EnterContext(vtkOpenGLRenderWindow* window)
{
  Content& content = *this->Internals;
  if (content.Window == window)
  {
    return;
  }
  if (content.Window) // another context: its objects are nothing to this one
  {
    vtkOpenGLRenderWindow::SafeDownCast(content.Window)->MakeCurrent();
    this->ReleaseGraphicsResources(content.Window);
    window->MakeCurrent();
  }
  content.Window = window;
  content.Pool.enter(pointfront::perWindow<pointfront::GpuAccount>(window));
}

/// Tells the front what its last frame cost, once.
void vtkOpenGLPointFrontMapper::ReadTimer(vtkRenderer* renderer)
{
  const auto timer = this->Internals->Timers.find(renderer);
  if (timer != this->Internals->Timers.end() && timer->second.Known())
  {
    const double milliseconds = timer->second.Milliseconds();
    this->TimeToDraw = 1e-3 * milliseconds;
    this->RecordFrame(renderer, timer->second.Points, timer->second.Moves, milliseconds);
    timer->second.Gpu.Reset();
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

  Content& content = *this->Internals;
  this->EnterContext(window);
  const auto begin = Clock::now();
  this->ReadTimer(renderer);
  pointfront::ViewFront* front = this->PrepareFrame(renderer, actor);
  if (!front)
  {
    return;
  }
  content.SetStore(this->GetStore());
  const pointfront::StoreDescription& description = content.Store->GetStore()->description();
  pointfront::PointDrawing& drawing = content.Drawing;
  drawing.colouring = this->GetColouring();
  drawing.pool = &content.Pool;
  drawing.records = &content.Records;
  drawing.pointSize = this->PointSize;
  drawing.stepSize = description.grid.scale;
  drawing.storePoints = static_cast<vtkIdType>(description.pointCount);
  drawing.reference = vtkOpenGLPointFrontPass::GetReference(renderer, actor);
  content.Pass->CopyState(this);

  const bool first = this->IsFirstDrawing(renderer);
  bool uploadsLeft = false;
  content.Pool.setColouring(drawing.colouring);
  if (first)
  {
    content.Pool.beginFrame({static_cast<std::uint64_t>(this->GetPointsOnGPU()),
      this->GPUMemoryBudget, this->GetNumberOfViews()});
    uploadsLeft = content.Upload(*front,
      IsInteracting(renderer) ? this->UploadLimit : std::numeric_limits<std::int64_t>::max());
  }
  else if (this->IsAheadOfFrame(renderer))
  {
    content.Upload(*front, std::numeric_limits<std::int64_t>::max());
  }
  const vtkIdType points = content.List(*front);
  drawing.table = nullptr;
  if (drawing.colouring.usesTable())
  {
    vtkScalarsToColors* table = this->GetLookupTable(); // makes one if there is none
    table->Build();
    if (!this->UseLookupTableScalarRange)
    {
      table->SetRange(this->ScalarRange);
    }
    if (table->GetIndexedLookup() && !drawing.colouring.integers && !content.IndexedWarned)
    {
      content.IndexedWarned = true;
      vtkWarningMacro("an indexed lookup table needs an attribute of whole numbers with less than "
                      "8192 different values; this one is drawn in the table's NaN colour");
    }
    content.Table.update(window, table, drawing.colouring, table->GetMTime());
    drawing.table = &content.Table;
  }
  FrameTimer& timer = content.Timers[renderer];
  // A time that is still on its way is waited for by leaving later frames untimed.
  const bool timed = first && points > 0 && !timer.Gpu.Started();
  if (points > 0)
  {
    content.Records.upload(window);
    if (timed)
    {
      timer.CpuMs = millisecondsSince(begin);
      timer.Gpu.Start();
    }
    content.Pass->Draw(renderer, actor, drawing);
    if (timed)
    {
      timer.Gpu.Stop();
    }
  }
  if (timed)
  {
    timer.DrawingMs = millisecondsSince(begin) - timer.CpuMs;
    timer.Points = points;
    timer.Moves = this->LastMoves;
  }
  if (first)
  {
    this->LastGPUBytes = content.Pool.bytes();
    this->LastWindowGPUBytes = content.Pool.windowBytes();
    this->FinishFrame(renderer, points, uploadsLeft);
  }
  this->UpdateProgress(1.0);
}

void vtkOpenGLPointFrontMapper::LeaveScreen()
{
  this->Superclass::LeaveScreen();
  this->Internals->Pool.leaveScreen();
  this->LastGPUBytes = this->Internals->Pool.bytes();
  this->LastWindowGPUBytes = this->Internals->Pool.windowBytes();
}

vtkTypeInt64 vtkOpenGLPointFrontMapper::GetUploadedBytes() const
{
  return static_cast<vtkTypeInt64>(this->Internals->Pool.uploadedBytes());
}

void vtkOpenGLPointFrontMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  Content& content = *this->Internals;
  content.Window = nullptr;
  content.Pool.release();
  content.Records.release(window);
  content.Table.release(window);
  for (auto& [renderer, timer] : content.Timers)
  {
    timer.Gpu.ReleaseGraphicsResources();
  }
  content.Timers.clear();
  content.Pass->ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

void vtkOpenGLPointFrontMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "UploadedBytes: " << this->GetUploadedBytes() << "\n";
}
