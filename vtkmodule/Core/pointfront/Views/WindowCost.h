#pragma once

#include "pointfront/Front/FrameCostModel.h"

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <unordered_map>

namespace pointfront
{

/// The points of one cloud in a frame of its window.
struct CloudCost
{
  std::uint64_t points = 0; ///< all that were drawn
  std::uint64_t beside = 0; ///< the part of these that the front did not choose
  std::uint32_t moves = 0;
  double milliseconds = 0.0; ///< CPU + GPU
  double fillPx = 0.0; ///< as FramePlan's
  double viewportPx = 0.0; ///< all of the window's view
};

/// The costs of a window's frames with all of its clouds. The clouds share a frame's points, so
/// they need one cost of a point: a cloud that shows ten points takes nearly as long as one that
/// shows ten thousand, and judged alone it would believe that points are expensive.
/// Fill     of splats: where few points are drawn around the eye, each is large, and a frame takes
/// as
///          long as its pixels are filled. Fill beyond that of a closed surface counts as points.
///          And while it outweighs the points, fewer points would be larger ones, not a shorter
///          frame: then a frame may have more of them.
/// Frame    ends when as many clouds as there are have told theirs, or when one tells again: clouds
///          that are not drawn tell nothing.
/// Threads  any.
class WindowCost
{
public:
  /// `cloud` is any address of its own; `clouds`: how many may tell.
  void record(const void* cloud, std::uint64_t clouds, const CloudCost& cost)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (frame_.count(cloud) > 0)
    {
      endFrame();
    }
    frame_[cloud] = cost;
    if (frame_.size() >= clouds)
    {
      endFrame();
    }
  }
  /// As the model's, of all clouds together.
  std::uint64_t pointsFor(double targetMs, std::uint64_t floorPoints) const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const std::uint64_t fill = fillPoints();
    const std::uint64_t drawn = last_.points + fill;
    const std::uint64_t affordable = model_.pointsFor(targetMs, floorPoints);
    const double share = drawn > 0 ? double(last_.points) / double(drawn) : 1.0;
    // Points take what there is to spare, and their share of what there is not.
    const std::uint64_t points = affordable >= drawn
      ? affordable - fill
      : static_cast<std::uint64_t>(share * double(affordable));
    return std::max(floorPoints, points);
  }
  /// Points that a frame may have whatever its time, because fewer would not be faster.
  std::uint64_t heldPoints() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return held_;
  }
  /// As the model's, beside the points of the last frame.
  std::uint32_t movesFor(double targetMs) const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return model_.movesFor(targetMs, last_.points + fillPoints());
  }
  /// Points that the fronts of the last frame did not choose.
  std::uint64_t beside() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return last_.beside;
  }

private:
  void endFrame()
  {
    last_ = {};
    for (const auto& [cloud, cost] : frame_)
    {
      last_.points += cost.points;
      last_.beside += cost.beside;
      last_.moves += cost.moves;
      last_.milliseconds += cost.milliseconds;
      last_.fillPx += cost.fillPx;
      last_.viewportPx = std::max(last_.viewportPx, cost.viewportPx);
    }
    frame_.clear();
    const std::uint64_t fill = fillPoints();
    model_.record(last_.points + fill, last_.moves, last_.milliseconds);
    if (fill > last_.points)
    {
      held_ = std::max(held_, std::min(fill, 2 * last_.points));
    }
    else if (2 * fill < last_.points)
    {
      held_ -= held_ / 20; // slowly: one that rose and fell with each frame would be seen
    }
  }
  /// The pixels that the last frame's splats filled too much, in points that cost the same.
  std::uint64_t fillPoints() const
  {
    const double most = closedSurface * last_.viewportPx;
    return static_cast<std::uint64_t>(std::max(0.0, last_.fillPx - most) / pixelsOfPoint);
  }

  /// How often splats that close a surface fill each pixel, with all that lies behind it.
  static constexpr double closedSurface = 8.0;
  /// Pixels that are filled in the time of a point: .35 against 5 ns in the software back end.
  static constexpr double pixelsOfPoint = 16.0;

  mutable std::mutex mutex_;
  FrameCostModel model_;
  std::unordered_map<const void*, CloudCost> frame_; ///< costs of the clouds that told theirs
  CloudCost last_;
  std::uint64_t held_ = 0; ///< heldPoints()
};

} // namespace pointfront
