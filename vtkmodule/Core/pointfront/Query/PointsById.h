#pragma once

#include "pointfront/Query/QueryBatch.h"
#include "pointfront/Store/StoredCloud.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// Points of a stored cloud by their numbers (QueryBatch::ids): what was picked or selected, with
/// its stored coordinates and attributes. Each node that holds one is read once. `ids` strictly
/// ascending. `attributes`  names; nothing: all. Order         of the ids. Errors BadArgument: ids
/// that are not ascending, or not in the cloud; an attribute that
///               it has not; else those of sweepNodes(), also for the budget.
Result<QueryReport> pointsById(const StoredCloud& store, const std::vector<std::uint64_t>& ids,
  const std::optional<std::vector<std::string>>& attributes, const QueryOptions& options,
  const QueryConsumer& consume);

} // namespace pointfront
