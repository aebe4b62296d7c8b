#include "LayerStyleJSON.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <set>

namespace pointfront
{
namespace
{

constexpr double mostPixels = 1e6;

glm::vec2 pixelsAt(const JSONPlace& place, double least)
{
  if (!place.isArray() || place.value().size() != 2)
  {
    place.refuse("expected two numbers of pixels, not " + place.shown());
  }
  return { place.at(std::size_t(0)).number(least, mostPixels),
    place.at(std::size_t(1)).number(least, mostPixels) };
}

/// Rows of text, the upper one first: a lens covers where a character is neither '.' nor a blank.
std::shared_ptr<const LensMask> maskAt(const JSONPlace& place)
{
  if (!place.isArray() || place.value().empty())
  {
    place.refuse("expected rows of text, not " + place.shown());
  }
  auto mask = std::make_shared<LensMask>();
  mask->height = static_cast<int>(place.value().size());
  for (int row = mask->height - 1; row >= 0; --row)
  {
    const JSONPlace line = place.at(static_cast<std::size_t>(row));
    const std::string text = line.text("a row of the mask");
    mask->width = row == mask->height - 1 ? static_cast<int>(text.size()) : mask->width;
    if (text.empty() || static_cast<int>(text.size()) != mask->width)
    {
      line.refuse("rows of a mask are of one length, which is not 0");
    }
    std::transform(text.begin(), text.end(), std::back_inserter(mask->values),
      [](char c) { return std::uint8_t(c == '.' || c == ' ' ? 0 : 1); });
  }
  return mask;
}

FrameLens lensPlaceAt(const JSONPlace& place)
{
  FrameLens lens;
  if (place.has("around_class"))
  {
    place.expectKeys({ "around_class", "radius", "inside" });
    lens.shape = LensShape::AroundClass;
    return lens;
  }
  if (!place.has("shape"))
  {
    place.refuse("a lens has a shape, or around_class");
  }
  lens.shape = oneOf<LensShape>(place.at("shape"),
    { { "circle", LensShape::Circle }, { "rectangle", LensShape::Rectangle },
      { "mask", LensShape::Mask } });
  if (lens.shape == LensShape::Mask)
  {
    place.expectKeys({ "shape", "mask", "inside" });
    lens.mask = maskAt(place.required("mask"));
    return lens;
  }
  const bool circle = lens.shape == LensShape::Circle;
  place.expectKeys({ "shape", "center_px", circle ? "radius_px" : "size_px", "inside" });
  lens.centrePx = pixelsAt(place.required("center_px"), -mostPixels);
  lens.halfSizePx = circle
    ? glm::vec2(static_cast<float>(place.required("radius_px").number(0.0, mostPixels)))
    : 0.5f * pixelsAt(place.required("size_px"), 0.0);
  return lens;
}

} // namespace

std::vector<StyleLens> lensesAt(const JSONPlace& place)
{
  if (!place.isArray())
  {
    place.refuse("expected a list of lenses, not " + place.shown());
  }
  std::vector<StyleLens> lenses;
  for (std::size_t i = 0; i < place.value().size(); ++i)
  {
    const JSONPlace one = place.at(i);
    StyleLens lens;
    lens.place = lensPlaceAt(one);
    if (lens.place.shape == LensShape::AroundClass)
    {
      const JSONPlace code = one.at("around_class");
      lens.aroundClass = classCode(code, code.shown());
      lens.aroundRadius = one.required("radius").positive();
    }
    const JSONPlace inside = one.required("inside");
    if (!inside.isObject())
    {
      inside.refuse(
        "expected an object with default and class codes as keys, not " + inside.shown());
    }
    for (const auto& [key, unused] : inside.value().items())
    {
      static_cast<void>(unused);
      const JSONPlace style = inside.at(key);
      LayerStyle& target = key == "default" ? lens.standard : lens.classes[classCode(style, key)];
      target = layerStyleAt(style);
    }
    lenses.push_back(std::move(lens));
  }
  return lenses;
}

std::vector<StyleHighlight> highlightsAt(const JSONPlace& place)
{
  if (!place.isArray())
  {
    place.refuse("expected a list of highlights, not " + place.shown());
  }
  std::vector<StyleHighlight> highlights;
  std::set<std::uint8_t> codes;
  for (std::size_t i = 0; i < place.value().size(); ++i)
  {
    const JSONPlace one = place.at(i);
    one.expectKeys({ "class", "color", "halo_px", "tint" });
    StyleHighlight highlight;
    const JSONPlace code = one.required("class");
    highlight.objectClass = classCode(code, code.shown());
    if (!codes.insert(highlight.objectClass).second)
    {
      code.refuse("a class has one highlight");
    }
    highlight.colour = one.has("color") ? colourCodeAt(one.at("color")) : highlight.colour;
    highlight.haloPx = one.has("halo_px")
      ? static_cast<float>(one.at("halo_px").number(0.0, mostHaloPx))
      : highlight.haloPx;
    highlight.tint =
      one.has("tint") ? static_cast<float>(one.at("tint").number(0.0, 1.0)) : highlight.tint;
    highlights.push_back(highlight);
  }
  if (highlights.size() > mostHighlights)
  {
    place.refuse("at most " + std::to_string(mostHighlights) + " classes are highlighted at once");
  }
  return highlights;
}

} // namespace pointfront
