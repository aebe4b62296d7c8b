#pragma once

#include <ctime>

namespace pointfront
{

/// CPU seconds of the calling thread.
inline double threadSeconds()
{
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// CPU seconds of all threads of the process.
inline double processSeconds()
{
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Adds the CPU time of its scope to a sum.
class CpuStopwatch
{
public:
  explicit CpuStopwatch(double& sum)
    : sum_(sum)
    , start_(threadSeconds())
  {
  }
  ~CpuStopwatch() { sum_ += threadSeconds() - start_; }
  CpuStopwatch(const CpuStopwatch&) = delete;
  CpuStopwatch& operator=(const CpuStopwatch&) = delete;

private:
  double& sum_;
  double start_;
};

} // namespace pointfront
