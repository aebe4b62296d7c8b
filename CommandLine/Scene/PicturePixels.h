#pragma once

#include "PNGWriter.h"
#include "SoftwareTarget.h"

#include "pointfront/Base/Result.h"

#include <array>
#include <memory>
#include <string>

namespace pointfront
{

/// Puts a colour, 0 to 1 a channel, behind what is drawn.
void putBackground(const std::array<double, 3>& colour, SoftwareTarget& target);

/// Whether a pixel shows a point.
bool showsPoints(const SoftwareTarget& target);

/// Begins a picture without alpha.
Result<std::unique_ptr<PNGWriter>> pngOf(const std::string& path, const std::array<int, 2>& size);
/// Writes rows [bottom, top) of the target, the top one first.
Result<void> appendRows(PNGWriter& png, const SoftwareTarget& target, int bottom, int top);

} // namespace pointfront
