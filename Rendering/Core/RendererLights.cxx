#include "RendererLights.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>
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

constexpr double widestCone = 90.0; ///< degrees; VTK's lights of that angle and more have none

glm::dmat4 viewMatrixOf(vtkCamera* camera)
{
  glm::dmat4 matrix;
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      matrix[column][row] = camera->GetModelViewTransformMatrix()->GetElement(row, column);
    }
  }
  return matrix;
}

/// A unit vector, without the noise of a turn by a right angle; `usual` if it has no length.
glm::dvec3 unit(const glm::dvec3& vector, const glm::dvec3& usual)
{
  const double length = glm::length(vector);
  if (!(length > 0.0))
  {
    return usual;
  }
  glm::dvec3 result = vector / length;
  for (int axis = 0; axis < 3; ++axis)
  {
    result[axis] = std::abs(result[axis]) < noise ? 0.0 : result[axis];
  }
  return result;
}

/// `toView`        world to the view of VTK's camera
/// `cameraToView`  from there to the view of the frame
FrameLight lightOf(vtkLight* light, const glm::dmat4& toView, const glm::dmat4& cameraToView)
{
  constexpr glm::dvec3 ahead(0.0, 0.0, -1.0);
  double from[3];
  double to[3];
  light->GetTransformedPosition(from);
  light->GetTransformedFocalPoint(to);
  const glm::dvec3 place(from[0], from[1], from[2]), aim(to[0], to[1], to[2]);
  const glm::dmat3 turn(cameraToView);
  const glm::dvec3 direction = unit(turn * (glm::dmat3(toView) * (aim - place)), ahead);
  const double* const colour = light->GetDiffuseColor();
  FrameLight result;
  result.colour = glm::vec3(light->GetIntensity() * glm::dvec3(colour[0], colour[1], colour[2]));
  result.towards =
    glm::vec3(light->LightTypeIsHeadlight() ? unit(turn * -ahead, -ahead) : -direction);
  result.positional = light->GetPositional() != 0;
  if (result.positional)
  {
    result.place = glm::vec3(cameraToView * (toView * glm::dvec4(place, 1.0)));
    result.aim = glm::vec3(direction);
    result.coneCosine = light->GetConeAngle() < widestCone
      ? static_cast<float>(std::cos(glm::radians(light->GetConeAngle())))
      : FrameLight::noCone;
    result.exponent = static_cast<float>(light->GetExponent());
    const double* const fall = light->GetAttenuationValues();
    result.attenuation = glm::vec3(fall[0], fall[1], fall[2]);
  }
  return result;
}

} // namespace

std::vector<FrameLight> lightsOf(vtkRenderer* renderer, const FrameCamera& camera)
{
  const glm::dmat4 toView = viewMatrixOf(renderer->GetActiveCamera());
  std::vector<FrameLight> lights;
  vtkLightCollection* const all = renderer->GetLights();
  vtkCollectionSimpleIterator at;
  all->InitTraversal(at);
  while (vtkLight* const light = all->GetNextLight(at))
  {
    if (light->GetSwitch())
    {
      lights.push_back(lightOf(light, toView, camera.cameraToView));
    }
  }
  if (lights.empty())
  {
    lights.emplace_back();
    lights.back().colour = glm::vec3(0.0f);
  }
  return lights;
}

} // namespace pointfront
