#pragma once

#include "pointfront/Front/FrameCostModel.h"

#include <cstdint>
#include <mutex>
#include <unordered_map>

namespace pointfront
{

/// What one cloud had in a frame of its window.
struct CloudCost
{
  std::uint64_t points = 0; ///< all that were drawn
  std::uint64_t beside = 0; ///< of these, not the front's
  std::uint32_t moves = 0;
  double milliseconds = 0.0; ///< CPU + GPU
};

/// What the frames of a window cost with all of its clouds. The clouds share a frame's points, so
/// they need one cost of a point: a cloud that shows ten points takes nearly as long as one that
/// shows ten thousand, and judged alone it would believe that points are expensive.
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
    return model_.pointsFor(targetMs, floorPoints);
  }
  /// As the model's, beside the points of the last frame.
  std::uint32_t movesFor(double targetMs) const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return model_.movesFor(targetMs, last_.points);
  }
  /// What the fronts of the last frame did not choose.
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
    }
    frame_.clear();
    model_.record(last_.points, last_.moves, last_.milliseconds);
  }

  mutable std::mutex mutex_;
  FrameCostModel model_;
  std::unordered_map<const void*, CloudCost> frame_; ///< of those that told
  CloudCost last_;
};

} // namespace pointfront
