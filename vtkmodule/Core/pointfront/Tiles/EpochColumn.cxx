#include "pointfront/Tiles/EpochColumn.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <string>
#include <utility>

namespace pointfront
{

std::optional<EpochColumn> EpochColumn::of(
  std::shared_ptr<const CollectionTable> table, const CollectionRecord& record)
{
  const std::vector<std::string> names = record.epochs();
  if (names.empty() || names.back().empty())
  {
    return std::nullopt;
  }
  EpochColumn column;
  column.epochs_ = timesOf(names);
  std::map<std::string, double> times;
  for (const EpochTime& epoch : column.epochs_)
  {
    times.emplace(epoch.name, epoch.time);
  }
  for (const CollectedTile& tile : record.tiles)
  {
    column.ofTiles_.push_back(times.at(tile.is.epoch));
  }
  column.ofHeads_.resize(table->headCount());
  for (NodeIndex i = table->headCount(); i-- > 0;) // children stand behind their parents
  {
    if (const std::optional<CollectionTable::TileNode> at = table->tileNodeOf(i))
    {
      column.ofHeads_[i] = column.ofTiles_[at->tile];
      continue;
    }
    const Node group = table->node(i);
    const auto first = column.ofHeads_.begin() + group.firstChild;
    if (std::any_of(first, first + group.childCount, [&](double other) { return other != *first; }))
    {
      return std::nullopt;
    }
    column.ofHeads_[i] = *first;
  }
  column.table_ = std::move(table);
  return column;
}

void EpochColumn::describe(StoreDescription& cloud)
{
  Attribute attribute;
  attribute.name = cloud.schema.find("epoch") ? "epoch_of_tile" : "epoch";
  attribute.type = ScalarType::Float64;
  attribute.description = "epoch of the point's tile: its year, or its number";
  column_ = static_cast<std::uint32_t>(cloud.schema.size());
  if (!cloud.schema.add(std::move(attribute)))
  {
    return; // the tiles have both names
  }
  const double last = epochs_.back().time;
  cloud.ranges.push_back({ { { epochs_.front().time, last } } });
  cloud.computed.push_back(column_);
  cloud.epochColumn = column_;
  for (const std::string& name : cloud.epochs)
  {
    cloud.epochTimes.push_back(std::find_if(epochs_.begin(), epochs_.end(),
      [&name](const EpochTime& epoch) {
        return epoch.name == name;
      })->time);
  }
}

void EpochColumn::fill(NodeColumns& node) const
{
  const std::vector<double> times(node.size(), timeOf(node.node));
  std::vector<std::byte> values(times.size() * sizeof(double));
  if (!times.empty())
  {
    std::memcpy(values.data(), times.data(), values.size());
  }
  node.selection.push_back(column_);
  node.columns.push_back(std::move(values));
}

double EpochColumn::timeOf(NodeIndex node) const
{
  return node < ofHeads_.size() ? ofHeads_[node] : ofTiles_[table_->tileOf(node)];
}

} // namespace pointfront
