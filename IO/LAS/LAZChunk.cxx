#include "LAZChunk.h"

#include <algorithm>
#include <vector>

namespace pointfront
{
namespace
{
constexpr std::size_t numberBytes = sizeof(std::uint32_t);

/// Bytes of a layered chunk in front of its layers: a point, the number of points, the sizes.
std::uint64_t layeredHeadBytes(const LASFile& file, const LAZCompression& compression)
{
  return file.header.pointBytes + numberBytes * (1 + compression.layers());
}

bool codeCanBegin(const std::byte* code, std::uint64_t bytes)
{
  return bytes < numberBytes || loadNumber<std::uint32_t>(code) != 0xFFFFFFFFu;
}
} // namespace

LAZChunk parseLayeredChunk(const LASFile& file, const LAZCompression& compression,
  std::uint64_t offset, std::uint64_t end)
{
  const std::uint64_t head = layeredHeadBytes(file, compression);
  if (end - offset < head)
  {
    return {};
  }
  const std::byte* number = file.bytes().data + offset + file.header.pointBytes;
  const auto points = loadNumber<std::uint32_t>(number);
  std::uint64_t bytes = head;
  for (std::size_t layer = 0; layer < compression.layers(); ++layer)
  {
    number += numberBytes;
    bytes += loadNumber<std::uint32_t>(number);
  }
  return bytes <= end - offset ? LAZChunk{ offset, bytes, points } : LAZChunk{};
}

bool codesCanBegin(const LASFile& file, const LAZCompression& compression, const LAZChunk& chunk)
{
  const std::byte* first = file.bytes().data + chunk.offset;
  if (compression.scheme != LAZCompression::Scheme::Layered)
  {
    const std::uint64_t point = std::min<std::uint64_t>(file.header.pointBytes, chunk.bytes);
    return codeCanBegin(first + point, chunk.bytes - point);
  }
  const std::byte* size = first + file.header.pointBytes + numberBytes;
  const std::byte* code = first + layeredHeadBytes(file, compression);
  for (std::size_t layer = 0; layer < compression.layers(); ++layer, size += numberBytes)
  {
    const auto bytes = loadNumber<std::uint32_t>(size);
    if (!codeCanBegin(code, bytes))
    {
      return false;
    }
    code += bytes;
  }
  return true;
}

} // namespace pointfront
