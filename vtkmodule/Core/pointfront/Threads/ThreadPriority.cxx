#include "pointfront/Threads/ThreadPriority.h"

#if defined(__linux__)
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace pointfront
{

void lowerThreadPriority([[maybe_unused]] int niceness)
{
#if defined(__linux__)
  static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), niceness));
#endif
}

} // namespace pointfront
