#pragma once

#include "pointfront/Base/RawBytes.h"
#include "pointfront/Base/Result.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace pointfront
{

/// A file that is read at given places.
/// Threads  readAt() from any thread: there is no shared cursor.
/// Errors   NotFound, Unreadable; Truncated when the file ends before what was asked for.
class InputFile
{
public:
  static Result<std::unique_ptr<const InputFile>> open(const std::string& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::string& path() const { return path_; }
  /// The number of the file system that it lies on.
  std::uint64_t device() const { return device_; }
  std::uint64_t bytes() const { return bytes_; } ///< when it was opened
  /// True while another process has the file open under an exclusive lock: a running build replaces
  /// or keeps it. Also true on file systems that have no locks.
  bool isLocked() const;
  /// False once another file has this path, or none.
  bool isStillNamed() const;
  Result<void> readAt(std::uint64_t offset, std::byte* target, std::size_t size) const;
  Result<RawBytes> readAt(std::uint64_t offset, std::size_t size) const;

private:
  InputFile(std::string path, int descriptor, std::uint64_t bytes, std::uint64_t device);
  std::string path_;
  int descriptor_;
  std::uint64_t bytes_;
  std::uint64_t device_;
};

/// False, too, for a file that cannot be read.
bool fileBeginsWith(const std::string& path, const void* bytes, std::size_t size);

} // namespace pointfront
