#pragma once

#include "pointfront/Threads/WorkerThread.h"

#include <array>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <string>

namespace pointfront
{

/// Appends bytes to a file past the page cache. Bytes that are written once and not read soon would
/// cost a page of memory and a copy there, for each 4 KiB. It gathers whole blocks in its own
/// memory and writes them at once on its own thread: the appending thread waits only if the disk is
/// slower.
/// Memory   two buffers: one is gathered in while the other is written.
/// Threads  called from one thread.
class DirectAppender
{
public:
  /// Bytes gathered before they are written.
  static constexpr std::size_t bufferBytes = std::size_t(2) << 20;

  /// Bytes that belong to the file and may not be in it yet.
  struct Span
  {
    std::uint64_t begin = 0; ///< byte of the file
    const std::byte* data = nullptr;
    std::size_t size = 0;
  };

  /// For an empty file; nullptr where files cannot be written that way.
  static std::unique_ptr<DirectAppender> open(const std::string& path);
  /// Whether everything that was handed over is written.
  ~DirectAppender();
  DirectAppender(const DirectAppender&) = delete;
  DirectAppender& operator=(const DirectAppender&) = delete;

  /// Takes as much as fits; returns how much that was.
  std::size_t take(const std::byte* data, std::size_t size);
  bool full() const { return gathered_.size == bufferBytes; }
  /// Hands over the buffer, which is full, to be written; the other one is gathered in then. False
  /// when the one before was not written, or not as a whole: both are still here.
  bool write();
  /// The bytes that were taken and are not in the file, in its order: those of a buffer that could
  /// not be written, and of the one that is gathered in. Waits for what is being written.
  std::array<Span, 2> unwritten();

private:
  struct Release
  {
    void operator()(std::byte* memory) const { std::free(memory); }
  };
  using Memory = std::unique_ptr<std::byte, Release>;

  /// Bytes from `begin` of the file on.
  struct Buffer
  {
    Memory memory;
    std::uint64_t begin = 0;
    std::size_t size = 0;
  };

  DirectAppender(int descriptor, Memory first, Memory second);
  bool writeHanded() const;
  void awaitWritten(std::unique_lock<std::mutex>& lock);
  bool startThread();
  void work();

  int descriptor_;
  Buffer gathered_;
  std::mutex mutex_; // guards what follows
  std::condition_variable changed_;
  Buffer handed_; // empty once it is written
  bool writing_ = false;
  bool over_ = false;
  WorkerThread thread_; // from the first full buffer on
};

} // namespace pointfront
