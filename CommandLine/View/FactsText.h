#pragma once

#include "StoreScene.h"

#include <string>

namespace pointfront
{

/// "1,234,567"
std::string grouped(std::int64_t number);
/// Time, points and error of a frame, two lines.
/// `loading`  something is on its way.
std::string factsText(const FrameRecord& frame, bool loading);

} // namespace pointfront
