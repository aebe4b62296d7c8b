#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Threads/WorkerThread.h"

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <mutex>
#include <vector>

namespace pointfront
{

/// How much is read ahead.
struct ReadAheadPlan
{
  std::size_t parts = 0; ///< held before they are taken, at most; 0: read when they are taken
  unsigned threads = 1; ///< that read, and mostly wait for the disk
};

/// Reads the parts of a pool on disk before they are asked for, so that threads that build trees do
/// not wait for the disk.
/// Order     begun in the order given; each is taken once, in about that order.
/// Memory    that of `parts` parts, and of those in take().
/// Errors    of reading a part, when that part is taken; NoMemory.
/// Threads   take() from any thread; reads on its own, which end with it: what they have begun is
///           finished, no more is begun.
class ReadAhead
{
public:
  using Records = Result<std::vector<std::byte>>;
  using Load = std::function<Records(std::uint32_t part)>;

  ReadAhead(std::vector<std::uint32_t> order, Load load, const ReadAheadPlan& plan);
  ~ReadAhead();
  ReadAhead(const ReadAhead&) = delete;
  ReadAhead& operator=(const ReadAhead&) = delete;

  /// Waits for the part, one of those in the order.
  Records take(std::uint32_t part);
  /// CPU seconds of reading, over all threads: those that take parts and its own.
  double seconds() const;

private:
  void work();
  Records loaded(std::uint32_t part);

  std::vector<std::uint32_t> order_;
  Load load_;
  std::size_t parts_;
  mutable std::mutex mutex_; // guards what follows
  std::condition_variable wanted_;
  std::condition_variable ready_;
  std::size_t next_ = 0; // in order_, to be read
  std::size_t taken_ = 0; // calls of take() so far
  bool over_ = false;
  bool noMemory_ = false; // to hold a part that was read
  std::map<std::uint32_t, Records> held_;
  double seconds_ = 0.0;
  std::list<WorkerThread> threads_; // not guarded: changed before they begin, and after
};

} // namespace pointfront
