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
  explicit WholeFront(std::shared_ptr<const Hierarchy> hierarchy);
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
  std::shared_ptr<const Hierarchy> hierarchy_;
  std::unique_ptr<AllResident> residents_;
  std::unique_ptr<DetailSelection> front_;
  const FrontDelta* delta_ = nullptr; ///< the front's
};

} // namespace pointfront
