#pragma once

#include "pointfront/Points/ScalarType.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pointfront
{

/// Finds out whether floating point numbers were decimal numbers once (637.25 m in millimetres
/// becomes the nearest float), and the fewest decimals that all of them have in common.
/// A number  is a multiple of a step if it is one to within the rounding of its type: half a unit
///           to one unit of the last place of float32, two to four of float64, to which an offset
///           may have been added.
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
    while (decimals_ <= mostDecimals && !isMultiple(value))
    {
      ++decimals_;
    }
  }
  void add(const DecimalStep& other)
  {
    farthest_ = std::max(farthest_, other.farthest_);
    decimals_ = std::max(decimals_, other.decimals_);
  }

  /// Nothing if there is no such step. No numbers, or only zeros, have no decimals.
  std::optional<int> decimals() const
  {
    const bool resolved =
      decimals_ <= mostDecimals && 1.0 >= 4.0 * rounding_ * farthest_ * powers[decimals_];
    return resolved ? std::optional<int>(decimals_) : std::nullopt;
  }

private:
  static constexpr double powers[mostDecimals + 1] = { 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8,
    1e9, 1e10, 1e11, 1e12 };

  bool isMultiple(double value) const
  {
    const double power = powers[decimals_];
    const double multiple = std::nearbyint(value * power) / power;
    return std::abs(multiple - value) <= rounding_ * std::abs(value);
  }

  double rounding_; ///< share of a number
  double farthest_ = 0.0;
  int decimals_ = 0;
};

} // namespace pointfront
