#pragma once

#include "pointfront/Codec/ByteStream.h"
#include "pointfront/Codec/Checksum.h"

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointfront
{

// The header of each of our files: its fields, zeros, and in its last four bytes the checksum of
// all that is before.

/// `fields` as a header of `size` bytes.
inline std::vector<std::byte> sealedHeader(ByteWriter fields, std::size_t size)
{
  assert(fields.size() + sizeof(std::uint32_t) <= size);
  while (fields.size() + sizeof(std::uint32_t) < size)
  {
    fields.put(std::uint8_t(0));
  }
  fields.put(checksumOf(fields.bytes().data(), fields.size()));
  return fields.bytes();
}

/// True if its checksum is that of its bytes.
inline bool headerIsSound(const std::byte* header, std::size_t size)
{
  const std::size_t end = size - sizeof(std::uint32_t);
  ByteReader checksum(header + end, sizeof(std::uint32_t));
  return matchesChecksum(header, end, checksum.get<std::uint32_t>());
}

} // namespace pointfront
