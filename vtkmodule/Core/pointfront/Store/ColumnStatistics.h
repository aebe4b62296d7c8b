#pragma once

#include "pointfront/Codec/BlockCodec.h"
#include "pointfront/Points/AttributeSchema.h"
#include "pointfront/Store/StoredCloud.h"

#include <cstddef>

namespace pointfront
{

/// Three 32-bit integers a point.
BlockShape positionShape(std::size_t points);
BlockShape columnShape(const Attribute& attribute, std::size_t points);

/// Memory for the points of a node: of exactly decodedBytesOf() bytes.
NodeColumns emptyColumns(NodeIndex node, std::size_t points, const ColumnSelection& columns,
  const AttributeSchema& schema);
std::size_t decodedBytesOf(
  std::size_t points, const ColumnSelection& columns, const AttributeSchema& schema);

/// The range of no values: low is +infinity, high -infinity.
ColumnRange emptyRange(const Attribute& attribute);
/// Smallest and largest value of each component of `points` values; NaN is left out.
ColumnRange rangeOf(const std::byte* values, const Attribute& attribute, std::size_t points);
void addRange(ColumnRange& range, const ColumnRange& other);
/// A range that no value of a column lies beyond: its range in the store; where that is of some
/// points only, the range of its type.
ColumnRange certainRange(const StoreDescription& store, std::size_t column);
/// True when `inner` adds nothing to `outer`.
bool encloses(const ColumnRange& outer, const ColumnRange& inner);

} // namespace pointfront
