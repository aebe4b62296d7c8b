#include "pointfront/Disk/InputFile.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::size_t maxReadBytes = std::size_t(1) << 30;

Error notReadable(const std::string& path, int error)
{
  if (error == ENOENT || error == ENOTDIR)
  {
    return makeError(Error::Kind::NotFound, "'" + path + "' does not exist; check the path");
  }
  return makeError(Error::Kind::Unreadable, "cannot read '" + path + "': " + std::strerror(error));
}
} // namespace

InputFile::InputFile(std::string path, int descriptor, std::uint64_t bytes, std::uint64_t device)
  : ByteSource(std::move(path), bytes)
  , descriptor_(descriptor)
  , device_(device)
{
}

InputFile::~InputFile()
{
  ::close(descriptor_);
}

Result<std::unique_ptr<const InputFile>> InputFile::open(const std::string& path)
{
  // Not blocking: opening a pipe would wait for its other end.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0)
  {
    return notReadable(path, errno);
  }
  struct stat status = {};
  if (::fstat(descriptor, &status) != 0)
  {
    const int error = errno;
    ::close(descriptor);
    return notReadable(path, error);
  }
  if (!S_ISREG(status.st_mode))
  {
    ::close(descriptor);
    return makeError(
      Error::Kind::Unreadable, "cannot read '" + path + "': it is not a file; name a file");
  }
  return std::unique_ptr<const InputFile>(new InputFile(path, descriptor,
    static_cast<std::uint64_t>(status.st_size), static_cast<std::uint64_t>(status.st_dev)));
}

bool InputFile::isLocked() const
{
  if (::flock(descriptor_, LOCK_SH | LOCK_NB) != 0)
  {
    return true;
  }
  ::flock(descriptor_, LOCK_UN);
  return false;
}

bool InputFile::isStillNamed() const
{
  struct stat opened = {};
  struct stat named = {};
  return ::fstat(descriptor_, &opened) == 0 && ::stat(path().c_str(), &named) == 0 &&
    opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

Result<void> InputFile::read(const ByteRange* ranges, std::size_t count) const
{
  for (std::size_t i = 0; i < count; ++i)
  {
    if (Result<void> done = readOne(ranges[i]); !done)
    {
      return done;
    }
  }
  return {};
}

Result<void> InputFile::readOne(ByteRange range) const
{
  while (range.size != 0)
  {
    const ssize_t count = ::pread(descriptor_, range.target, std::min(range.size, maxReadBytes),
      static_cast<off_t>(range.offset));
    if (count < 0 && errno == EINTR)
    {
      continue;
    }
    if (count < 0)
    {
      return makeError(Error::Kind::Unreadable,
        "cannot read '" + path() + "' at byte " + std::to_string(range.offset) + ": " +
          std::strerror(errno));
    }
    if (count == 0)
    {
      return makeError(Error::Kind::Truncated,
        "'" + path() + "' ends at byte " + std::to_string(range.offset) + ", " +
          std::to_string(range.size) + " bytes too early; copy the file again");
    }
    range.target += count;
    range.size -= static_cast<std::size_t>(count);
    range.offset += static_cast<std::uint64_t>(count);
  }
  return {};
}

} // namespace pointfront
