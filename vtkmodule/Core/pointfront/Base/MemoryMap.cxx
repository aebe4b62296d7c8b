#include "pointfront/Base/MemoryMap.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace pointfront
{
namespace
{
/// A touched page brings its neighbours with it, as far as the system holds them in one piece: what
/// was released at the border of two ranges comes back with the first byte of the second one.
/// Linux maps 64 KiB around a fault, or a whole folio, up to 2 MiB.
constexpr std::size_t mappedAround = std::size_t(2) << 20;

Error systemError(const std::string& path, int code)
{
  const bool missing = code == ENOENT || code == ENOTDIR;
  return makeError(missing ? Error::Kind::NotFound : Error::Kind::Unreadable,
    path + ": " + std::generic_category().message(code));
}

/// Closes the descriptor on every way out; the mapping outlives it.
struct Descriptor
{
  int number = -1;
  ~Descriptor()
  {
    if (number >= 0)
    {
      ::close(number);
    }
  }
};
} // namespace

Result<MemoryMap> MemoryMap::open(const std::string& path, Access access)
{
  // O_NONBLOCK: opening a named pipe must not wait for a writer; without effect on files.
  const Descriptor file{ ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK) };
  if (file.number < 0)
  {
    return systemError(path, errno);
  }
  struct stat status = {};
  if (::fstat(file.number, &status) != 0)
  {
    return systemError(path, errno);
  }
  if (!S_ISREG(status.st_mode))
  {
    return makeError(Error::Kind::Unreadable, path + ": not a regular file");
  }
  MemoryMap map;
  map.path_ = path;
  map.device_ = status.st_dev;
  map.inode_ = status.st_ino;
  map.size_ = static_cast<std::size_t>(status.st_size);
  if (map.size_ == 0)
  {
    return map;
  }
  void* address = ::mmap(nullptr, map.size_, PROT_READ, MAP_SHARED, file.number, 0);
  if (address == MAP_FAILED)
  {
    map.size_ = 0;
    return systemError(path, errno);
  }
  map.data_ = static_cast<const std::byte*>(address);
  map.pages_ = std::make_unique<WatchedPages>(address, map.size_);
  // Advice only: a system that does not take it reads correctly all the same.
  ::madvise(address, map.size_, access == Access::Sequential ? MADV_SEQUENTIAL : MADV_RANDOM);
  return map;
}

MemoryMap MemoryMap::ofBytes(const std::string& path, const std::byte* bytes, std::size_t size)
{
  MemoryMap map;
  map.path_ = path;
  map.data_ = bytes;
  map.size_ = size;
  return map;
}

Result<void> MemoryMap::checkWhole() const
{
  struct stat now = {};
  // The rest of a file's last page reads as 0 without a signal: its length tells.
  const bool shorter = pages_ && ::stat(path_.c_str(), &now) == 0 && now.st_dev == device_ &&
    now.st_ino == inode_ && static_cast<std::size_t>(now.st_size) < size_;
  if (shorter || (pages_ && pages_->lost()))
  {
    return makeError(Error::Kind::Truncated,
      path_ +
        ": another program has shortened the file while it was read; wait until the file is "
        "whole and start again");
  }
  return {};
}

Result<void> MemoryMap::checkWhole(Result<void> done) const
{
  Result<void> whole = checkWhole();
  return whole ? done : whole;
}

void MemoryMap::release(std::size_t offset, std::size_t bytes) const
{
  if (bytes == 0 || !pages_ || pages_->lost())
  {
    return;
  }
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const std::size_t begin = (offset - std::min(offset, mappedAround)) / page * page;
  const std::size_t end = std::min(size_, offset + bytes + mappedAround);
  // Advice only, as above. The mapping is read-only: no page of it can hold what the file does not.
  ::madvise(const_cast<std::byte*>(data_) + begin, end - begin, MADV_DONTNEED);
}

MemoryMap::MemoryMap(MemoryMap&& other) noexcept
  : path_(std::move(other.path_))
  , data_(std::exchange(other.data_, nullptr))
  , size_(std::exchange(other.size_, 0))
  , device_(other.device_)
  , inode_(other.inode_)
  , pages_(std::move(other.pages_))
{
}

MemoryMap& MemoryMap::operator=(MemoryMap&& other) noexcept
{
  std::swap(path_, other.path_);
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  std::swap(device_, other.device_);
  std::swap(inode_, other.inode_);
  std::swap(pages_, other.pages_);
  return *this;
}

MemoryMap::~MemoryMap()
{
  if (pages_)
  {
    pages_.reset(); // the addresses may be another's from here on
    ::munmap(const_cast<std::byte*>(data_), size_);
  }
}

} // namespace pointfront
