#include "vtkOpenGLPointFrontPoints.h"

#include "CoincidentOffset.h"
#include "ColourMapTexture.h"
#include "DrawBatches.h"
#include "GpuPool.h"
#include "OpenGLFunctions.h"
#include "SelectionIds.h"
#include "SlotRecords.h"
#include "TechniquePasses.h"

#include "ColourMapTextureGLSL.h"
#include "PointsFSGLSL.h"
#include "PointsVSGLSL.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkHardwareSelector.h>
#include <vtkMatrix3x3.h>
#include <vtkMatrix4x4.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLCamera.h>
#include <vtkOpenGLError.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkOpenGLVertexArrayObject.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProgram.h>
#include <vtkShaderProperty.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

vtkStandardNewMacro(vtkOpenGLPointFrontPoints);

namespace
{

std::string definitions(pointfront::PointColouring::Kind kind, bool ids, bool squares)
{
  return "#define POINTFRONT_COLOUR " + std::to_string(static_cast<int>(kind)) +
    "\n#define POINTFRONT_PICKING " + (ids ? "1" : "0") + "\n#define POINTFRONT_SQUARES " +
    (squares ? "1\n" : "0\n");
}

/// Ours speak to each other of the squares beside the view.
bool hasOwnStages(vtkShaderProperty* shaders)
{
  return shaders->HasVertexShaderCode() || shaders->HasFragmentShaderCode() ||
    shaders->HasGeometryShaderCode();
}

/// World to view without what VTK's matrix lost: `reference` to view is the origin where it is the
/// eye, but comes out as rounding noise of two large terms. What is below that noise is zero.
void referenceToView(vtkMatrix4x4* worldToView, const double reference[3], double view[3])
{
  for (int row = 0; row < 3; ++row)
  {
    double sum = worldToView->GetElement(row, 3);
    double size = std::abs(sum);
    for (int column = 0; column < 3; ++column)
    {
      const double term = worldToView->GetElement(row, column) * reference[column];
      sum += term;
      size = std::max(size, std::abs(term));
    }
    view[row] = std::abs(sum) <= 16.0 * std::numeric_limits<double>::epsilon() * size ? 0.0 : sum;
  }
}

/// Whether a matrix puts the reference point at `world`, by which no digits are lost. `placed` is
/// where it puts it: a store that an actor flattens has no point there (cameraOf()).
bool isPlacedAt(
  const double world[3], vtkMatrix4x4* matrix, const glm::dvec3& reference, double placed[4])
{
  const double in[4] = { reference.x, reference.y, reference.z, 1.0 };
  matrix->MultiplyPoint(in, placed);
  bool isThere = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double off = std::abs(placed[axis] - world[axis]);
    isThere = isThere && off <= 1e-9 * std::max(1.0, std::abs(world[axis]));
  }
  return isThere;
}

} // namespace

vtkOpenGLPointFrontPoints::vtkOpenGLPointFrontPoints()
{
  this->SetPopulateSelectionSettings(1);
  // No points, no normals, no cells: what the superclass finds when it looks at its input.
  this->SetInputData(this->NoInput);
}

vtkOpenGLPointFrontPoints::~vtkOpenGLPointFrontPoints() = default;

void vtkOpenGLPointFrontPoints::CopyState(vtkMapper* owner)
{
  if (this->GetClippingPlanes() != owner->GetClippingPlanes())
  {
    this->SetClippingPlanes(owner->GetClippingPlanes());
  }
  pointfront::copyPointOffset(owner, this);
}

void vtkOpenGLPointFrontPoints::Draw(
  vtkRenderer* renderer, vtkActor* actor, const pointfront::PointDrawing& drawing)
{
  this->Drawing = &drawing;
  const bool squares = this->SquareSize(actor) > 1 && !hasOwnStages(actor->GetShaderProperty());
  if (this->Variant != drawing.colouring.kind || this->Squares != squares)
  {
    this->Variant = drawing.colouring.kind;
    this->Squares = squares;
    this->Modified(); // another program
  }
  // Without points in its input the superclass only registers its resources with the window, by a
  // class whose header is not installed; without that it never releases them.
  this->Superclass::RenderPiece(renderer, actor);
  this->RenderPieceStart(renderer, actor);
  this->RenderPieceDraw(renderer, actor);
  this->RenderPieceFinish(renderer, actor);
  this->Drawing = nullptr;
}

int vtkOpenGLPointFrontPoints::SquareSize(vtkActor* actor) const
{
  const double own = this->Drawing->pointSize;
  return pointfront::squareSizeOf(
    own > 0.0 ? own : static_cast<double>(actor->GetProperty()->GetPointSize()));
}

bool vtkOpenGLPointFrontPoints::IsDrawingIds() const
{
  return pointfront::drawsIds(this->LastSelectionState);
}

void vtkOpenGLPointFrontPoints::GetShaderTemplate(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* act)
{
  this->Superclass::GetShaderTemplate(shaders, ren, act);
  vtkShaderProperty* custom = act->GetShaderProperty();
  const std::string defines = definitions(this->Variant, this->IsDrawingIds(), this->Squares);
  if (!custom->HasVertexShaderCode())
  {
    std::string source = PointsVSGLSL;
    vtkShaderProgram::Substitute(source, "//POINTFRONT::Define::Dec", defines);
    vtkShaderProgram::Substitute(
      source, "//POINTFRONT::ColourMapTexture::Dec", ColourMapTextureGLSL);
    shaders[vtkShader::Vertex]->SetSource(source);
  }
  if (!custom->HasFragmentShaderCode())
  {
    std::string source = PointsFSGLSL;
    vtkShaderProgram::Substitute(source, "//POINTFRONT::Define::Dec", defines);
    shaders[vtkShader::Fragment]->SetSource(source);
  }
  shaders[vtkShader::Geometry]->SetSource(
    custom->HasGeometryShaderCode() ? custom->GetGeometryShaderCode() : "");
}

void vtkOpenGLPointFrontPoints::ReplaceShaderColor(
  std::map<vtkShader::Type, vtkShader*>, vtkRenderer*, vtkActor*)
{
  // The templates have it.
}

void vtkOpenGLPointFrontPoints::ReplaceShaderPicking(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* act)
{
  if (!this->IsDrawingIds())
  {
    this->Superclass::ReplaceShaderPicking(shaders, ren, act);
    return;
  }
  pointfront::replacePicking(shaders, this->LastSelectionState, "pointIdVSOutput");
}

/// VTK gives view coordinates to what it lights only; code of render passes, as that of shadows,
/// uses them for everything.
void vtkOpenGLPointFrontPoints::ReplaceShaderPositionVC(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* act)
{
  this->Superclass::ReplaceShaderPositionVC(shaders, ren, act);
  std::string vertex = shaders[vtkShader::Vertex]->GetSource();
  std::string fragment = shaders[vtkShader::Fragment]->GetSource();
  const auto has = [](const std::string& source, const char* tag)
  { return source.find(tag) != std::string::npos; };
  if (has(vertex, "//POINTFRONT::PositionVC::Impl") && has(vertex, "//VTK::PositionVC::Dec") &&
    has(fragment, "//VTK::PositionVC::Dec") && has(fragment, "//VTK::PositionVC::Impl"))
  {
    vtkShaderProgram::Substitute(
      vertex, "//VTK::PositionVC::Dec", "uniform mat4 MCVCMatrix;\nout vec4 vertexVCVSOutput;\n");
    vtkShaderProgram::Substitute(
      vertex, "//POINTFRONT::PositionVC::Impl", "vertexVCVSOutput = MCVCMatrix * vertexMC;\n");
    vtkShaderProgram::Substitute(fragment, "//VTK::PositionVC::Dec", "in vec4 vertexVCVSOutput;\n");
    vtkShaderProgram::Substitute(
      fragment, "//VTK::PositionVC::Impl", "vec4 vertexVC = vertexVCVSOutput;\n");
    shaders[vtkShader::Vertex]->SetSource(vertex);
    shaders[vtkShader::Fragment]->SetSource(fragment);
  }
}

/// Without what VTK moves points by in selections: they would win over what hides them, 30 m behind
/// it at a distance of 1 km with a near plane at 1 m.
void vtkOpenGLPointFrontPoints::ReplaceShaderCoincidentOffset(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* ren, vtkActor* act)
{
  float factor = 0.0f;
  float offset = 0.0f;
  this->GetCoincidentParameters(ren, act, factor, offset);
  if (!pointfront::selectsPoints(ren) || factor != 0.0f || offset != pointfront::selectionOffset)
  {
    this->Superclass::ReplaceShaderCoincidentOffset(shaders, ren, act);
  }
}

void vtkOpenGLPointFrontPoints::SetMapperShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* act)
{
  this->Superclass::SetMapperShaderParameters(cellBO, ren, act);
  cellBO.AttributeUpdateTime.Modified();
  const pointfront::PointDrawing& drawing = *this->Drawing;
  drawing.records->activate(cellBO.Program);
  const float stepSize[3] = { static_cast<float>(drawing.stepSize.x),
    static_cast<float>(drawing.stepSize.y), static_cast<float>(drawing.stepSize.z) };
  cellBO.Program->SetUniform3f("stepSize", stepSize);
  float flat[4];
  std::transform(drawing.flat.begin(), drawing.flat.end(), flat,
    [](std::uint8_t value) { return static_cast<float>(value) / 255.0f; });
  cellBO.Program->SetUniform4f("flatColour", flat);
  if (drawing.table)
  {
    drawing.table->activate(
      cellBO.Program, drawing.colouring, drawing.reference.z, drawing.stepSize.z);
  }
  this->SetClippingUniforms(cellBO.Program, act);
  this->SetSquareUniforms(cellBO.Program, ren, act);
}

void vtkOpenGLPointFrontPoints::SetSquareUniforms(
  vtkShaderProgram* program, vtkRenderer* ren, vtkActor* actor)
{
  if (!this->Squares)
  {
    return;
  }
  int box[4];
  static_cast<vtkOpenGLRenderWindow*>(ren->GetRenderWindow())
    ->GetState()
    ->vtkglGetIntegerv(GL_VIEWPORT, box);
  float viewport[4];
  std::transform(box, box + 4, viewport, [](int value) { return static_cast<float>(value); });
  program->SetUniform4f("viewportPx", viewport);
  program->SetUniformf("squareEdge", static_cast<float>(this->SquareSize(actor)));
}

void vtkOpenGLPointFrontPoints::SetClippingUniforms(vtkShaderProgram* program, vtkActor* actor)
{
  const int planes = std::min(this->GetNumberOfClippingPlanes(), 6);
  if (planes == 0 || !program->IsUniformUsed("clipPlanes"))
  {
    return;
  }
  const glm::dvec3& reference = this->Drawing->reference;
  float equations[6][4] = {};
  for (int i = 0; i < planes; ++i)
  {
    double plane[4];
    this->GetClippingPlaneInDataCoords(actor->GetMatrix(), i, plane);
    plane[3] += plane[0] * reference.x + plane[1] * reference.y + plane[2] * reference.z;
    std::copy(plane, plane + 4, equations[i]);
  }
  program->SetUniform4fv("clipPlanes", 6, equations);
}

void vtkOpenGLPointFrontPoints::SetCameraShaderParameters(
  vtkOpenGLHelper& cellBO, vtkRenderer* ren, vtkActor* act)
{
  this->Superclass::SetCameraShaderParameters(cellBO, ren, act);
  if (pointfront::selectsPoints(ren) && cellBO.Program->IsUniformUsed("cOffset"))
  {
    float factor = 0.0f;
    float offset = 0.0f;
    this->GetCoincidentParameters(ren, act, factor, offset);
    cellBO.Program->SetUniformf("cOffset", offset - pointfront::selectionOffset);
  }

  // The superclass's matrices take world coordinates; ours are relative to the reference point, and
  // all that is large is folded in here, in double.
  vtkMatrix4x4 *wcvc, *vcdc, *wcdc; // stored transposed
  vtkMatrix3x3* normals;
  auto* camera = static_cast<vtkOpenGLCamera*>(ren->GetActiveCamera());
  camera->GetKeyMatrices(ren, wcvc, normals, vcdc, wcdc);
  vtkNew<vtkMatrix4x4> worldToView;
  vtkMatrix4x4::Transpose(wcvc, worldToView);
  vtkNew<vtkMatrix4x4> storeToView;
  vtkMatrix4x4::Multiply4x4(worldToView, act->GetMatrix(), storeToView);

  double moved[3];
  if (act->GetIsIdentity())
  {
    referenceToView(worldToView, &this->Drawing->reference.x, moved);
  }
  else
  {
    const double* world =
      camera->GetParallelProjection() ? camera->GetFocalPoint() : camera->GetPosition();
    double placed[4];
    const bool isThere = isPlacedAt(world, act->GetMatrix(), this->Drawing->reference, placed);
    referenceToView(worldToView, isThere ? world : placed, moved);
  }
  for (int row = 0; row < 3; ++row)
  {
    storeToView->SetElement(row, 3, moved[row]);
  }
  vtkNew<vtkMatrix4x4> viewToClip;
  vtkMatrix4x4::Transpose(vcdc, viewToClip);
  vtkNew<vtkMatrix4x4> storeToClip;
  vtkMatrix4x4::Multiply4x4(viewToClip, storeToView, storeToClip);
  storeToClip->Transpose();
  cellBO.Program->SetUniformMatrix("MCDCMatrix", storeToClip);
  if (cellBO.Program->IsUniformUsed("MCVCMatrix"))
  {
    storeToView->Transpose();
    cellBO.Program->SetUniformMatrix("MCVCMatrix", storeToView);
  }
}

void vtkOpenGLPointFrontPoints::UpdateMaximumPointCellIds(vtkRenderer* ren, vtkActor*)
{
  vtkHardwareSelector* selector = ren->GetSelector();
  const vtkIdType last = std::max<vtkIdType>(0, this->Drawing->storePoints - 1);
  selector->UpdateMaximumPointId(last);
  selector->UpdateMaximumCellId(last);
}

/// From one block's buffers after the other.
void vtkOpenGLPointFrontPoints::DrawBlocks(vtkOpenGLHelper& cellBO)
{
  const auto program = static_cast<GLuint>(cellBO.Program->GetHandle());
  const GLint positions = glGetAttribLocation(program, "positionSteps");
  const GLint colours = glGetAttribLocation(program, "pointColour");
  const GLint values = glGetAttribLocation(program, "pointValue");
  for (const GLint location : { positions, colours, values })
  {
    if (location >= 0)
    {
      glEnableVertexAttribArray(static_cast<GLuint>(location));
    }
  }
  const auto attach = [](GLint location, std::uint32_t buffer, int size, GLenum type, bool colour)
  {
    if (location >= 0)
    {
      glBindBuffer(GL_ARRAY_BUFFER, buffer);
      glVertexAttribPointer(
        static_cast<GLuint>(location), size, type, colour ? GL_TRUE : GL_FALSE, 0, nullptr);
    }
  };
  pointfront::DrawBatches batches;
  const pointfront::DrawRuns& runs = *this->Drawing->runs;
  for (const pointfront::DrawRuns::Stretch& stretch : runs.stretches())
  {
    const pointfront::GpuBlock& block = this->Drawing->pool->memory().blocks()[stretch.block];
    if (positions >= 0) // a user's own vertex shader may do without
    {
      glBindBuffer(GL_ARRAY_BUFFER, block.positionBuffer());
      glVertexAttribIPointer(static_cast<GLuint>(positions), 3, GL_UNSIGNED_INT, 0, nullptr);
    }
    attach(colours, block.buffer(pointfront::GpuStream::Value), 4, GL_UNSIGNED_BYTE, true);
    attach(values, block.buffer(pointfront::GpuStream::Value), 1, GL_FLOAT, false);
    cellBO.Program->SetUniformi("firstSlot", static_cast<int>(block.first()));
    batches.draw(
      runs.firsts() + stretch.begin, runs.counts() + stretch.begin, stretch.end - stretch.begin);
  }
  glBindBuffer(GL_ARRAY_BUFFER, 0);
}

void vtkOpenGLPointFrontPoints::RenderPieceDraw(vtkRenderer* ren, vtkActor* act)
{
  auto* window = static_cast<vtkOpenGLRenderWindow*>(ren->GetRenderWindow());
  vtkOpenGLState* state = window->GetState();
  this->DrawingVertices = false;
  this->DrawingSelection = false;
  if (pointfront::selectsPoints(ren))
  {
    // Its points are those of the pixels that show them. VTK would draw squares of two pixels at
    // least, and without a depth mask the last point near the surface, not the nearest.
    this->PointPicking = false;
    state->vtkglDepthMask(GL_TRUE);
  }
  vtkOpenGLHelper& points = this->Primitives[PrimitivePoints];
  points.PrimitiveType = PrimitivePoints;
  this->UpdateShaders(points, ren, act);
  if (points.Program)
  {
    state->vtkglPointSize(static_cast<float>(this->SquareSize(act)));
    points.VAO->Bind();
    this->DrawBlocks(points);
    vtkOpenGLCheckErrorMacro("failed after drawing points");
  }
  this->Drawing->records->deactivate();
  if (this->Drawing->table)
  {
    this->Drawing->table->deactivate();
  }
}
