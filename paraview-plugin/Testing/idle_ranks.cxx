// Preloaded into ranks by programs.py: a rank that waits for another one sleeps. Open MPI yields
// the processor in a loop, which took a third of the processor seconds of a test of two ranks.

#include <time.h>

extern "C" int sched_yield() noexcept
{
  const timespec pause{ 0, 50000 };
  nanosleep(&pause, nullptr);
  return 0;
}
