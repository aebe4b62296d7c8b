#pragma once

#include "pointfront/Base/Result.h"

#include <cstddef>
#include <string>

namespace pointfront
{

/// A whole file, mapped read-only into memory; unmapped when destroyed.
/// Threads   reading data() is safe from any thread.
/// Limits    the file must not be shortened by others while it is mapped: touching a page that is
///           gone raises SIGBUS, as for every reader that maps.
class MemoryMap
{
public:
  /// The order in which the bytes will be touched: it lets the system read ahead, or not.
  enum class Access
  {
    Sequential,
    Random
  };

  /// Errors NotFound; Unreadable (a folder, permission). An empty file gives an empty map.
  static Result<MemoryMap> open(const std::string& path, Access access = Access::Sequential);

  MemoryMap(MemoryMap&& other) noexcept;
  MemoryMap& operator=(MemoryMap&& other) noexcept;
  MemoryMap(const MemoryMap&) = delete;
  MemoryMap& operator=(const MemoryMap&) = delete;
  ~MemoryMap();

  const std::byte* data() const { return data_; }
  std::size_t size() const { return size_; }

  /// Gives the pages of these bytes, and 2 MiB on both sides, back to the system: they no longer
  /// count as memory of this process, so reading a file of any size stays inside a memory limit.
  /// The pages stay valid: a later access gets them from the disk cache, together with their
  /// neighbours. Any thread, any range of the map.
  void release(std::size_t offset, std::size_t bytes) const;

private:
  MemoryMap() = default;

  const std::byte* data_ = nullptr;
  std::size_t size_ = 0;
};

} // namespace pointfront
