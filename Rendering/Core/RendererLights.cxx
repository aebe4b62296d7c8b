#include "RendererLights.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkMatrix4x4.h>
#include <vtkRenderer.h>

#include <cmath>

namespace pointfront
{
namespace
{

/// Less of a unit vector than this is rounding.
constexpr double noise = 1.0e-12;

glm::dvec3 towards(vtkLight* light, vtkCamera* camera)
{
  double place[3];
  double aim[3];
  light->GetTransformedPosition(place);
  light->GetTransformedFocalPoint(aim);
  if (light->GetPositional())
  {
    camera->GetFocalPoint(aim);
  }
  const glm::dvec3 world(place[0] - aim[0], place[1] - aim[1], place[2] - aim[2]);
  vtkMatrix4x4* const toView = camera->GetModelViewTransformMatrix();
  glm::dvec3 view(0.0);
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      view[row] += toView->GetElement(row, column) * world[column];
    }
  }
  const double length = glm::length(view);
  if (light->LightTypeIsHeadlight() || !(length > 0.0))
  {
    return { 0.0, 0.0, 1.0 };
  }
  view /= length;
  for (int axis = 0; axis < 3; ++axis)
  {
    view[axis] = std::abs(view[axis]) < noise ? 0.0 : view[axis];
  }
  return view;
}

} // namespace

std::vector<FrameLight> lightsOf(vtkRenderer* renderer)
{
  std::vector<FrameLight> lights;
  vtkLightCollection* const all = renderer->GetLights();
  vtkCollectionSimpleIterator at;
  all->InitTraversal(at);
  while (vtkLight* const light = all->GetNextLight(at))
  {
    if (light->GetSwitch())
    {
      const double* const colour = light->GetDiffuseColor();
      FrameLight one;
      one.towards = towards(light, renderer->GetActiveCamera());
      one.colour = glm::vec3(light->GetIntensity() * glm::dvec3(colour[0], colour[1], colour[2]));
      lights.push_back(one);
    }
  }
  if (lights.empty())
  {
    lights.push_back({ { 0.0f, 0.0f, 1.0f }, glm::vec3(0.0f) });
  }
  return lights;
}

} // namespace pointfront
