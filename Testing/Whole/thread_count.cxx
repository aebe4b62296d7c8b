// Preloaded by test_random_pairs.py: a machine with as many processors as the environment says.

#include <cstdlib>
#include <thread>

unsigned std::thread::hardware_concurrency() noexcept
{
  const char* const text = std::getenv("POINTFRONT_TEST_THREADS");
  const long count = text ? std::strtol(text, nullptr, 10) : 0;
  return count > 0 ? static_cast<unsigned>(count) : 1;
}
