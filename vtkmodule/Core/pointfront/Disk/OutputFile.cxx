#include "pointfront/Disk/OutputFile.h"

#include "pointfront/Disk/DirectAppender.h"
#include "pointfront/Disk/TemporaryFile.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace pointfront
{
namespace
{
/// Linux writes at most 2 GiB a call anyway.
constexpr std::size_t maxWriteBytes = std::size_t(1) << 30;

Error unwritable(const std::string& path, const std::string& why)
{
  return makeError(Error::Kind::Unwritable, "cannot write '" + path + "': " + why);
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
  PosixOutputFile(std::string path, TemporaryFile temporary, bool replaces, Durability durability)
    : path_(std::move(path))
    , temporary_(std::move(temporary))
    , replaces_(replaces)
    , durable_(durability == Durability::Full)
    , tryDirect_(durable_)
  {
  }
  ~PosixOutputFile() override
  {
    if (!published_)
    {
      ::unlink(temporary_.path.c_str());
    }
    ::close(temporary_.descriptor);
  }

  const std::string& path() const override { return path_; }
  const std::string& pathMeanwhile() const override { return temporary_.path; }

  Result<void> append(const std::byte* data, std::size_t size) override
  {
    if (tryDirect_)
    {
      tryDirect_ = false; // a file that waits for its first byte holds no buffers
      direct_ = DirectAppender::open(temporary_.path);
    }
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
    if (durable_ && ::fsync(temporary_.descriptor) != 0)
    {
      return unwritable(path_, std::strerror(errno));
    }
    if (Result<void> named = nameTemporaryFile(temporary_.path, path_, replaces_); !named)
    {
      return named;
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
      const ssize_t count = ::pwrite(temporary_.descriptor, data,
        size < maxWriteBytes ? size : maxWriteBytes, static_cast<off_t>(offset));
      if (count < 0 && errno == EINTR)
      {
        continue;
      }
      if (count <= 0)
      {
        const int error = count < 0 ? errno : ENOSPC;
        if (error == ENOSPC || error == EDQUOT || error == EFBIG)
        {
          return noSpace(path_, size, offset, error);
        }
        return unwritable(path_, std::strerror(error));
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
    ::sync_file_range(temporary_.descriptor, static_cast<off64_t>(offset),
      static_cast<off64_t>(size), SYNC_FILE_RANGE_WRITE);
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
  TemporaryFile temporary_;
  bool replaces_;
  bool durable_;
  bool tryDirect_;
  std::unique_ptr<DirectAppender> direct_; // nullptr: all goes through the page cache
  std::uint64_t end_ = 0;
  bool published_ = false;
};
} // namespace

Result<std::unique_ptr<OutputFile>> OutputFile::create(
  const std::string& path, Durability durability)
{
  struct stat existing = {};
  if (::stat(path.c_str(), &existing) == 0 && !S_ISREG(existing.st_mode))
  {
    return unwritable(path, "it is there and is not a file; choose another name");
  }
  // A symbolic link to nothing is there, too: it is known now, not after hours of writing.
  const bool exists = ::lstat(path.c_str(), &existing) == 0;
  Result<TemporaryFile> temporary = createTemporaryFile(path);
  if (!temporary)
  {
    return temporary.error();
  }
  return std::unique_ptr<OutputFile>(
    std::make_unique<PosixOutputFile>(path, std::move(*temporary), exists, durability));
}

} // namespace pointfront
