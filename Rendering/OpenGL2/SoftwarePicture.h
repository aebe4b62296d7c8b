#pragma once

#include "SoftwareComposition.h"
#include "SoftwareRasteriser.h"

#include "pointfront/Plan/FramePlan.h"

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkWeakPointer.h>

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

class vtkMapper;
class vtkOpenGLPointFrontPicture;
class vtkOpenGLRenderWindow;
class vtkRenderer;
class vtkTextureObject;

namespace pointfront
{

/// Plans drawn by threads of this process, and handed over to a window's framebuffer.
/// Viewport  the one that GL has at that moment: that of a tile, of a part of the window, or of a
///           pass's own framebuffer; the plan's camera gets its size.
/// Threads   that of the GL context, current in handOver() and release().
class SoftwarePicture
{
public:
  SoftwarePicture();
  ~SoftwarePicture();

  /// Draws the plan with threads. `ids`: also makes the point ids of all pixels, for a selection.
  RasterStatistics draw(vtkOpenGLRenderWindow* window, vtkRenderer* renderer, vtkActor* actor,
    FramePlan& plan, bool ids);
  /// Hands over the last drawing, as if it were geometry of the actor. `owner`: the mapper whose
  /// coincident offset it has.
  void handOver(vtkOpenGLRenderWindow* window, vtkRenderer* renderer, vtkActor* actor,
    const FramePlan& plan, std::int64_t storePoints, vtkMapper* owner);
  void release(vtkOpenGLRenderWindow* window);
  /// Tells that nothing of it is shown: gives the memory of pictures back.
  void leaveScreen();

private:
  struct Picture
  {
    vtkWeakPointer<vtkActor> actor;
    SoftwareRasteriser rasteriser; ///< goes on from its last picture
    SoftwareComposition composition;
    SoftwareTarget target;
  };

  void numberPoints(const FramePlan& plan);
  Picture& pictureOf(vtkRenderer* renderer, vtkActor* actor);

  std::map<std::pair<vtkRenderer*, vtkActor*>, Picture> pictures_;
  const SoftwareTarget* last_ = nullptr;
  int originPx_[2] = { 0, 0 };
  std::vector<float> ids_; ///< 2 a pixel: low and high 24 bits
  vtkNew<vtkTextureObject> colour_;
  vtkNew<vtkTextureObject> depth_;
  vtkNew<vtkTextureObject> idTexture_;
  vtkSmartPointer<vtkOpenGLPointFrontPicture> mapper_;
};

} // namespace pointfront
