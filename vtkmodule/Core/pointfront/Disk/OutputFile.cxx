#include "pointfront/Disk/OutputFile.h"

#include "pointfront/Disk/DirectAppender.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace pointfront
{
namespace
{
/// Linux writes at most 2 GiB a call anyway.
constexpr std::size_t maxWriteBytes = std::size_t(1) << 30;

std::string folderOf(const std::string& path)
{
  const std::size_t slash = path.rfind('/');
  if (slash == std::string::npos)
  {
    return ".";
  }
  return slash == 0 ? "/" : path.substr(0, slash);
}

Error unwritable(const std::string& path, const std::string& why)
{
  return makeError(Error::Kind::Unwritable, "cannot write '" + path + "': " + why);
}

std::string creationAdvice(int error, const std::string& path)
{
  switch (error)
  {
    case ENOENT:
      return "the folder '" + folderOf(path) + "' does not exist; create it first";
    case EACCES:
    case EPERM:
    case EROFS:
      return std::string(std::strerror(error)) + "; choose a folder you may write to";
    case ELOOP:
      return "it is a symbolic link; remove it";
    case EISDIR:
      return "it is a folder; choose another name";
    default:
      return std::strerror(error);
  }
}

Error noSpace(const std::string& path, std::size_t missing, std::uint64_t written, int error)
{
  return unwritable(path,
    std::string(std::strerror(error)) + "; " + std::to_string(missing) +
      " bytes could not be written after byte " + std::to_string(written) +
      "; free some space or write to another disk");
}

class PosixOutputFile final : public OutputFile
{
public:
  PosixOutputFile(
    std::string path, std::string temporaryPath, int descriptor, Durability durability)
    : path_(std::move(path))
    , temporaryPath_(std::move(temporaryPath))
    , descriptor_(descriptor)
    , durable_(durability == Durability::Full)
    , direct_(durable_ ? DirectAppender::open(temporaryPath_) : nullptr)
  {
  }
  ~PosixOutputFile() override
  {
    if (!published_)
    {
      ::unlink(temporaryPath_.c_str()); // while the lock is held: nobody else's file
    }
    ::close(descriptor_);
  }

  const std::string& path() const override { return path_; }

  Result<void> append(const std::byte* data, std::size_t size) override
  {
    while (direct_ && size != 0)
    {
      const std::size_t taken = direct_->take(data, size);
      data += taken;
      size -= taken;
      end_ += taken;
      if (direct_->full() && !direct_->write())
      {
        // The usual way may work all the same, or it says what is wrong.
        if (Result<void> done = leaveDirect(); !done)
        {
          return done;
        }
      }
    }
    Result<void> done = writeAt(end_, data, size);
    if (done && size != 0)
    {
      startWriting(end_, size);
      end_ += size;
    }
    return done;
  }

  Result<void> settle() override
  {
    if (direct_)
    {
      for (const DirectAppender::Span& span : direct_->unwritten())
      {
        if (Result<void> done = writeAt(span.begin, span.data, span.size); !done)
        {
          return done;
        }
      }
    }
    return {};
  }

  Result<void> overwrite(std::uint64_t offset, const std::byte* data, std::size_t size) override
  {
    Result<void> done = leaveDirect();
    return done ? writeAt(offset, data, size) : done;
  }

  Result<void> publish() override
  {
    if (Result<void> done = leaveDirect(); !done)
    {
      return done;
    }
    if (durable_ && ::fsync(descriptor_) != 0)
    {
      return unwritable(temporaryPath_, std::strerror(errno));
    }
    if (::rename(temporaryPath_.c_str(), path_.c_str()) != 0)
    {
      return unwritable(path_, std::strerror(errno));
    }
    published_ = true;
    return durable_ ? syncFolder() : Result<void>{};
  }

private:
  Result<void> leaveDirect()
  {
    Result<void> done = settle();
    direct_.reset();
    return done;
  }

  Result<void> writeAt(std::uint64_t offset, const std::byte* data, std::size_t size)
  {
    while (size != 0)
    {
      const ssize_t count = ::pwrite(
        descriptor_, data, size < maxWriteBytes ? size : maxWriteBytes, static_cast<off_t>(offset));
      if (count < 0 && errno == EINTR)
      {
        continue;
      }
      if (count <= 0)
      {
        const int error = count < 0 ? errno : ENOSPC;
        if (error == ENOSPC || error == EDQUOT || error == EFBIG)
        {
          return noSpace(temporaryPath_, size, offset, error);
        }
        return unwritable(temporaryPath_, std::strerror(error));
      }
      data += count;
      size -= static_cast<std::size_t>(count);
      offset += static_cast<std::uint64_t>(count);
    }
    return {};
  }

  /// The disk works while the next bytes are made: what is left for publish() is then short.
  /// Advice only.
  void startWriting(std::uint64_t offset, std::size_t size) const
  {
#ifdef SYNC_FILE_RANGE_WRITE
    ::sync_file_range(
      descriptor_, static_cast<off64_t>(offset), static_cast<off64_t>(size), SYNC_FILE_RANGE_WRITE);
#else
    static_cast<void>(offset);
    static_cast<void>(size);
#endif
  }

  // The new name is durable only when the folder is.
  Result<void> syncFolder()
  {
    const std::string folder = folderOf(path_);
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0)
    {
      // A folder that may be written to but not read cannot be opened; the file is in place.
      return errno == EACCES ? Result<void>{} : unwritable(folder, std::strerror(errno));
    }
    const int failed = ::fsync(descriptor) != 0 ? errno : 0;
    ::close(descriptor);
    // EINVAL: a file system without durable folders.
    return failed == 0 || failed == EINVAL ? Result<void>{}
                                           : unwritable(folder, std::strerror(failed));
  }

  std::string path_;
  std::string temporaryPath_;
  int descriptor_;
  bool durable_;
  std::unique_ptr<DirectAppender> direct_; // nullptr: all goes through the page cache
  std::uint64_t end_ = 0;
  bool published_ = false;
};

// True when the descriptor is still the file of that name: another writer may have removed or
// renamed it between our open and our lock.
bool stillNamed(int descriptor, const std::string& path)
{
  struct stat opened = {};
  struct stat named = {};
  return ::fstat(descriptor, &opened) == 0 && ::lstat(path.c_str(), &named) == 0 &&
    opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}
} // namespace

Result<std::unique_ptr<OutputFile>> OutputFile::create(
  const std::string& path, Durability durability)
{
  struct stat existing = {};
  if (::stat(path.c_str(), &existing) == 0 && !S_ISREG(existing.st_mode))
  {
    return unwritable(path, "it is there and is not a file; choose another name");
  }
  const std::string temporaryPath = path + ".tmp";
  for (;;)
  {
    const int descriptor =
      ::open(temporaryPath.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor < 0)
    {
      if (errno == EINTR)
      {
        continue;
      }
      return unwritable(temporaryPath, creationAdvice(errno, path));
    }
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    { // any other failure: this file system has no locks
      ::close(descriptor);
      return unwritable(
        temporaryPath, "another build is writing it now; wait or choose another name");
    }
    if (!stillNamed(descriptor, temporaryPath))
    {
      ::close(descriptor);
      continue;
    }
    if (::ftruncate(descriptor, 0) != 0)
    {
      const int error = errno;
      ::close(descriptor);
      return unwritable(temporaryPath, std::strerror(error));
    }
    return std::unique_ptr<OutputFile>(
      std::make_unique<PosixOutputFile>(path, temporaryPath, descriptor, durability));
  }
}

} // namespace pointfront
