#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Records/RecordPool.h"
#include "pointfront/Threads/WorkerThread.h"

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <vector>

namespace pointfront
{

/// Writes blocks of records to a pool on disk while the next blocks are read. Reading threads do
/// not wait for the disk; they wait for a buffer if the disk is slower.
/// Memory    `buffers` blocks; they are used again.
/// Errors    the first of any write; from then on nothing is written.
/// Threads   buffer() and write() from any thread; writes on one of its own, or in write() if there
///           is none to be had. The end waits for what was handed over.
class WriteBehind
{
public:
  using Buffer = std::vector<std::byte>;

  WriteBehind(RecordPool& pool, std::size_t buffers);
  ~WriteBehind();
  WriteBehind(const WriteBehind&) = delete;
  WriteBehind& operator=(const WriteBehind&) = delete;

  /// A buffer of at least `bytes`, with anything in it; each goes back by write(). Waits for one.
  Result<Buffer> buffer(std::size_t bytes);
  /// The first `count` records of the buffer, to `first` and on.
  void write(std::uint64_t first, std::uint64_t count, Buffer records);
  /// Waits until all is written.
  Result<void> finish();
  double seconds() const; ///< CPU, of writing

private:
  struct Block
  {
    std::uint64_t first = 0;
    std::uint64_t count = 0;
    Buffer records;
  };
  void work();
  void writeNext(std::unique_lock<std::mutex>& lock);
  Result<void> outcome() const;

  RecordPool& pool_;
  mutable std::mutex mutex_; // guards what follows
  std::condition_variable handed_;
  std::condition_variable written_;
  std::deque<Block> blocks_;
  std::vector<Buffer> idle_;
  std::size_t underWay_ = 0; // blocks handed over and not written
  bool over_ = false;
  std::optional<Error> error_;
  double seconds_ = 0.0;
  WorkerThread thread_;
};

} // namespace pointfront
