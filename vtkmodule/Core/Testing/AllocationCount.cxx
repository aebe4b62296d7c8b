#include "AllocationCount.h"

#include <atomic>
#include <cstdlib>
#include <malloc.h>
#include <new>

namespace
{

std::atomic<std::size_t> allocations{ 0 };
std::atomic<std::size_t> bytesNow{ 0 };
std::atomic<std::size_t> bytesPeak{ 0 };

void* counted(std::size_t bytes) noexcept
{
  ++allocations;
  void* const memory = std::malloc(bytes > 0 ? bytes : 1);
  if (memory != nullptr)
  {
    const std::size_t now = bytesNow += malloc_usable_size(memory);
    std::size_t peak = bytesPeak;
    while (now > peak && !bytesPeak.compare_exchange_weak(peak, now))
    {
    }
  }
  return memory;
}

void release(void* memory) noexcept
{
  if (memory != nullptr)
  {
    bytesNow -= malloc_usable_size(memory);
    std::free(memory);
  }
}

void* countedOrThrow(std::size_t bytes)
{
  if (void* const memory = counted(bytes))
  {
    return memory;
  }
  throw std::bad_alloc();
}

} // namespace

// Never inlined: a compiler that sees free() behind a delete takes it for a mistake. The one that
// does not throw is replaced too: AddressSanitizer has its own, and would pair it with our delete.
[[gnu::noinline]] void* operator new(std::size_t bytes)
{
  return countedOrThrow(bytes);
}
[[gnu::noinline]] void* operator new[](std::size_t bytes)
{
  return countedOrThrow(bytes);
}
[[gnu::noinline]] void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept
{
  return counted(bytes);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept
{
  release(memory);
}
[[gnu::noinline]] void operator delete[](void* memory) noexcept
{
  release(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept
{
  release(memory);
}
[[gnu::noinline]] void operator delete[](void* memory, std::size_t) noexcept
{
  release(memory);
}

namespace pointfront::test
{

std::size_t allocationCount()
{
  return allocations;
}

std::size_t allocatedBytes()
{
  return bytesNow;
}

std::size_t peakAllocatedBytes()
{
  return bytesPeak;
}

void resetPeakBytes()
{
  bytesPeak = bytesNow.load();
}

} // namespace pointfront::test
