#include "pointfront/Threads/WorkerThread.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace pointfront
{

bool WorkerThread::start(std::function<void()> work) noexcept
{
  try
  {
    mark_ = ProcessMark();
    thread_ = std::thread(
      [kept = std::move(work)]
      {
        try
        {
          kept();
        }
        catch (const std::exception&)
        {
          return; // as the header says: who waits for the work was told by the work
        }
      });
  }
  catch (const std::exception&) // no thread, or no memory for one
  {
    return false;
  }
  return true;
}

void WorkerThread::join()
{
  if (thread_.joinable() && mark_.left())
  {
    // The handle may be that of another thread here, which has the same stack.
    static_cast<void>(new std::thread(std::move(thread_)));
  }
  else if (thread_.joinable())
  {
    thread_.join();
  }
}

void WorkerThread::detach()
{
  if (thread_.joinable())
  {
    thread_.detach();
  }
}

unsigned threadsOr(unsigned asked)
{
  return asked > 0 ? asked : std::max(1u, std::thread::hardware_concurrency());
}

} // namespace pointfront
