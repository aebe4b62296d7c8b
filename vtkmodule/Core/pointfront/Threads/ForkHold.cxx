#include "pointfront/Threads/ForkHold.h"

#include <pthread.h>

namespace pointfront
{
namespace
{
std::mutex held; // begun when the program is loaded, before any thread

[[maybe_unused]] const int asked =
  ::pthread_atfork([] { held.lock(); }, [] { held.unlock(); }, [] { held.unlock(); });
} // namespace

ForkHold::ForkHold()
  : lock_(held)
{
}

} // namespace pointfront
