/// @file Infinity: a distance or bound that no value reaches.
#pragma once

#include <limits>

namespace pointfront
{

inline constexpr double infinity = std::numeric_limits<double>::infinity();

} // namespace pointfront
