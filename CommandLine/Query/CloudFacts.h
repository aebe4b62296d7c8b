#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Points/AttributeSchema.h"
#include "pointfront/Statistics/PointStatistics.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace pointfront
{

/// Facts that `info` tells of stores and of point files in the same words.

/// [x0, y0, z0, x1, y1, z1]; null for an empty box.
nlohmann::ordered_json boundsJson(const Bounds& bounds);
/// "x y z to x y z", or "none".
std::string boundsText(const Bounds& bounds);
/// "3 not a number, 1 infinite"; empty if there are none.
std::string rejectedText(const PointCount& counted);
/// Reason -> points.
nlohmann::ordered_json rejectedJson(const PointCount& counted);
/// A list of {name, type, components}.
nlohmann::ordered_json attributesJson(const AttributeSchema& schema);
/// "intensity:uint16 rgb:uint8x3".
std::string attributesText(const AttributeSchema& schema);

} // namespace pointfront
