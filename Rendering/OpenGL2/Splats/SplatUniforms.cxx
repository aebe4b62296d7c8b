#include "SplatUniforms.h"

#include <vtkShaderProgram.h>

#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{

void setMatrix(vtkShaderProgram* program, const char* name, const glm::mat3& matrix)
{
  glm::mat3 columns = matrix; // as GL wants them, but the function takes no const
  program->SetUniformMatrix3x3(name, &columns[0][0]);
}

void setColour(vtkShaderProgram* program, const char* name, const Rgba8& colour)
{
  const float rgb[3] = { static_cast<float>(colour[0]) / 255.0f,
    static_cast<float>(colour[1]) / 255.0f, static_cast<float>(colour[2]) / 255.0f };
  program->SetUniform3f(name, rgb);
}

/// Camera space of a step: without what a node of many steps was shifted by.
glm::mat3 stepsToCamera(const RasterItem& item)
{
  const float step = std::ldexp(1.0f, -static_cast<int>(item.positions.shift));
  glm::mat3 result;
  for (int row = 0; row < 3; ++row)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      result[axis][row] = item.camera.matrix[row][axis] * step;
    }
  }
  return result;
}

void setCamera(vtkShaderProgram* program, const FramePlan& plan, const RasterItem& item)
{
  const RasterCamera& camera = item.camera;
  const float scale[2] = { camera.scaleX, camera.scaleY };
  const float centre[2] = { camera.centreX, camera.centreY };
  const float range[2] = { camera.nearDepth, camera.farDepth };
  const float size[2] = { static_cast<float>(plan.camera.width),
    static_cast<float>(plan.camera.height) };
  program->SetUniform2f("cameraScale", scale);
  program->SetUniform2f("cameraCentre", centre);
  program->SetUniform2f("depthRange", range);
  program->SetUniform2f("viewportSize", size);
  program->SetUniformf("depthScale", depthScaleOf(camera));
  program->SetUniform4fv("clipPlanes", 6, item.positions.clipping);
  program->SetUniformi("clipCount", item.positions.clippingPlanes);
}

/// The factor of a radius of the store, or of the style.
float radiusFactorOf(const RasterItems& items, const RasterItem& item, float share)
{
  const auto value = static_cast<float>(item.style->size.value);
  switch (item.style->size.mode)
  {
    case SplatSize::Mode::Pixels:
      return 0.5f * value * share;
    case SplatSize::Mode::World:
      return 0.5f * value * items.radiusFactor() * share;
    default:
      return value * items.radiusFactor() * share;
  }
}

} // namespace

float depthScaleOf(const RasterCamera& camera)
{
  // Paraboloids push keys back by some radii: far more than that is left.
  const int exponent = std::ilogb(std::min(camera.farDepth, 1.0e30f)) + 8;
  return std::ldexp(1.0f, -std::clamp(exponent, -60, 110));
}

RadiusSource radiusSourceOf(const RasterItem& item, bool shaped, bool sized)
{
  switch (item.style->size.mode)
  {
    case SplatSize::Mode::Pixels:
      return RadiusSource::Pixels;
    case SplatSize::Mode::World:
      return RadiusSource::World;
    case SplatSize::Mode::Attribute:
      return sized ? RadiusSource::Sizes : RadiusSource::Node;
    default:
      return shaped && item.style->radiusColumn ? RadiusSource::Codes : RadiusSource::Node;
  }
}

void setSplatUniforms(
  vtkShaderProgram* program, const RasterItems& items, const RasterItem& item, bool second)
{
  setCamera(program, items.plan(), item);
  setMatrix(program, "stepsToCamera", stepsToCamera(item));
  setMatrix(program, "normalToCamera", items.normalToCamera());
  const bool fixedNormal = item.style->orientation == SplatOrientation::Fixed;
  const glm::vec3 normal =
    fixedNormal ? items.normalToCamera() * item.style->fixedNormal : glm::vec3(0.0f);
  program->SetUniform3f("fixedNormal", &normal.x);
  const SplatPass& pass = second ? item.passes.second : item.passes.first;
  const float share = second ? item.passes.secondRadius : item.passes.firstRadius;
  program->SetUniformf("radiusFactor", radiusFactorOf(items, item, share));
  program->SetUniformf("radiusBase", static_cast<float>(items.plan().splatRadiusBase));
  program->SetUniformf("squareSize", static_cast<float>(item.passes.squareSize));
  program->SetUniformf("leastRadius", pass.leastRadius);
  program->SetUniformf("mostRadius", pass.mostRadius);
  program->SetUniformf("lowPass", pass.lowPass);
  program->SetUniformf("paraboloid", pass.paraboloid);
  program->SetUniformf("slackRadii", pass.slackRadii);
  program->SetUniformf("slackPixels", pass.slackPixels);
  // In bytes: from 255 down where sums are its colour, from 127 down where they are not; how far
  // down is its highlight. 0 is nothing.
  const int mark = (item.passes.blended ? 255 : 127) - item.style->highlight;
  program->SetUniformf("seenMark", static_cast<float>(mark) / 255.0f);
  program->SetUniformf("seenLook", static_cast<float>(item.style->look));
  program->SetUniformf("rimFrom", pass.rimFrom);
  program->SetUniformf("rimRadii", pass.rimRadii);
  program->SetUniformf("mostAtCentre", pass.mostAtCentre());
  setColour(program, "rimColour", item.style->rim);
  if (item.passes.walls())
  {
    const bool own = !item.style->wall;
    setColour(program, "wallUpper", own ? Rgba8{} : (*item.style->wall)[0]);
    setColour(program, "wallLower", own ? Rgba8{} : (*item.style->wall)[1]);
    program->SetUniformi("wallColoured", own ? 0 : 1);
    program->SetUniform3f("upwards", item.camera.up);
    program->SetUniformf("heightFactor", items.upFactor());
  }
}

} // namespace pointfront
