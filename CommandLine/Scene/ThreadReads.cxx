#include "ThreadReads.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>

namespace pointfront
{

std::uint64_t ThreadReads::since()
{
  const int file = open("/proc/thread-self/io", O_RDONLY | O_CLOEXEC);
  if (file < 0)
  {
    return 0;
  }
  std::array<char, 512> text{};
  const ssize_t length = read(file, text.data(), text.size() - 1);
  close(file);
  unsigned long long bytes = 0;
  known_ = length > 0 && std::sscanf(text.data(), "rchar: %llu", &bytes) == 1;
  if (!known_)
  {
    return 0;
  }
  const std::uint64_t taken = bytes - before_;
  // The text was made before its own bytes were counted.
  before_ = bytes + static_cast<std::uint64_t>(length);
  return taken;
}

} // namespace pointfront
