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
  // How large splats close the surface (drawing.md 3); a back end takes the largest of what
  // applies, and FramePlan::spacingPx.
  /// A point's own radius counts that many times: more than 1 for a prefix.
  float radiusScale = 1.0f;
  /// World units, for points without a radius of their own.
  float closingRadius = 0.0f;
  /// The same of the sparsest finer node that is drawn among its points; its own if there is none.
  /// A point's own radius is bounded by that: a stray is no surface.
  float sparsestRadius = 0.0f;
  /// Finer nodes are drawn among this one's points: how far these are apart does not say how large
  /// their splats must be.
  bool refined = false;
  /// The store has more points there than are drawn.
  bool unfinished = false;
  /// Pixels between the points on screen while this node or finer ones among its points grow, if
  /// these are more than FramePlan::spacingPx, which counts on what they will be.
  float growingSpacingPx = 0.0f;
};

/// What is drawn in one way: the nodes of one layer.
struct DrawBatch
{
  std::uint16_t layer = 0;
  std::shared_ptr<const ResolvedStyle> style; ///< never null
  std::vector<PlanItem> items; ///< near to far, ties by node
};

/// What is true of a whole frame, whatever is drawn in it.
struct FrameSetting
{
  FrameCamera camera;
  /// (n, d) in store coordinates: points with n . p + d < 0 for any of them are not drawn.
  std::vector<glm::dvec4> clippingPlanes;
  QuantisationGrid grid;
  std::shared_ptr<const AttributeSchema> schema; ///< of the nodes' columns; never null
  double splatRadiusBase = 0.0; ///< of the store's radii (SplatRadius.h); 0: none
  /// Pixels between the points on screen wherever the store has more than is drawn: the front's
  /// threshold. No splat need be smaller, whatever was measured; by it a point looks the same
  /// whether its parent or its leaf is drawn.
  float spacingPx = 0.0f;
  /// The view moves, or more is to come: what the last picture showed and this plan lacks is drawn
  /// too, by back ends that can (SMOOTH-7). A complete view never keeps anything: its picture is
  /// the same whatever was seen before.
  bool keepsVisible = false;
  /// Other processes draw the rest of the cloud, and the nearest of all is shown: the picture's
  /// depths are those that decide who is seen, which lie behind a splat's plane towards its rim.
  bool composited = false;
  FrameShading shading;
};

/// One frame of one store, between the front and a back end: plain values, the same on every
/// machine for the same view and the same nodes in memory.
/// Order    a back end's picture does not depend on the order of batches, items or threads.
/// Threads  a value.
struct FramePlan : FrameSetting
{
  std::vector<DrawBatch> batches;

  /// Each point once, however many styles of its layer look at it.
  std::uint64_t pointCount() const;
  std::size_t nodeCount() const; ///< of all batches
};

/// One line a batch and an item: for tests and for looking at a frame.
std::ostream& operator<<(std::ostream& out, const FramePlan& plan);

} // namespace pointfront
