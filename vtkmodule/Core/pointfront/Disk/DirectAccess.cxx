#include "pointfront/Disk/DirectAccess.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace pointfront
{
namespace
{
/// `transfer()` until no signal interrupts it; bytes moved, 0 for an error.
template <typename Transfer>
std::size_t moved(Transfer transfer)
{
  ssize_t count = -1;
  do
  {
    count = transfer();
  } while (count < 0 && errno == EINTR);
  return count < 0 ? 0 : static_cast<std::size_t>(count);
}

std::size_t roundedUp(std::size_t bytes)
{
  return (bytes + DirectAccess::alignment - 1) / DirectAccess::alignment * DirectAccess::alignment;
}
} // namespace

std::unique_ptr<DirectAccess> DirectAccess::open(const std::string& path)
{
#ifdef O_DIRECT
  const int descriptor = ::open(path.c_str(), O_RDWR | O_DIRECT | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor >= 0)
  {
    return std::unique_ptr<DirectAccess>(new DirectAccess(descriptor));
  }
#else
  static_cast<void>(path);
#endif
  return nullptr;
}

DirectAccess::~DirectAccess()
{
  ::close(descriptor_);
}

/// A buffer; null when there is no memory for one.
DirectAccess::Buffer DirectAccess::take()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!idle_.empty())
    {
      Buffer buffer = std::move(idle_.back());
      idle_.pop_back();
      return buffer;
    }
  }
  return Buffer(static_cast<std::byte*>(std::aligned_alloc(alignment, bufferBytes)));
}

void DirectAccess::giveBack(Buffer buffer)
{
  if (buffer)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    idle_.push_back(std::move(buffer));
  }
}

std::size_t DirectAccess::write(std::uint64_t offset, const std::byte* data, std::size_t bytes)
{
  Buffer buffer = take();
  const std::size_t whole = buffer ? bytes / alignment * alignment : 0;
  std::size_t done = 0;
  while (done < whole)
  {
    const std::size_t step = std::min(whole - done, bufferBytes);
    std::memcpy(buffer.get(), data + done, step);
    const auto place = static_cast<off_t>(offset + done);
    const std::size_t written =
      moved([&] { return ::pwrite(descriptor_, buffer.get(), step, place); });
    done += written;
    if (written < step)
    {
      break;
    }
  }
  giveBack(std::move(buffer));
  return done;
}

std::size_t DirectAccess::read(std::uint64_t offset, std::byte* data, std::size_t bytes)
{
  Buffer buffer = take();
  std::size_t done = 0;
  while (buffer && done < bytes)
  {
    const std::size_t before = static_cast<std::size_t>((offset + done) % alignment);
    const std::size_t step = std::min(bytes - done, bufferBytes - before);
    const std::size_t asked = roundedUp(before + step);
    const auto place = static_cast<off_t>(offset + done - before);
    const std::size_t got = moved([&] { return ::pread(descriptor_, buffer.get(), asked, place); });
    const std::size_t useful = std::min(step, got - std::min(got, before));
    std::memcpy(data + done, buffer.get() + before, useful);
    done += useful;
    if (useful < step)
    {
      break; // the file ends, or an error
    }
  }
  giveBack(std::move(buffer));
  return done;
}

} // namespace pointfront
