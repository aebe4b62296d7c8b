#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Query/PlanarGeometry.h"

#include <string_view>

namespace pointfront
{

/// Areas and lines of a well-known text (OGC 06-103r4, section 7): POLYGON, MULTIPOLYGON, TRIANGLE,
/// LINESTRING, MULTILINESTRING and GEOMETRYCOLLECTION of these, EMPTY too; one after the other if
/// there are several. Words in any case; of Z and M coordinates x and y are taken; "SRID=n;" before
/// a geometry (EWKT) is its crs.
/// Errors  BadFormat, with what is wrong and at which byte: other geometries (points, curves),
///         numbers that are not finite, rings that are not closed.
Result<PlanarGeometry> parseWellKnownText(std::string_view text);

} // namespace pointfront
