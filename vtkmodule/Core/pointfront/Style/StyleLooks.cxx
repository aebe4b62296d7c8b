#include "pointfront/Style/StyleLooks.h"

#include "pointfront/Style/StyleSheet.h"

#include <algorithm>

namespace pointfront
{

FrameLook lookOf(const LayerStyle& style, const FrameShading& shading)
{
  FrameLook look;
  const bool asked = shading.lit || *style.technique == Technique::Spheres;
  look.lit = style.light ? style.light->on : asked;
  if (look.lit)
  {
    const StyleLight light = style.light.value_or(StyleLight());
    look.ambient = light.ambient.value_or(shading.ambient);
    look.diffuse = light.diffuse.value_or(shading.diffuse);
  }
  const bool all = shading.eyeDomeStrength > 0.0f;
  if (style.eyeDome ? style.eyeDome->on : all)
  {
    const StyleEyeDome own = style.eyeDome.value_or(StyleEyeDome());
    const float usual = all ? shading.eyeDomeStrength : usualEyeDomeStrength;
    look.eyeDomeStrength = own.strength.value_or(usual);
    look.eyeDomeRadiusPx = own.radiusPx.value_or(shading.eyeDomeRadiusPx);
  }
  return look.eyeDomeStrength > 0.0f
    ? look
    : FrameLook{ look.lit, look.ambient, look.diffuse, 0.0f, FrameLook().eyeDomeRadiusPx };
}

StyleLooks::StyleLooks(const StyleSheet& sheet)
  : shading_(sheet.shading)
{
  addAll(sheet);
  for (const StyleLens& lens : sheet.lenses)
  {
    addAll(sheet.inside(lens));
  }
}

void StyleLooks::addAll(const StyleSheet& sheet)
{
  add(sheet.standard.over(standardStyle()));
  for (const auto& [code, unused] : sheet.classes)
  {
    static_cast<void>(unused);
    add(sheet.styleOf(code));
  }
}

void StyleLooks::add(const LayerStyle& style)
{
  const FrameLook look = lookOf(style, shading_);
  const auto found = std::find(looks_.begin(), looks_.end(), look);
  numbers_.push_back(static_cast<std::uint16_t>(found - looks_.begin()));
  if (found == looks_.end())
  {
    looks_.push_back(look);
  }
}

std::uint16_t StyleLooks::numberOf(const LayerStyle& style) const
{
  const auto found = std::find(looks_.begin(), looks_.end(), lookOf(style, shading_));
  return static_cast<std::uint16_t>(found == looks_.end() ? 0 : found - looks_.begin());
}

} // namespace pointfront
