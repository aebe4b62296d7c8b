#include "pointfront/Tiles/TileColumns.h"

#include "pointfront/Ingest/CommonRadii.h"
#include "pointfront/Points/SplatRadius.h"
#include "pointfront/Store/ColumnStatistics.h"

#include <algorithm>
#include <utility>

namespace pointfront
{

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
      continue;
    }
    if (radii_ && attribute.name == splatRadiusAttribute)
    {
      std::transform(values.begin(), values.end(), values.begin(),
        [this](std::byte code) { return (*radii_)[std::to_integer<std::size_t>(code)]; });
    }
    columns.push_back(std::move(values));
  }
  node.selection = wanted;
  node.columns = std::move(columns);
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
