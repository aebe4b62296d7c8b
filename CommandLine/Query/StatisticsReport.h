#pragma once

#include "pointfront/Statistics/PointStatistics.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace pointfront
{

/// The key `stats` of `info --stats --json`.
nlohmann::ordered_json statisticsJson(const PointStatistics& statistics);
/// Tables for people, one for all points and one for each class. Begins with a line break.
std::string statisticsText(const PointStatistics& statistics);

} // namespace pointfront
