#include "SplatCodes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <thread>

namespace pointfront
{
namespace
{
/// The code of radius 1. Codes 1 to 4095 are radii of 2^-128 to 2^127.9.
constexpr int codeOfOne = 2048;
constexpr int lastByte = 255;
} // namespace

WaitingRadius waitingRadius(double radius)
{
  if (!(radius > 0.0))
  {
    return 0;
  }
  const double most = std::ldexp(1.0, 127);
  int exponent = 0;
  const double mantissa =
    2.0 * std::frexp(std::clamp(radius, std::ldexp(1.0, -127), most), &exponent);
  const auto step = std::lower_bound(splat::sixteenths.begin(), splat::sixteenths.end(), mantissa) -
    splat::sixteenths.begin();
  const int code = codeOfOne + splat::codesPerDoubling * (exponent - 1) + static_cast<int>(step);
  return static_cast<WaitingRadius>(code);
}

void SplatCodes::count(WaitingRadius radius)
{
  thread_local const std::size_t share =
    std::hash<std::thread::id>()(std::this_thread::get_id()) % shares;
  counts_[share][radius].fetch_add(1, std::memory_order_relaxed);
}

double SplatCodes::base() const
{
  std::array<std::uint64_t, codes> sums{};
  std::uint64_t total = 0;
  std::size_t low = codes;
  std::size_t high = 0;
  for (std::size_t code = 1; code < codes; ++code)
  {
    for (const auto& share : counts_)
    {
      sums[code] += share[code];
    }
    total += sums[code];
    low = sums[code] > 0 ? std::min(low, code) : low;
    high = sums[code] > 0 ? code : high;
  }
  if (total == 0)
  {
    return 0.0;
  }
  std::size_t middle = (low + high) / 2;
  if (high - low > std::size_t(lastByte) - splat::codesPerDoubling)
  {
    middle = low;
    for (std::uint64_t below = sums[low]; below < (total + 1) / 2; below += sums[middle])
    {
      ++middle;
    }
  }
  const double doublings =
    static_cast<double>(static_cast<int>(middle) - codeOfOne) / splat::codesPerDoubling;
  return std::ldexp(1.0, static_cast<int>(std::lround(doublings)));
}

std::uint8_t splatCode(WaitingRadius radius, double base)
{
  if (radius == 0 || !(base > 0.0))
  {
    return unknownSplatRadius;
  }
  const int code = static_cast<int>(radius) - codeOfOne + splat::codeOfBase -
    splat::codesPerDoubling * std::ilogb(base);
  return static_cast<std::uint8_t>(std::clamp(code, 1, lastByte));
}

} // namespace pointfront
