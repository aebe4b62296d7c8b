#include "pointfront/Query/ChosenColumns.h"

#include "pointfront/Base/NearestName.h"
#include "pointfront/Points/AttributeNames.h"
#include "pointfront/Points/EnclosingRadius.h"

#include <algorithm>
#include <utility>

namespace pointfront
{
namespace
{

ChosenColumns described(const StoreDescription& store, ColumnSelection columns)
{
  ChosenColumns chosen{ std::move(columns), store };
  chosen.description.schema = {};
  chosen.description.computed.clear(); // they are computed for these points
  chosen.description.ranges.clear();
  for (const std::uint32_t column : chosen.columns)
  {
    chosen.description.schema.add(store.schema[column]);
    if (column < store.ranges.size())
    {
      chosen.description.ranges.push_back(store.ranges[column]);
    }
  }
  return chosen;
}

/// All that the cloud holds.
ColumnSelection allColumns(const StoreDescription& store)
{
  ColumnSelection columns;
  for (std::uint32_t c = 0; c < store.schema.size(); ++c)
  {
    if (!store.isComputed(c))
    {
      columns.push_back(c);
    }
  }
  return columns;
}

} // namespace

Result<ChosenColumns> ChosenColumns::make(
  const StoreDescription& store, const std::optional<std::vector<std::string>>& names)
{
  if (!names)
  {
    return described(store, allColumns(store));
  }
  ColumnSelection columns;
  for (const std::string& name : *names)
  {
    const std::optional<std::size_t> column = store.schema.find(name);
    if (!column)
    {
      return makeError(Error::Kind::BadArgument,
        store.path + ": no attribute is called '" + name + "' (info lists them)" +
          didYouMean(name, attributeNames(store.schema)));
    }
    columns.push_back(static_cast<std::uint32_t>(*column));
  }
  std::sort(columns.begin(), columns.end());
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
  return described(store, std::move(columns));
}

ChosenColumns ChosenColumns::ofInput(const StoreDescription& store)
{
  ColumnSelection columns = allColumns(store);
  if (store.refinement == Refinement::Replace)
  {
    columns.erase(
      std::remove_if(columns.begin(), columns.end(),
        [&store](std::uint32_t c) { return store.schema[c].name == enclosingRadiusName; }),
      columns.end());
  }
  return described(store, std::move(columns));
}

} // namespace pointfront
