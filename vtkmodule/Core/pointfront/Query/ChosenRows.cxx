#include "pointfront/Query/ChosenRows.h"

#include <cstring>

namespace pointfront
{

QueryBatch chosenRows(const NodeColumns& node, const std::vector<std::uint32_t>& rows,
  const StoreDescription& description)
{
  QueryBatch batch;
  batch.node = node.node;
  batch.ids.reserve(rows.size());
  batch.points.positions.reserve(rows.size());
  for (const std::uint32_t row : rows)
  {
    batch.ids.push_back(node.firstPoint + row);
    batch.points.positions.push_back(
      description.grid.toWorld(node.origin + GridPosition(node.positions[row])));
  }
  for (std::size_t c = 0; c < node.columns.size(); ++c)
  {
    const std::size_t bytes = description.schema[node.selection[c]].bytes();
    std::vector<std::byte>& values = batch.points.columns.emplace_back(rows.size() * bytes);
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      std::memcpy(values.data() + i * bytes, node.columns[c].data() + rows[i] * bytes, bytes);
    }
  }
  return batch;
}

} // namespace pointfront
