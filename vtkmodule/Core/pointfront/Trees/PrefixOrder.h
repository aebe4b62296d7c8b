#pragma once

#include "pointfront/Records/RecordLayout.h"

#include <cstdint>
#include <vector>

namespace pointfront
{

/// Orders the points of a node so that every prefix is a fair subset of it: a renderer that draws
/// the first third sees the whole node, thinner.
/// Batches    each about as large as all before it together; each in Morton order, which draws
///            two to four times faster than random order.
/// Choice     of two neighbours on the Morton curve one goes into the coarser half, picked by a
///            fixed hash of its position: stratified, but never an equidistant step, which
///            would beat with scan lines.
/// `indices` must come in Morton order; the result depends on the positions only.
/// Source     Kovac 2009, section 3.1 (random step); docs/formats/pfront.md, Blocks.
std::vector<std::uint32_t> prefixOrder(
  const RecordSpan& records, const std::vector<std::uint32_t>& indices);

/// A point of a node and a fixed, well mixed hash of it.
struct NumberedHash
{
  std::uint32_t index;
  std::uint32_t hash;
};

/// The same order of points that come in some order of their own, which every batch keeps: along
/// the Morton curve, or as a scanner wrote them.
std::vector<std::uint32_t> prefixBatches(std::vector<NumberedHash> points);

} // namespace pointfront
