#include "pointfront/Trees/NodeEmitter.h"

#include "pointfront/Trees/PrefixOrder.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <numeric>

namespace pointfront
{
namespace
{
/// Records gathered together: all their columns while they are in the nearest cache.
constexpr std::size_t tilePoints = 256;

/// `count` points of a node, in the order in which they are stored.
struct Tile
{
  const RecordSpan& records;
  const std::uint32_t* order;
  std::size_t count;
};

/// The fixed sizes let the compiler turn the copy into one or two moves.
template <std::size_t Bytes>
void copyColumn(const Tile& tile, std::size_t offset, std::byte* out)
{
  for (std::size_t i = 0; i < tile.count; ++i, out += Bytes)
  {
    std::memcpy(out, tile.records.record(tile.order[i]) + offset, Bytes);
  }
}

void copyColumn(const Tile& tile, std::size_t offset, std::size_t bytes, std::byte* out)
{
  for (std::size_t i = 0; i < tile.count; ++i, out += bytes)
  {
    std::memcpy(out, tile.records.record(tile.order[i]) + offset, bytes);
  }
}

void copyLowBytes(const Tile& tile, std::size_t offset, std::size_t components, std::byte* out)
{
  for (std::size_t i = 0; i < tile.count; ++i)
  {
    const std::byte* values = tile.records.record(tile.order[i]) + offset;
    for (std::size_t k = 0; k < components; ++k)
    {
      *out++ = values[2 * k]; // records are of this machine: little-endian
    }
  }
}

void gatherColumn(const StoredColumn& column, const Tile& tile, std::byte* out)
{
  if (column.narrowed)
  {
    return copyLowBytes(tile, *column.offset, column.bytes, out);
  }
  switch (column.bytes)
  {
    case 1:
      return copyColumn<1>(tile, *column.offset, out);
    case 2:
      return copyColumn<2>(tile, *column.offset, out);
    case 3:
      return copyColumn<3>(tile, *column.offset, out);
    case 4:
      return copyColumn<4>(tile, *column.offset, out);
    case 6:
      return copyColumn<6>(tile, *column.offset, out);
    case 8:
      return copyColumn<8>(tile, *column.offset, out);
    default:
      return copyColumn(tile, *column.offset, column.bytes, out);
  }
}

Bounds boundsOf(const QuantisationGrid& grid, const NodeColumns& points)
{
  Bounds bounds;
  if (points.size() == 0)
  {
    return bounds;
  }
  glm::u32vec3 high(0);
  for (const glm::u32vec3& p : points.positions)
  {
    high = glm::max(high, p);
  }
  bounds.add(grid.toWorld(points.origin));
  bounds.add(grid.toWorld(points.origin + GridPosition(high)));
  return bounds;
}
} // namespace

NodeEmitter::NodeEmitter(
  TreeSpace space, const RecordColumns& columns, AttributeSchema stored, Refinement refinement)
  : space_(space)
  , schema_(std::move(stored))
  , refinement_(refinement)
{
  const RecordLayout layout(columns.schema());
  for (std::size_t c = 0; c < schema_.size(); ++c)
  {
    StoredColumn column;
    column.bytes = schema_[c].bytes();
    if (const auto& place = columns.place(c))
    {
      column.offset = layout.offset(*place);
      column.narrowed = columns.schema()[*place].type != schema_[c].type;
    }
    columns_.push_back(column);
    constants_.push_back(columns.constant(c));
  }
}

NodeColumns NodeEmitter::gather(
  const RecordSpan& records, const std::vector<std::uint32_t>& order) const
{
  NodeColumns points;
  points.positions.resize(order.size());
  points.selection.resize(columns_.size());
  std::iota(points.selection.begin(), points.selection.end(), 0u);
  points.columns.resize(columns_.size());
  for (std::size_t c = 0; c < columns_.size(); ++c)
  {
    points.columns[c].resize(columns_[c].offset ? order.size() * columns_[c].bytes : 0);
  }
  for (std::size_t begin = 0; begin < order.size(); begin += tilePoints)
  {
    const Tile tile{ records, order.data() + begin, std::min(tilePoints, order.size() - begin) };
    for (std::size_t i = 0; i < tile.count; ++i)
    {
      // The node's records lie anywhere in the part: ask early for those of the next tile.
      const std::size_t ahead = std::min(begin + tilePoints + i, order.size() - 1);
      __builtin_prefetch(records.record(order[ahead]));
      points.positions[begin + i] = records.position(tile.order[i]);
    }
    for (std::size_t c = 0; c < columns_.size(); ++c)
    {
      if (columns_[c].offset)
      {
        gatherColumn(columns_[c], tile, points.columns[c].data() + begin * columns_[c].bytes);
      }
    }
  }
  TreePosition low(order.empty() ? 0u : UINT32_MAX);
  for (const TreePosition& p : points.positions)
  {
    low = glm::min(low, p);
  }
  points.origin = order.empty() ? points.origin : space_.gridPosition(low);
  for (TreePosition& p : points.positions)
  {
    const TreePosition steps = p - low;
    p = { steps.x >> space_.shift[0], steps.y >> space_.shift[1], steps.z >> space_.shift[2] };
  }
  return points;
}

EncodedNode NodeEmitter::emit(
  BuiltNode& node, const RecordSpan& records, const std::vector<std::uint32_t>& points) const
{
  const NodeColumns columns = gather(records, prefixOrder(records, points));
  encloseNode(node.row, boundsOf(space_.grid, columns), node.children);
  node.row.pointCount = static_cast<std::uint32_t>(columns.size());
  const bool original = refinement_ == Refinement::Add || node.children.empty();
  node.row.pointsBelow = original ? columns.size() : 0;
  for (const auto& child : node.children)
  {
    node.row.pointsBelow += child->row.pointsBelow;
  }
  return encodeNode(columns, schema_, constants_);
}

} // namespace pointfront
