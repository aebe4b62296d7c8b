#pragma once

#include "pointfront/Views/WholeFront.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront
{

/// The nodes that a view at rest draws when it is complete, from the table alone, while they are
/// being loaded. With them a point's splat has its final size as soon as the point is there
/// (SMOOTH-5).
/// Promise  none: where memory ends, nodes fail or rows of the table are missing the complete view
///          draws other nodes.
/// Time     as WholeFront's.
/// Threads  one.
class ExpectedNodes
{
public:
  explicit ExpectedNodes(std::shared_ptr<const Hierarchy> hierarchy,
    WholeFront::Selection selection = WholeFront::Selection::RenderingFront);

  /// `thresholdPx`: where the threshold of the view will stop.
  void update(const View& view, const FrontLimits& limits, double thresholdPx);
  /// The view is complete: frees what only an update needs.
  void finish();

  Refinement refinement() const { return hierarchy_->refinement(); }
  const std::vector<TabledNode>& nodes() const { return nodes_; } ///< by node
  /// The nodes above them that they replace, by node; none with Refinement::Add, which draws these.
  const std::vector<TabledNode>& replaced() const { return replaced_; }
  /// The node among them; null: it is none of them.
  const TabledNode* find(NodeIndex node) const;
  /// In force in the complete view, pixels.
  double thresholdPx() const { return thresholdPx_; }
  std::uint64_t points() const { return points_; }
  /// Points of nodes among or in place of which finer nodes are drawn, by level.
  const std::vector<std::uint64_t>& refinedPoints() const { return refinedPoints_; }
  /// Whether the complete view draws neither this node nor one below nor one above it: those below
  /// it lie beside the view, so that with Replace nothing takes its place. False while rows are
  /// missing.
  bool passesOver(NodeIndex node) const;
  /// How many of them and of those that they replace lie right below a node.
  std::uint32_t finerNodes(NodeIndex node) const;

private:
  void listReplaced();

  std::shared_ptr<const Hierarchy> hierarchy_;
  WholeFront::Selection selection_;
  std::unique_ptr<WholeFront> front_; ///< null: finished
  std::uint64_t seen_ = 0; ///< number of the delta that nodes_ are made of
  std::vector<TabledNode> nodes_;
  std::vector<TabledNode> replaced_;
  std::vector<NodeIndex> parents_; ///< parent of each of both; sorted
  double thresholdPx_ = 0.0;
  std::uint64_t points_ = 0;
  std::vector<std::uint64_t> refinedPoints_;
};

} // namespace pointfront
