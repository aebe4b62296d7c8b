#pragma once

#include "ColourMapTexture.h"
#include "DrawRuns.h"
#include "GpuPool.h"
#include "SlotRecords.h"
#include "SoftwarePicture.h"
#include "SplatPicture.h"
#include "vtkOpenGLPointFrontPoints.h"
#include "vtkWindowResources.h"

#include "pointfront/Plan/FramePlan.h"

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkOpenGLRenderTimer.h>
#include <vtkSmartPointer.h>
#include <vtkWeakPointer.h>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkRenderer;

namespace pointfront
{

/// The time of a frame, measured by CPU and GL. It is read when GL has it; nobody waits for it.
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
  /// The time of a frame, once for each timed frame.
  std::optional<Frame> take();
  void release() { gpu_.ReleaseGraphicsResources(); }

private:
  vtkOpenGLRenderTimer gpu_;
  Frame frame_;
  double cpuMs_ = 0.0;
  double drawingMs_ = 0.0;
};

/// Owns all GL names that one mapper has in one window's context, and draws with them. A mapper in
/// two windows has one object for each, and names are deleted in their own context.
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

  /// Called before any other function in a frame.
  void enter(vtkRenderer* renderer, vtkActor* actor);
  void release();

  /// Sets the store; uploaded nodes of another store are dropped.
  void setStore(const void* store);
  /// Uploads the nodes of the plan, near to far, until `bytes` are used up. True when nodes are
  /// left that another frame can upload.
  bool upload(const FramePlan& plan, std::int64_t bytes);
  /// Lists the points of the plan that are on the GPU, and returns their number.
  std::int64_t list(const FramePlan& plan);
  /// Draws the listed points.
  void draw(vtkRenderer* renderer, vtkActor* actor, vtkMapper* owner, const FramePlan& plan,
    std::int64_t storePoints);

  /// Replaces list() and draw() for splats: draws into targets of their own. Returns the number of
  /// points.
  /// `ids`: for a selection. One that a view's picture does not go on from is drawn apart, so that
  /// the view's next frame goes on from its own last one.
  /// `unfinished`: another frame follows, with more points on the GPU.
  std::int64_t drawSplats(vtkRenderer* renderer, FramePlan& plan, bool ids, bool unfinished);
  /// The picture that was drawn last.
  SplatPicture& splats() { return *drawn_; }

  /// Replaces all of these: threads of this process draw from host memory. GPU memory of points is
  /// given back.
  SoftwarePicture& softwarePicture()
  {
    pool_.release();
    return picture_;
  }
  void leaveScreen();

  GpuPool& pool() { return pool_; }
  /// The context is current.
  FrameTimer& timerOf(vtkRenderer* renderer, vtkActor* actor);

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
  ColourMapTexture* tableOf(const std::shared_ptr<const ColourMap>& map);
  vtkOpenGLPointFrontPoints& passOf(PointColouring::Kind kind);

  vtkWeakPointer<vtkOpenGLRenderWindow> window_;
  vtkNew<vtkWindowResources> resources_;
  const void* store_ = nullptr; ///< compared, not used
  GpuPool pool_;
  SlotRecords records_;
  std::vector<LayerStreams> streams_; ///< by layer
  std::vector<std::unique_ptr<ColourMapTexture>> tables_; ///< tables of the last frame's maps
  std::array<vtkSmartPointer<vtkOpenGLPointFrontPoints>, 4> passes_; ///< by kind of colouring
  SoftwarePicture picture_;
  SplatPicture splats_;
  SplatPicture selection_; ///< while a view refines
  SplatPicture* drawn_ = &splats_;
  bool refines_ = false; ///< the last frame was of a refining view
  struct ActorTimer
  {
    vtkWeakPointer<vtkActor> actor;
    FrameTimer timer;
  };
  std::map<std::pair<vtkRenderer*, vtkActor*>, ActorTimer> timers_;
  GpuPool::DrawList order_; ///< items of the plan, near to far
  GpuPool::DrawList wanted_; ///< these, then stand-ins of nodes that the plan has no items of
  std::vector<const ResolvedStyle*> styles_; ///< styles of the items of order_
  std::vector<StyleGroup> groups_;
};

} // namespace pointfront
