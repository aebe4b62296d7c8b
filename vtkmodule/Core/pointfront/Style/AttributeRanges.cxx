#include "pointfront/Style/AttributeRanges.h"

#include "pointfront/Base/Infinity.h"

#include "pointfront/Base/LetterCase.h"
#include "pointfront/Statistics/StoreSample.h"
#include "pointfront/Style/ComponentName.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace pointfront
{
namespace
{

constexpr double lowShare = 0.02;
constexpr double highShare = 0.98;

using Range = std::array<double, 2>;

Range united(const Range& a, const Range& b)
{
  return { std::min(a[0], b[0]), std::max(a[1], b[1]) };
}

Range inWorldUnits(const Attribute& attribute, const Range& stored)
{
  const double a = stored[0] * attribute.scale + attribute.offset;
  const double b = stored[1] * attribute.scale + attribute.offset;
  return { std::min(a, b), std::max(a, b) };
}

/// Empty, low > high, where the store says nothing.
Range wholeOf(const StoreDescription& store, const AttributeComponent& part)
{
  const auto component = static_cast<std::size_t>(part.component.value_or(0));
  if (part.column >= store.ranges.size() ||
    component >= store.ranges[part.column].components.size())
  {
    return { infinity, -infinity };
  }
  const Range stored = store.ranges[part.column].components[component];
  return stored[0] <= stored[1] ? inWorldUnits(store.schema[part.column], stored)
                                : Range{ infinity, -infinity };
}

bool isFinite(const Range& range)
{
  return std::isfinite(range[0]) && std::isfinite(range[1]);
}

/// Finite: over an infinite range all colours would be one.
Range usable(const Range& robust, const Range& whole)
{
  if (robust[0] < robust[1])
  {
    return robust;
  }
  if (whole[0] < whole[1] && isFinite(whole))
  {
    return whole;
  }
  const Range& one = isFinite(whole) ? whole : robust;
  const double low = isFinite(one) ? one[0] : 0.0;
  return { low, low + 1.0 };
}

} // namespace

bool AttributeRanges::has(const std::string& name) const
{
  return std::any_of(stores_.begin(), stores_.end(),
    [&](const std::shared_ptr<const StoredCloud>& store)
    { return findComponent(store->description().schema, name).has_value(); });
}

std::array<double, 2> AttributeRanges::whole(const StoreDescription& store, const std::string& name)
{
  const std::optional<AttributeComponent> part = findComponent(store.schema, name);
  const Range range =
    part ? wholeOf(store, *part) : Range{ store.bounds.low.z, store.bounds.high.z };
  return usable({ infinity, -infinity }, range);
}

Result<std::array<double, 2>> AttributeRanges::of(const std::string& name) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (const auto known = known_.find(name); known != known_.end())
  {
    return known->second;
  }
  const bool elevation = !has(name) && sameWithoutCase(name, "elevation");
  Range robust{ infinity, -infinity };
  Range whole = robust;
  for (const std::shared_ptr<const StoredCloud>& store : stores_)
  {
    const StoreDescription& description = store->description();
    const auto part = findComponent(description.schema, name);
    if (!part && !elevation)
    {
      continue;
    }
    const Result<StoreSample> sample =
      StoreSample::read(*store->hierarchy(), *store, description.grid, description.schema,
        part ? ColumnSelection{ part->column } : ColumnSelection{});
    if (!sample)
    {
      return sample.error();
    }
    if (!part)
    {
      whole = united(whole, { description.bounds.low.z, description.bounds.high.z });
      robust = united(
        robust, { sample->elevationQuantile(lowShare), sample->elevationQuantile(highShare) });
      continue;
    }
    const auto component = static_cast<std::size_t>(part->component.value_or(0));
    whole = united(whole, wholeOf(description, *part));
    robust = united(robust,
      inWorldUnits(description.schema[part->column],
        { sample->columnQuantile(0, component, lowShare),
          sample->columnQuantile(0, component, highShare) }));
  }
  if (stores_.empty() || (!elevation && !has(name)))
  {
    return makeError(
      Error::Kind::BadArgument, "no store here has the attribute '" + name + "' (info lists them)");
  }
  return known_[name] = usable(robust, whole);
}

} // namespace pointfront
