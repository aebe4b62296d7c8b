#pragma once

#include <functional>

namespace pointfront
{

/// While one exists, reads of its thread from far sources end with Cancelled a few hundredths of a
/// second after `stopped` says true. Openings, and what they read, have no other stop; reads that
/// have one end by either. Files on a disk are read to the end.
/// Nested   each of them ends the reads.
/// Threads  of its own thread; `stopped` is called by it, and by those that carry() it on.
class StopOfReads
{
public:
  explicit StopOfReads(std::function<bool()> stopped);
  ~StopOfReads();
  StopOfReads(const StopOfReads&) = delete;
  StopOfReads& operator=(const StopOfReads&) = delete;

  /// For all threads of this process besides, such as the state of a signal. Null: none.
  static void setForProcess(bool (*stopped)());
  /// Whether a read of this thread is to end.
  static bool asked();
  /// A predicate of this thread's stops for a thread that works for it. It holds as long as they.
  static std::function<bool()> carry();

private:
  bool askedHere() const;

  const std::function<bool()> stopped_;
  const StopOfReads* const outer_;
};

} // namespace pointfront
