#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Query/PlanarGeometry.h"
#include "pointfront/Store/StoredCloud.h"

#include <string>
#include <vector>

namespace pointfront
{

/// Areas and lines of a file of GeoJSON or well-known text, in the store's coordinates.
/// System    that of GeoJSON's "crs" or of an SRID; GeoJSON without one is longitude and latitude
///           of WGS 84 (RFC 7946) if its numbers can be that; all else is in the store's system.
///           Vertices are transformed, edges between them stay straight. A store without a system
///           takes the numbers as they are.
/// `notes`   gets a sentence where a system was assumed, or the transformation is doubtful.
/// Errors    Unreadable; BadFormat; BadArgument of the transformation.
Result<PlanarGeometry> readMapGeometry(
  const std::string& path, const StoreDescription& store, std::vector<std::string>& notes);

} // namespace pointfront
