#include "pointfront/Build/NodeEmitter.h"

#include "pointfront/Build/PrefixOrder.h"

#include <cassert>
#include <cstring>
#include <numeric>

namespace pointfront
{
namespace
{
/// The fixed sizes let the compiler turn the copy into one or two moves.
template <std::size_t Bytes>
void copyColumn(const RecordView& records, std::size_t offset,
  const std::vector<std::uint32_t>& order, std::byte* out)
{
  for (const std::uint32_t i : order)
  {
    std::memcpy(out, records.record(i) + offset, Bytes);
    out += Bytes;
  }
}

void copyColumn(const RecordView& records, std::size_t offset, std::size_t bytes,
  const std::vector<std::uint32_t>& order, std::byte* out)
{
  for (const std::uint32_t i : order)
  {
    std::memcpy(out, records.record(i) + offset, bytes);
    out += bytes;
  }
}

void copyLowBytes(const RecordView& records, std::size_t offset, std::size_t components,
  const std::vector<std::uint32_t>& order, std::byte* out)
{
  for (const std::uint32_t i : order)
  {
    for (std::size_t k = 0; k < components; ++k)
    {
      std::uint16_t value;
      std::memcpy(&value, records.record(i) + offset + 2 * k, sizeof(value));
      *out++ = static_cast<std::byte>(value);
    }
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

NodeEmitter::NodeEmitter(TreeSpace space, const AttributeSchema& pooled, AttributeSchema stored)
    : space_(std::move(space)), schema_(std::move(stored))
{
  assert(pooled.size() == schema_.size());
  const RecordLayout layout(pooled);
  for (std::size_t c = 0; c < schema_.size(); ++c)
  {
    columns_.push_back({layout.offset(c), schema_[c].bytes(), pooled[c].type != schema_[c].type});
  }
}

void NodeEmitter::gatherColumn(const StoredColumn& column, const RecordView& records,
  const std::vector<std::uint32_t>& order, std::vector<std::byte>& out) const
{
  out.resize(order.size() * column.bytes);
  if (column.narrowed)
  {
    copyLowBytes(records, column.offset, column.bytes, order, out.data());
    return;
  }
  switch (column.bytes)
  {
  case 1:
    copyColumn<1>(records, column.offset, order, out.data());
    break;
  case 2:
    copyColumn<2>(records, column.offset, order, out.data());
    break;
  case 4:
    copyColumn<4>(records, column.offset, order, out.data());
    break;
  case 6:
    copyColumn<6>(records, column.offset, order, out.data());
    break;
  case 8:
    copyColumn<8>(records, column.offset, order, out.data());
    break;
  default:
    copyColumn(records, column.offset, column.bytes, order, out.data());
  }
}

NodeColumns NodeEmitter::gather(
  const RecordView& records, const std::vector<std::uint32_t>& order) const
{
  NodeColumns points;
  points.positions.reserve(order.size());
  TreePosition low(UINT32_MAX);
  for (const std::uint32_t i : order)
  {
    low = glm::min(low, records.position(i));
  }
  if (!order.empty())
  {
    points.origin = space_.gridPosition(low);
  }
  for (const std::uint32_t i : order)
  {
    const TreePosition steps = records.position(i) - low;
    points.positions.emplace_back(
      steps.x >> space_.shift[0], steps.y >> space_.shift[1], steps.z >> space_.shift[2]);
  }
  points.selection.resize(columns_.size());
  std::iota(points.selection.begin(), points.selection.end(), 0u);
  points.columns.resize(columns_.size());
  for (std::size_t c = 0; c < columns_.size(); ++c)
  {
    gatherColumn(columns_[c], records, order, points.columns[c]);
  }
  return points;
}

EncodedNode NodeEmitter::emit(
  BuiltNode& node, const RecordView& records, const std::vector<std::uint32_t>& points) const
{
  const NodeColumns columns = gather(records, prefixOrder(records, points));
  encloseNode(node.row, boundsOf(space_.grid, columns), node.children);
  node.row.pointCount = static_cast<std::uint32_t>(columns.size());
  node.row.pointsBelow = columns.size();
  for (const auto& child : node.children)
  {
    node.row.pointsBelow += child->row.pointsBelow;
  }
  return encodeNode(columns, schema_);
}

} // namespace pointfront
