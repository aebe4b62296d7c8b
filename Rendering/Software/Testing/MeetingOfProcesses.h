#pragma once

#include "pointfront/Plan/PictureExchange.h"

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <mutex>
#include <vector>

namespace pointfront::test
{

/// Where processes that draw one picture meet, as threads play them: in each call of an exchange.
class MeetingOfProcesses
{
public:
  explicit MeetingOfProcesses(int processes)
    : processes_(processes)
  {
  }
  void nearest(float* depths, std::size_t count)
  {
    reduce(least_, std::numeric_limits<float>::infinity(), depths, count,
      [](float a, float b) { return std::min(a, b); });
  }
  void sum(std::uint32_t* sums, std::size_t count)
  {
    reduce(sums_, 0u, sums, count, std::plus<std::uint32_t>());
  }

private:
  template <typename T, typename Join>
  void reduce(std::vector<T>& all, T nothing, T* values, std::size_t count, const Join& join)
  {
    std::unique_lock<std::mutex> lock(mutex_);
    all.resize(std::max(all.size(), count), nothing);
    std::transform(values, values + count, all.begin(), all.begin(), join);
    meet(lock);
    std::copy_n(all.begin(), count, values);
    meet(lock);
    all.clear();
    meet(lock);
  }

  void meet(std::unique_lock<std::mutex>& lock)
  {
    const int round = round_;
    if (++here_ == processes_)
    {
      here_ = 0;
      ++round_;
      all_.notify_all();
      return;
    }
    all_.wait(lock, [&] { return round_ != round; });
  }

  const int processes_;
  int here_ = 0;
  int round_ = 0;
  std::mutex mutex_;
  std::condition_variable all_;
  std::vector<float> least_;
  std::vector<std::uint32_t> sums_;
};

class ProcessOfMeeting final : public PictureExchange
{
public:
  explicit ProcessOfMeeting(MeetingOfProcesses& meeting)
    : meeting_(meeting)
  {
  }
  bool nearest(float* depths, std::size_t count) override
  {
    meeting_.nearest(depths, count);
    return true;
  }
  void sum(std::uint32_t* sums, std::size_t count) override { meeting_.sum(sums, count); }

private:
  MeetingOfProcesses& meeting_;
};

} // namespace pointfront::test
