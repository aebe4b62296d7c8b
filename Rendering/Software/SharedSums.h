#pragma once

#include "RasterBuffers.h"
#include "SoftwareTarget.h"

#include "pointfront/Plan/PictureExchange.h"

#include <cstdint>
#include <vector>

namespace pointfront
{

/// Makes the depths behind which nothing is added up those of all processes; where nothing is drawn
/// they are minus infinity. False, and they are as they were, if the processes do not agree in the
/// number of pixels.
bool shareDepths(PictureExchange& others, float* depths, std::int64_t count);

/// Makes the first thread's sums those of all threads and processes, and those of other threads
/// none.
void shareSums(PictureExchange& others, std::vector<ThreadBuffers>& threads, std::int64_t count);

/// Makes an opaque picture that of all processes: in each pixel what is nearest, by what decided
/// where the target keeps that. Unchanged if they do not agree in the number of pixels. Looks and
/// highlights are exchanged where the target has them; normals and points stay this process's own.
void sharePicture(PictureExchange& others, SoftwareTarget& target);

} // namespace pointfront
