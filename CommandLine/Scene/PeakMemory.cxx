#include "PeakMemory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <string>

namespace pointfront
{

std::uint64_t peakResidentBytes()
{
  // Not getrusage: its number begins with what the parent held when it started this program.
  std::ifstream file("/proc/self/status");
  std::string word;
  std::uint64_t kibibytes = 0;
  while (file >> word)
  {
    if (word == "VmHWM:" && file >> kibibytes)
    {
      return kibibytes * 1024u;
    }
  }
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
