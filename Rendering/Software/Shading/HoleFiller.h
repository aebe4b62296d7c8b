#pragma once

#include "PixelRectangle.h"
#include "SoftwareTarget.h"

#include "pointfront/Plan/FrameCamera.h"
#include "pointfront/Style/FrameShading.h"

namespace pointfront
{

/// Depths agree within that many pixels' size.
constexpr float holeFillerAgreePx = 3.0f;

/// The rectangle from which the pixels of `place` and holes beside them are filled: whole blocks,
/// counted from the viewport's corner, and those around them.
PixelRectangle filledFrom(const PixelRectangle& place, const FrameCamera& camera);

/// Fills pixels that no splat covers, and those through which a farther surface shows, from the
/// nearest surface around them: a pyramid of means over pixels that agree in depth, then back down
/// (pull-push). A pixel is filled when most of its surroundings agree; the farther surface beside
/// an object stays. A filled pixel has the
/// highlight and the look of one that it is filled from.
/// Threads  one; works with those of ThreadCrew::ofProcess().
void fillHoles(const FrameCamera& camera, SoftwareTarget& target);

} // namespace pointfront
