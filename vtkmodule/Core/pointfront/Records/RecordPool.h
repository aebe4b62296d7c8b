#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Disk/SpillFile.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace pointfront
{

/// All records of a build as one array, in memory or in a spill file.
/// Threads  read() and write() from any thread, on separate ranges.
class RecordPool
{
public:
  /// Memory is taken page by page as records are written.
  static std::unique_ptr<RecordPool> inMemory(std::uint64_t capacity, std::size_t recordBytes);
  static Result<std::unique_ptr<RecordPool>> spilled(
    const std::string& folder, std::uint64_t capacity, std::size_t recordBytes);

  Result<void> write(std::uint64_t first, std::uint64_t count, const std::byte* records);
  Result<void> read(std::uint64_t first, std::uint64_t count, std::byte* records) const;
  /// Where that record is; nullptr if it is on disk.
  std::byte* memory(std::uint64_t first)
  {
    return file_ ? nullptr : memory_.get() + first * recordBytes_;
  }
  std::size_t recordBytes() const { return recordBytes_; }
  bool onDisk() const { return file_ != nullptr; }

private:
  explicit RecordPool(std::size_t recordBytes)
    : recordBytes_(recordBytes)
  {
  }
  std::size_t recordBytes_;
  std::unique_ptr<std::byte[]> memory_;
  std::unique_ptr<SpillFile> file_;
};

} // namespace pointfront
