#pragma once

#include <future>
#include <system_error>

namespace pointfront
{

/// Does work on a thread of its own; where the system gives none, when its result is asked for.
template <typename Work>
auto workBeside(const Work& work) -> std::future<decltype(work())>
{
  try
  {
    return std::async(std::launch::async, work);
  }
  catch (const std::system_error&)
  {
    return std::async(std::launch::deferred, work);
  }
}

} // namespace pointfront
