#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Plan/PointGrowth.h"
#include "pointfront/Store/NodeReader.h"

#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace pointfront
{

/// The time of a frame, and how detail grows in it.
struct GrowthMoment
{
  double seconds = 0.0; ///< time of any clock that does not go back: only differences count
  double duration = 0.0; ///< seconds that a node takes to grow; 0: all is whole at once
  bool moving = false; ///< the view is in motion
  /// Left, right, bottom and top of the view as View::planes; zeros: all places are in sight.
  std::array<glm::dvec4, 4> sides{};

  bool sees(const Bounds& place) const;
};

/// Lets detail grow from frame to frame instead of popping up (SMOOTH-6). For one view it chooses
/// what is shown of each node, between what the last frame showed and what the front wants.
/// Ordered    (Refinement::Add) a node's prefix grows and falls within `duration`. In motion the
///            last fifth of a prefix has sizes from full to nothing, so that a point that comes or
///            goes has none: the picture depends on the view alone where the front's prefixes
///            change slowly. At rest all become whole.
/// Unordered  (Refinement::Replace) a node that replaces another grows as a whole; the replaced
///            node is drawn meanwhile and shrinks last, so that no hole opens.
/// At once    nodes of the first frame, nodes that come into view with their whole branch, and
///            nodes whose place was beside the last frame's view are whole: nobody saw their
///            place without them.
/// At rest    after `duration` nothing is left of it: the plan is the same, bit for bit, as one
///            that never grew.
/// Pauses     a frame counts for half of `duration` at most, so that a change after a long rest
///            grows too.
/// Time       is a value; none is read here.
/// Threads    one.
/// Source     Futterlieb, Teutsch & Berndt 2016, section 3.2.2, which blends finished pictures at
///            intervals; docs/adr/0025.
class DetailGrowth
{
public:
  /// The drawn prefix of a node.
  struct Shown
  {
    std::uint32_t points = 0; ///< a prefix, not longer than asked for
    /// Number of these that count when it is asked how far points are apart.
    std::uint32_t spread = 0;
    PointGrowth growth;
  };
  /// A node that its front no longer draws.
  struct Leaving
  {
    std::shared_ptr<const NodeColumns> node;
    std::uint32_t points = 0;
    PointGrowth growth;
  };

  void begin(const GrowthMoment& moment, bool ordered);
  /// Called for each node of which the front draws `points` points.
  /// `wasSeen`: the last frame had the node's place in sight.
  Shown grow(
    const std::shared_ptr<const NodeColumns>& node, std::uint32_t points, bool wasSeen = true);
  /// Whether the frame before this one had a place in sight, store coordinates.
  bool saw(const Bounds& place) const { return last_.sees(place); }
  /// Called after all nodes: the nodes that are drawn in addition. Unordered only.
  std::vector<Leaving> finish();

  /// Whether another frame with the same request would differ.
  bool growing() const { return growing_; }
  /// Whether everything that the front draws is shown at full size.
  bool whole() const { return whole_; }
  /// Forgets all nodes: the next frame counts as the first.
  void reset();

private:
  struct State
  {
    double shown = 0.0; ///< ordered: points; unordered: 0 to 1
    std::uint32_t points = 0;
    NodeIndex parent = noNode;
    std::weak_ptr<const NodeColumns> node; ///< not pinned from frame to frame
  };
  /// Nodes that a frame shows, and their parents.
  struct States
  {
    std::unordered_map<NodeIndex, State> nodes;
    std::unordered_set<NodeIndex> parents;

    const State* find(NodeIndex node) const;
    State& add(NodeIndex node, NodeIndex parent);
    /// Whether the node's source, or a node made from it, is there.
    bool hasRelatives(NodeIndex node, NodeIndex parent) const;
  };
  Shown growOrdered(State& now, const NodeColumns& node, bool wasSeen);
  Shown growWhole(State& now, const NodeColumns& node, bool wasSeen);

  GrowthMoment moment_;
  GrowthMoment last_; ///< that of the frame before
  bool ordered_ = true;
  bool begun_ = false;
  bool growing_ = false;
  bool whole_ = true;
  double step_ = 0.0; ///< share of `duration` since the last frame; half of it at most
  States before_;
  States now_;
};

} // namespace pointfront
