/// @file
/// The distance or bound that nothing reaches.
#pragma once

#include <limits>

namespace pointfront
{

inline constexpr double infinity = std::numeric_limits<double>::infinity();

} // namespace pointfront
