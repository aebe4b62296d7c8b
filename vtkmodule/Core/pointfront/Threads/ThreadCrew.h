#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace pointfront
{

/// Threads that wait for work and do it together: for work that is cut into many pieces. Where the
/// system gives fewer threads than asked for, those that there are do it.
/// Order       pieces are handed out in ascending order, to whichever thread is free. Results must
///             not depend on which thread does which.
/// Errors      an exception of a piece stops the handing out and comes out of run(), the first one
///             if there are several.
/// Threads     run() from one thread at a time; a second caller waits. A piece that calls run() of
/// its
///             own crew does the pieces itself, as the thread that it is.
class ThreadCrew
{
public:
  /// The one that the process shares, for work that is over within a frame: as many threads as
  /// processors, the caller's included; with POINTFRONT_THREADS in the environment that many. A
  /// child of fork() has one of its own.
  static ThreadCrew& ofProcess();

  /// `threads` with the caller's; 0 is taken as 1.
  explicit ThreadCrew(unsigned threads);
  ~ThreadCrew();
  ThreadCrew(const ThreadCrew&) = delete;
  ThreadCrew& operator=(const ThreadCrew&) = delete;

  unsigned threads() const;

  /// Calls work(piece, thread) for each piece in [0, pieces), thread in [0, threads()), and returns
  /// when all are done. The caller's thread works too. At most `most` threads take part; 0: all.
  void run(
    std::size_t pieces, const std::function<void(std::size_t, unsigned)>& work, unsigned most = 0);

private:
  struct Content;
  std::unique_ptr<Content> content_;
};

} // namespace pointfront
