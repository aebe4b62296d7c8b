/**
 * @class vtkOpenGLPointFrontPoints
 * @brief draws slots of a GpuPool as GL points, as one of VTK's polygonal mappers
 *
 * By being a vtkOpenGLPolyDataMapper it takes part in all that VTK does with shaders of such
 * mappers: render passes (peeling, SSAO, EDL), clipping planes, selection passes, lights,
 * coincident topology, vtkShaderProperty. What it replaces is the vertex template (integer
 * positions relative to the camera), the colour, and the draw call (DrawBatches).
 */
#ifndef vtkOpenGLPointFrontPoints_h
#define vtkOpenGLPointFrontPoints_h

#include "DrawRuns.h" // for the draw list
#include "pointfront/Style/ColourMap.h" // for colours
#include "pointfront/Style/PointColouring.h" // for the colouring
#include "vtkOpenGLPolyDataMapper.h"

#include <glm/vec3.hpp> // for the reference point

namespace pointfront
{
class ColourMapTexture;
class GpuBlock;
class GpuPool;
class SlotRecords;

/// The arguments of one drawing.
struct PointDrawing
{
  const GpuPool* pool = nullptr;
  SlotRecords* records = nullptr;
  ColourMapTexture* table = nullptr; ///< when the colouring uses one
  PointColouring colouring;
  glm::dvec3 reference{ 0.0 }; ///< store coordinates that the records' origins are relative to
  glm::dvec3 stepSize{ 1.0 }; ///< store units of a grid step
  double pointSize = 0.0; ///< pixels; 0: the property's
  vtkIdType storePoints = 0; ///< ids are below it
  const DrawRuns* runs = nullptr;
  Rgba8 flat{ 255, 255, 255, 255 }; ///< colour of points without a value
};
} // namespace pointfront

class vtkOpenGLPointFrontPoints : public vtkOpenGLPolyDataMapper
{
public:
  static vtkOpenGLPointFrontPoints* New();
  vtkTypeMacro(vtkOpenGLPointFrontPoints, vtkOpenGLPolyDataMapper);

  /// Takes the properties of an owner that concern drawing: clipping planes, coincident topology.
  void CopyState(vtkMapper* owner);
  /// Draws into the bound framebuffer. `drawing` is used until it returns.
  void Draw(vtkRenderer* renderer, vtkActor* actor, const pointfront::PointDrawing& drawing);

  void RenderPiece(vtkRenderer*, vtkActor*) override {}

protected:
  vtkOpenGLPointFrontPoints();
  ~vtkOpenGLPointFrontPoints() override;

  void GetShaderTemplate(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* act) override;
  void ReplaceShaderColor(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* act) override;
  void ReplaceShaderPicking(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* act) override;
  void ReplaceShaderPositionVC(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* act) override;
  void ReplaceShaderCoincidentOffset(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* act) override;
  void SetMapperShaderParameters(vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* act) override;
  void SetCameraShaderParameters(vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* act) override;
  void UpdateMaximumPointCellIds(vtkRenderer* ren, vtkActor* act) override;
  void UpdateBufferObjects(vtkRenderer*, vtkActor*) override {}
  void RenderPieceDraw(vtkRenderer* ren, vtkActor* act) override;

private:
  vtkOpenGLPointFrontPoints(const vtkOpenGLPointFrontPoints&) = delete;
  void operator=(const vtkOpenGLPointFrontPoints&) = delete;

  bool IsDrawingIds() const;
  /// Edge of the squares, pixels.
  int SquareSize(vtkActor* actor) const;
  void SetSquareUniforms(vtkShaderProgram* program, vtkRenderer* ren, vtkActor* actor);
  void DrawBlocks(vtkOpenGLHelper& cellBO);
  void SetClippingUniforms(vtkShaderProgram* program, vtkActor* actor);

  const pointfront::PointDrawing* Drawing = nullptr;
  pointfront::PointColouring::Kind Variant = pointfront::PointColouring::Kind::Flat;
  bool Squares = false; ///< larger than a pixel, by our own shaders
  vtkNew<vtkPolyData> NoInput;
};

#endif
