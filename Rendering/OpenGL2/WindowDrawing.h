#pragma once

#include "ColourTable.h"
#include "DrawRuns.h"
#include "GpuPool.h"
#include "SlotRecords.h"
#include "SoftwarePicture.h"
#include "SplatPicture.h"
#include "vtkOpenGLPointFrontPass.h"
#include "vtkWindowResources.h"

#include "pointfront/Plan/FramePlan.h"

#include <vtkNew.h>
#include <vtkOpenGLRenderTimer.h>
#include <vtkSmartPointer.h>
#include <vtkWeakPointer.h>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

class vtkActor;
class vtkOpenGLRenderWindow;
class vtkRenderer;

namespace pointfront
{

/// What a frame cost, measured by CPU and GL; read when it is there, never waited for.
class FrameTimer
{
public:
  struct Frame
  {
    std::int64_t points = 0;
    std::int64_t moves = 0;
    double milliseconds = 0.0; ///< CPU and GPU
  };

  /// False while an earlier frame's time is on its way: this one goes untimed.
  bool begin(double cpuMilliseconds, std::int64_t moves);
  /// `drawingMilliseconds`: of the CPU since begin(); the GPU draws meanwhile, or after.
  void end(double drawingMilliseconds, std::int64_t points);
  /// Once a timed frame.
  std::optional<Frame> take();
  void release() { gpu_.ReleaseGraphicsResources(); }

private:
  vtkOpenGLRenderTimer gpu_;
  Frame frame_;
  double cpuMs_ = 0.0;
  double drawingMs_ = 0.0;
};

/// All GL names that one mapper has in one window's context, and drawing with them: the only owner,
/// so that a mapper in two windows has what it needs in each, and names go where they belong.
/// Releasing  by release() or destruction, whichever context is current then (it is current again
///            after it), and by itself when the window's context goes.
/// Threads    the renderers'; the window's context is current in enter() and whatever draws.
class WindowDrawing
{
public:
  explicit WindowDrawing(vtkOpenGLRenderWindow* window);
  ~WindowDrawing();
  WindowDrawing(const WindowDrawing&) = delete;
  WindowDrawing& operator=(const WindowDrawing&) = delete;

  /// Before anything else of a frame.
  void enter(vtkRenderer* renderer, vtkActor* actor);
  void release();

  /// Nodes of another store are worth nothing.
  void setStore(const void* store);
  /// Brings to the GPU what the plan draws, near to far, until `bytes` are used up. True when
  /// something is left over that another frame can bring.
  bool upload(const FramePlan& plan, std::int64_t bytes);
  /// Makes ready what is on the GPU of the plan. Returns its points.
  std::int64_t list(const FramePlan& plan);
  /// Draws what was listed.
  void draw(vtkRenderer* renderer, vtkActor* actor, vtkMapper* owner, const FramePlan& plan,
    std::int64_t storePoints);

  /// In the place of the last two, for splats: into targets of their own. Returns points.
  std::int64_t drawSplats(vtkRenderer* renderer, FramePlan& plan, bool ids);
  SplatPicture& splats() { return splats_; }

  /// In the place of all these: by threads of this process, from host memory. Points that are on
  /// the GPU are given back.
  SoftwarePicture& softwarePicture()
  {
    pool_.release();
    return picture_;
  }
  void leaveScreen();

  GpuPool& pool() { return pool_; }
  FrameTimer& timerOf(vtkRenderer* renderer) { return timers_[renderer]; }

private:
  struct StyleGroup
  {
    std::shared_ptr<const ResolvedStyle> style;
    DrawRuns runs;
  };

  void order(const FramePlan& plan);
  void chooseStreams(const FramePlan& plan);
  void dropTables(const FramePlan& plan);
  DrawRuns& runsOf(const std::shared_ptr<const ResolvedStyle>& style);
  ColourTable* tableOf(const std::shared_ptr<const ColourMap>& map);
  vtkOpenGLPointFrontPass& passOf(PointColouring::Kind kind);

  vtkWeakPointer<vtkOpenGLRenderWindow> window_;
  vtkNew<vtkWindowResources> resources_;
  const void* store_ = nullptr; ///< compared, not used
  GpuPool pool_;
  SlotRecords records_;
  std::vector<LayerStreams> streams_; ///< by layer
  std::vector<std::unique_ptr<ColourTable>> tables_; ///< of the maps of the last frame
  std::array<vtkSmartPointer<vtkOpenGLPointFrontPass>, 4> passes_; ///< by kind of colouring
  SoftwarePicture picture_;
  SplatPicture splats_;
  std::map<vtkRenderer*, FrameTimer> timers_;
  GpuPool::DrawList order_; ///< of the plan, near to far
  std::vector<const ResolvedStyle*> styles_; ///< of the items of order_
  std::vector<StyleGroup> groups_;
};

} // namespace pointfront
