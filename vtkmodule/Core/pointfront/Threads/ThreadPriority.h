#pragma once

namespace pointfront
{

/// Lets other threads go first where there are not enough processors: FRONT-9, what loads or builds
/// must not disturb the drawing. A hint: where it is refused nothing is lost. Threads that the
/// calling one starts later have its priority. `niceness` as in nice(1).
void lowerThreadPriority(int niceness);

} // namespace pointfront
