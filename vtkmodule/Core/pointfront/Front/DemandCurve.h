#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace pointfront
{

/// The demand of a view (points or bytes) at each threshold; it falls as the threshold rises. It is
/// a table over thresholds, so that the curves of many views can be added to find the threshold at
/// which all views fit.
/// Steps     eight to a factor of two, from 2^-8 to 2^24 px; between two the larger demand counts.
/// Threads   a value.
class DemandCurve
{
public:
  static constexpr int stepsPerOctave = 8;
  static constexpr int lowestOctave = -8;
  static constexpr std::size_t size = 256;

  /// The last step at or below `px`.
  static std::size_t stepOf(double px)
  {
    const double step = std::floor((std::log2(px) - lowestOctave) * stepsPerOctave);
    return static_cast<std::size_t>(std::clamp(step, 0.0, double(size - 1)));
  }
  /// Size of a step, in px.
  static double pxOf(std::size_t step)
  {
    return std::exp2(lowestOctave + double(step) / stepsPerOctave);
  }

  std::uint64_t at(double px) const { return steps_[stepOf(px)]; }
  std::uint64_t& operator[](std::size_t step) { return steps_[step]; }
  std::uint64_t operator[](std::size_t step) const { return steps_[step]; }
  void clear() { steps_.fill(0); }

  void add(const DemandCurve& other)
  {
    for (std::size_t s = 0; s < size; ++s)
    {
      steps_[s] += other.steps_[s];
    }
  }
  void subtract(const DemandCurve& other)
  {
    for (std::size_t s = 0; s < size; ++s)
    {
      steps_[s] -= other.steps_[s];
    }
  }
  /// Sets the demand below `px` to the demand at `px`: the view will not go lower.
  void levelOff(double px)
  {
    const std::size_t last = stepOf(px);
    std::fill(steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(last), steps_[last]);
  }

  friend bool operator==(const DemandCurve& a, const DemandCurve& b)
  {
    return a.steps_ == b.steps_;
  }

private:
  std::array<std::uint64_t, size> steps_{};
};

/// The whole demand of a view at each threshold.
struct DemandCurves
{
  DemandCurve drawn; ///< points on screen
  DemandCurve slots; ///< slots of GPU memory (GpuSlots.h)
  DemandCurve held; ///< points in memory, whole nodes
};

} // namespace pointfront
