/**
 * @class vtkOpenGLPointFrontMapper
 * @brief the OpenGL side of vtkPointFrontMapper: uploads what the front draws and draws it as
 * points
 *
 * Comes from vtkPointFrontMapper::New() by the object factory. It draws plans (FramePlan) and asks
 * neither residency nor table. Host nodes become slots of a GpuPool (bounded bytes a frame while
 * interacting). Points of some pixels are drawings of vtkOpenGLPointFrontPoints, in VTK's own pass;
 * splats are drawn into targets of their own (SplatPicture) and handed over as one picture. Each
 * window has its own (WindowDrawing). Hardware selection gives ids that are numbers in the store:
 * (node, position in the node), 48 bits.
 */
#ifndef vtkOpenGLPointFrontMapper_h
#define vtkOpenGLPointFrontMapper_h

#include "pointfrontRenderingOpenGL2Module.h" // for the export macro
#include "vtkPointFrontMapper.h"

#include <memory> // for what each window has

namespace pointfront
{
class FrameTimer;
class WindowDrawing;
} // namespace pointfront

class POINTFRONTRENDERINGOPENGL2_EXPORT vtkOpenGLPointFrontMapper : public vtkPointFrontMapper
{
public:
  static vtkOpenGLPointFrontMapper* New();
  vtkTypeMacro(vtkOpenGLPointFrontMapper, vtkPointFrontMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void RenderPiece(vtkRenderer* renderer, vtkActor* actor) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  bool GetSupportsSelection() override { return true; }

  /// Bytes uploaded to the GPU since the mapper was made (positions and values of points).
  vtkTypeInt64 GetUploadedBytes() const;

protected:
  vtkOpenGLPointFrontMapper();
  ~vtkOpenGLPointFrontMapper() override;
  void LeaveScreen() override;
  bool DrawsFromHostMemory(
    vtkRenderer* renderer, vtkActor* actor, const pointfront::CloudLook& look) override;

private:
  vtkOpenGLPointFrontMapper(const vtkOpenGLPointFrontMapper&) = delete;
  void operator=(const vtkOpenGLPointFrontMapper&) = delete;

  void TellFallBack(const char* what);
  vtkIdType HandOver(vtkRenderer* renderer, vtkActor* actor, pointfront::WindowDrawing& drawing,
    const pointfront::FramePlan& plan);
  vtkIdType DrawPoints(vtkRenderer* renderer, vtkActor* actor, const pointfront::CloudLook& look,
    pointfront::WindowDrawing& drawing, pointfront::FramePlan& plan, bool uploadsLeft);
  bool Upload(vtkRenderer* renderer, vtkActor* actor, pointfront::WindowDrawing& drawing,
    const pointfront::FramePlan& plan);
  void ReadTimer(vtkRenderer* renderer, vtkActor* actor, pointfront::FrameTimer& timer);

  struct Content;
  std::unique_ptr<Content> Internals;
};

#endif
