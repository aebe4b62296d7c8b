#include "ChosenStyle.h"

#include "pointfront/Style/ClassHeights.h"

namespace pointfront
{

namespace
{
ColourRequest requestOf(const ColourChoice& colour)
{
  ColourRequest request;
  request.name = colour.attribute;
  request.component = 0;
  if (!colour.direct)
  {
    request.mode = colour.vector ? ColourRequest::Mode::Direct : ColourRequest::Mode::Table;
    request.colourRange = colour.range;
  }
  return request;
}

std::shared_ptr<const ColourMap> mapOf(const ColourChoice& colour)
{
  auto map = std::make_shared<ColourMap>();
  map->range = colour.range;
  for (const auto& entry : colour.table)
  {
    map->entries.push_back({ entry[0], entry[1], entry[2], 255 });
  }
  return map;
}
} // namespace

std::shared_ptr<const ResolvedStyle> chosenStyle(
  const ColourChoice& colour, const std::shared_ptr<const StoredCloud>& store)
{
  const StoreDescription& description = store->description();
  const ColourRequest request = requestOf(colour);
  const auto heights = PointColouring::wantsHeights(description, request)
    ? std::make_shared<const ClassHeights>(store)
    : nullptr;
  auto style = std::make_shared<ResolvedStyle>();
  style->colouring =
    PointColouring::choose(description, request, heights).value_or(PointColouring{});
  if (style->colouring.usesTable())
  {
    style->map = mapOf(colour);
  }
  return style;
}

} // namespace pointfront
