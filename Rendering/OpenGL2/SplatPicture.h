#pragma once

#include "SlotRecords.h"
#include "SplatGroups.h"
#include "SplatProgram.h"
#include "SplatTarget.h"

#include "pointfront/Plan/FramePlan.h"

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

class vtkActor;
class vtkOpenGLPointFrontPicture;
class vtkOpenGLRenderWindow;
class vtkOpenGLVertexArrayObject;
class vtkRenderer;

namespace pointfront
{
class ColourTable;
class GpuPool;

/// Plans whose points are splats, drawn by GL into targets of their own and handed over to a
/// window's framebuffer: the twin of SoftwareRasteriser and SoftwarePicture.
/// Passes    who is seen in each pixel (the nearest; of splats that overlap the one with the
///           nearest centre), then weights and colours of what is not behind it, then light and
///           eye-dome lighting.
/// Viewport  as SoftwarePicture's.
/// Threads   that of the GL context, current in all functions.
/// Source    drawing.md sections 4 to 6; docs/adr/0016, 0028.
class SplatPicture
{
public:
  using TableOf = std::function<ColourTable*(const std::shared_ptr<const ColourMap>&)>;

  /// In the place of a number of points: GL has no room for the targets, or cannot draw into them.
  static constexpr std::int64_t noTarget = -1;

  SplatPicture();
  ~SplatPicture();

  /// What is on the GPU of the plan; its camera gets the viewport's size. Returns its points.
  /// `ids`: for a selection. What the last picture has of it is not drawn again.
  std::int64_t draw(vtkOpenGLRenderWindow* window, vtkRenderer* renderer, FramePlan& plan,
    const GpuPool& pool, const TableOf& tableOf, bool ids);
  /// What was drawn last, as if it were geometry of the actor.
  void handOver(vtkRenderer* renderer, vtkActor* actor, const FramePlan& plan,
    std::int64_t storePoints);
  void release(vtkOpenGLRenderWindow* window);

private:
  void drawInto(vtkOpenGLRenderWindow* window, const FramePlan& plan, const GpuPool& pool,
    const TableOf& tableOf, bool goesOn);
  void drawGroups(vtkOpenGLRenderWindow* window, const GpuPool& pool, const TableOf& tableOf,
    bool second, bool addedOnly);
  void drawGroup(vtkOpenGLRenderWindow* window, const GpuPool& pool, const TableOf& tableOf,
    const SplatGroups::Group& group, const DrawRuns& runs, bool second);
  void resolve(vtkOpenGLRenderWindow* window, const FramePlan& plan);

  std::shared_ptr<SplatTarget> target_; ///< all clouds of the window draw into it in turn
  SplatTarget::Parts parts_;
  SplatPrograms programs_;
  SlotRecords records_;
  SplatGroups groups_;
  FrameShading shading_; ///< of the last picture
  vtkRenderer* renderer_ = nullptr; ///< compared, not used
  vtkNew<vtkOpenGLVertexArrayObject> vertices_;
  int originPx_[2] = { 0, 0 };
  vtkSmartPointer<vtkOpenGLPointFrontPicture> mapper_;
};

} // namespace pointfront
