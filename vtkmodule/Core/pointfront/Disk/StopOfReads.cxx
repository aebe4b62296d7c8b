#include "pointfront/Disk/StopOfReads.h"

#include <atomic>
#include <utility>

namespace pointfront
{
namespace
{
using Stopped = bool (*)();
std::atomic<Stopped> ofProcess{ nullptr };
thread_local const StopOfReads* innermost = nullptr;
} // namespace

StopOfReads::StopOfReads(std::function<bool()> stopped)
  : stopped_(std::move(stopped))
  , outer_(innermost)
{
  innermost = this;
}

StopOfReads::~StopOfReads()
{
  innermost = outer_;
}

void StopOfReads::setForProcess(bool (*stopped)())
{
  ofProcess = stopped;
}

bool StopOfReads::askedHere() const
{
  return stopped_() || (outer_ != nullptr && outer_->askedHere());
}

bool StopOfReads::asked()
{
  const Stopped process = ofProcess;
  return (process != nullptr && process()) || (innermost != nullptr && innermost->askedHere());
}

std::function<bool()> StopOfReads::carry()
{
  return [stop = innermost] { return stop != nullptr && stop->askedHere(); };
}

} // namespace pointfront
