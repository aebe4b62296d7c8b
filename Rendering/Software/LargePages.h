#pragma once

#include <cstddef>
#include <cstdlib>
#include <vector>

namespace pointfront
{

struct FreesMemory
{
  void operator()(void* memory) const { std::free(memory); }
};

/// Memory that nothing is written to yet; std::free() gives it back. Large ones lie in large pages
/// where the system has them: the first write to each of 2,000 small pages costs a new picture of
/// 1280x720 a millisecond or more.
/// @throws std::bad_alloc
void* allocateInLargePages(std::size_t bytes);

/// The same for containers.
template <typename T>
struct LargePages
{
  using value_type = T;

  LargePages() = default;
  template <typename Other>
  LargePages(const LargePages<Other>& /*other*/) noexcept
  {
  }
  T* allocate(std::size_t count)
  {
    return static_cast<T*>(allocateInLargePages(count * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t /*count*/) noexcept { std::free(memory); }
  template <typename Other>
  bool operator==(const LargePages<Other>& /*other*/) const
  {
    return true;
  }
  template <typename Other>
  bool operator!=(const LargePages<Other>& /*other*/) const
  {
    return false;
  }
};

/// Values of a picture's pixels.
template <typename T>
using PictureValues = std::vector<T, LargePages<T>>;

} // namespace pointfront
