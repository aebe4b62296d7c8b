#include "pointfront/Style/ResolvedStyle.h"

#include <algorithm>

namespace pointfront
{

ColumnSelection ResolvedStyle::columns() const
{
  ColumnSelection all = colouring.columns();
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

bool operator==(const ResolvedStyle& a, const ResolvedStyle& b)
{
  const bool sameMap = a.map == b.map || (a.map && b.map && *a.map == *b.map);
  return a.technique == b.technique && a.accuracy == b.accuracy && a.blended == b.blended &&
    a.size == b.size && a.orientation == b.orientation && a.fixedNormal == b.fixedNormal &&
    a.normalColumn == b.normalColumn && a.radiusColumn == b.radiusColumn &&
    a.heightColumn == b.heightColumn && a.colouring == b.colouring && sameMap &&
    a.flat == b.flat && a.rim == b.rim && a.opacity == b.opacity && a.filter == b.filter;
}

} // namespace pointfront
