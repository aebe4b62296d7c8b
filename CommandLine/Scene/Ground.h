#pragma once

#include "pointfront/Base/Result.h"

namespace pointfront
{

class StoredCloud;

/// Median z of a sample of the store's points, world units: how high a flight has to be. Reads
/// nodes.
Result<double> groundOf(const StoredCloud& store);

} // namespace pointfront
