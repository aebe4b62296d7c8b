#include "pointfront/Store/StoreWriter.h"

#include "pointfront/Codec/BlockCodec.h"
#include "pointfront/Codec/ByteStream.h"
#include "pointfront/Codec/Checksum.h"
#include "pointfront/Store/ColumnStatistics.h"
#include "pointfront/Store/StoreFormat.h"

#include <algorithm>
#include <cassert>

namespace pointfront
{
namespace
{
EncodedNode::Block checked(CodedBlock coded)
{
  EncodedNode::Block block;
  block.codec = static_cast<std::uint8_t>(coded.codec);
  block.checksum = checksumOf(coded.bytes.data(), coded.bytes.size());
  block.bytes = std::move(coded.bytes);
  return block;
}

EncodedNode::Block encodedBlock(const std::byte* values, const BlockShape& shape)
{
  return checked(encodeBlock(values, shape));
}

EncodedNode::Block constantBlock(const std::vector<std::byte>& value, const BlockShape& shape)
{
  return checked(encodeConstant(value.data(), shape));
}

GridBounds boundsOf(const NodeColumns& points)
{
  GridBounds bounds;
  if (points.size() == 0)
  {
    return bounds;
  }
  glm::u32vec3 low(UINT32_MAX);
  glm::u32vec3 high(0);
  for (const glm::u32vec3& p : points.positions)
  {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  bounds.add(points.origin + GridPosition(low));
  bounds.add(points.origin + GridPosition(high));
  return bounds;
}
} // namespace

std::size_t EncodedNode::bytes() const
{
  std::size_t sum = positions.bytes.size();
  for (const Block& column : columns)
  {
    sum += column.bytes.size();
  }
  return sum;
}

EncodedNode encodeNode(const NodeColumns& points, const AttributeSchema& schema)
{
  return encodeNode(points, schema, ColumnConstants(schema.size()));
}

EncodedNode encodeNode(
  const NodeColumns& points, const AttributeSchema& schema, const ColumnConstants& constants)
{
  assert(points.size() <= maxNodePoints);
  assert(points.selection.size() == schema.size() && points.columns.size() == schema.size());
  assert(constants.size() == schema.size());
  EncodedNode node;
  node.origin = points.origin;
  node.pointCount = static_cast<std::uint32_t>(points.size());
  node.bounds = boundsOf(points);
  const auto* positions = reinterpret_cast<const std::byte*>(points.positions.data());
  node.positions = encodedBlock(positions, positionShape(points.size()));
  for (std::size_t c = 0; c < schema.size(); ++c)
  {
    if (constants[c])
    {
      node.columns.push_back(constantBlock(*constants[c], columnShape(schema[c], points.size())));
      node.ranges.push_back(
        rangeOf(constants[c]->data(), schema[c], std::min<std::size_t>(points.size(), 1)));
      continue;
    }
    const BlockShape shape = columnShape(schema[c], points.size());
    assert(points.selection[c] == c && points.columns[c].size() == shape.bytes());
    node.columns.push_back(encodedBlock(points.columns[c].data(), shape));
    node.ranges.push_back(rangeOf(points.columns[c].data(), schema[c], points.size()));
  }
  return node;
}

} // namespace pointfront
