#include "Looks.h"

#include "pointfront/Style/ColourSource.h"
#include "pointfront/Style/QualityPreset.h"
#include "pointfront/Style/TechniqueNames.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace pointfront
{

namespace
{
constexpr double sizeStep = 1.25;
constexpr double largestPx = 255.0;
constexpr double largestFactor = 64.0; // times the points' spacing; the smallest is its inverse

/// Whether any component of the column has several values.
bool varies(const StoreDescription& store, std::size_t column)
{
  const std::vector<std::array<double, 2>>& ranges = store.ranges[column].components;
  return store.rangesAreSampled ||
    std::any_of(ranges.begin(), ranges.end(), [](const auto& r) { return r[0] < r[1]; });
}

std::vector<std::string> coloursOf(const StoreDescription& store)
{
  std::vector<std::string> names;
  const auto add = [&names](const std::string& name)
  {
    if (std::find(names.begin(), names.end(), name) == names.end())
    {
      names.push_back(name);
    }
  };
  const auto varying = [&store](const char* name)
  {
    const auto column = store.schema.find(name);
    return column && varies(store, *column);
  };
  for (const char* const name : { "rgb", "classification", "intensity" })
  {
    if (varying(name))
    {
      add(name);
    }
  }
  add("elevation");
  if (store.schema.find("normal"))
  {
    add("normal");
    add("horizontality");
  }
  for (std::size_t c = 0; c < store.schema.size(); ++c)
  {
    if (store.schema[c].components == 1 && !store.isComputed(c) && varies(store, c))
    {
      add(store.schema[c].name);
    }
  }
  return names;
}

/// The entry `step` behind `now`; without an entry of that name the first.
template <typename List, typename Name>
std::size_t following(const List& list, const std::string& now, int step, const Name& nameOf)
{
  const auto found =
    std::find_if(list.begin(), list.end(), [&](const auto& entry) { return nameOf(entry) == now; });
  const auto count = static_cast<std::ptrdiff_t>(list.size());
  const std::ptrdiff_t at = found == list.end() ? -step : found - list.begin();
  return static_cast<std::size_t>(((at + step) % count + count) % count);
}
} // namespace

void Looks::choose(const std::vector<std::shared_ptr<const StoredCloud>>& stores)
{
  colours_.clear();
  for (const auto& store : stores)
  {
    for (const std::string& name : coloursOf(store->description()))
    {
      if (std::find(colours_.begin(), colours_.end(), name) == colours_.end())
      {
        colours_.push_back(name);
      }
    }
  }
  if (drawing_.colourBy.empty() && !drawing_.style.standard.colour)
  {
    drawing_.colourBy = defaultColourAttribute(stores.front()->description());
    drawing_.style.standard.colour = ColourSource::ofAttribute(drawing_.colourBy);
  }
}

std::optional<std::string> Looks::obey(KeyAction action)
{
  switch (action)
  {
    case KeyAction::NextColour:
      return changeColour(1);
    case KeyAction::LastColour:
      return changeColour(-1);
    case KeyAction::NextTechnique:
      return changeTechnique(1);
    case KeyAction::LastTechnique:
      return changeTechnique(-1);
    case KeyAction::NextQuality:
      return changeQuality();
    case KeyAction::EyeDome:
      return toggleEyeDome();
    case KeyAction::Larger:
      return resize(sizeStep);
    case KeyAction::Smaller:
      return resize(1.0 / sizeStep);
    default:
      return std::nullopt;
  }
}

std::string Looks::changeColour(int step)
{
  const auto& colour = drawing_.style.standard.colour;
  const std::string now = colour ? colour->attribute : drawing_.colourBy;
  const auto itself = [](const std::string& name) { return name; };
  drawing_.colourBy = colours_[following(colours_, now, step, itself)];
  drawing_.style.standard.colour = ColourSource::ofAttribute(drawing_.colourBy);
  return "colour by " + drawing_.colourBy;
}

std::string Looks::changeTechnique(int step)
{
  LayerStyle& style = drawing_.style.standard;
  const std::string now = traitsOf(style.technique.value_or(Technique::Points)).name;
  const std::size_t next = following(
    techniqueTraits, now, step, [](const TechniqueTraits& traits) { return traits.name; });
  style.technique = techniqueTraits[next].technique;
  return std::string("technique ") + techniqueTraits[next].name;
}

std::string Looks::changeQuality()
{
  const LayerStyle& now = drawing_.style.standard;
  const auto found = std::find_if(qualityPresets.begin(), qualityPresets.end(),
    [&](const QualityPreset& preset)
    {
      LayerStyle with = now;
      preset.applyTo(with);
      return with == now && drawing_.errorPx == preset.errorPx;
    });
  const std::size_t next = found == qualityPresets.end()
    ? 0
    : (static_cast<std::size_t>(found - qualityPresets.begin()) + 1) % qualityPresets.size();
  const QualityPreset& preset = qualityPresets[next];
  preset.applyTo(drawing_.style.standard);
  drawing_.errorPx = preset.errorPx;
  char text[80];
  std::snprintf(text, sizeof text, "quality %s: %s, error %.2g px", preset.name,
    traitsOf(preset.technique).name, preset.errorPx);
  return text;
}

std::string Looks::toggleEyeDome()
{
  float& strength = drawing_.style.shading.eyeDomeStrength;
  strength = strength > 0.0f ? 0.0f : usualEyeDomeStrength;
  return strength > 0.0f ? "eye-dome lighting" : "no eye-dome lighting";
}

std::string Looks::resize(double factor)
{
  StyleSize size = drawing_.style.standard.size.value_or(*standardStyle().size);
  const bool pixels = size.mode == SplatSize::Mode::Pixels;
  size.value = pixels ? std::clamp(size.value * factor, 1.0, largestPx)
                      : std::clamp(size.value * factor, 1.0 / largestFactor, largestFactor);
  drawing_.style.standard.size = size;
  drawing_.pointSizePx = pixels ? size.value : drawing_.pointSizePx;
  char text[80];
  std::snprintf(text, sizeof text,
    pixels ? "points of %.3g px" : "points of %.3g times the size that closes surfaces",
    size.value);
  return text;
}

void Looks::showClasses(std::vector<std::uint8_t> codes)
{
  drawing_.classes = std::move(codes);
  drawing_.style.shownClasses.reset();
  if (!drawing_.classes.empty())
  {
    drawing_.style.shownClasses = drawing_.classes;
  }
}

} // namespace pointfront
