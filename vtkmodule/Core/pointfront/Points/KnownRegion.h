#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/Infinity.h"

#include <algorithm>
#include <atomic>

namespace pointfront
{

/// The columns (height plays no part) of a cloud of which a computation has all points, when it has
/// only some: it tells whether the values that are wanted could depend on points that it lacks.
/// Threads  note() from any thread.
class KnownRegion
{
public:
  /// Values are wanted inside of `wanted`; all points inside of `known` are there. Infinite bounds
  /// reach over the whole cloud.
  KnownRegion(const Bounds& wanted, const Bounds& known)
    : wanted_(wanted)
    , known_(known)
  {
  }

  /// Whether anybody asks for the value of `p`; it may be left out if not.
  bool wants(const glm::dvec3& p) const { return wanted_.contains(p); }
  /// The value of `p` depends on points within that squared distance; infinite: the neighbours that
  /// it needs were not all found.
  void note(const glm::dvec3& p, double squaredReach)
  {
    if (!wants(p))
    {
      return;
    }
    const double clearance = std::max(0.0,
      std::min(
        { p.x - known_.low.x, known_.high.x - p.x, p.y - known_.low.y, known_.high.y - p.y }));
    // A point that lies exactly at the reach must not fall to rounding.
    const double squared = squaredReach * (1.0 + 1e-9);
    if (clearance == infinity || squared < clearance * clearance)
    {
      return;
    }
    double before = squaredMissing_.load(std::memory_order_relaxed);
    const double now = std::max(squared, std::numeric_limits<double>::min());
    while (before < now && !squaredMissing_.compare_exchange_weak(before, now))
    {
    }
  }
  /// Squared distance around `wanted` that has to be known; 0 if enough is.
  double squaredMissing() const { return squaredMissing_; }

private:
  Bounds wanted_;
  Bounds known_;
  std::atomic<double> squaredMissing_{ 0.0 };
};

} // namespace pointfront
