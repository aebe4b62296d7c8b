#include "LAZChunk.h"

#include <algorithm>

namespace pointfront
{
namespace
{
constexpr std::size_t numberBytes = sizeof(std::uint32_t);

/// Bytes of a layered chunk in front of its layers: a point, the number of points, the sizes.
std::size_t layeredHeadBytes(std::size_t pointBytes, const LAZCompression& compression)
{
  return pointBytes + numberBytes * (1 + compression.layers());
}

bool codeCanBegin(const std::byte* code, std::uint64_t bytes)
{
  return bytes < numberBytes || loadNumber<std::uint32_t>(code) != 0xFFFFFFFFu;
}
} // namespace

LAZChunk parseLayeredChunk(
  ByteSpan bytes, std::size_t pointBytes, const LAZCompression& compression)
{
  const std::size_t head = layeredHeadBytes(pointBytes, compression);
  if (bytes.size < head)
  {
    return {};
  }
  const std::byte* number = bytes.data + pointBytes;
  const auto points = loadNumber<std::uint32_t>(number);
  std::uint64_t needed = head;
  for (std::size_t layer = 0; layer < compression.layers(); ++layer)
  {
    number += numberBytes;
    needed += loadNumber<std::uint32_t>(number);
  }
  return needed <= bytes.size ? LAZChunk{ 0, needed, points } : LAZChunk{};
}

LAZChunk parseLayeredChunk(
  const LASFile& file, const LAZCompression& compression, std::uint64_t offset, std::uint64_t end)
{
  LAZChunk chunk =
    parseLayeredChunk({ file.bytes().data + offset, static_cast<std::size_t>(end - offset) },
      file.header.pointBytes, compression);
  chunk.offset = chunk.bytes > 0 ? offset : 0;
  return chunk;
}

bool codesCanBegin(ByteSpan bytes, std::size_t pointBytes, const LAZCompression& compression)
{
  const std::byte* size = bytes.data + pointBytes + numberBytes;
  const std::byte* code = bytes.data + layeredHeadBytes(pointBytes, compression);
  for (std::size_t layer = 0; layer < compression.layers(); ++layer, size += numberBytes)
  {
    const auto codeBytes = loadNumber<std::uint32_t>(size);
    if (!codeCanBegin(code, codeBytes))
    {
      return false;
    }
    code += codeBytes;
  }
  return true;
}

bool codesCanBegin(const LASFile& file, const LAZCompression& compression, const LAZChunk& chunk)
{
  const ByteSpan bytes{ file.bytes().data + chunk.offset, static_cast<std::size_t>(chunk.bytes) };
  if (compression.scheme == LAZCompression::Scheme::Layered)
  {
    return codesCanBegin(bytes, file.header.pointBytes, compression);
  }
  const std::size_t point = std::min<std::size_t>(file.header.pointBytes, bytes.size);
  return codeCanBegin(bytes.data + point, bytes.size - point);
}

} // namespace pointfront
