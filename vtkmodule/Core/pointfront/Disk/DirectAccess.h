#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace pointfront
{

/// Reads and writes ranges of a file past the page cache. Bytes that are used once would cost the
/// first touch of a page there, for each 4 KiB, and would push out bytes that others read again.
/// Bytes move through aligned buffers of this object, which are used again. Beside it the file may
/// be read and written the usual way, on separate ranges: the system keeps both the same.
/// Memory   bufferBytes for each thread that is in a call at the same time.
/// Threads  from any thread, on separate ranges.
/// Errors   none of its own. The caller moves the remaining bytes the usual way, which works all
///          the same or says what is wrong.
class DirectAccess
{
public:
  static constexpr std::size_t bufferBytes = std::size_t(1) << 20;
  /// Alignment of places in the file and of memory: the largest block of a disk, and a page.
  static constexpr std::size_t alignment = 4096;

  /// For an existing file; nullptr where files cannot be accessed that way.
  static std::unique_ptr<DirectAccess> open(const std::string& path);
  ~DirectAccess();
  DirectAccess(const DirectAccess&) = delete;
  DirectAccess& operator=(const DirectAccess&) = delete;

  /// `offset` is a multiple of the alignment. How many bytes were written, from the first on: at
  /// most all whole blocks of `bytes`.
  std::size_t write(std::uint64_t offset, const std::byte* data, std::size_t bytes);
  /// Any range. How many bytes were read, from the first on.
  std::size_t read(std::uint64_t offset, std::byte* data, std::size_t bytes);

private:
  struct Release
  {
    void operator()(std::byte* memory) const { std::free(memory); }
  };
  using Buffer = std::unique_ptr<std::byte, Release>;

  explicit DirectAccess(int descriptor)
    : descriptor_(descriptor)
  {
  }
  Buffer take();
  void giveBack(Buffer buffer);

  int descriptor_;
  std::mutex mutex_; // guards what follows
  std::vector<Buffer> idle_;
};

} // namespace pointfront
