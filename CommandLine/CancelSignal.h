#pragma once

#include <csignal>

namespace pointfront
{

/// SIGINT, SIGTERM and, unless it is ignored, SIGHUP while a command runs. Objects may be nested;
/// the handlers of before come back when one goes.
/// Modes    Finish: the signal only sets a flag; the operation sees it at its next progress report,
/// or
///          while it waits for a server, stops and removes what it had begun (builds, exports).
///          Leave: the process ends at once with status 130; for commands that have nothing on the
///          disk yet, whatever they are waiting for (a render in a driver, for example).
class CancelSignal
{
public:
  enum class Mode
  {
    Finish,
    Leave
  };
  explicit CancelSignal(Mode mode);
  ~CancelSignal();
  CancelSignal(const CancelSignal&) = delete;
  CancelSignal& operator=(const CancelSignal&) = delete;

  /// True once a signal came. Any thread.
  static bool requested();

private:
  struct sigaction oldInterrupt_;
  struct sigaction oldTerminate_;
  struct sigaction oldHangUp_;
};

} // namespace pointfront
