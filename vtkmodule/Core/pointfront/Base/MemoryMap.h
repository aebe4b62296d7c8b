#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Base/WatchedPages.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace pointfront
{

/// A whole file, mapped read-only into memory; unmapped when destroyed.
/// Threads   reading data() is safe from any thread.
/// Changes   bytes beyond the end of a file that others shorten meanwhile read as 0. Who has read
///           asks checkWhole() before the result counts.
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
  /// Bytes that were read already, as if they were the file `path`. They outlive the map.
  static MemoryMap ofBytes(const std::string& path, const std::byte* bytes, std::size_t size);

  MemoryMap(MemoryMap&& other) noexcept;
  MemoryMap& operator=(MemoryMap&& other) noexcept;
  MemoryMap(const MemoryMap&) = delete;
  MemoryMap& operator=(const MemoryMap&) = delete;
  ~MemoryMap();

  const std::byte* data() const { return data_; }
  std::size_t size() const { return size_; }

  /// Errors  Truncated: bytes that were touched so far were gone, and read as 0.
  Result<void> checkWhole() const;
  /// The error of checkWhole() if there is one, else `done`: what went wrong behind the end of a
  /// file that was shortened is no fault of its content.
  Result<void> checkWhole(Result<void> done) const;

  /// Gives the pages of these bytes, and 2 MiB on both sides, back to the system: they no longer
  /// count as memory of this process, so reading a file of any size stays inside a memory limit.
  /// The pages stay valid: a later access gets them from the disk cache, together with their
  /// neighbours. Any thread, any range of the map.
  void release(std::size_t offset, std::size_t bytes) const;

private:
  MemoryMap() = default;

  std::string path_;
  const std::byte* data_ = nullptr;
  std::size_t size_ = 0;
  std::uint64_t device_ = 0; ///< device of the file, and its inode
  std::uint64_t inode_ = 0;
  std::unique_ptr<WatchedPages> pages_; ///< none: empty, or bytes of somebody else
};

} // namespace pointfront
