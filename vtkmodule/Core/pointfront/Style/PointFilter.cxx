#include "pointfront/Style/PointFilter.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pointfront
{
namespace
{

template <typename T>
void applyTo(const std::byte* point, const Attribute& attribute,
  const AttributeCondition& condition, std::uint32_t count, std::uint8_t* keep)
{
  point += static_cast<std::size_t>(condition.component) * sizeof(T);
  for (std::uint32_t i = 0; i < count; ++i, point += attribute.bytes())
  {
    T stored;
    std::memcpy(&stored, point, sizeof(T));
    const double value = static_cast<double>(stored) * attribute.scale + attribute.offset;
    keep[i] = static_cast<std::uint8_t>(keep[i] & (condition.passes(value) ? 1 : 0));
  }
}

} // namespace

bool AttributeCondition::passes(double value) const
{
  if (std::isnan(value))
  {
    return false;
  }
  const bool inside = !values.empty()
    ? std::binary_search(values.begin(), values.end(), value)
    : (lowOpen ? value > range[0] : value >= range[0]) &&
      (highOpen ? value < range[1] : value <= range[1]);
  return inside != inverted;
}

bool AttributeCondition::mayPass(double low, double high) const
{
  if (!values.empty())
  {
    const auto first = std::lower_bound(values.begin(), values.end(), low);
    const bool some = first != values.end() && *first <= high;
    // Inverted, only a range of one value that is excluded can be left out.
    return inverted ? !(some && low == high) : some;
  }
  if (inverted)
  {
    const bool lowInside = lowOpen ? low > range[0] : low >= range[0];
    const bool highInside = highOpen ? high < range[1] : high <= range[1];
    return !(lowInside && highInside);
  }
  return (lowOpen ? high > range[0] : high >= range[0]) &&
    (highOpen ? low < range[1] : low <= range[1]);
}

ColumnSelection PointFilter::columns() const
{
  ColumnSelection all;
  for (const AttributeCondition& condition : conditions)
  {
    all.push_back(condition.column);
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

void PointFilter::evaluate(const NodeColumns& node, const AttributeSchema& schema,
  std::uint32_t first, std::uint32_t count, std::uint8_t* keep) const
{
  std::fill(keep, keep + count, std::uint8_t(1));
  for (const AttributeCondition& condition : conditions)
  {
    const auto place =
      std::find(node.selection.begin(), node.selection.end(), condition.column);
    const Attribute& attribute = schema[condition.column];
    const std::byte* point =
      node.columns[static_cast<std::size_t>(place - node.selection.begin())].data() +
      first * attribute.bytes();
    visitScalar(attribute.type,
      [&](auto zero)
      { applyTo<decltype(zero)>(point, attribute, condition, count, keep); });
  }
}

} // namespace pointfront
