#pragma once

#include <cstdint>

namespace pointfront
{

/// Bytes that the calling thread read from files: a frame that reads any waits for a disk, or may
/// if the pages are not in memory. Sockets and pipes to other programs do not count.
/// Source   /proc/thread-self/io of Linux; elsewhere, and where the kernel does not count, 0.
/// Threads  all calls from one.
class ThreadReads
{
public:
  ThreadReads() { since(); }
  /// Since the last call, that of the look itself left out.
  std::uint64_t since();
  /// Whether the system tells.
  bool known() const { return known_; }

private:
  std::uint64_t before_ = 0;
  bool known_ = false;
};

} // namespace pointfront
