#pragma once

#include "DrawRuns.h"
#include "SlotRecords.h"
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
class RasterItems;
struct RasterItem;

/// Plans whose points are splats, drawn by GL into targets of their own and handed over to a
/// window's framebuffer: the twin of SoftwareRasteriser and SoftwarePicture.
/// Passes    who is seen in each pixel (the nearest; of splats that overlap the one with the nearest
///           centre), then weights and colours of what is not behind it, then light and eye-dome
///           lighting.
/// Viewport  as SoftwarePicture's.
/// Threads   that of the GL context, current in all functions.
/// Source    drawing.md sections 4 to 6; docs/adr/0016, 0028.
class SplatPicture
{
public:
  using TableOf = std::function<ColourTable*(const std::shared_ptr<const ColourMap>&)>;

  SplatPicture();
  ~SplatPicture();

  /// What is on the GPU of the plan; its camera gets the viewport's size. Returns its points.
  /// `ids`: for a selection. Nothing is drawn again where `sameFrame` and nothing differs.
  std::int64_t draw(vtkOpenGLRenderWindow* window, vtkRenderer* renderer, FramePlan& plan,
    const GpuPool& pool, const TableOf& tableOf, bool ids, bool sameFrame);
  /// What was drawn last, as if it were geometry of the actor.
  void handOver(vtkRenderer* renderer, vtkActor* actor, const FramePlan& plan,
    std::int64_t storePoints);
  void release(vtkOpenGLRenderWindow* window);

private:
  /// Points that are drawn by one program in one call.
  struct Group
  {
    const RasterItems* items;
    const RasterItem* first; ///< as all of it: style, passes
    bool shaped;
    bool sized;
    bool quads;
    int mark;
    DrawRuns runs;
  };
  /// What the target shows.
  struct Drawn
  {
    vtkRenderer* renderer = nullptr;
    FrameCamera camera;
    std::vector<glm::dvec4> clippingPlanes;
    std::vector<std::shared_ptr<const ResolvedStyle>> styles;
    bool ids = false;
    std::int64_t points = 0;
  };

  bool showsAlready(vtkRenderer* renderer, const FramePlan& plan, bool ids) const;
  void remember(vtkRenderer* renderer, const FramePlan& plan, bool ids, std::int64_t points);
  std::int64_t list(const FramePlan& plan, const GpuPool& pool);
  Group& groupOf(const Group& like);
  void drawGroups(vtkOpenGLRenderWindow* window, const GpuPool& pool, const TableOf& tableOf,
    bool second);
  void drawGroup(vtkOpenGLRenderWindow* window, const GpuPool& pool, const TableOf& tableOf,
    const Group& group, bool second);
  void resolve(vtkOpenGLRenderWindow* window, const FramePlan& plan);

  SplatTarget target_;
  SplatTarget::Parts parts_;
  SplatPrograms programs_;
  SlotRecords records_;
  vtkNew<vtkOpenGLVertexArrayObject> vertices_;
  std::vector<std::unique_ptr<RasterItems>> rounds_; ///< of the frame that is drawn
  std::vector<Group> groups_;
  Drawn drawn_;
  int originPx_[2] = { 0, 0 };
  float largestPointPx_ = 1.0f;
  vtkSmartPointer<vtkOpenGLPointFrontPicture> mapper_;
};

} // namespace pointfront
