#include "MapperSheet.h"

#include "ColourChoice.h"

#include "pointfront/Style/AttributeRanges.h"

namespace pointfront
{

namespace
{

/// The same colour means the same value in all stores: ranges that the sheet leaves open are taken
/// over all of them, as the software back end does.
void setRanges(ColourSource& source, const AttributeRanges& ranges)
{
  using Kind = ColourMapChoice::Kind;
  const bool mapped = source.map.kind != Kind::Classification && source.map.kind != Kind::Direct;
  if (source.kind == ColourSource::Kind::Attribute && mapped && !source.map.range &&
    source.attribute != "classification" && ranges.has(source.attribute))
  {
    if (const Result<std::array<double, 2>> range = ranges.of(source.attribute); range)
    {
      source.map.range = *range;
    }
  }
  for (ColourSource& part : source.parts)
  {
    setRanges(part, ranges);
  }
}

} // namespace

bool isPlain(const DrawingOptions& options)
{
  StyleSheet rest = options.style;
  LayerStyle& style = rest.standard;
  const StyleSize pixels{ SplatSize::Mode::Pixels, options.pointSizePx, "" };
  if (style.technique == Technique::Points)
  {
    style.technique.reset();
  }
  if (style.colour == ColourSource::ofAttribute(options.colourBy))
  {
    style.colour.reset();
  }
  if (style.size == pixels)
  {
    style.size.reset();
  }
  if (rest.shownClasses == options.classes)
  {
    rest.shownClasses.reset();
  }
  return options.pointSizePx > 0.0 && rest == StyleSheet();
}

std::shared_ptr<const StyleSheet> sheetOf(
  const DrawingOptions& options, const std::vector<std::shared_ptr<const StoredCloud>>& stores)
{
  auto sheet = std::make_shared<StyleSheet>(options.style);
  if (!sheet->standard.colour)
  {
    sheet->standard.colour =
      ColourSource::ofAttribute(defaultColourAttribute(stores.front()->description()));
  }
  if (stores.size() > 1)
  {
    const AttributeRanges ranges(stores);
    setRanges(*sheet->standard.colour, ranges);
    for (auto& [code, style] : sheet->classes)
    {
      if (style.colour)
      {
        setRanges(*style.colour, ranges);
      }
    }
  }
  return sheet;
}

} // namespace pointfront
