#include "CancelSignal.h"

#include "Command.h"

#include "pointfront/Disk/StopOfReads.h"

#include <unistd.h>

namespace pointfront
{

namespace
{
volatile std::sig_atomic_t signalled = 0;

// Called by the kernel on any thread: async-signal-safe calls only.
void remember(int)
{
  signalled = 1;
}

void leave(int)
{
  _exit(ExitStatus::Interrupted);
}
} // namespace

CancelSignal::CancelSignal(Mode mode)
{
  StopOfReads::setForProcess(&CancelSignal::requested); // a silent server holds nobody
  struct sigaction action = {};
  action.sa_handler = mode == Mode::Finish ? remember : leave;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, &oldInterrupt_);
  sigaction(SIGTERM, &action, &oldTerminate_);
  // A terminal that closes; `nohup` wants the command to go on.
  sigaction(SIGHUP, nullptr, &oldHangUp_);
  if (oldHangUp_.sa_handler != SIG_IGN)
  {
    sigaction(SIGHUP, &action, nullptr);
  }
}

CancelSignal::~CancelSignal()
{
  sigaction(SIGINT, &oldInterrupt_, nullptr);
  sigaction(SIGTERM, &oldTerminate_, nullptr);
  sigaction(SIGHUP, &oldHangUp_, nullptr);
}

bool CancelSignal::requested()
{
  return signalled != 0;
}

} // namespace pointfront
