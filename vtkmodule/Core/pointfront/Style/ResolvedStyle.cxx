#include "pointfront/Style/ResolvedStyle.h"

#include <algorithm>

namespace pointfront
{

ColumnSelection ResolvedStyle::columns() const
{
  ColumnSelection all = colouring.columns();
  if (second.combination != ColourCombination::None)
  {
    const ColumnSelection ofSecond = second.colouring.columns();
    all.insert(all.end(), ofSecond.begin(), ofSecond.end());
  }
  const ColumnSelection filtered = filter.columns();
  all.insert(all.end(), filtered.begin(), filtered.end());
  for (const auto& column : { normalColumn, radiusColumn, heightColumn })
  {
    if (column)
    {
      all.push_back(*column);
    }
  }
  if (size.mode == SplatSize::Mode::Attribute)
  {
    all.push_back(size.column);
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

namespace
{
bool sameMap(const std::shared_ptr<const ColourMap>& a, const std::shared_ptr<const ColourMap>& b)
{
  return a == b || (a && b && *a == *b);
}
} // namespace

bool operator==(const SecondColour& a, const SecondColour& b)
{
  if (a.combination == ColourCombination::None || b.combination == ColourCombination::None)
  {
    return a.combination == b.combination;
  }
  return a.combination == b.combination && a.share256 == b.share256 && a.colouring == b.colouring &&
    sameMap(a.map, b.map) && a.flat == b.flat;
}

bool operator==(const ResolvedStyle& a, const ResolvedStyle& b)
{
  return a.technique == b.technique && a.accuracy == b.accuracy && a.blended == b.blended &&
    a.size == b.size && a.orientation == b.orientation && a.fixedNormal == b.fixedNormal &&
    a.normalColumn == b.normalColumn && a.radiusColumn == b.radiusColumn &&
    a.heightColumn == b.heightColumn && a.colouring == b.colouring && sameMap(a.map, b.map) &&
    a.flat == b.flat && a.second == b.second && a.rim == b.rim && a.wall == b.wall &&
    a.opacity == b.opacity && a.filter == b.filter && a.lens == b.lens &&
    a.lensMask == b.lensMask && a.group == b.group && a.highlight == b.highlight &&
    a.look == b.look;
}

} // namespace pointfront
