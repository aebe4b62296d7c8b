#pragma once

#include "pointfront/Records/RecordLayout.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// A cube of 2^log2Side steps a side, aligned to multiples of its side from the tree's origin.
struct OctreeCell
{
  TreePosition origin{ 0 };
  unsigned log2Side = 0; ///< 0 to 32
};

/// Number of the lowest bits in which two positions differ: they lie in one cell of 2^n steps if
/// and only if n >= differingBits(a, b). 0 when equal.
inline unsigned differingBits(const TreePosition& a, const TreePosition& b)
{
  const std::uint32_t d = (a.x ^ b.x) | (a.y ^ b.y) | (a.z ^ b.z);
  return d == 0 ? 0u : 32u - static_cast<unsigned>(__builtin_clz(d));
}

/// The smallest cell that holds both.
OctreeCell commonCell(const TreePosition& a, const TreePosition& b);

/// Octant of a position in a cell of that size (1 or more): x is bit 0, y bit 1, z bit 2.
inline unsigned octantOf(const TreePosition& p, unsigned log2Side)
{
  const unsigned bit = log2Side - 1;
  return ((p.x >> bit) & 1u) | (((p.y >> bit) & 1u) << 1) | (((p.z >> bit) & 1u) << 2);
}

/// Order along the Morton (Z) curve, z the most significant axis, without making a key: the axis
/// whose highest differing bit is highest decides.
bool mortonLess(const TreePosition& a, const TreePosition& b);

/// The order of `count` records along the Morton curve; equal positions keep their order, so the
/// result depends on the input order of duplicates only.
/// Cost     about a third of the key's bits are sorted by digits, the rest only where they decide.
/// Memory   16 bytes a record while it runs, 4 bytes a record of result.
std::vector<std::uint32_t> mortonOrder(const RecordSpan& records, std::size_t count);

/// mortonOrder() needs that much memory for one record beside the records themselves.
constexpr std::size_t mortonOrderBytes = 20;

} // namespace pointfront
