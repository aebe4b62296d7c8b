#pragma once

#include "DrawingOptions.h"
#include "FrameRecord.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace pointfront
{

/// Says on stderr what --quality chose, where it was a number; a warning where no place on the
/// curve has what was asked.
void tellQuality(const std::string& command, const DrawingOptions& drawing);

/// Adds what was asked of --quality and chosen, where it was a number, as "quality"; and as
/// "expected" how far such a frame is from the truth by the curve of docs/tradeoffs.md: least,
/// middle and most of its scenes. Null where its technique or its error was not measured.
void addQuality(
  nlohmann::ordered_json& statistics, const DrawingOptions& drawing, const FrameRecord& last);

} // namespace pointfront
