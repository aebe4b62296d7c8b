#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace pointfront
{

/// Bytes on their way to the end of a file, past the page cache: what is written once and not read
/// soon costs a page of memory and a copy there, for each 4 KiB. Gathers whole blocks in memory of
/// its own and hands them to the disk as one.
/// Threads  one thread.
class DirectAppender
{
public:
  /// Bytes gathered before they are written.
  static constexpr std::size_t bufferBytes = std::size_t(4) << 20;

  /// For an empty file; nullptr where files cannot be written that way.
  static std::unique_ptr<DirectAppender> open(const std::string& path);
  ~DirectAppender();
  DirectAppender(const DirectAppender&) = delete;
  DirectAppender& operator=(const DirectAppender&) = delete;

  /// Takes as much as fits; returns how much that was.
  std::size_t take(const std::byte* data, std::size_t size);
  bool full() const { return size_ == bufferBytes; }
  /// What was taken and not written: `size()` bytes, which belong to byte begin() of the file.
  std::uint64_t begin() const { return begin_; }
  const std::byte* data() const { return buffer_; }
  std::size_t size() const { return size_; }
  /// Writes the buffer, which is full; it is empty then. False when it was not written, or not as
  /// a whole: it is still here.
  bool write();

private:
  DirectAppender(int descriptor, std::byte* buffer);
  int descriptor_;
  std::byte* buffer_;
  std::uint64_t begin_ = 0;
  std::size_t size_ = 0;
};

} // namespace pointfront
