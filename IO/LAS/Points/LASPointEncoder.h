#pragma once

#include "LASExport.h"

#include "pointfront/Base/Result.h"
#include "pointfront/Points/PointBatch.h"

#include <cstddef>
#include <string>
#include <vector>

namespace pointfront
{

/// Turns points [first, first + count) of `batch` into LAS records, one behind the other, and
/// counts them in `totals`: the inverse of decodeLASPoints.
/// Errors   BadArgument with `path` and the point's number in the file: a coordinate beyond 32 bits
///          or not finite, a value or an angle that the field has not enough bits for, unless the
///          plan knows what comes instead.
/// Rounding angles go to the nearest degree, in formats 6 to 10 to the nearest 0.006 degrees.
Result<void> encodeLASPoints(const LASExport& plan, const std::string& path,
  const PointBatch& batch, std::size_t first, std::size_t count, std::vector<std::byte>& records,
  LASTotals& totals);

} // namespace pointfront
