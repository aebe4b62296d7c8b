#pragma once

#include <cstdint>

namespace pointfront
{

/// Largest resident set of this program so far, bytes (Linux: VmHWM; elsewhere getrusage).
std::uint64_t peakResidentBytes();
/// Resident set of this process at this moment, bytes (Linux: /proc); 0 where it is not told.
std::uint64_t residentBytesNow();

} // namespace pointfront
