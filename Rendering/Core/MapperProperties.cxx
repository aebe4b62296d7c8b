#include "MapperProperties.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkScalarsToColors.h>

#include <algorithm>

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
      request.colourRange = {range[0], range[1]};
    }
  }
  else if (mapper.GetColorMode() == VTK_COLOR_MODE_MAP_SCALARS)
  {
    request.mode = ColourRequest::Mode::Table;
  }
  request.component = mapper.GetArrayComponent();
  if (request.component < 0 && vectorMode == vtkScalarsToColors::COMPONENT)
  {
    request.component = std::max(0, table ? table->GetVectorComponent() : 0);
  }
  return request;
}

View viewOf(vtkRenderer* renderer, vtkActor* actor)
{
  int size[2];
  int origin[2];
  renderer->GetTiledSizeAndOrigin(&size[0], &size[1], &origin[0], &origin[1]);
  vtkMatrix4x4* toClip = renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
    renderer->GetTiledAspectRatio(), -1.0, 1.0);
  vtkNew<vtkMatrix4x4> storeToClip;
  vtkMatrix4x4::Multiply4x4(toClip, actor->GetMatrix(), storeToClip);
  glm::dmat4 matrix;
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      matrix[column][row] = storeToClip->GetElement(row, column);
    }
  }
  return View::fromMatrix(matrix, std::max(1, size[0]), std::max(1, size[1]));
}

} // namespace pointfront
