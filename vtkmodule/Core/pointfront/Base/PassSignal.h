#pragma once

#include <csignal>

namespace pointfront
{

/// Passes on a signal that is not the handler's own: calls the handler that was there
/// `before`, or gives the signal back its usual meaning, so that the access, tried again, ends the
/// process. Only what a signal handler may call.
inline void passSignal(const struct sigaction& before, int signal, siginfo_t* info, void* context)
{
  if ((before.sa_flags & SA_SIGINFO) != 0 && before.sa_sigaction != nullptr)
  {
    before.sa_sigaction(signal, info, context);
  }
  else if (before.sa_handler != SIG_DFL && before.sa_handler != SIG_IGN)
  {
    before.sa_handler(signal);
  }
  else
  {
    struct sigaction usual = {};
    usual.sa_handler = SIG_DFL;
    ::sigaction(signal, &usual, nullptr);
  }
}

} // namespace pointfront
