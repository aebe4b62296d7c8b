#pragma once

#include "BuildOrder.h"

#include <nlohmann/json_fwd.hpp>

namespace pointfront
{

/// A build as Python asks for it, by the names of pointfront.build(), whose checks it has passed;
/// what is not named has its default.
BuildOrder buildOrderOf(const nlohmann::json& request);

} // namespace pointfront
