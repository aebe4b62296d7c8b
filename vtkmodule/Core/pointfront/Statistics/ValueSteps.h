#pragma once

#include "pointfront/Statistics/ValueKey.h"
#include "pointfront/Statistics/ValueSpan.h"

#include <cstddef>
#include <cstdint>

namespace pointfront
{

/// Sums of whole steps: the same for any order of the values.
/// Range  2^40 values of 2^44 steps.
struct StepSums
{
  __extension__ using Wide = unsigned __int128;
  std::uint64_t count = 0;
  Wide sum = 0;
  Wide squares = 0;

  void add(std::uint64_t step)
  {
    ++count;
    sum += step;
    squares += static_cast<Wide>(step) * step;
  }
  void add(const StepSums& other)
  {
    count += other.count;
    sum += other.sum;
    squares += other.squares;
  }
};

/// Mean and standard deviation of the values that were summed.
struct ValueMoments
{
  double mean = 0.0;
  double deviation = 0.0; ///< deviation of all values, divided by their number
};

/// Divides the range that was found for a component into steps to sum and bins to count.
/// Steps      whole numbers over less than 2^44 are exact: one step is 1. Others have 2^44 steps,
///            or half as many, over the range, so mean and deviation err by its 2^-44 at most.
/// Bins       equally wide over the range, the last one with its upper end. Whole numbers that
///            have no more different values than bins are wanted: one bin for each value. One bin
///            where all values are equal.
/// Threads    immutable.
class ValueSteps
{
public:
  ValueSteps() = default;
  /// `bins` >= 1. Without a value in `range` there is no bin.
  ValueSteps(ValueKind kind, const ValueSpan& range, std::size_t bins);

  /// Step of a key inside the range.
  std::uint64_t step(std::uint64_t key) const;
  std::size_t bin(std::uint64_t key) const;
  std::size_t bins() const { return bins_; }
  double binWidth() const { return binWidth_; } ///< 0 where all values are equal
  /// NaN for no values.
  ValueMoments moments(const StepSums& sums) const;

private:
  double fraction(std::uint64_t key) const; ///< place in the range; Real only

  ValueKind kind_ = ValueKind::Real;
  std::uint64_t low_ = 0; ///< key
  std::uint64_t range_ = 0; ///< difference of keys; whole numbers only
  unsigned shift_ = 0; ///< a step is 2^shift_; whole numbers only
  double realLow_ = 0.0;
  double halfRange_ = 0.0; ///< half, for the whole may be larger than any double
  std::size_t bins_ = 0;
  double binWidth_ = 0.0;
};

} // namespace pointfront
