#include "PeakMemory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

namespace pointfront
{

std::uint64_t peakResidentBytes()
{
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024u; // Linux counts in KiB
}

std::uint64_t residentBytesNow()
{
  std::ifstream file("/proc/self/statm");
  std::uint64_t size = 0;
  std::uint64_t resident = 0; // pages
  file >> size >> resident;
  return file ? resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) : 0;
}

} // namespace pointfront
