#include "pointfront/Threads/ThreadCrew.h"

#include "pointfront/Threads/OfProcess.h"
#include "pointfront/Threads/WorkerThread.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <list>
#include <mutex>
#include <utility>

namespace pointfront
{
namespace
{
/// The crew whose piece this thread works at, and its number there.
thread_local const void* crewOfPiece = nullptr;
thread_local unsigned numberInCrew = 0;
} // namespace

struct ThreadCrew::Content
{
  std::mutex callers; ///< one run() at a time
  std::mutex mutex; ///< guards what follows
  std::condition_variable begun;
  std::condition_variable ended;
  std::uint64_t round = 0;
  unsigned most = 0; ///< threads that take part in this round
  unsigned working = 0; ///< that have not ended this round
  bool leaving = false;
  std::exception_ptr failure;
  // State of the round:
  const std::function<void(std::size_t, unsigned)>* work = nullptr;
  std::size_t pieces = 0;
  std::atomic<std::size_t> next{ 0 };
  std::list<WorkerThread> threads;

  void takePart(unsigned thread)
  {
    const void* const crewBefore = std::exchange(crewOfPiece, this);
    const unsigned numberBefore = std::exchange(numberInCrew, thread);
    try
    {
      for (std::size_t piece = next++; piece < pieces; piece = next++)
      {
        (*work)(piece, thread);
      }
    }
    catch (...)
    {
      next = pieces;
      const std::lock_guard<std::mutex> lock(mutex);
      failure = failure ? failure : std::current_exception();
    }
    crewOfPiece = crewBefore;
    numberInCrew = numberBefore;
  }

  void wait(unsigned thread)
  {
    std::uint64_t seen = 0;
    std::unique_lock<std::mutex> lock(mutex);
    while (true)
    {
      begun.wait(lock, [&] { return leaving || round != seen; });
      if (leaving)
      {
        return;
      }
      seen = round;
      if (thread >= most)
      {
        continue;
      }
      lock.unlock();
      takePart(thread);
      lock.lock();
      if (--working == 0)
      {
        ended.notify_one();
      }
    }
  }
};

ThreadCrew& ThreadCrew::ofProcess()
{
  static OfProcess<ThreadCrew> crew;
  return crew.get(
    []
    {
      const char* const text = std::getenv("POINTFRONT_THREADS");
      const unsigned long wanted = text ? std::strtoul(text, nullptr, 10) : 0;
      return std::make_unique<ThreadCrew>(
        wanted > 0 ? static_cast<unsigned>(std::min(wanted, 256ul)) : threadsOr(0));
    });
}

ThreadCrew::ThreadCrew(unsigned threads)
  : content_(std::make_unique<Content>())
{
  for (unsigned thread = 1; thread < threads; ++thread)
  {
    WorkerThread& worker = content_->threads.emplace_back();
    if (!worker.start([content = content_.get(), thread] { content->wait(thread); }))
    {
      content_->threads.pop_back();
      break;
    }
  }
}

ThreadCrew::~ThreadCrew()
{
  {
    const std::lock_guard<std::mutex> lock(content_->mutex);
    content_->leaving = true;
  }
  content_->begun.notify_all();
  content_->threads.clear();
}

unsigned ThreadCrew::threads() const
{
  return static_cast<unsigned>(content_->threads.size()) + 1;
}

void ThreadCrew::run(
  std::size_t pieces, const std::function<void(std::size_t, unsigned)>& work, unsigned most)
{
  Content& content = *content_;
  if (crewOfPiece == &content)
  {
    for (std::size_t piece = 0; piece < pieces; ++piece)
    {
      work(piece, numberInCrew);
    }
    return;
  }
  const std::lock_guard<std::mutex> one(content.callers);
  const auto useful = static_cast<unsigned>(std::min<std::size_t>(pieces, threads()));
  const unsigned part = std::max(1u, most > 0 ? std::min(most, useful) : useful);
  content.work = &work;
  content.pieces = pieces;
  content.next = 0;
  if (part > 1)
  {
    const std::lock_guard<std::mutex> lock(content.mutex);
    content.most = part;
    content.working = part - 1;
    ++content.round;
  }
  if (part > 1)
  {
    content.begun.notify_all();
  }
  content.takePart(0);
  std::unique_lock<std::mutex> lock(content.mutex);
  content.ended.wait(lock, [&] { return content.working == 0; });
  const std::exception_ptr failure = std::exchange(content.failure, nullptr);
  lock.unlock();
  if (failure)
  {
    std::rethrow_exception(failure);
  }
}

} // namespace pointfront
