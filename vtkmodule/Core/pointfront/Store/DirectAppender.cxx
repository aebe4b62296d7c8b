#include "pointfront/Store/DirectAppender.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace pointfront
{
namespace
{
/// Of memory and of places in the file: the largest block of a disk, and a page.
constexpr std::size_t alignment = 4096;
} // namespace

std::unique_ptr<DirectAppender> DirectAppender::open(const std::string& path)
{
#ifdef O_DIRECT
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_DIRECT | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0)
  {
    return nullptr;
  }
  void* buffer = std::aligned_alloc(alignment, bufferBytes);
  if (buffer == nullptr)
  {
    ::close(descriptor);
    return nullptr;
  }
  return std::unique_ptr<DirectAppender>(
    new DirectAppender(descriptor, static_cast<std::byte*>(buffer)));
#else
  static_cast<void>(path);
  return nullptr;
#endif
}

DirectAppender::DirectAppender(int descriptor, std::byte* buffer)
  : descriptor_(descriptor)
  , buffer_(buffer)
{
}

DirectAppender::~DirectAppender()
{
  ::close(descriptor_);
  std::free(buffer_);
}

std::size_t DirectAppender::take(const std::byte* data, std::size_t size)
{
  const std::size_t taken = std::min(size, bufferBytes - size_);
  std::memcpy(buffer_ + size_, data, taken);
  size_ += taken;
  return taken;
}

bool DirectAppender::write()
{
  ssize_t count = -1;
  do
  {
    count = ::pwrite(descriptor_, buffer_, size_, static_cast<off_t>(begin_));
  } while (count < 0 && errno == EINTR);
  if (count < 0 || static_cast<std::size_t>(count) < size_)
  {
    return false;
  }
  begin_ += size_;
  size_ = 0;
  return true;
}

} // namespace pointfront
