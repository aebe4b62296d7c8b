#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace pointfront
{

/// A range of memory that a file is mapped to, and whether a page of it was gone when it was
/// touched: another program has shortened the file. The system sends SIGBUS then. A handler gives
/// the range zeros from that page on and notes the loss, so that the thread goes on and its caller
/// asks lost(). Other SIGBUS go to the handler that was there before, or end the process as ever.
/// Threads  all functions from any thread; lost() is true for a thread that has met the page.
class WatchedPages
{
public:
  /// Never fails: without memory for it the range goes unwatched.
  WatchedPages(const void* begin, std::size_t size);
  ~WatchedPages();
  WatchedPages(const WatchedPages&) = delete;
  WatchedPages& operator=(const WatchedPages&) = delete;

  bool lost() const;

  /// The ranges that the handler reads. They are never freed: a handler may look at any time.
  struct Range
  {
    std::atomic<std::uintptr_t> begin{ 0 };
    std::atomic<std::uintptr_t> end{ 0 }; ///< 0: free
    std::atomic<bool> lost{ false };
    std::atomic<bool> taken{ false };
    Range* next = nullptr; ///< constant
  };

private:
  Range* range_ = nullptr;
};

} // namespace pointfront
