#pragma once

#include "SplatComposition.h"
#include "SplatPart.h"

#include "pointfront/Plan/FramePlan.h"
#include "pointfront/Plan/PlanParts.h"

#include <vtkSmartPointer.h>

#include <cstdint>
#include <memory>
#include <vector>

class vtkActor;
class vtkMapper;
class vtkOpenGLPointFrontPicture;
class vtkOpenGLRenderWindow;
class vtkRenderer;

namespace pointfront
{

/// Plans that are drawn by GL, part by part, composed and handed over to a window's framebuffer:
/// the twin of SoftwareComposition and SoftwarePicture.
/// Viewport  as SoftwarePicture's.
/// Threads   that of the GL context, current in all functions.
/// Source    docs/adr/0028, 0029.
class SplatPicture
{
public:
  using TableOf = SplatFrame::TableOf;
  static constexpr std::int64_t noTarget = SplatPart::noTarget;

  SplatPicture();
  ~SplatPicture();

  /// Draws the points of the plan that are on the GPU, except those that the last picture has, and
  /// returns their number. The plan's camera gets the size of the viewport. `ids`: for a selection.
  /// `unfinished`: another frame follows, with more points on the GPU.
  std::int64_t draw(vtkOpenGLRenderWindow* window, vtkRenderer* renderer, FramePlan& plan,
    const GpuPool& pool, const TableOf& tableOf, bool ids, bool unfinished);
  /// Hands over the last drawing, as if it were geometry of the actor. `owner`: the mapper whose
  /// coincident offset it has; null: none.
  void handOver(vtkRenderer* renderer, vtkActor* actor, const FramePlan& plan,
    std::int64_t storePoints, vtkMapper* owner = nullptr);
  /// Kept points of the last drawing: the picture before showed them and the plan lacks them.
  std::int64_t keptPoints() const;
  void release(vtkOpenGLRenderWindow* window);

private:
  /// Beside what is opaque outside of lenses.
  struct FurtherPart
  {
    std::int16_t lens;
    bool mask;
    std::uint16_t group;
    double opacity;
    bool drawn; ///< in this picture
    std::shared_ptr<SplatTarget> target;
    std::unique_ptr<SplatPart> part;
  };

  std::int64_t drawParts(const SplatFrame& frame, const FramePlan& plan);
  std::shared_ptr<SplatTarget> mainTarget(const SplatFrame& frame, const FramePlan& plan);
  FurtherPart& furtherPart(const PlanPart& like);
  const FurtherPart* find(std::int16_t lens, bool mask) const;
  SplatTextures blended(
    std::int16_t lens, const SplatTextures& base, const SplatTextures& untouched);
  void compose(const FramePlan& plan);
  void putLens(const FrameLens& lens, std::int16_t number, const SplatTextures& inside);

  SplatTools tools_;
  std::shared_ptr<SplatTargets> targets_; ///< the window's
  SplatPart main_;
  std::vector<FurtherPart> further_;
  SplatComposition composition_;
  SplatTextures picture_;
  PixelRectangle shown_;
  int originPx_[2] = { 0, 0 };
  vtkSmartPointer<vtkOpenGLPointFrontPicture> mapper_;
};

} // namespace pointfront
