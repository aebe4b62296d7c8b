#include "StackGuard.h"

#include "pointfront/Base/PassSignal.h"

#include <csetjmp>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <mutex>

#include <pthread.h>

namespace pointfront
{
namespace
{
constexpr std::size_t handlerStackBytes = std::size_t(64) << 10;
/// How far below the end of the stack, and above it, the address lies that a call could not write:
/// the guard pages of threads, the gap that the kernel keeps below the first thread's stack.
constexpr std::uintptr_t reachBelow = std::uintptr_t(1) << 20;
constexpr std::uintptr_t reachAbove = std::uintptr_t(64) << 10;

struct sigaction before = {}; // written before the handler can run

/// Where a thread's stack ends, and a second one for the handler, which finds no room on the first.
class ThreadStack
{
public:
  ThreadStack()
  {
    pthread_attr_t attributes;
    if (::pthread_getattr_np(::pthread_self(), &attributes) == 0)
    {
      void* lowest = nullptr;
      std::size_t bytes = 0;
      if (::pthread_attr_getstack(&attributes, &lowest, &bytes) == 0)
      {
        end_ = reinterpret_cast<std::uintptr_t>(lowest);
      }
      ::pthread_attr_destroy(&attributes);
    }
    stack_t had = {};
    // A thread of somebody who has prepared it keeps what it has.
    if (::sigaltstack(nullptr, &had) == 0 && (had.ss_flags & SS_DISABLE) != 0)
    {
      memory_ = std::malloc(handlerStackBytes);
      stack_t own = {};
      own.ss_sp = memory_;
      own.ss_size = handlerStackBytes;
      if (memory_ == nullptr || ::sigaltstack(&own, nullptr) != 0)
      {
        end_ = 0;
      }
    }
  }
  ~ThreadStack()
  {
    if (memory_ != nullptr)
    {
      stack_t none = {};
      none.ss_flags = SS_DISABLE;
      ::sigaltstack(&none, nullptr);
      std::free(memory_);
    }
  }
  ThreadStack(const ThreadStack&) = delete;
  ThreadStack& operator=(const ThreadStack&) = delete;

  bool known() const { return end_ != 0; }
  bool endsAt(std::uintptr_t address) const
  {
    return known() && address + reachBelow >= end_ && address < end_ + reachAbove;
  }

  sigjmp_buf* way = nullptr; ///< out of a body that runs; none: none runs

private:
  std::uintptr_t end_ = 0;
  void* memory_ = nullptr;
};

ThreadStack& ownStack()
{
  thread_local ThreadStack stack;
  return stack;
}

/// The same, for the handler, which may not make one.
thread_local ThreadStack* preparedStack = nullptr;

void onFault(int signal, siginfo_t* info, void* context)
{
  ThreadStack* const stack = preparedStack;
  if (stack != nullptr && stack->way != nullptr &&
    stack->endsAt(reinterpret_cast<std::uintptr_t>(info->si_addr)))
  {
    siglongjmp(*stack->way, 1);
  }
  passSignal(before, signal, info, context);
}

void installHandler()
{
  static std::once_flag once;
  std::call_once(once,
    []
    {
      struct sigaction now = {};
      now.sa_sigaction = &onFault;
      // Not deferred: the handler may be left by a jump, which does not unblock the signal.
      now.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER;
      ::sigemptyset(&now.sa_mask);
      ::sigaction(SIGSEGV, nullptr, &before);
      ::sigaction(SIGSEGV, &now, nullptr);
    });
}
} // namespace

bool runWithinStack(const std::function<void()>& body)
{
  installHandler();
  ThreadStack& stack = ownStack();
  preparedStack = &stack;
  if (!stack.known() || stack.way != nullptr)
  {
    body();
    return true;
  }
  sigjmp_buf way;
  // The mask of signals is not kept: nothing changes it.
  if (sigsetjmp(way, 0) != 0)
  {
    ownStack().way = nullptr;
    return false;
  }
  stack.way = &way;
  body();
  stack.way = nullptr;
  return true;
}

} // namespace pointfront
