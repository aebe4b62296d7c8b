#include "pointfront/Disk/DirectAppender.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>
#include <utility>

namespace pointfront
{
namespace
{
/// Alignment of memory and of places in the file: the largest block of a disk, and a page.
constexpr std::size_t alignment = 4096;

std::byte* alignedMemory()
{
  return static_cast<std::byte*>(std::aligned_alloc(alignment, DirectAppender::bufferBytes));
}
} // namespace

std::unique_ptr<DirectAppender> DirectAppender::open(const std::string& path)
{
#ifdef O_DIRECT
  Memory first(alignedMemory());
  Memory second(alignedMemory());
  if (!first || !second)
  {
    return nullptr;
  }
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_DIRECT | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0)
  {
    return nullptr;
  }
  return std::unique_ptr<DirectAppender>(
    new DirectAppender(descriptor, std::move(first), std::move(second)));
#else
  static_cast<void>(path);
  return nullptr;
#endif
}

DirectAppender::DirectAppender(int descriptor, Memory first, Memory second)
  : descriptor_(descriptor)
  , gathered_{ std::move(first) }
  , handed_{ std::move(second) }
{
}

DirectAppender::~DirectAppender()
{
  {
    std::unique_lock<std::mutex> lock(mutex_);
    awaitWritten(lock);
    over_ = true;
  }
  changed_.notify_all();
  thread_.join();
  ::close(descriptor_);
}

std::size_t DirectAppender::take(const std::byte* data, std::size_t size)
{
  const std::size_t taken = std::min(size, bufferBytes - gathered_.size);
  std::memcpy(gathered_.memory.get() + gathered_.size, data, taken);
  gathered_.size += taken;
  return taken;
}

bool DirectAppender::write()
{
  std::unique_lock<std::mutex> lock(mutex_);
  awaitWritten(lock);
  if (handed_.size != 0)
  {
    return false;
  }
  std::swap(gathered_, handed_);
  gathered_.begin = handed_.begin + handed_.size;
  if (!startThread())
  {
    handed_.size = writeHanded() ? 0 : handed_.size;
    return handed_.size == 0;
  }
  writing_ = true;
  changed_.notify_all();
  return true;
}

std::array<DirectAppender::Span, 2> DirectAppender::unwritten()
{
  std::unique_lock<std::mutex> lock(mutex_);
  awaitWritten(lock);
  return { Span{ handed_.begin, handed_.memory.get(), handed_.size },
    Span{ gathered_.begin, gathered_.memory.get(), gathered_.size } };
}

void DirectAppender::awaitWritten(std::unique_lock<std::mutex>& lock)
{
  changed_.wait(lock, [this] { return !writing_; });
}

/// False when the system gives none: then who appends writes.
bool DirectAppender::startThread()
{
  return thread_.started() || thread_.start([this] { work(); });
}

void DirectAppender::work()
{
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;)
  {
    changed_.wait(lock, [this] { return writing_ || over_; });
    if (!writing_)
    {
      return;
    }
    lock.unlock();
    const bool done = writeHanded(); // nobody else touches it meanwhile
    lock.lock();
    handed_.size = done ? 0 : handed_.size;
    writing_ = false;
    changed_.notify_all();
  }
}

bool DirectAppender::writeHanded() const
{
  ssize_t count = -1;
  do
  {
    count =
      ::pwrite(descriptor_, handed_.memory.get(), handed_.size, static_cast<off_t>(handed_.begin));
  } while (count < 0 && errno == EINTR);
  return count >= 0 && static_cast<std::size_t>(count) == handed_.size;
}

} // namespace pointfront
