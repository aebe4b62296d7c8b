#include "CancelSignal.h"

#include "Command.h"

#include <csignal>
#include <unistd.h>

namespace pointfront
{

namespace
{
volatile std::sig_atomic_t signalled = 0;
struct sigaction oldInterrupt;
struct sigaction oldTerminate;

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
  signalled = 0;
  struct sigaction action = {};
  action.sa_handler = mode == Mode::Finish ? remember : leave;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, &oldInterrupt);
  sigaction(SIGTERM, &action, &oldTerminate);
}

CancelSignal::~CancelSignal()
{
  sigaction(SIGINT, &oldInterrupt, nullptr);
  sigaction(SIGTERM, &oldTerminate, nullptr);
}

bool CancelSignal::requested()
{
  return signalled != 0;
}

} // namespace pointfront
