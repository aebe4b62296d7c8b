#pragma once

#include "pointfront/Store/BlockCodec.h"

#include <cstddef>
#include <vector>

namespace pointfront
{

/// BlockCodec::PlanesZstd: differences to the point before, folded, cut into planes of bytes,
/// compressed with Zstandard. Slower than Packed; for columns whose values repeat.
std::vector<std::byte> encodePlanes(const std::byte* values, const BlockShape& shape);

/// As decodeBlock(): safe with any bytes.
bool decodePlanes(
  const std::byte* coded, std::size_t codedBytes, const BlockShape& shape, std::byte* values);

} // namespace pointfront
