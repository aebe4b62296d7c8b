#include "pointfront/Tiles/TileColumns.h"

#include "pointfront/Ingest/CommonRadii.h"
#include "pointfront/Points/SplatRadius.h"
#include "pointfront/Points/WidenedColour.h"
#include "pointfront/Store/ColumnStatistics.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace pointfront
{
namespace
{
constexpr const char* colourName = "rgb";

/// An end of a range: a whole number of 16 bits.
double widened(double value)
{
  return value <= largestOf8Bits ? widenedColour(static_cast<std::uint16_t>(value)) : value;
}

void widen(std::vector<std::byte>& values)
{
  for (std::size_t at = 0; at + 2 <= values.size(); at += 2)
  {
    std::uint16_t value;
    std::memcpy(&value, values.data() + at, sizeof value);
    value = widenedColour(value);
    std::memcpy(values.data() + at, &value, sizeof value);
  }
}
} // namespace

void TileColumns::recodeRadii(double ownBase, double commonBase)
{
  radii_ = recodedRadii(ownBase, commonBase);
}

ColumnSelection TileColumns::own(const ColumnSelection& columns) const
{
  ColumnSelection own;
  for (const std::uint32_t column : columns)
  {
    if (const auto there = mappings_[column].column)
    {
      own.push_back(static_cast<std::uint32_t>(*there));
    }
  }
  std::sort(own.begin(), own.end());
  return own;
}

void TileColumns::adapt(
  NodeColumns& node, const ColumnSelection& wanted, const AttributeSchema& common) const
{
  const std::size_t points = node.size();
  std::vector<std::vector<std::byte>> columns;
  for (const std::uint32_t column : wanted)
  {
    const Attribute& attribute = common[column];
    const ColumnMapping& mapping = mappings_[column];
    if (!mapping.column)
    {
      columns.emplace_back(points * attribute.bytes());
      continue;
    }
    const auto place =
      std::find(node.selection.begin(), node.selection.end(), std::uint32_t(*mapping.column));
    std::vector<std::byte>& values =
      node.columns[static_cast<std::size_t>(place - node.selection.begin())];
    if (mapping.converted)
    {
      columns.emplace_back(points * attribute.bytes());
      convertColumn(own_[*mapping.column], values.data(), attribute, columns.back().data(), points);
    }
    else
    {
      columns.push_back(std::move(values));
    }
    recode(attribute, columns.back());
  }
  node.selection = wanted;
  node.columns = std::move(columns);
}

/// Codes and depths that differ where types are the same.
void TileColumns::recode(const Attribute& common, std::vector<std::byte>& values) const
{
  if (radii_ && common.name == splatRadiusAttribute)
  {
    std::transform(values.begin(), values.end(), values.begin(),
      [this](std::byte code) { return (*radii_)[std::to_integer<std::size_t>(code)]; });
  }
  else if (colours_ && common.name == colourName)
  {
    widen(values);
  }
}

std::optional<std::uint32_t> TileColumns::ownComponent(
  std::size_t column, std::uint32_t component) const
{
  const auto there = mappings_[column].column;
  return there ? std::optional(rangeComponent(own_, static_cast<std::uint32_t>(*there), component))
               : std::nullopt;
}

ValueRange TileColumns::adapted(
  const ValueRange& range, std::size_t column, const Attribute& common) const
{
  const ColumnMapping& mapping = mappings_[column];
  if (range.empty() || !mapping.column)
  {
    return range;
  }
  if (radii_ && common.name == splatRadiusAttribute)
  {
    ValueRange codes{ 255.0, 0.0 };
    const auto last = static_cast<std::size_t>(std::clamp(range.high, 0.0, 255.0));
    for (auto code = static_cast<std::size_t>(std::clamp(range.low, 0.0, 255.0)); code <= last;
         ++code)
    {
      const auto recoded = std::to_integer<std::uint8_t>((*radii_)[code]);
      codes = { std::min(codes.low, double(recoded)), std::max(codes.high, double(recoded)) };
    }
    return codes;
  }
  if (colours_ && common.name == colourName)
  {
    return { widened(range.low), widened(range.high) };
  }
  const Attribute& from = own_[*mapping.column];
  if (!mapping.converted || (from.scale == common.scale && from.offset == common.offset))
  {
    return range;
  }
  const double a = range.low * from.scale + from.offset;
  const double b = range.high * from.scale + from.offset;
  return { std::min(a, b), std::max(a, b) };
}

ColumnRange TileColumns::range(
  const StoreDescription& own, std::size_t column, const Attribute& common) const
{
  const auto there = mappings_[column].column;
  if (!there)
  {
    const std::vector<std::byte> zero(common.bytes());
    return rangeOf(zero.data(), common, 1);
  }
  ColumnRange result = *there < own.ranges.size() ? own.ranges[*there] : emptyRange(common);
  for (std::array<double, 2>& ends : result.components)
  {
    const ValueRange all = adapted({ ends[0], ends[1] }, column, common);
    ends = { all.low, all.high };
  }
  return result;
}

} // namespace pointfront
