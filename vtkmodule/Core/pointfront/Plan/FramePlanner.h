#pragma once

#include "pointfront/Plan/DetailGrowth.h"
#include "pointfront/Plan/FramePlan.h"
#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Views/ViewFront.h"

#include <memory>
#include <utility>
#include <vector>

namespace pointfront
{

/// The styles of one layer: usually one; several for a tree of all classes, where each style's
/// filter lets its own points through; none: the layer is hidden.
struct LayerStyles : std::vector<std::shared_ptr<const ResolvedStyle>>
{
  using vector::vector;
  LayerStyles(std::shared_ptr<const ResolvedStyle> only)
  {
    if (only)
    {
      push_back(std::move(only));
    }
  }
};

/// The demands of a view on a frame, in addition to the nodes that its front draws.
struct PlanRequest
{
  FrameCamera camera;
  std::vector<glm::dvec4> clippingPlanes; ///< (n, d), store coordinates; as FramePlan's
  FrameShading shading;
  bool keepsVisible = false; ///< as FramePlan's: see leavesOut()
  bool composited = false; ///< as FramePlan's
  /// The back end draws FramePlan::standIns, so that a view that is being loaded can be refining.
  bool refines = false;
  PictureExchange* exchange = nullptr; ///< as FramePlan's
  /// Not null: detail grows. The object knows what that view showed so far, and learns what this
  /// plan shows.
  DetailGrowth* growth = nullptr;
  GrowthMoment moment;
  std::vector<LayerStyles> styles; ///< by number of the store's layer; beyond the list: hidden
};

/// The plan of what the front draws since its last update: a batch for each layer that shows
/// anything, in the order of their numbers; one for each style of a layer that has several.
/// Nodes     each is looked up once and pinned until the plan is gone. One that is no longer in
///           memory is left out.
/// Columns   a node may lack columns that its style reads, while it is being read again. It is in
///           the plan all the same: back ends draw it in the flat colour without the column of the
///           colouring, as paraboloids without normals, and not at all without the column of a
///           filter (NodeColumns::selection says which columns it has).
/// Threads   the renderer's, as ViewFront.
FramePlan planFrame(
  const ViewFront& front, const StoreDescription& description, PlanRequest request);

/// Gives the plan's batches and stand-ins the styles that another request for the same nodes (of
/// another actor, eye or pass) has in their place. One that has none there stays as it is.
void restyle(FramePlan& plan, const std::vector<LayerStyles>& styles);

/// Whether the view will show more than this frame: it moves, or nodes are being loaded.
bool leavesOut(const FrontDelta& delta, const FrameRequest& request);

/// World units between the points on screen when the first `drawn` points of a node and all nodes
/// above it are drawn; `spacingRatio` as in DrawItem. 0 where the node's spacing is not known.
float prefixSpacing(const NodeColumns& node, std::uint32_t drawn, float spacingRatio);

} // namespace pointfront
