#pragma once

#include "FetchAhead.h"
#include "ItemNumbers.h"
#include "PointColours.h"
#include "RasterBatch.h"
#include "TechniquePasses.h"

#include "pointfront/Plan/FramePlan.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace pointfront
{

/// The terms by which a frame's plan decides how large an item's points are, beside its passes; 0
/// where nothing reads. Equal terms give equal splats.
struct SizeTerms
{
  PointGrowth growth;
  float radius = 0.0f;
  float radiusScale = 0.0f; ///< where points have radii of their own, as RasterItem's
  float sparsestRadius = 0.0f; ///< likewise
  bool bounded = false; ///< likewise: no radius is less than `radius`
};

inline bool operator==(const SizeTerms& a, const SizeTerms& b)
{
  return a.growth == b.growth && a.radius == b.radius && a.radiusScale == b.radiusScale &&
    a.sparsestRadius == b.sparsestRadius && a.bounded == b.bounded;
}

/// One node of a plan as the loops want it; where its style is solid there is one more, of the
/// walls below its points.
struct RasterItem
{
  const PlanItem* item = nullptr;
  const ResolvedStyle* style = nullptr;
  std::uint32_t base = 0; ///< index of the node's first point in keys
  RasterCamera camera;
  RasterPositions positions; ///< positions from the node's first point on
  TechniquePasses passes;
  std::shared_ptr<const PointColours> colours;
  float radius = 0.0f; ///< world units, of all points without one of their own
  float sparsestRadius = 0.0f; ///< where the item's points are farthest apart
  float radiusScale = 1.0f; ///< times a point's own
  const std::uint8_t* radiusCodes = nullptr;
  const std::byte* sizes = nullptr; ///< a column of radii
  const Attribute* sizeAttribute = nullptr;
  const std::byte* normals = nullptr;
  const Attribute* normalAttribute = nullptr;
  const std::byte* heights = nullptr; ///< walls: above the ground
  const Attribute* heightAttribute = nullptr;

  const NodeColumns& node() const { return *item->node; }
  /// A splat's own radius is for all points: too small where finer nodes are there and not drawn.
  bool radiusBounded() const { return !item->refined && !node().leaf; }
  SizeTerms sizeTerms() const;
  /// Asks for what these points are drawn by, one after the other.
  void fetchAhead(PointRange points) const
  {
    pointfront::fetchAhead(positions.xyz, 3 * sizeof(std::uint32_t), points);
    if (normals)
    {
      pointfront::fetchAhead(normals, normalAttribute->bytes(), points);
    }
  }
  /// Asks for the memory that holds what a winner is resolved by.
  void fetchAhead(std::uint32_t point) const
  {
    if (!passes.depthInKey() || normals)
    {
      __builtin_prefetch(positions.xyz + 3 * std::size_t(point));
    }
    if (radiusCodes && !passes.depthInKey())
    {
      __builtin_prefetch(radiusCodes + point);
    }
    if (heights)
    {
      __builtin_prefetch(heights + std::size_t(point) * heightAttribute->bytes());
    }
    if (normals)
    {
      __builtin_prefetch(normals + std::size_t(point) * normalAttribute->bytes());
    }
    if (!passes.blended)
    {
      colours->fetchAhead(point);
    }
  }
};

/// A plan's items in the order of their nodes, with numbers for their points: a key's 32 bits name
/// a point of the frame, and of two points at one depth the same one wins whatever was drawn first.
class RasterItems
{
public:
  /// Takes the plan's items, in the order of their nodes, those from `from` on that fit into 32
  /// bits. The plan outlives this object. `opaque`: nothing is blended, whatever the styles say.
  RasterItems(const FramePlan& plan, std::size_t from, bool opaque = false);

  /// Number of the plan's items that are in this or earlier rounds.
  std::size_t end() const { return end_; }
  bool first() const { return first_; }
  bool last() const { return end_ == ordered_.size(); }
  const std::vector<RasterItem>& items() const { return items_; }
  bool blended() const { return blended_; }
  /// The meaning of the keys' indices.
  const ItemNumbers& numbers() const { return numbers_; }
  /// Radius of a point's code, world units; 0 where it has none.
  const std::array<float, 256>& radii() const { return radii_; }
  /// View units of a store unit.
  float radiusFactor() const { return radiusFactor_; }
  /// The same along the store's z axis.
  float upFactor() const { return upFactor_; }
  const glm::mat3& normalToCamera() const { return normalToCamera_; }
  const FramePlan& plan() const { return plan_; }

  /// Fills RasterBatch::keep of points [first, first + count); false: nothing is filtered.
  static bool filter(const FramePlan& plan, const RasterItem& item, std::uint32_t first, int count,
    RasterBatch& batch);

private:
  struct PlannedItem
  {
    const PlanItem* item;
    const DrawBatch* batch;
  };
  /// The item that draws `planned`, without its place.
  RasterItem itemOf(const PlannedItem& planned);
  RasterItem wallsOf(const RasterItem& item) const;
  PassConditions conditionsOf(const RasterItem& item) const;
  void append(RasterItem item);
  void setPlace(RasterItem& item) const;
  /// `reference` in camera space; `shift`: what depths of a parallel view count from.
  void setClipping(const glm::dmat3& axes, const glm::dvec3& reference, double shift,
    RasterPositions& positions) const;

  const FramePlan& plan_;
  std::vector<PlannedItem> ordered_;
  std::vector<RasterItem> items_;
  ItemNumbers numbers_;
  std::vector<std::pair<const ResolvedStyle*, std::unique_ptr<StyleColours>>> tables_;
  std::array<float, 256> radii_{};
  float radiusFactor_ = 1.0f;
  float upFactor_ = 1.0f;
  glm::mat3 normalToCamera_{ 1.0f };
  std::size_t end_ = 0;
  bool first_ = true;
  bool opaque_ = false;
  bool blended_ = false;
};

} // namespace pointfront
