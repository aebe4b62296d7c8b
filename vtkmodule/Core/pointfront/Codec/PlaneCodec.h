#pragma once

#include "pointfront/Codec/BlockCodec.h"

#include <cstddef>
#include <vector>

namespace pointfront
{

/// The planes alone: plane (k * scalarBytes + b) holds byte b of the folded differences of
/// component k, one byte a point. Both arrays have shape.bytes() bytes.
void splitPlanes(const std::byte* values, const BlockShape& shape, std::byte* planes);
void joinPlanes(const std::byte* planes, const BlockShape& shape, std::byte* values);

/// BlockCodec::PlanesZstd: differences to the point before, folded, cut into planes of bytes,
/// compressed with Zstandard. Slower than Packed; for columns whose values repeat.
std::vector<std::byte> encodePlanes(const std::byte* values, const BlockShape& shape);

/// As decodeBlock(): safe with any bytes.
bool decodePlanes(
  const std::byte* coded, std::size_t codedBytes, const BlockShape& shape, std::byte* values);

} // namespace pointfront
