#include "pointfront/Disk/InputFile.h"

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
  : path_(std::move(path))
  , descriptor_(descriptor)
  , bytes_(bytes)
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
  return ::fstat(descriptor_, &opened) == 0 && ::stat(path_.c_str(), &named) == 0 &&
    opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

Result<void> InputFile::readAt(std::uint64_t offset, std::byte* target, std::size_t size) const
{
  while (size != 0)
  {
    const ssize_t count = ::pread(
      descriptor_, target, size < maxReadBytes ? size : maxReadBytes, static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR)
    {
      continue;
    }
    if (count < 0)
    {
      return makeError(Error::Kind::Unreadable,
        "cannot read '" + path_ + "' at byte " + std::to_string(offset) + ": " +
          std::strerror(errno));
    }
    if (count == 0)
    {
      return makeError(Error::Kind::Truncated,
        "'" + path_ + "' ends at byte " + std::to_string(offset) + ", " + std::to_string(size) +
          " bytes too early; copy the file again");
    }
    target += count;
    size -= static_cast<std::size_t>(count);
    offset += static_cast<std::uint64_t>(count);
  }
  return {};
}

Result<RawBytes> InputFile::readAt(std::uint64_t offset, std::size_t size) const
{
  RawBytes bytes(size);
  const Result<void> done = readAt(offset, bytes.data.get(), size);
  return done ? Result<RawBytes>(std::move(bytes)) : done.error();
}

bool fileBeginsWith(const std::string& path, const void* bytes, std::size_t size)
{
  const Result<std::unique_ptr<const InputFile>> file = InputFile::open(path);
  if (!file || (*file)->bytes() < size)
  {
    return false;
  }
  const Result<RawBytes> beginning = (*file)->readAt(0, size);
  return beginning && std::memcmp(beginning->data.get(), bytes, size) == 0;
}

} // namespace pointfront
