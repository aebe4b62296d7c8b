#include "LargePages.h"

#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace pointfront
{

namespace
{

constexpr std::size_t largePage = std::size_t(2) << 20;

} // namespace

void* allocateInLargePages(std::size_t bytes)
{
#if defined(__linux__)
  // Only whole large pages, so that no memory is taken that nobody asked for.
  if (const std::size_t whole = bytes / largePage * largePage; whole > 0)
  {
    void* memory = nullptr;
    if (::posix_memalign(&memory, largePage, bytes) != 0)
    {
      throw std::bad_alloc();
    }
    ::madvise(memory, whole, MADV_HUGEPAGE); // a kernel without large pages takes small ones
    return memory;
  }
#endif
  if (void* const memory = std::malloc(bytes > 0 ? bytes : 1))
  {
    return memory;
  }
  throw std::bad_alloc();
}

} // namespace pointfront
