#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace pointfront
{

/// One file of FarCache: the blocks of 8 MiB of a far file, as far as they were fetched.
/// Layout    4 KiB of header (which file, which part), a record for each block (checksum, size),
///           the blocks at their places. What is not there is a hole and takes no room on the
///           disk.
/// Safety    a block counts once its record matches its checksum. Whatever a crash, a full disk or
///           another process leaves behind is a block that is not there.
/// Processes several may read and write one segment: the same block always has the same bytes.
/// Threads   any, as processes. A lock of the file is held while a writer begins a segment.
class FarSegment
{
public:
  static constexpr std::size_t blockBytes = 4096;
  static constexpr std::size_t blocks = 2048;
  static constexpr std::uint64_t bytes = std::uint64_t(blocks) * blockBytes;

  /// label: what the header must say, without secrets.
  FarSegment(std::string path, std::string label);

  /// Bytes of the segment at `offset`, if all blocks of them are there and whole.
  bool read(std::uint64_t offset, std::size_t size, std::byte* target) const;
  /// Writes blocks from the one at `offset` (a multiple of their size) on; only the last block of
  /// the far file may be shorter. False if the disk refuses.
  bool write(std::uint64_t offset, const std::byte* data, std::size_t size) const;

  struct Check
  {
    bool sound = true; ///< its header, and all blocks
    std::uint64_t blocks = 0;
  };
  /// Reads all blocks of any segment's file.
  static Check check(const std::string& path);

private:
  std::string header() const;

  const std::string path_;
  const std::string label_;
};

} // namespace pointfront
