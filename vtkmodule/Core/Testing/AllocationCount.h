#pragma once

#include <cstddef>

/// Counted at operator new and delete of the whole test program.
namespace pointfront::test
{

/// Calls of operator new since the program began.
std::size_t allocationCount();
/// Bytes that are allocated now, as malloc hands them out.
std::size_t allocatedBytes();
/// The most since resetPeakBytes().
std::size_t peakAllocatedBytes();
void resetPeakBytes();

} // namespace pointfront::test
