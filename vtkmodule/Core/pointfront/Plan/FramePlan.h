#pragma once

#include "pointfront/Plan/FrameCamera.h"
#include "pointfront/Plan/PointGrowth.h"
#include "pointfront/Points/AttributeSchema.h"
#include "pointfront/Points/QuantisationGrid.h"
#include "pointfront/Store/NodeReader.h"
#include "pointfront/Style/FrameShading.h"
#include "pointfront/Style/ResolvedStyle.h"

#include <glm/vec4.hpp>

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <vector>

namespace pointfront
{
class PictureExchange;

/// Points [first, last) of one node. The node is looked up once a frame and pinned: back ends never
/// ask a residency or a table.
struct PlanItem
{
  std::shared_ptr<const NodeColumns> node;
  std::uint32_t first = 0;
  std::uint32_t last = 0;
  PointGrowth growth; ///< how large its points are yet
  /// World units between the points on screen when this prefix and all nodes above it are drawn, by
  /// the tree's levels.
  float spacing = 0.0f;
  // How large splats must be to close the surface (docs/adr/0017). A back end takes the largest of
  // the radii that apply and of FramePlan::spacingPx.
  /// Factor of a point's own radius: more than 1 for a prefix.
  float radiusScale = 1.0f;
  /// World units, for points without a radius of their own.
  float closingRadius = 0.0f;
  /// The closing radius of the sparsest finer node that is drawn among its points, or its own. It
  /// bounds a point's own radius, because a stray point is no surface.
  float sparsestRadius = 0.0f;
  /// Finer nodes are drawn among the points of this node, so the distances between its own points
  /// do not tell how large their splats must be.
  bool refined = false;
  /// The store has more points in this node's place than are drawn.
  bool unfinished = false;
  /// Points of the prefix that the sizes are for, if those are more than are drawn.
  std::uint32_t sizedFor = 0;
  /// Pixels between the points on screen while this node or finer nodes among its points grow, if
  /// more than FramePlan::spacingPx, which assumes that growth is over.
  float growingSpacingPx = 0.0f;
  /// For a stand-in (FramePlan::standIns): finer splats close the surface in its place, so it is
  /// not to be seen any more.
  bool covered = false;
};

/// Nodes of one layer that are drawn in one style.
struct DrawBatch
{
  std::uint16_t layer = 0;
  std::shared_ptr<const ResolvedStyle> style; ///< never null
  std::vector<PlanItem> items; ///< near to far, ties by node
  std::uint8_t level = 0; ///< level of a stand-in's nodes
  std::uint16_t styleNumber = 0; ///< place of the style among those of the layer
};

/// The settings of a whole frame, whatever nodes it draws.
struct FrameSetting
{
  FrameCamera camera;
  /// (n, d) in store coordinates: points with n . p + d < 0 for any of them are not drawn.
  std::vector<glm::dvec4> clippingPlanes;
  QuantisationGrid grid;
  std::shared_ptr<const AttributeSchema> schema; ///< schema of the nodes' columns; never null
  double splatRadiusBase = 0.0; ///< base of the store's radii (SplatRadius.h); 0: none
  /// Pixels between the points on screen wherever the store has more points than are drawn: the
  /// front's threshold, or less where that is coarse and the points share the viewport more closely
  /// (docs/adr/0036). No splat need be smaller than this, whatever its measured radius. So a
  /// place looks the same whether a parent or a leaf is drawn there.
  float spacingPx = 0.0f;
  /// The view moves, or more nodes are to come. Back ends that can then also draw points that the
  /// last picture showed and this plan lacks (SMOOTH-7). A complete view never keeps points: its
  /// picture does not depend on earlier pictures.
  bool keepsVisible = false;
  /// A view at rest is being loaded, and its splats have the sizes of the complete view: a point
  /// that is drawn once stays as it is (SMOOTH-5).
  bool refining = false;
  /// Other processes draw the rest of the cloud, or the renderer shows other clouds, and the
  /// nearest point of all is shown. The picture then has the depths that decide which splat is
  /// seen; they lie behind a splat's plane towards its rim.
  bool composited = false;
  /// Not null: those processes draw at the same time, and blended splats of all of them are added
  /// up. Outlives the drawing.
  PictureExchange* exchange = nullptr;
  FrameShading shading;
};

/// One frame of one store, between the front and a back end: plain values, the same on every
/// machine for the same view and the same nodes in memory.
/// Order    a back end's picture does not depend on the order of batches, items or threads.
/// Threads  a value.
struct FramePlan : FrameSetting
{
  std::vector<DrawBatch> batches;
  /// While the view is refining: large splats of nodes whose finer nodes are not there yet, seen
  /// where the batches leave holes, and those of coarse levels where those of finer ones do. Finest
  /// level first. Of a node that stays in sight an item only ever changes from not covered to
  /// covered, or back.
  std::vector<DrawBatch> standIns;

  /// Each point once, however many styles of its layer look at it.
  std::uint64_t pointCount() const;
  /// The same of each layer by its number; layers beyond the list have none.
  std::vector<std::uint64_t> layerPoints() const;
  std::size_t nodeCount() const; ///< nodes of all batches
  /// Pixels that splats fill at least where they close the surface, by `spacingPx`, counted as
  /// often as they are filled. An estimate: it counts all points of nodes that are partly in sight.
  double fillPx() const;
};

/// One line a batch and an item: for tests and for looking at a frame.
std::ostream& operator<<(std::ostream& out, const FramePlan& plan);

} // namespace pointfront
