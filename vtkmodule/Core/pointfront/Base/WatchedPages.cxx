#include "pointfront/Base/WatchedPages.h"

#include "pointfront/Base/PassSignal.h"

#include <csignal>
#include <mutex>
#include <new>

#include <sys/mman.h>
#include <unistd.h>

namespace pointfront
{
namespace
{
using Range = WatchedPages::Range;

std::atomic<Range*> ranges{ nullptr };
struct sigaction before = {}; // written before the handler can run
std::uintptr_t pageBytes = 4096; // likewise
static_assert(std::atomic<std::uintptr_t>::is_always_lock_free, "a signal handler reads it");

/// Only what a signal handler may call: mmap is a bare system call.
bool giveZeros(std::uintptr_t address)
{
  for (Range* range = ranges.load(); range != nullptr; range = range->next)
  {
    const std::uintptr_t begin = range->begin.load(), end = range->end.load();
    if (address < begin || address >= end)
    {
      continue;
    }
    // A missing page is the end of the file: one fault for all of it.
    const std::uintptr_t page = address / pageBytes * pageBytes;
    range->lost.store(true);
    return ::mmap(reinterpret_cast<void*>(page), end - page, PROT_READ,
             MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED | MAP_NORESERVE, -1, 0) != MAP_FAILED;
  }
  return false;
}

void onBusError(int signal, siginfo_t* info, void* context)
{
  if (info->si_code == BUS_ADRERR && giveZeros(reinterpret_cast<std::uintptr_t>(info->si_addr)))
  {
    return;
  }
  passSignal(before, signal, info, context);
}

void installHandler()
{
  static std::once_flag once;
  std::call_once(once,
    []
    {
      pageBytes = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
      struct sigaction now = {};
      now.sa_sigaction = &onBusError;
      now.sa_flags = SA_SIGINFO | SA_ONSTACK;
      ::sigemptyset(&now.sa_mask);
      ::sigaction(SIGBUS, nullptr, &before);
      ::sigaction(SIGBUS, &now, nullptr);
    });
}

Range* freeRange()
{
  for (Range* range = ranges.load(); range != nullptr; range = range->next)
  {
    bool taken = false;
    if (range->taken.compare_exchange_strong(taken, true))
    {
      return range;
    }
  }
  auto* const added = new (std::nothrow) Range;
  if (added != nullptr)
  {
    added->taken.store(true);
    added->next = ranges.load();
    while (!ranges.compare_exchange_weak(added->next, added))
    {
    }
  }
  return added;
}
} // namespace

WatchedPages::WatchedPages(const void* begin, std::size_t size)
{
  installHandler();
  range_ = freeRange();
  if (range_ != nullptr)
  {
    range_->lost.store(false);
    range_->begin.store(reinterpret_cast<std::uintptr_t>(begin));
    // To the end of the last page, all of which is mapped.
    const std::uintptr_t end = reinterpret_cast<std::uintptr_t>(begin) + size;
    range_->end.store((end + pageBytes - 1) / pageBytes * pageBytes);
  }
}

WatchedPages::~WatchedPages()
{
  if (range_ != nullptr)
  {
    range_->end.store(0);
    range_->taken.store(false);
  }
}

bool WatchedPages::lost() const
{
  return range_ != nullptr && range_->lost.load();
}

} // namespace pointfront
