#pragma once

#include "pointfront/Plan/FramePlan.h"

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace pointfront
{

/// A point that is visible, and where its values are.
struct VisiblePoint
{
  std::uint32_t indexInNode;
  std::uint32_t point;
  const NodeColumns* from;
};

/// Points of one node that were visible at some time of a motion, as a node of their own: the
/// node's memory may go to others.
class KeptNode
{
public:
  /// Adds those that are not there yet; ascending, each once. `as`: how their node was drawn, which
  /// the first ones decide. Points with other columns than these replace all.
  void add(const std::vector<VisiblePoint>& points, const PlanItem& as, std::uint32_t frame);
  void sawPoint(std::uint32_t point, std::uint32_t frame) { seen_[point] = frame; }
  /// Keeps those that were seen after `frame`, and of those seen in it the first `more`, which then
  /// is what is left of it.
  void dropUnseen(std::uint32_t frame, std::uint64_t& more);
  /// The node's first points are drawn anyway, as many as that.
  void setPlanned(std::uint32_t points);

  const std::shared_ptr<const NodeColumns>& columns() const { return item_.node; }
  const std::vector<std::uint32_t>& indices() const { return indices_; }
  /// The number of the frame in which each was visible last.
  const std::vector<std::uint32_t>& seen() const { return seen_; }
  /// The item that draws them.
  const PlanItem& item() const { return item_; }

  std::shared_ptr<const ResolvedStyle> style; ///< that they were drawn in

private:
  void take(const std::vector<VisiblePoint>& points, std::vector<std::uint32_t> seen);
  std::vector<VisiblePoint> all() const;

  std::vector<std::uint32_t> indices_; ///< in the node, ascending
  std::vector<std::uint32_t> seen_;
  PlanItem item_;
};

/// The kept points of a motion, by node. Whoever was visible once stays until the motion ends,
/// though another point may hide it for a while; beyond a number of points those go that were not
/// seen for the longest time.
using KeptNodes = std::map<NodeIndex, KeptNode>;

/// Leaves at most so many points.
void bound(KeptNodes& nodes, std::uint64_t points);

} // namespace pointfront
