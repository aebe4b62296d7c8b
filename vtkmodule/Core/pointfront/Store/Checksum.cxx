#include "pointfront/Store/Checksum.h"

// Header only: the store needs no library at run time for it.
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace pointfront
{

std::uint32_t checksumOf(const std::byte* data, std::size_t size)
{
  return static_cast<std::uint32_t>(XXH3_64bits(data, size) & 0xffffffffu);
}

} // namespace pointfront
