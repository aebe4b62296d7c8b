#pragma once

#include <functional>

namespace pointfront
{

/// Runs `body`, whose recursion hostile bytes decide about, and survives it. Gives false where the
/// stack of the thread was used up: the frames of `body` are left then, and no destructor of theirs
/// runs. So `body` calls C, or C++ without objects that need one.
/// Threads  any. Cost  one system call a thread, and the keeping of some registers a call.
bool runWithinStack(const std::function<void()>& body);

} // namespace pointfront
