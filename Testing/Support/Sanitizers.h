#pragma once

// Programs of tests are compiled the same with and without AddressSanitizer, so a macro of the
// compiler does not say whether this process runs under it. Its library does: it has these.
extern "C" void __asan_init() __attribute__((weak)); // NOLINT: their names
extern "C" void __tsan_init() __attribute__((weak)); // NOLINT

namespace pointfront::test
{

/// Whether this process runs under AddressSanitizer or ThreadSanitizer.
inline bool underSanitizer()
{
  return __asan_init != nullptr || __tsan_init != nullptr;
}

/// Whether it runs under ThreadSanitizer, which needs the same threads once and is the slowest.
inline bool underThreadSanitizer()
{
  return __tsan_init != nullptr;
}

} // namespace pointfront::test
