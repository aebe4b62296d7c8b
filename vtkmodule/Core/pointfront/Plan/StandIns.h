#pragma once

#include "pointfront/Plan/FramePlan.h"
#include "pointfront/Views/ExpectedNodes.h"

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

namespace pointfront
{

/// Items that a refining view draws for nodes whose finer nodes are missing, where splats of the
/// final sizes leave holes: their points, or an even share of them, as large as closes the surface.
/// Share     all stand-ins of a view are a few percent of the points of the complete view: all
///           points of the coarse levels, a share of those of the next one, and none of finer ones.
///           It is the same in each frame of a view, and so are the sizes.
/// Replace   the nodes that the complete view's replace stand in for these. Their points are in
///           Morton order, so whole levels stand in.
/// Threads   a value.
class StandIns
{
public:
  explicit StandIns(const ExpectedNodes& expected);

  /// Tells that all points of the node that the complete view has are drawn at full size; or that a
  /// node which is replaced there is in memory.
  void noteWhole(const std::shared_ptr<const NodeColumns>& node, const TabledNode& complete);
  /// Those of the nodes that were noted, without a style: a batch for each level and layer, finest
  /// level first.
  std::vector<DrawBatch> batches();

private:
  struct Noted
  {
    std::shared_ptr<const NodeColumns> node;
    const TabledNode* complete;
    bool covered = false;
  };
  double shareOf(std::uint8_t level) const;
  PlanItem itemOf(const Noted& noted) const;

  const ExpectedNodes& expected_;
  std::vector<double> shares_; ///< by level
  std::vector<Noted> noted_;
};

} // namespace pointfront
