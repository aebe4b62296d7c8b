#pragma once

#include "pointfront/Front/DetailSelection.h"
#include "pointfront/Store/Hierarchy.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace pointfront
{

/// A node that a view draws somewhere or some time, by the hierarchy's table alone.
struct TabledNode
{
  DrawItem item;
  Node row;
};

/// The front of a view as if all of a hierarchy were in memory.
/// Time     that of a front's update; next to nothing where neither view nor threshold changed.
/// Threads  one.
class WholeFront
{
public:
  /// How detail is chosen.
  enum class Selection
  {
    RenderingFront, ///< RenderFront: by the threshold alone
    ViewSpecific ///< ViewDetail: by all limits; `thresholdPx` is its target
  };

  explicit WholeFront(
    std::shared_ptr<const Hierarchy> hierarchy, Selection selection = Selection::RenderingFront);
  ~WholeFront();

  /// Updates for a view with the layers of `limits`, at a threshold. `waits`: as long as it is true
  /// the update waits for rows of a paged table; empty: the next update looks again for rows that
  /// are on their way.
  const FrontDelta& update(const View& view, const FrontLimits& limits, double thresholdPx,
    const std::function<bool()>& waits);
  /// The nodes that the last update draws, by node: their rows are here, and they are `wanted`.
  std::vector<TabledNode> drawn(const std::function<bool(NodeIndex)>& wanted) const;

private:
  class AllResident;
  FrontLimits limitsOf(const FrontLimits& limits, double thresholdPx) const;

  std::shared_ptr<const Hierarchy> hierarchy_;
  Selection selection_;
  std::unique_ptr<AllResident> residents_;
  std::unique_ptr<DetailSelection> front_;
  const FrontDelta* delta_ = nullptr; ///< the front's
};

} // namespace pointfront
