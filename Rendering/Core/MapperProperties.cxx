#include "MapperProperties.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkScalarsToColors.h>
#include <vtkWindow.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace pointfront
{

ColourRequest colourRequestOf(vtkPolyDataMapper& mapper, const StoreDescription& description)
{
  ColourRequest request;
  vtkPointData* points = mapper.GetInput() ? mapper.GetInput()->GetPointData() : nullptr;
  if (mapper.GetScalarMode() == VTK_SCALAR_MODE_USE_POINT_FIELD_DATA)
  {
    const bool byName = mapper.GetArrayAccessMode() == VTK_GET_ARRAY_BY_NAME;
    const char* numbered = points ? points->GetArrayName(mapper.GetArrayId()) : nullptr;
    const char* name = byName ? mapper.GetArrayName() : numbered;
    request.name = name ? name : "";
  }
  else if (mapper.GetScalarMode() == VTK_SCALAR_MODE_DEFAULT ||
    mapper.GetScalarMode() == VTK_SCALAR_MODE_USE_POINT_DATA)
  {
    vtkDataArray* active = points ? points->GetScalars() : nullptr;
    const char* name = active ? active->GetName() : nullptr;
    if (name && description.schema.find(name))
    {
      request.name = name;
    }
    else if (description.schema.find("rgb"))
    {
      request.name = "rgb";
    }
  }
  vtkScalarsToColors* table = mapper.GetLookupTable();
  const int vectorMode = table ? table->GetVectorMode() : vtkScalarsToColors::COMPONENT;
  if (mapper.GetColorMode() == VTK_COLOR_MODE_DIRECT_SCALARS ||
    vectorMode == vtkScalarsToColors::RGBCOLORS)
  {
    request.mode = ColourRequest::Mode::Direct;
    if (vectorMode == vtkScalarsToColors::RGBCOLORS)
    {
      const double* range =
        mapper.GetUseLookupTableScalarRange() ? table->GetRange() : mapper.GetScalarRange();
      request.colourRange = { range[0], range[1] };
    }
  }
  else if (mapper.GetColorMode() == VTK_COLOR_MODE_MAP_SCALARS)
  {
    request.mode = ColourRequest::Mode::Table;
  }
  request.coloursInBytes = true; // as arrays have them (AttributeArray)
  request.component = mapper.GetArrayComponent();
  if (request.component < 0 && vectorMode == vtkScalarsToColors::COMPONENT)
  {
    request.component = std::max(0, table ? table->GetVectorComponent() : 0);
  }
  return request;
}

namespace
{

glm::dmat4 columnsOf(vtkMatrix4x4* rows)
{
  glm::dmat4 matrix;
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      matrix[column][row] = rows->GetElement(row, column);
    }
  }
  return matrix;
}

/// World to view without what VTK's matrix lost: the eye is the origin, but comes out as rounding
/// noise of two large terms. What is below that noise is zero.
glm::dvec3 withoutNoise(const glm::dmat4& worldToView, const glm::dvec3& point)
{
  glm::dvec3 view;
  for (int row = 0; row < 3; ++row)
  {
    double sum = worldToView[3][row];
    double size = std::abs(sum);
    for (int column = 0; column < 3; ++column)
    {
      const double term = worldToView[column][row] * point[column];
      sum += term;
      size = std::max(size, std::abs(term));
    }
    view[row] = std::abs(sum) <= 16.0 * std::numeric_limits<double>::epsilon() * size ? 0.0 : sum;
  }
  return view;
}

/// Beyond this a store's coordinate is rounding alone.
constexpr double farthestReference = 1e13;

/// The point of the store that the actor puts at `world`. An actor that flattens the store puts
/// many there or none: then the middle of what it draws, and where that is seen.
void placeReference(vtkActor* actor, const glm::dvec3& world, FrameCamera& frame)
{
  vtkNew<vtkMatrix4x4> toStore;
  vtkMatrix4x4::Invert(actor->GetMatrix(), toStore);
  const double in[4] = { world.x, world.y, world.z, 1.0 };
  double out[4];
  toStore->MultiplyPoint(in, out);
  frame.reference = { out[0] / out[3], out[1] / out[3], out[2] / out[3] };
  const glm::dvec3 size = glm::abs(frame.reference);
  const bool placed = actor->GetMatrix()->Determinant() != 0.0 &&
    std::max({ size.x, size.y, size.z }) < farthestReference; // not of infinities
  if (!placed)
  {
    const double* const box = actor->GetMapper()->GetBounds();
    frame.reference = 0.5 * glm::dvec3(box[0] + box[1], box[2] + box[3], box[4] + box[5]);
    frame.referenceInView = glm::dvec3(frame.storeToView * glm::dvec4(frame.reference, 1.0));
  }
}

/// An eye of a stereo pair stands beside the camera, which VTK makes a part of the projection: from
/// there positions are taken.
void centre(FrameCamera& frame)
{
  for (int axis = 0; axis < 2 && !frame.parallel; ++axis)
  {
    const double aside = frame.viewToClip[3][axis] / frame.viewToClip[axis][axis];
    frame.viewToClip[3][axis] = 0.0;
    frame.storeToView[3][axis] += aside;
    frame.referenceInView[axis] += aside;
    frame.cameraToView[3][axis] = aside;
  }
}

/// A row of `turn` that takes what a row of a projection says of other axes into the view. Gives
/// what is left of the row: the factor of its own axis, with its sign.
double straightened(const glm::dvec3& row, int axis, double length, glm::dmat3& turn)
{
  const double factor = std::copysign(length, row[axis]);
  for (int column = 0; column < 3; ++column)
  {
    turn[column][axis] = row[column] / factor;
  }
  return factor;
}

/// A projection may shear or turn what the view shows: that of an eye of a stereo pair in a
/// parallel view, oblique angles, a shear or a transformation of the user's. This becomes a part of
/// the view.
void straighten(FrameCamera& frame)
{
  glm::dmat4& clip = frame.viewToClip;
  glm::dmat3 turn(1.0);
  glm::dvec3 factors(clip[0][0], clip[1][1], clip[2][2]);
  // With perspective z of the view is the depth that x and y are divided by: it stays.
  for (int axis = 0; axis < (frame.parallel ? 3 : 2); ++axis)
  {
    glm::dvec3 row(clip[0][axis], clip[1][axis], frame.parallel ? clip[2][axis] : 0.0);
    const double length = axis < 2 ? glm::length(glm::dvec2(row)) : glm::length(row);
    glm::dvec3 others = row;
    others[axis] = 0.0;
    if (length > 0.0 && others != glm::dvec3(0.0))
    {
      factors[axis] = straightened(row, axis, length, turn);
    }
  }
  if (turn == glm::dmat3(1.0) || glm::determinant(turn) == 0.0)
  {
    return;
  }
  const glm::dmat4 wholeTurn(turn);
  clip = clip * glm::inverse(wholeTurn);
  for (int axis = 0; axis < (frame.parallel ? 3 : 2); ++axis)
  {
    for (int column = 0; column < (frame.parallel ? 3 : 2); ++column)
    {
      clip[column][axis] = column == axis ? factors[axis] : 0.0; // without rounding
    }
  }
  frame.storeToView = wholeTurn * frame.storeToView;
  frame.referenceInView = turn * frame.referenceInView;
  frame.cameraToView = wholeTurn;
}

} // namespace

FrameCamera cameraOf(vtkRenderer* renderer, vtkActor* actor)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  FrameCamera frame;
  int origin[2];
  renderer->GetTiledSizeAndOrigin(&frame.width, &frame.height, &origin[0], &origin[1]);
  frame.width = std::max(1, frame.width);
  frame.height = std::max(1, frame.height);
  frame.parallel = camera->GetParallelProjection() != 0;
  const double* point = frame.parallel ? camera->GetFocalPoint() : camera->GetPosition();
  const glm::dvec3 world(point[0], point[1], point[2]);
  const glm::dmat4 worldToView = columnsOf(camera->GetModelViewTransformMatrix());
  frame.viewToClip =
    columnsOf(camera->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0));
  frame.referenceInView = withoutNoise(worldToView, world);
  frame.storeToView = worldToView;
  frame.reference = world;
  straighten(frame);
  centre(frame);
  if (!actor->GetIsIdentity())
  {
    frame.storeToView = frame.storeToView * columnsOf(actor->GetMatrix());
    placeReference(actor, world, frame);
  }
  return frame;
}

std::vector<glm::dvec4> clippingPlanesOf(vtkPolyDataMapper& mapper, vtkActor* actor)
{
  std::vector<glm::dvec4> planes;
  for (int i = 0; i < mapper.GetNumberOfClippingPlanes(); ++i)
  {
    double plane[4];
    mapper.GetClippingPlaneInDataCoords(actor->GetMatrix(), i, plane);
    planes.emplace_back(plane[0], plane[1], plane[2], plane[3]);
  }
  return planes;
}

View viewOf(vtkRenderer* renderer, vtkActor* actor, const ViewportMargin& margin)
{
  int size[2];
  int origin[2];
  renderer->GetTiledSizeAndOrigin(&size[0], &size[1], &origin[0], &origin[1]);
  vtkMatrix4x4* toClip = renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
    renderer->GetTiledAspectRatio(), -1.0, 1.0);
  FrameCamera frame;
  frame.viewToClip = columnsOf(toClip);
  frame.width = std::max(1, size[0]);
  frame.height = std::max(1, size[1]);
  frame.setViewport(frame.width, frame.height, margin);
  return View::ofModel(columnsOf(actor->GetMatrix()), frame.viewToClip, frame.width, frame.height);
}

} // namespace pointfront
