#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Query/PlanarGeometry.h"

#include <string>

namespace pointfront
{

/// Areas and lines of a GeoJSON text (RFC 7946): features and their collections, geometries and
/// their collections; of coordinates x and y. A member "crs" of the format's first version, which
/// GIS programs still write, is the geometry's crs; without it that stays empty.
/// Errors  BadFormat, with what is wrong and where: points, rings that are not closed, numbers that
///         are none.
Result<PlanarGeometry> parseGeoJSON(const std::string& text);

} // namespace pointfront
