#pragma once

#include <array>
#include <cstdint>

namespace pointfront
{

/// Learns what a frame costs and says what the next one may contain (FRONT-6, -7).
/// Model    milliseconds = a * points + b * moves + c, a, b, c >= 0, fitted by exponentially
///          weighted least squares over earlier frames (half of the weight lies on the last 14).
///          A prior with the weight of a third of a frame holds what the frames do not tell: with a
///          still camera points and moves do not vary, and the fit alone would be singular.
/// Outliers a frame far from its prediction (the first upload, a shader being compiled, another
///          program) counts with a weight that shrinks with its distance (Huber 1964). If frames go
///          on being different, the scale of what is far grows and the model follows within some
///          ten frames.
/// Control  the fit alone is no good guide away from the frames it saw: while a camera hardly
///          moves, points and moves do not vary, a and c cannot be told apart, and a few spare
///          milliseconds would promise twice the points. So answers go from the median time a
///          point of the last three frames. With time to spare they grow in proportion: c >= 0, so
///          more could be afforded, never less. When a frame was too long the fit says how much
///          of it c is, within bounds. Half the way is gone, unless the frame was off by more than
///          a factor of two; within a tenth of the target nothing changes: detail does not
///          flicker with the noise of a clock.
/// Threads  one instance, one thread.
class FrameCostModel
{
public:
  /// Records a frame: its content and its time (CPU + GPU, milliseconds). Times that are not
  /// positive and finite are left out.
  void record(std::uint64_t points, std::uint32_t moves, double milliseconds);
  double predictMs(std::uint64_t points, std::uint32_t moves) const;
  /// Points for the next frame so that it comes nearer to `targetMs`; at least `floorPoints`.
  /// Asked again after each frame it converges.
  std::uint64_t pointsFor(double targetMs, std::uint64_t floorPoints) const;
  /// Front moves that fit beside `points` in `targetMs`; between 8 and 4096.
  std::uint32_t movesFor(double targetMs, std::uint64_t points) const;

private:
  /// Cost of a million points, of 64 moves, of an empty frame: numbers of one magnitude.
  using Costs = std::array<double, 3>;

  void solve();
  double recentPerPoint() const;

  static constexpr Costs prior_{ 10.0, 1.0, 2.0 };
  Costs costs_ = prior_;
  /// Upper triangle of the normal equations' matrix, and their right side; decayed by each frame.
  std::array<double, 6> matrix_{};
  Costs right_{};
  double scaleMs_ = 0.0; ///< typical distance of a frame from its prediction
  double lastPoints_ = 0.0;
  std::array<double, 3> recentPerPoint_{}; ///< ms a point of the last frames, without their moves
  std::uint64_t frames_ = 0;
};

} // namespace pointfront
