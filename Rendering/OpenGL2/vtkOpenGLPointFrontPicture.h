/**
 * @class vtkOpenGLPointFrontPicture
 * @brief hands a finished picture over to the bound framebuffer
 *
 * As one of VTK's polygonal mappers, so that render passes (SSAO, EDL, peeling), selections and
 * multisampled targets take it as they take geometry. Pixels of nothing are left alone; depth is
 * written from the picture's (gl_FragDepth).
 */
#ifndef vtkOpenGLPointFrontPicture_h
#define vtkOpenGLPointFrontPicture_h

#include "vtkOpenGLPolyDataMapper.h"

#include "PixelRectangle.h"

class vtkPolyData;
class vtkTextureObject;

namespace pointfront
{
struct FrameCamera;

/// The arguments of one drawing.
struct PictureDrawing
{
  vtkTextureObject* colour = nullptr;
  vtkTextureObject* depth = nullptr;
  vtkTextureObject* ids = nullptr; ///< in selections
  const FrameCamera* camera = nullptr;
  int originPx[2] = { 0, 0 }; ///< corner of the viewport in the framebuffer
  PixelRectangle textures; ///< where they lie in the viewport
  PixelRectangle place; ///< the pixels that are handed over
  vtkIdType storePoints = 0; ///< ids are below it
  vtkMapper* owner = nullptr; ///< whose coincident offset it has; null: none
};
} // namespace pointfront

class vtkOpenGLPointFrontPicture : public vtkOpenGLPolyDataMapper
{
public:
  static vtkOpenGLPointFrontPicture* New();
  vtkTypeMacro(vtkOpenGLPointFrontPicture, vtkOpenGLPolyDataMapper);

  /// `drawing` is used until it returns.
  void Draw(vtkRenderer* renderer, vtkActor* actor, const pointfront::PictureDrawing& drawing);

  void RenderPiece(vtkRenderer*, vtkActor*) override {}

protected:
  vtkOpenGLPointFrontPicture();
  ~vtkOpenGLPointFrontPicture() override;

  void BuildShaders(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* act) override;
  void GetShaderTemplate(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* act) override;
  void ReplaceShaderLight(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* act) override;
  void ReplaceShaderPicking(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* act) override;
  void SetMapperShaderParameters(vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* act) override;
  void UpdateMaximumPointCellIds(vtkRenderer* ren, vtkActor* act) override;
  void UpdateBufferObjects(vtkRenderer*, vtkActor*) override {}
  void RenderPieceDraw(vtkRenderer* ren, vtkActor* act) override;

private:
  vtkOpenGLPointFrontPicture(const vtkOpenGLPointFrontPicture&) = delete;
  void operator=(const vtkOpenGLPointFrontPicture&) = delete;

  bool IsDrawingIds() const;
  void SetOffset(vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* act);

  const pointfront::PictureDrawing* Drawing = nullptr;
  vtkNew<vtkPolyData> NoInput;
};

#endif
