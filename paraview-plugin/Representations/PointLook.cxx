#include "PointLook.h"

#include "pointfront/Quality/QualityChoice.h"
#include "pointfront/Style/StyleSheet.h"
#include "pointfront/Style/TechniqueNames.h"

#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkScalarsToColors.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pointfront
{
namespace
{

/// Entries of a style sheet's colour map.
constexpr int entries = 256;

Rgba8 rgba(const std::array<double, 3>& colour)
{
  Rgba8 bytes{ 0, 0, 0, 255 };
  for (std::size_t c = 0; c < 3; ++c)
  {
    bytes[c] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(colour[c], 0.0, 1.0)));
  }
  return bytes;
}

/// A table as a map: one colour for each whole number from 0 on if it names categories, else even
/// steps over its range.
ColourMapChoice sampled(vtkScalarsToColors& table)
{
  table.Build();
  ColourMapChoice map;
  map.kind = ColourMapChoice::Kind::Colours;
  const bool categories = table.GetIndexedLookup() != 0;
  std::array<double, 2> range = { table.GetRange()[0], table.GetRange()[1] };
  map.logarithmic = !categories && table.UsingLogScale() != 0 && range[0] > 0.0;
  if (categories)
  {
    range = { -0.5, entries - 0.5 };
  }
  else if (!(range[0] < range[1]))
  {
    range[1] = range[0] + 1.0;
  }
  map.range = range;
  const double low = map.logarithmic ? std::log10(range[0]) : range[0];
  const double high = map.logarithmic ? std::log10(range[1]) : range[1];
  vtkNew<vtkDoubleArray> values;
  for (int entry = 0; entry < entries; ++entry)
  {
    const double middle = low + (entry + 0.5) * (high - low) / entries;
    values->InsertNextValue(map.logarithmic ? std::pow(10.0, middle) : middle);
  }
  const auto colours = vtkSmartPointer<vtkUnsignedCharArray>::Take(
    table.MapScalars(values, VTK_COLOR_MODE_MAP_SCALARS, 0, VTK_RGBA));
  for (vtkIdType entry = 0; entry < entries; ++entry)
  {
    const unsigned char* from = colours->GetPointer(4 * entry);
    map.colours.push_back({ from[0], from[1], from[2], 255 });
  }
  return map;
}

StyleSize sizeOf(const PointLook& look, bool closes)
{
  StyleSize size;
  size.mode = closes ? SplatSize::Mode::Spacing : SplatSize::Mode::Pixels;
  size.value = std::max(closes ? look.factor : look.pixels, 0.01);
  return size;
}

ColourSource sourceOf(const LookColour& colour)
{
  if (colour.array.empty())
  {
    return ColourSource::ofConstant(rgba(colour.flat));
  }
  ColourMapChoice map;
  std::string name = colour.array;
  const int component =
    colour.table && !colour.direct && colour.table->GetVectorMode() == vtkScalarsToColors::COMPONENT
    ? colour.table->GetVectorComponent()
    : -1;
  const bool vectors = name == "rgb" || name == "normal";
  if (colour.direct)
  {
    map.kind = ColourMapChoice::Kind::Direct;
  }
  else if (colour.table && (!vectors || component >= 0))
  {
    map = sampled(*colour.table);
    name += vectors ? "[" + std::to_string(component) + "]" : "";
  }
  return ColourSource::ofAttribute(std::move(name), std::move(map));
}

} // namespace

std::optional<NamedTechnique> namedTechnique(const std::string& name)
{
  if (name == "blended")
  {
    return NamedTechnique{ Technique::Splats, true };
  }
  const auto technique = techniqueOf(name);
  if (!technique)
  {
    return std::nullopt;
  }
  NamedTechnique named{ *technique, std::nullopt };
  if (*technique != Technique::Ewa)
  {
    named.blended = false;
  }
  return named;
}

std::string namedTechniques()
{
  return techniqueList() + ", blended";
}

Result<std::optional<QualityPreset>> PointLook::preset() const
{
  if (quality.empty())
  {
    return std::optional<QualityPreset>();
  }
  auto choice = chooseQuality(quality);
  if (!choice)
  {
    return choice.error();
  }
  return std::optional<QualityPreset>(choice->preset);
}

bool PointLook::closes() const
{
  return !quality.empty() || closing == ALWAYS ||
    (closing == BY_TECHNIQUE && technique != "points");
}

LayerStyle PointLook::sized(LayerStyle differs) const
{
  if (closing == BY_TECHNIQUE && differs.technique && !differs.size)
  {
    differs.size = sizeOf(*this, *differs.technique != Technique::Points);
  }
  return differs;
}

bool PointLook::plain() const
{
  return technique == "points" && !closes() && eyeDomeStrength == 0.0 && light != ALL &&
    !fillHoles && where.empty() && !(translucentSurface && opacity < 1.0);
}

bool applyLook(
  const PointLook& look, const LookColour& colour, StyleSheet& sheet, std::string& error)
{
  const auto named = namedTechnique(look.technique);
  if (!named)
  {
    error = "\"" + look.technique + "\" is no technique: choose " + namedTechniques();
    return false;
  }
  const auto preset = look.preset();
  if (!preset)
  {
    error = preset.error().what;
    return false;
  }
  auto where = FilterExpression::parse(look.where);
  if (!where)
  {
    error = where.error().what;
    return false;
  }
  sheet.standard.technique = named->technique;
  sheet.standard.blended = named->blended;
  if (*preset)
  {
    (*preset)->applyTo(sheet.standard);
  }
  sheet.standard.colour = sourceOf(colour);
  sheet.standard.size = sizeOf(look, look.closes());
  sheet.standard.opacity = std::clamp(look.opacity, 0.0, 1.0);
  sheet.where = std::move(*where);
  sheet.shading.lit = look.light == PointLook::ALL;
  if (look.light == PointLook::NONE)
  {
    sheet.standard.light = StyleLight{ false, {}, {} };
  }
  sheet.shading.fillHoles = look.fillHoles;
  sheet.shading.eyeDomeStrength = static_cast<float>(std::max(look.eyeDomeStrength, 0.0));
  return true;
}

} // namespace pointfront
