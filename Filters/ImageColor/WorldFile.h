#pragma once

#include "GeoTransform.h"

#include "pointfront/Base/Result.h"

#include <string>

namespace pointfront
{

/// The world file beside an image: its extension with "w" appended (a.tifw), its first and last
/// letter and "w" (a.tfw, a.jgw, a.pgw), or a.wld; also in capitals. "" if there is none.
std::string worldFileOf(const std::string& image);

/// Six numbers, one a line: A, D, B, E, and C, F, the CENTRE of the upper left pixel:
/// x = A column + B row + C, y = D column + E row + F.
/// Source   ESRI technical article 000002860.
/// Errors   BadFormat: fewer than six numbers, or pixels without an area.
Result<GeoTransform> readWorldFile(const std::string& path);

} // namespace pointfront
