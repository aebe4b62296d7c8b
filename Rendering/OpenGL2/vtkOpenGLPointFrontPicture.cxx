#include "vtkOpenGLPointFrontPicture.h"

#include "CoincidentOffset.h"
#include "OpenGLFunctions.h"
#include "SelectionIds.h"

#include "pointfront/Plan/FrameCamera.h"

#include "PictureFSGLSL.h"
#include "PictureVSGLSL.h"

#include <vtkActor.h>
#include <vtkHardwareSelector.h>
#include <vtkMatrix4x4.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLError.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkOpenGLVertexArrayObject.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>

#include <algorithm>
#include <string>

vtkStandardNewMacro(vtkOpenGLPointFrontPicture);

vtkOpenGLPointFrontPicture::vtkOpenGLPointFrontPicture()
{
  this->SetPopulateSelectionSettings(1);
  this->SetInputData(this->NoInput);
}

vtkOpenGLPointFrontPicture::~vtkOpenGLPointFrontPicture() = default;

void vtkOpenGLPointFrontPicture::Draw(
  vtkRenderer* renderer, vtkActor* actor, const pointfront::PictureDrawing& drawing)
{
  this->Drawing = &drawing;
  drawing.owner ? pointfront::copyPointOffset(drawing.owner, this) : void();
  // Without points in its input the superclass only registers its resources with the window.
  this->Superclass::RenderPiece(renderer, actor);
  this->RenderPieceStart(renderer, actor);
  this->RenderPieceDraw(renderer, actor);
  this->RenderPieceFinish(renderer, actor);
  this->Drawing = nullptr;
}

bool vtkOpenGLPointFrontPicture::IsDrawingIds() const
{
  return pointfront::drawsIds(this->LastSelectionState);
}

/// Without an actor's replacements: they are for a shader that draws points.
void vtkOpenGLPointFrontPicture::BuildShaders(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* act)
{
  this->GetShaderTemplate(shaders, ren, act);
  this->ReplaceShaderValues(shaders, ren, act);
}

void vtkOpenGLPointFrontPicture::GetShaderTemplate(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer*, vtkActor*)
{
  std::string source = PictureFSGLSL;
  vtkShaderProgram::Substitute(source, "//POINTFRONT::Define::Dec",
    std::string("#define POINTFRONT_PICKING ") + (this->IsDrawingIds() ? "1\n" : "0\n"));
  shaders[vtkShader::Vertex]->SetSource(PictureVSGLSL);
  shaders[vtkShader::Fragment]->SetSource(source);
  shaders[vtkShader::Geometry]->SetSource("");
}

/// Points have no normals to be lit by, or were lit where they were drawn.
void vtkOpenGLPointFrontPicture::ReplaceShaderLight(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer*, vtkActor*)
{
  std::string source = shaders[vtkShader::Fragment]->GetSource();
  vtkShaderProgram::Substitute(
    source, "//VTK::Light::Impl", "gl_FragData[0] = vec4(colour, opacity);\n");
  shaders[vtkShader::Fragment]->SetSource(source);
}

void vtkOpenGLPointFrontPicture::ReplaceShaderPicking(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* act)
{
  if (!this->IsDrawingIds())
  {
    this->Superclass::ReplaceShaderPicking(shaders, ren, act);
    return;
  }
  pointfront::replacePicking(
    shaders, this->LastSelectionState, "ivec2(texelFetch(pictureIds, texel, 0).xy)");
}

void vtkOpenGLPointFrontPicture::SetMapperShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* act)
{
  this->Superclass::SetMapperShaderParameters(cellBO, ren, act);
  cellBO.AttributeUpdateTime.Modified();
  const pointfront::PictureDrawing& drawing = *this->Drawing;
  vtkShaderProgram* program = cellBO.Program;
  program->SetUniformi("pictureColour", drawing.colour->GetTextureUnit());
  program->SetUniformi("pictureDepth", drawing.depth->GetTextureUnit());
  if (drawing.ids && program->IsUniformUsed("pictureIds"))
  {
    program->SetUniformi("pictureIds", drawing.ids->GetTextureUnit());
  }
  const pointfront::ViewportMargin& margin = drawing.camera->margin;
  const int origin[2] = { drawing.originPx[0] - margin.left, drawing.originPx[1] - margin.bottom };
  program->SetUniform2i("pictureOrigin", origin);
  const float size[2] = { static_cast<float>(drawing.camera->width),
    static_cast<float>(drawing.camera->height) };
  program->SetUniform2f("pictureSize", size);
  const pointfront::PixelRectangle& place = drawing.place;
  const int corner[2] = { drawing.textures.left, drawing.textures.bottom };
  program->SetUniform2i("pictureCorner", corner);
  const auto edge = [](int pixel, float drawn, int low, int high)
  {
    const float shown = drawn - static_cast<float>(low + high);
    return 2.0f * static_cast<float>(pixel - low) / shown - 1.0f;
  };
  const float edges[4] = { edge(place.left, size[0], margin.left, margin.right),
    edge(place.bottom, size[1], margin.bottom, margin.top),
    edge(place.right, size[0], margin.left, margin.right),
    edge(place.top, size[1], margin.bottom, margin.top) };
  program->SetUniform4f("pictureEdges", edges);
  vtkNew<vtkMatrix4x4> viewToClip; // stored as GL wants it: columns
  for (int column = 0; column < 4; ++column)
  {
    for (int row = 0; row < 4; ++row)
    {
      viewToClip->SetElement(column, row, drawing.camera->viewToClip[column][row]);
    }
  }
  program->SetUniformMatrix("pictureViewToClip", viewToClip);
  this->SetOffset(cellBO, ren, act);
}

/// Its pixels are moved as points are, except by what VTK adds in selections.
void vtkOpenGLPointFrontPicture::SetOffset(vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* act)
{
  float factor = 0.0f;
  float offset = 0.0f;
  if (this->Drawing->owner)
  {
    const auto drawn = cellBO.PrimitiveType;
    cellBO.PrimitiveType = PrimitivePoints; // the superclass asks it
    this->GetCoincidentParameters(ren, act, factor, offset);
    cellBO.PrimitiveType = drawn;
    offset -= pointfront::selectsPoints(ren) ? pointfront::selectionOffset : 0.0f;
  }
  cellBO.Program->SetUniformf("pictureOffset", offset / 65000.0f); // as the superclass's shaders
}

void vtkOpenGLPointFrontPicture::UpdateMaximumPointCellIds(vtkRenderer* ren, vtkActor*)
{
  vtkHardwareSelector* selector = ren->GetSelector();
  const vtkIdType last = std::max<vtkIdType>(0, this->Drawing->storePoints - 1);
  selector->UpdateMaximumPointId(last);
  selector->UpdateMaximumCellId(last);
}

void vtkOpenGLPointFrontPicture::RenderPieceDraw(vtkRenderer* ren, vtkActor* act)
{
  this->DrawingVertices = false;
  this->DrawingSelection = false;
  // The property may cull faces, but a picture is of points, which have none.
  vtkOpenGLState* const state =
    static_cast<vtkOpenGLRenderWindow*>(ren->GetRenderWindow())->GetState();
  const vtkOpenGLState::ScopedglEnableDisable culling(state, GL_CULL_FACE);
  state->vtkglDisable(GL_CULL_FACE);
  vtkTextureObject* const textures[] = { this->Drawing->colour, this->Drawing->depth,
    this->Drawing->ids };
  for (vtkTextureObject* texture : textures)
  {
    if (texture)
    {
      texture->Activate();
    }
  }
  if (ren->GetSelector())
  {
    // VTK selects points without a depth mask: it relies on the depths of the picture before. A
    // renderer of a layer above clears them in its viewport, ParaView on a rank that shows what all
    // drew; and what has no depth is nothing to those who composite by it.
    state->vtkglDepthMask(GL_TRUE);
  }
  vtkOpenGLHelper& triangle = this->Primitives[PrimitiveTris];
  triangle.PrimitiveType = PrimitiveTris;
  this->UpdateShaders(triangle, ren, act);
  if (triangle.Program)
  {
    triangle.VAO->Bind();
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    vtkOpenGLCheckErrorMacro("failed after drawing a picture");
  }
  for (vtkTextureObject* texture : textures)
  {
    if (texture)
    {
      texture->Deactivate();
    }
  }
}
