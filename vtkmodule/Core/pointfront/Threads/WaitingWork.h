#pragma once

#include <cstddef>
#include <functional>

namespace pointfront
{

/// Calls work(0) to work(pieces - 1) on at most `most` threads at a time, the caller's among them,
/// each piece once, begun in ascending order. For pieces that wait for others (servers): there may
/// be more threads than processors. Where the system gives fewer threads, those that there are do
/// it.
/// Errors  an exception of a piece comes out of it when all that was begun has ended, the first one
///         if there are several; pieces that were not begun are left out.
void runWaiting(std::size_t pieces, std::size_t most, const std::function<void(std::size_t)>& work);

} // namespace pointfront
