#include "pointfront/Disk/SpillFile.h"

#include "pointfront/Disk/DiskEstimate.h"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace pointfront
{
namespace
{
Error tooSmall(const std::string& folder, std::uint64_t needed, std::uint64_t available)
{
  return makeError(Error::Kind::Unwritable,
    "the points do not fit in the memory limit and need " + mebibytes(needed) +
      " of spill space in '" + folder + "', where " + mebibytes(available) +
      " are free; choose another folder for temporary files (--temp) or a higher memory limit "
      "(--memory)");
}

/// The disk, a quota or a limit on the size of files ended while it was written.
Error writeFault(const std::string& folder, std::uint64_t needed, int systemError)
{
  const std::string left = mebibytes(diskSpaceOf(folder).freeBytes) + " are free now";
  return makeError(Error::Kind::Unwritable,
    "cannot write a temporary file in '" + folder + "': " + std::strerror(systemError) + "; " +
      (needed == 0 ? left
                   : "it needs " + mebibytes(needed) + ", and " + left +
            "; choose another folder for temporary files (--temp) or a higher memory "
            "limit (--memory)"));
}

Error systemError(const std::string& doing, const std::string& folder)
{
  return makeError(Error::Kind::Unwritable,
    doing + " a temporary file in '" + folder + "': " + std::strerror(errno));
}
} // namespace

Result<std::unique_ptr<SpillFile>> SpillFile::create(
  const std::string& folder, std::uint64_t bytes, Way way)
{
  static std::atomic<unsigned> serial{ 0 };
  if (const std::uint64_t available = diskSpaceOf(folder).freeBytes; available < bytes)
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
  std::unique_ptr<SpillFile> file(new SpillFile(descriptor, folder, bytes));
  if (way == Way::PastCache)
  {
    file->direct_ = DirectAccess::open(path);
  }
  unlink(path.c_str());
  return file;
}

SpillFile::SpillFile(int descriptor, std::string folder, std::uint64_t bytes)
  : descriptor_(descriptor)
  , folder_(std::move(folder))
  , bytes_(bytes)
{
}

SpillFile::~SpillFile()
{
  close(descriptor_);
}

/// Blocks of the disk that are not the range's alone go through the page cache, which puts together
/// what several threads have of them.
Result<void> SpillFile::write(std::uint64_t offset, const std::byte* data, std::size_t bytes)
{
  if (direct_ && bytes >= leastDirectBytes)
  {
    constexpr std::uint64_t block = DirectAccess::alignment;
    const auto shared = static_cast<std::size_t>((block - offset % block) % block);
    if (Result<void> done = writeCached(offset, data, shared); !done)
    {
      return done;
    }
    const std::size_t done =
      shared + direct_->write(offset + shared, data + shared, bytes - shared);
    offset += done;
    data += done;
    bytes -= done;
  }
  return writeCached(offset, data, bytes);
}

Result<void> SpillFile::writeCached(std::uint64_t offset, const std::byte* data, std::size_t bytes)
{
  while (bytes > 0)
  {
    const ssize_t done = pwrite(descriptor_, data, bytes, static_cast<off_t>(offset));
    if (done < 0 && errno == EINTR)
    {
      continue;
    }
    if (done <= 0)
    {
      const int fault = done < 0 ? errno : ENOSPC;
      return isDiskFault(fault) ? writeFault(folder_, bytes_, fault)
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
  const std::size_t done =
    direct_ && bytes >= leastDirectBytes ? direct_->read(offset, data, bytes) : 0;
  return readCached(offset + done, data + done, bytes - done);
}

Result<void> SpillFile::readCached(std::uint64_t offset, std::byte* data, std::size_t bytes) const
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
      return makeError(Error::Kind::Unreadable,
        "cannot read a temporary file in '" + folder_ + "' at byte " + std::to_string(offset) +
          ": " + std::strerror(errno));
    }
    data += done;
    offset += static_cast<std::uint64_t>(done);
    bytes -= static_cast<std::size_t>(done);
  }
  return {};
}

} // namespace pointfront
