#pragma once

#include <cstdint>

namespace pointfront
{

/// Learns what a frame costs and says what the next one may contain (FRONT-6, -7).
/// Model    milliseconds = a * points + b * moves + c, fitted by exponentially weighted least
///          squares over earlier frames; a small prior until there are enough.
/// Threads  one instance, one thread.
class FrameCostModel
{
public:
  /// What a frame contained and how long it took (CPU + GPU, milliseconds).
  void record(std::uint64_t points, std::uint32_t moves, double milliseconds);
  double predictMs(std::uint64_t points, std::uint32_t moves) const;
  /// Most points whose frame is predicted to hold `targetMs`; at least `floorPoints`.
  std::uint64_t pointsFor(double targetMs, std::uint64_t floorPoints) const;
  /// Front moves that fit beside `points` in `targetMs`; between 8 and 4096.
  std::uint32_t movesFor(double targetMs, std::uint64_t points) const;

private:
  // Weighted sums of the normal equations, decayed by each frame.
  double sums_[9] = { 0 };
  std::uint64_t frames_ = 0;
};

} // namespace pointfront
