#include "PeakMemory.h"

#include <sys/resource.h>

namespace pointfront
{

std::uint64_t peakResidentBytes()
{
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024u; // Linux counts in KiB
}

} // namespace pointfront
