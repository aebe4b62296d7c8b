#pragma once

#include <cstdint>

namespace pointfront
{

/// Largest resident set of this process so far, bytes (getrusage).
std::uint64_t peakResidentBytes();

} // namespace pointfront
