#include "pointfront/Statistics/ValueSteps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pointfront
{
namespace
{
constexpr int stepBits = 44;

double wideAsDouble(StepSums::Wide value)
{
  return std::ldexp(static_cast<double>(static_cast<std::uint64_t>(value >> 64)), 64) +
    static_cast<double>(static_cast<std::uint64_t>(value));
}
} // namespace

ValueSteps::ValueSteps(ValueKind kind, const ValueSpan& range, std::size_t bins)
  : kind_(kind)
{
  if (range.count == 0)
  {
    return;
  }
  low_ = range.low;
  bins_ = range.low == range.high ? 1 : bins;
  if (kind_ == ValueKind::Real)
  {
    realLow_ = valueKey::real(range.low);
    halfRange_ = 0.5 * valueKey::real(range.high) - 0.5 * realLow_;
    binWidth_ = 2.0 * (halfRange_ / static_cast<double>(bins_));
    return;
  }
  range_ = range.high - range.low;
  while ((range_ >> shift_) >> stepBits != 0)
  {
    ++shift_;
  }
  if (range_ < bins)
  {
    bins_ = static_cast<std::size_t>(range_) + 1;
    binWidth_ = 1.0;
    return;
  }
  binWidth_ = static_cast<double>(range_) / static_cast<double>(bins_);
}

double ValueSteps::fraction(std::uint64_t key) const
{
  const double above = 0.5 * valueKey::real(key) - 0.5 * realLow_;
  return halfRange_ > 0.0 ? std::clamp(above / halfRange_, 0.0, 1.0) : 0.0;
}

std::uint64_t ValueSteps::step(std::uint64_t key) const
{
  if (kind_ == ValueKind::Real)
  {
    return static_cast<std::uint64_t>(std::llround(std::ldexp(fraction(key), stepBits)));
  }
  const std::uint64_t above = key - low_;
  const std::uint64_t rounded = shift_ == 0 ? 0 : (above >> (shift_ - 1)) & 1;
  return (above >> shift_) + rounded;
}

std::size_t ValueSteps::bin(std::uint64_t key) const
{
  if (bins_ <= 1)
  {
    return 0;
  }
  std::size_t bin = 0;
  if (kind_ == ValueKind::Real)
  {
    bin = static_cast<std::size_t>(fraction(key) * static_cast<double>(bins_));
  }
  else if (range_ < bins_)
  {
    bin = static_cast<std::size_t>(key - low_);
  }
  else
  {
    bin = static_cast<std::size_t>(static_cast<StepSums::Wide>(key - low_) * bins_ / range_);
  }
  return std::min(bin, bins_ - 1);
}

ValueMoments ValueSteps::moments(const StepSums& sums) const
{
  if (sums.count == 0)
  {
    const double none = std::numeric_limits<double>::quiet_NaN();
    return { none, none };
  }
  // Around the whole step below the mean all is exact, modulo 2^128: nothing cancels.
  const auto middle = static_cast<std::uint64_t>(sums.sum / sums.count);
  const auto rest = static_cast<std::uint64_t>(sums.sum % sums.count);
  const double fraction = static_cast<double>(rest) / static_cast<double>(sums.count);
  const StepSums::Wide around = sums.squares - middle * (sums.sum + rest);
  const double squares = std::max(0.0, wideAsDouble(around) - static_cast<double>(rest) * fraction);
  const double deviation = std::sqrt(squares / static_cast<double>(sums.count));
  const double mean = static_cast<double>(middle) + fraction;
  if (kind_ == ValueKind::Real)
  {
    const double halfMean = std::ldexp(mean, -stepBits) * halfRange_;
    const double halfDeviation = std::ldexp(deviation, -stepBits) * halfRange_;
    return { 2.0 * (0.5 * realLow_ + halfMean), 2.0 * halfDeviation };
  }
  const double low = kind_ == ValueKind::Unsigned
    ? static_cast<double>(low_)
    : static_cast<double>(static_cast<std::int64_t>(low_ ^ valueKey::signBit));
  const int shift = static_cast<int>(shift_);
  return { low + std::ldexp(mean, shift), std::ldexp(deviation, shift) };
}

} // namespace pointfront
