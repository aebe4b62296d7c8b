#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <thread>
#include <vector>

namespace pointfront::truth
{

/// Calls work(row) for every row from 0 to count - 1, on `threads` threads (0: one a core). The
/// work of a row must not depend on other rows; then nothing depends on the threads.
inline void forEachRow(
  std::size_t count, unsigned threads, const std::function<void(std::size_t row)>& work)
{
  const unsigned cores = std::thread::hardware_concurrency();
  const unsigned crew = threads != 0 ? threads : cores != 0 ? cores : 1;
  std::atomic<std::size_t> next{ 0 };
  const auto run = [&]
  {
    for (std::size_t row = next++; row < count; row = next++)
    {
      work(row);
    }
  };
  std::vector<std::thread> others;
  for (unsigned i = 1; i < crew; ++i)
  {
    others.emplace_back(run);
  }
  run();
  for (std::thread& thread : others)
  {
    thread.join();
  }
}

} // namespace pointfront::truth
