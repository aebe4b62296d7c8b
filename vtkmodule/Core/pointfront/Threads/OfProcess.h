#pragma once

#include <atomic>
#include <memory>
#include <unistd.h>

namespace pointfront
{

/// Remembers in which process it was made. A child of fork() has the memory of its parent and none
/// of its threads: what waits for these threads there waits for ever.
/// Threads  a value.
class ProcessMark
{
public:
  /// The process is a child of the one that made this.
  bool left() const { return process_ != ::getpid(); }

private:
  ::pid_t process_ = ::getpid();
};

/// One object for each process. In a child of fork() the parent's is neither used nor destroyed:
/// its threads are not there, and others of the parent's threads may have held its locks.
/// Threads  get() from any; takes no lock, which a fork() might find taken.
template <typename T>
class OfProcess
{
public:
  OfProcess() = default;
  ~OfProcess()
  {
    Owned* const last = current_.load();
    if (last != nullptr && !last->mark.left())
    {
      delete last;
    }
  }
  OfProcess(const OfProcess&) = delete;
  OfProcess& operator=(const OfProcess&) = delete;

  /// `make` gives a std::unique_ptr<T>. Where two threads are first together, each makes one and
  /// both take the same.
  template <typename Make>
  T& get(const Make& make)
  {
    Owned* seen = current_.load();
    while (seen == nullptr || seen->mark.left())
    {
      auto own = std::make_unique<Owned>();
      own->object = make();
      if (current_.compare_exchange_strong(seen, own.get()))
      {
        seen = own.release();
      }
    }
    return *seen->object;
  }

private:
  struct Owned
  {
    ProcessMark mark;
    std::unique_ptr<T> object;
  };
  std::atomic<Owned*> current_{ nullptr };
};

} // namespace pointfront
