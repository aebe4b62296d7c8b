#pragma once

#include "ProjObject.h"

#include "pointfront/Base/Result.h"
#include "pointfront/Reference/CoordinateSystems.h"

#include <string>

namespace pointfront
{

/// Questions about one CRS in PROJ's hands. All objects belong to `context`.

/// Without the link to WGS 84 that TOWGS84 of WKT 1 adds, if the system has a code of its own:
/// PROJ's database knows better ones.
ProjObject unbound(const ProjContext& context, ProjObject crs);
/// The two horizontal axes: of a compound system its first part, of one with heights above the
/// ellipsoid the system without them.
ProjObject horizontalPart(const ProjContext& context, const PJconsts* crs);
/// The second part of a compound system; none otherwise.
ProjObject verticalPart(const ProjContext& context, const PJconsts* crs);

/// Nothing when `definition` is no CRS: the context's message says why.
ProjObject createSystem(const ProjContext& context, const std::string& definition);
/// `crs` in words and numbers. Error Unsupported: a system without horizontal axes.
Result<CoordinateSystem> describeSystem(const ProjContext& context, const PJconsts* crs);

} // namespace pointfront
