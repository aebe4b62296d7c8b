#pragma once

#include "pointfront/Threads/OfProcess.h"

#include <functional>
#include <thread>

namespace pointfront
{

/// A thread that does not end the program: it may not be had, and what it runs may run out of
/// memory.
/// Errors    start() is false where the system gives no thread: who starts it does the work. An
///           exception that leaves the work ends the thread and nothing else; work that others
///           wait for catches its own and tells them.
/// Fork      a child process has not the thread: there, nobody waits for it.
/// Threads   called by one thread. Destruction waits for the work to end.
class WorkerThread
{
public:
  WorkerThread() = default;
  ~WorkerThread() { join(); }
  WorkerThread(const WorkerThread&) = delete;
  WorkerThread& operator=(const WorkerThread&) = delete;

  /// Begins the work; not while another is running.
  [[nodiscard]] bool start(std::function<void()> work) noexcept;
  /// Started, and neither joined nor detached since.
  bool started() const { return thread_.joinable(); }
  /// Waits for the work to end, if there is any.
  void join();
  /// Lets it end by itself: it holds all that it needs.
  void detach();

private:
  std::thread thread_;
  ProcessMark mark_; ///< mark of the process that started it
};

/// Threads for work of its own: as many as asked for; 0: as there are processors.
unsigned threadsOr(unsigned asked);

} // namespace pointfront
