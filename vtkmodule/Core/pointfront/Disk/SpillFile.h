#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Disk/DirectAccess.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace pointfront
{

/// A file on disk for data that does not fit in memory. It has no name once it is open, so nothing
/// can be left behind: not by an Error, not by a killed process. Large ranges go past the page
/// cache where the file system lets them: they are written once and read once. Small ones are read
/// more than once when a dense place is divided, and stay there.
/// Threads  read() and write() are positional and safe from any thread, on separate ranges.
/// Errors   Unwritable, with the bytes needed and those free when the disk is too small.
class SpillFile
{
public:
  enum class Way
  {
    PastCache, ///< where that is possible
    ThroughCache ///< all of it
  };
  /// Ranges from so many bytes on go past the page cache.
  static constexpr std::size_t leastDirectBytes = std::size_t(128) << 10;

  /// `bytes` is what will be written (0: not known); a disk with less free space is refused before
  /// any work.
  static Result<std::unique_ptr<SpillFile>> create(
    const std::string& folder, std::uint64_t bytes, Way way = Way::PastCache);
  ~SpillFile();
  SpillFile(const SpillFile&) = delete;
  SpillFile& operator=(const SpillFile&) = delete;

  Result<void> write(std::uint64_t offset, const std::byte* data, std::size_t bytes);
  Result<void> read(std::uint64_t offset, std::byte* data, std::size_t bytes) const;

  /// Whether large ranges go past the page cache.
  bool direct() const { return direct_ != nullptr; }

private:
  SpillFile(int descriptor, std::string folder, std::uint64_t bytes);
  Result<void> writeCached(std::uint64_t offset, const std::byte* data, std::size_t bytes);
  Result<void> readCached(std::uint64_t offset, std::byte* data, std::size_t bytes) const;
  int descriptor_;
  std::string folder_;
  std::uint64_t bytes_;
  std::unique_ptr<DirectAccess> direct_;
};

} // namespace pointfront
