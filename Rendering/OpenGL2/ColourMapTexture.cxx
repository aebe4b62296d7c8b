#include "ColourMapTexture.h"

#include <vtkOpenGLRenderWindow.h>
#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace pointfront
{
namespace
{

/// So many are left out of the integers of heights.
constexpr double mostSteps = 1 << 30;
/// A range that is narrower than floats has one height, which is 0 above its low end.
constexpr double largestScale = std::numeric_limits<float>::max();

} // namespace

ColourMapTexture::ColourMapTexture() = default;
ColourMapTexture::~ColourMapTexture() = default;

void ColourMapTexture::update(vtkOpenGLRenderWindow* window, std::shared_ptr<const ColourMap> map)
{
  if (map == map_)
  {
    return;
  }
  map_ = std::move(map);
  std::vector<Rgba8> texels{ map_->usesBelow ? map_->below : map_->entries.front() };
  texels.insert(texels.end(), map_->entries.begin(), map_->entries.end());
  texels.push_back(map_->usesAbove ? map_->above : map_->entries.back());
  texels.push_back(map_->missing);
  texture_->ReleaseGraphicsResources(window);
  texture_->SetContext(window);
  texture_->SetMinificationFilter(vtkTextureObject::Nearest);
  texture_->SetMagnificationFilter(vtkTextureObject::Nearest);
  texture_->Create2DFromRaw(
    static_cast<unsigned int>(texels.size()), 1, 4, VTK_UNSIGNED_CHAR, texels.data());
}

void ColourMapTexture::activate(
  vtkShaderProgram* program, const PointColouring& colouring, double referenceZ, double stepZ)
{
  texture_->Activate();
  const auto entries = static_cast<double>(map_->entries.size());
  const bool logarithmic = map_->logarithmic && !colouring.decades;
  const auto inFloats = [&](double end)
  { return colouring.decades ? std::log10(end) : end / colouring.unit; };
  const double low = inFloats(map_->range[0]);
  const double logLow = logarithmic ? std::log10(low) : 0.0;
  const double high = inFloats(map_->range[1]);
  const double width = logarithmic ? std::log10(high) - logLow : high - low;
  const double scale = map_->indexed ? 1.0 : (width != 0.0 ? entries / width : 0.0);
  const double base = colouring.kind == PointColouring::Kind::Elevation
    ? referenceZ
    : colouring.base / colouring.unit;
  program->SetUniformi("colourTable", texture_->GetTextureUnit());
  program->SetUniformi("tableSize", static_cast<int>(map_->entries.size()));
  program->SetUniformf("tableShift", static_cast<float>(logarithmic ? base : base - low));
  program->SetUniformf("tableScale", static_cast<float>(std::min(scale, largestScale)));
  program->SetUniformf("tableLogLow", static_cast<float>(logLow));
  program->SetUniformi("tableScaling", map_->indexed ? 2 : (logarithmic ? 1 : 0));
  const double steps = std::round((low - referenceZ) / stepZ);
  const double lowSteps = std::abs(steps) < mostSteps ? steps : 0.0;
  program->SetUniformi("tableLowSteps", static_cast<int>(lowSteps));
  program->SetUniformf("tableLowRest", static_cast<float>(lowSteps * stepZ - (low - referenceZ)));
}

void ColourMapTexture::deactivate()
{
  if (texture_->GetTextureUnit() >= 0)
  {
    texture_->Deactivate();
  }
}

void ColourMapTexture::release(vtkWindow* window)
{
  texture_->ReleaseGraphicsResources(window);
  map_.reset();
}

} // namespace pointfront
