#pragma once

#include <mutex>

namespace pointfront
{

/// While one exists, fork() waits: a child of fork() finds what was done under it whole, or not
/// begun.
/// Without it, the child of a fork() during the first use of a static object, or under another
/// thread's lock, waits for ever for a thread that it has not.
/// For       what is made once in a process by threads that others may fork beside, and tables that
///           a child inherits; calls of libraries which do the like.
/// Threads   any; one exists at a time in a process, so it also guards what it is made for.
/// Never     a second one in the same thread, and no fork() there: either would wait for ever.
class ForkHold
{
public:
  ForkHold();

private:
  std::lock_guard<std::mutex> lock_;
};

} // namespace pointfront
