#include "pointfront/Build/SpillFile.h"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/statvfs.h>
#include <unistd.h>

namespace pointfront
{
namespace
{
std::string mebibytes(std::uint64_t bytes)
{
  return std::to_string((bytes >> 20) + 1) + " MiB";
}

Error tooSmall(const std::string& folder, std::uint64_t needed, std::uint64_t available)
{
  return makeError(Error::Kind::Unwritable,
    "the points do not fit in the memory limit and need " + mebibytes(needed) +
      " of spill space in '" + folder + "', where " + mebibytes(available) +
      " are free; choose another folder for temporary files or a higher memory limit");
}

std::uint64_t freeBytes(const std::string& folder)
{
  struct statvfs file
  {
  };
  return statvfs(folder.c_str(), &file) == 0 ? std::uint64_t(file.f_bavail) * file.f_frsize
                                             : UINT64_MAX;
}

Error systemError(const std::string& doing, const std::string& folder)
{
  return makeError(Error::Kind::Unwritable,
    doing + " a temporary file in '" + folder + "': " + std::strerror(errno));
}
} // namespace

Result<std::unique_ptr<SpillFile>> SpillFile::create(const std::string& folder, std::uint64_t bytes)
{
  static std::atomic<unsigned> serial{0};
  if (const std::uint64_t available = freeBytes(folder); available < bytes)
  {
    return tooSmall(folder, bytes, available);
  }
  const std::string path =
    folder + "/pointfront-" + std::to_string(getpid()) + "-" + std::to_string(serial++) + ".spill";
  const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor < 0)
  {
    return systemError("cannot create", folder);
  }
  unlink(path.c_str());
  return std::unique_ptr<SpillFile>(new SpillFile(descriptor, folder, bytes));
}

SpillFile::SpillFile(int descriptor, std::string folder, std::uint64_t bytes)
    : descriptor_(descriptor), folder_(std::move(folder)), bytes_(bytes)
{
}

SpillFile::~SpillFile()
{
  close(descriptor_);
}

Result<void> SpillFile::write(std::uint64_t offset, const std::byte* data, std::size_t bytes)
{
  while (bytes > 0)
  {
    const ssize_t done = pwrite(descriptor_, data, bytes, static_cast<off_t>(offset));
    if (done < 0 && errno == EINTR)
    {
      continue;
    }
    if (done < 0)
    {
      return errno == ENOSPC ? tooSmall(folder_, bytes_, freeBytes(folder_))
                             : systemError("cannot write", folder_);
    }
    data += done;
    offset += static_cast<std::uint64_t>(done);
    bytes -= static_cast<std::size_t>(done);
  }
  return {};
}

Result<void> SpillFile::read(std::uint64_t offset, std::byte* data, std::size_t bytes) const
{
  while (bytes > 0)
  {
    const ssize_t done = pread(descriptor_, data, bytes, static_cast<off_t>(offset));
    if (done < 0 && errno == EINTR)
    {
      continue;
    }
    if (done <= 0)
    {
      errno = done == 0 ? EIO : errno;
      return makeError(Error::Kind::Unreadable, "cannot read a temporary file in '" + folder_ +
                                                  "' at byte " + std::to_string(offset) + ": " +
                                                  std::strerror(errno));
    }
    data += done;
    offset += static_cast<std::uint64_t>(done);
    bytes -= static_cast<std::size_t>(done);
  }
  return {};
}

} // namespace pointfront
