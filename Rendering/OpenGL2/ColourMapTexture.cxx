#include "ColourMapTexture.h"

#include <vtkOpenGLRenderWindow.h>
#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>

#include <cmath>
#include <utility>
#include <vector>

namespace pointfront
{
namespace
{

/// So many are left out of the integers of heights.
constexpr double mostSteps = 1 << 30;

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
  double low = map_->range[0];
  double high = map_->range[1];
  if (map_->indexed)
  {
    low -= 0.5; // a whole number lies in the middle of its entry
    high = low + entries;
  }
  const double logLow = map_->logarithmic ? std::log10(low) : 0.0;
  const double width = map_->logarithmic ? std::log10(high) - logLow : high - low;
  const double scale = width != 0.0 ? entries / width : 0.0;
  const double base =
    colouring.kind == PointColouring::Kind::Elevation ? referenceZ : colouring.base;
  program->SetUniformi("colourTable", texture_->GetTextureUnit());
  program->SetUniformi("tableSize", static_cast<int>(map_->entries.size()));
  program->SetUniformf("tableShift", static_cast<float>(map_->logarithmic ? base : base - low));
  program->SetUniformf("tableScale", static_cast<float>(scale));
  program->SetUniformf("tableLogLow", static_cast<float>(logLow));
  program->SetUniformi("tableLogarithmic", map_->logarithmic ? 1 : 0);
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
