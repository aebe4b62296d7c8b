#pragma once

#include "pointfront/Points/ScalarType.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace pointfront
{

/// Finds out whether floating point numbers were decimal numbers once (637.25 m in millimetres
/// becomes the nearest float), and the fewest decimals that all of them have in common.
/// A number  is a multiple of a step if it is one to within the rounding of its type: half a unit
///           to one unit of the last place of float32. Of float64, to which an offset may have been
///           added, two to four of the largest number: where the sum is near zero, the rounding of
///           the offset is left.
/// A step    counts only if it is four times as wide even at the largest of the numbers. Else every
///           number would be a multiple, and nothing could be said.
/// Missed    numbers that were rounded more than once in their own type: a product in float32.
/// NaN and infinities are left out.
class DecimalStep
{
public:
  static constexpr int mostDecimals = 12;

  /// For values of float32 or float64.
  explicit DecimalStep(ScalarType type = ScalarType::Float64)
    : rounding_(type == ScalarType::Float32 ? 0x1p-24 : 0x1p-51)
    , single_(type == ScalarType::Float32)
  {
  }

  void add(double value)
  {
    if (!std::isfinite(value))
    {
      return;
    }
    farthest_ = std::max(farthest_, std::abs(value));
    // A multiple of a step is one of every smaller step.
    for (int d = decimals_; d <= mostDecimals; ++d)
    {
      const double missed = std::abs(std::nearbyint(value * powers[d]) / powers[d] - value);
      if (missed <= rounding_ * std::abs(value))
      {
        return;
      }
      if (single_ || missed * powers[d] > 0.25) // more than any rounding that counts
      {
        decimals_ = decimals_ == d ? d + 1 : decimals_;
      }
      missed_[static_cast<std::size_t>(d)] = std::max(missed_[static_cast<std::size_t>(d)], missed);
    }
  }
  void add(const DecimalStep& other)
  {
    farthest_ = std::max(farthest_, other.farthest_);
    decimals_ = std::max(decimals_, other.decimals_);
    for (std::size_t d = 0; d < missed_.size(); ++d)
    {
      missed_[d] = std::max(missed_[d], other.missed_[d]);
    }
  }

  /// Nothing if there is no such step. No numbers, or only zeros, have no decimals.
  std::optional<int> decimals() const
  {
    for (int d = decimals_; d <= mostDecimals && 1.0 >= 4.0 * rounding_ * farthest_ * powers[d];
         ++d)
    {
      if (missed_[static_cast<std::size_t>(d)] <= rounding_ * farthest_)
      {
        return d;
      }
    }
    return std::nullopt;
  }

private:
  static constexpr double powers[mostDecimals + 1] = { 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8,
    1e9, 1e10, 1e11, 1e12 };

  double rounding_; ///< share of a number
  bool single_; ///< float32: each number is rounded by itself
  double farthest_ = 0.0;
  int decimals_ = 0; ///< fewer are not enough
  /// By decimals: what the numbers miss at most that are no multiples by themselves.
  std::array<double, mostDecimals + 1> missed_{};
};

} // namespace pointfront
