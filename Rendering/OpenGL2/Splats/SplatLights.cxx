#include "SplatLights.h"

#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkShaderProgram.h>

#include <algorithm>
#include <array>
#include <vector>

namespace pointfront
{

float depthShiftOf(const FrameCamera& camera)
{
  const glm::dmat4& clip = camera.viewToClip;
  return camera.parallel ? static_cast<float>((clip[3][2] + clip[3][3]) / (clip[2][2] + clip[2][3]))
                         : 0.0f;
}

void setLights(vtkShaderProgram* program, const FramePlan& plan)
{
  const FrameShading& shading = plan.shading;
  const float ambientDiffuse[2] = { shading.ambient, shading.diffuse };
  program->SetUniform2f("ambientDiffuse", ambientDiffuse);
  std::vector<FrameLight> lights = shading.lights;
  lights.resize(std::clamp<std::size_t>(lights.size(), 1, mostLights)); // none: one at the eye
  std::array<float[4], mostLights> places, colours, aims;
  std::array<float[3], mostLights> attenuations;
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    const FrameLight& light = lights[i];
    std::copy_n(&(light.positional ? light.place : light.towards).x, 3, places[i]);
    places[i][3] = light.positional ? 1.0f : 0.0f;
    std::copy_n(&light.colour.x, 3, colours[i]);
    colours[i][3] = light.exponent;
    std::copy_n(&light.aim.x, 3, aims[i]);
    aims[i][3] = light.coneCosine;
    std::copy_n(&light.attenuation.x, 3, attenuations[i]);
  }
  const auto count = static_cast<int>(lights.size());
  program->SetUniformi("lightCount", count);
  program->SetUniform4fv("lightPlaces", count, places.data());
  program->SetUniform4fv("lightColours", count, colours.data());
  program->SetUniform4fv("lightAims", count, aims.data());
  program->SetUniform3fv("lightAttenuations", count, attenuations.data());
  vtkNew<vtkMatrix4x4> viewToClip; // stored as GL wants it: columns
  for (int column = 0; column < 4; ++column)
  {
    for (int row = 0; row < 4; ++row)
    {
      viewToClip->SetElement(column, row, plan.camera.viewToClip[column][row]);
    }
  }
  program->SetUniformMatrix("viewToClip", viewToClip);
  const float size[2] = { static_cast<float>(plan.camera.width),
    static_cast<float>(plan.camera.height) };
  program->SetUniform2f("viewportSize", size);
}

} // namespace pointfront
