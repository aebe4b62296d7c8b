#include "SplatLights.h"

#include "SoftwareRasteriser.h"

#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkShaderProgram.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace pointfront
{

float depthShiftOf(const FrameCamera& camera)
{
  const glm::dmat4& clip = camera.viewToClip;
  return camera.parallel ? static_cast<float>((clip[3][2] + clip[3][3]) / (clip[2][2] + clip[2][3]))
                         : 0.0f;
}

int looksOf(const FrameShading& shading)
{
  return shading.lookCount() > 1 ? static_cast<int>(mostLooks) : 1;
}

void setLooks(vtkShaderProgram* program, const FrameShading& shading)
{
  std::array<float[4], mostLooks> looks;
  const std::size_t count = std::min(shading.lookCount(), mostLooks);
  for (std::size_t number = 0; number < count; ++number)
  {
    const FrameLook& look = shading.look(number);
    looks[number][0] = look.lit ? look.ambient : -1.0f;
    looks[number][1] = look.diffuse;
    looks[number][2] = eyeDomeGain * look.eyeDomeStrength;
    looks[number][3] = std::max(1.0f, std::round(look.eyeDomeRadiusPx));
  }
  program->SetUniform4fv("looks", static_cast<int>(count), looks.data());
}

void setLights(vtkShaderProgram* program, const FramePlan& plan)
{
  const FrameShading& shading = plan.shading;
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
