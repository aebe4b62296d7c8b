#include "pointfront/Codec/Checksum.h"

// Header only: the store needs no library at run time for it.
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace pointfront
{

std::uint32_t checksumOf(const std::byte* data, std::size_t size)
{
  return static_cast<std::uint32_t>(XXH3_64bits(data, size) & 0xffffffffu);
}

std::uint64_t contentHash(const std::byte* data, std::size_t size, std::uint64_t seed)
{
  return XXH3_64bits_withSeed(data, size, seed);
}

bool matchesChecksum(const std::byte* data, std::size_t size, std::uint32_t checksum)
{
#if defined(FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION)
  static_cast<void>(data);
  static_cast<void>(size);
  static_cast<void>(checksum);
  return true;
#else
  return checksumOf(data, size) == checksum;
#endif
}

} // namespace pointfront
