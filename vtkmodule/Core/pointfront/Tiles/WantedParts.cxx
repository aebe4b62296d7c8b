#include "pointfront/Tiles/WantedParts.h"

#include <algorithm>
#include <utility>

namespace pointfront
{

void WantedParts::want(std::size_t part)
{
  const auto among = [part](const std::vector<std::size_t>& parts)
  { return std::find(parts.begin(), parts.end(), part) != parts.end(); };
  const std::lock_guard<std::mutex> lock(mutex_);
  if (wanted_.size() == most || among(wanted_) || among(beingRead_))
  {
    return;
  }
  wanted_.push_back(part);
  if (!any_.exchange(true))
  {
    for (const auto& [reader, tell] : readers_)
    {
      tell();
    }
  }
}

void WantedParts::noteFault(std::size_t part, const Error& error)
{
  const std::lock_guard<std::mutex> lock(faultMutex_);
  if (lost_.insert(part).second)
  {
    firstFault_ = firstFault_ ? firstFault_ : error;
    newFaults_.push_back(error);
  }
}

std::size_t WantedParts::readNext()
{
  std::vector<std::size_t> parts;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (wanted_.empty())
    {
      return 0;
    }
    const std::size_t count = std::min(wanted_.size(), reading_.atOnce(wanted_.front()));
    const auto end = wanted_.begin() + static_cast<std::ptrdiff_t>(count);
    parts.assign(wanted_.begin(), end);
    beingRead_.insert(beingRead_.end(), parts.begin(), parts.end());
    wanted_.erase(wanted_.begin(), end);
    any_ = !wanted_.empty();
  }
  const auto ended = [this](std::size_t part)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto place = std::find(beingRead_.begin(), beingRead_.end(), part);
    if (place != beingRead_.end())
    {
      beingRead_.erase(place);
    }
    ++arrivals_;
    changed_.notify_all();
  };
  try
  {
    // A row has come or is lost, in any case.
    return std::max<std::size_t>(1, reading_.read(parts, ended));
  }
  catch (...)
  {
    std::for_each(parts.begin(), parts.end(), ended); // they can be asked for again
    throw;
  }
}

void WantedParts::attach(const void* reader, std::function<void()> tell)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  readers_[reader] = std::move(tell);
  left_ = false;
}

void WantedParts::detach(const void* reader)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  readers_.erase(reader);
  left_ = readers_.empty();
  changed_.notify_all();
}

bool WantedParts::wait(std::uint64_t seen, std::chrono::steady_clock::time_point end)
{
  std::unique_lock<std::mutex> lock(mutex_);
  while (arrivals_ == seen && !(wanted_.empty() && beingRead_.empty()))
  {
    if (std::chrono::steady_clock::now() >= end)
    {
      return true;
    }
    if (readers_.empty() && !wanted_.empty())
    {
      left_ = false;
      lock.unlock();
      readNext();
      lock.lock();
    }
    else
    {
      changed_.wait_until(lock, end);
    }
  }
  return arrivals_ != seen;
}

std::optional<Error> WantedParts::fault() const
{
  const std::lock_guard<std::mutex> lock(faultMutex_);
  return firstFault_;
}

std::vector<Error> WantedParts::takeFaults()
{
  const std::lock_guard<std::mutex> lock(faultMutex_);
  return std::exchange(newFaults_, {});
}

} // namespace pointfront
