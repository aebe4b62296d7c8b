#pragma once

#include "LASPointLayout.h"

#include "pointfront/Points/PointBatch.h"
#include "pointfront/Points/QuantisationGrid.h"

#include <cstddef>

namespace pointfront
{

/// Turns `count` LAS records that lie one behind the other into points [first, first + count) of
/// `batch`, which is large enough and has the layout's columns. Positions are the records' own
/// steps if the batch has steps, otherwise world coordinates.
/// Speed    one strided pass for each column over some hundred records at a time, so that a
///          record is read from memory once and from the nearest cache after that.
/// Threads  pure.
void decodeLASPoints(const LASPointLayout& layout, const QuantisationGrid& grid,
  const std::byte* records, std::size_t count, PointBatch& batch, std::size_t first = 0);

/// The values of one column of `count` records that lie one behind the other.
void decodeLASColumn(const LASPointLayout& layout, std::size_t column, const std::byte* records,
  std::size_t count, std::byte* to);

} // namespace pointfront
