#pragma once

#include "pointfront/Base/Result.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace pointfront
{

/// A file on disk for what does not fit in memory. It has no name once it is open, so nothing
/// can be left behind: not by an Error, not by a killed process.
/// Threads  read() and write() are positional and safe from any thread, on separate ranges.
/// Errors   Unwritable, with the bytes needed and those free when the disk is too small.
class SpillFile
{
public:
  /// `bytes` is what will be written; a disk with less free space is refused before any work.
  static Result<std::unique_ptr<SpillFile>> create(const std::string& folder, std::uint64_t bytes);
  ~SpillFile();
  SpillFile(const SpillFile&) = delete;
  SpillFile& operator=(const SpillFile&) = delete;

  Result<void> write(std::uint64_t offset, const std::byte* data, std::size_t bytes);
  Result<void> read(std::uint64_t offset, std::byte* data, std::size_t bytes) const;

private:
  SpillFile(int descriptor, std::string folder, std::uint64_t bytes);
  int descriptor_;
  std::string folder_;
  std::uint64_t bytes_;
};

} // namespace pointfront
