#pragma once

#include "pointfront/Query/PointQuery.h"
#include "pointfront/Store/StoredCloud.h"

#include <optional>
#include <string>

namespace pointfront
{

/// Says why a query has no points if one of its regions lies beside the cloud, whatever its shape:
/// a sentence with the coordinates that the cloud has. Nothing where points are possible, and of a
/// cloud without points.
std::optional<std::string> missedRegion(const StoreDescription& store, const PointQuery& query);

} // namespace pointfront
