#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Query/Region.h"

#include <memory>
#include <string_view>

namespace pointfront
{

/// Reads a well-known text as a region of a query: points above and below its areas, or within
/// `distance` of its lines on the map.
/// Errors  those of parseWellKnownText(); BadArgument: a text that names a coordinate reference
///         system, lines without a distance above 0, or areas beside lines.
Result<std::shared_ptr<const Region>> regionOfText(std::string_view text, double distance);

} // namespace pointfront
