#pragma once

#include "SoftwareTarget.h"

#include "pointfront/Plan/FrameCamera.h"
#include "pointfront/Style/FrameShading.h"

namespace pointfront
{

/// Fills pixels that no splat covers, and those through which a farther surface shows, from the
/// nearest surface around them: a pyramid of means over pixels that agree in depth, then back down
/// (pull-push). A pixel is filled when most of its surroundings agree; the farther surface beside
/// an object stays.
/// Threads  one; works with those of ThreadCrew::ofProcess().
void fillHoles(const FrameCamera& camera, SoftwareTarget& target);

} // namespace pointfront
