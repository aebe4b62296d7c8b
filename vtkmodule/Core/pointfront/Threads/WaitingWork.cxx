#include "pointfront/Threads/WaitingWork.h"

#include "pointfront/Threads/WorkerThread.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <list>
#include <mutex>

namespace pointfront
{

void runWaiting(std::size_t pieces, std::size_t most, const std::function<void(std::size_t)>& work)
{
  std::atomic<std::size_t> next{ 0 };
  std::mutex mutex; // guards fault
  std::exception_ptr fault;
  const auto several = [&]
  {
    try
    {
      for (std::size_t i = next++; i < pieces; i = next++)
      {
        work(i);
      }
    }
    catch (...)
    {
      next = pieces;
      const std::lock_guard<std::mutex> lock(mutex);
      fault = fault ? fault : std::current_exception();
    }
  };
  {
    std::list<WorkerThread> threads; // destruction waits for them
    while (threads.size() + 1 < std::min(pieces, most))
    {
      if (!threads.emplace_back().start(several))
      {
        threads.pop_back();
        break;
      }
    }
    several();
  }
  if (fault)
  {
    std::rethrow_exception(fault);
  }
}

} // namespace pointfront
