#include "SplatGroups.h"

#include "GpuPool.h"
#include "PointShapes.h"
#include "SameCamera.h"
#include "ShownRectangle.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace pointfront
{
namespace
{

/// Depth of the nearest corner of the node's box.
float nearestDepth(const RasterItem& item, const RasterItems& items)
{
  const NodeColumns& node = item.node();
  float depth = item.camera.matrix[2][3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const double step =
      items.plan().grid.scale[axis] * std::ldexp(1.0, static_cast<int>(item.positions.shift));
    const double half = static_cast<double>(node.halfSize[axis]) / step;
    const float slope = item.camera.matrix[2][axis];
    depth += slope * static_cast<float>(half - item.positions.steps[axis]) -
      std::abs(slope) * static_cast<float>(half);
  }
  return std::max(item.camera.nearDepth, depth);
}

/// Edge in pixels of a square around any splat of at most `pixels` radius at its centre's depth:
/// perspective makes it longer aside of the line of sight, without end where it reaches the eye's
/// plane. Of what setUpEllipse, setUpExact and setUpSphere say the most.
float largestExtent(float pixels, const RasterCamera& camera, const FrameCamera& view)
{
  const float largestView = static_cast<float>(std::max(view.width, view.height));
  float half = pixels;
  if (!camera.parallel)
  {
    const float size = pixels / camera.scaleY; // radii a unit of depth
    if (!(size * size < 0.81f))
    {
      return largestView;
    }
    const auto width = static_cast<float>(view.width), height = static_cast<float>(view.height);
    const float right = std::max(width - camera.centreX, camera.centreX) / camera.scaleX;
    const float up = std::max(height - camera.centreY, camera.centreY) / camera.scaleY;
    const float edge = std::max(right, up);
    // A centre may be beside the view, as far as meetsView has it.
    const float reach = size * 1.01f + 1.0f / camera.scaleX;
    const float aside = edge + reach * std::sqrt(1.0f + edge * edge);
    const float bent = 1.0f + 5.27f * size * size; // more than 1 / (1 - size * size)
    half = size * std::max(camera.scaleX, camera.scaleY) * bent *
      (1.0f + 0.5f * aside * aside + size * aside);
  }
  const float extent = 2.0f * (half + 1.0f) + 1.0f; // low-pass, and pixels that are cut
  return extent < largestView ? extent : largestView;
}

/// Edge in pixels of a square that each splat of the node fits into, as far as it is in the view.
float largestSplat(const RasterItem& item, const RasterItems& items)
{
  if (item.passes.squares)
  {
    return static_cast<float>(item.passes.squareSize);
  }
  const RasterCamera& camera = item.camera;
  const SplatPass& pass = item.passes.blended ? item.passes.second : item.passes.first;
  const float reach = camera.parallel ? 1.0f : nearestDepth(item, items);
  const float share = item.passes.blended ? item.passes.secondRadius : item.passes.firstRadius;
  float pixels = PointShapes::largestRadius(item) * share * camera.scaleY / reach;
  if (item.style->size.mode == SplatSize::Mode::Pixels)
  {
    pixels = 0.5f * static_cast<float>(item.style->size.value) * share;
  }
  return largestExtent(
    std::clamp(pixels, pass.leastRadius, pass.mostRadius), camera, items.plan().camera);
}

SlotRecords::Record recordOf(const RasterItem& item, const FramePlan& plan)
{
  const NodeColumns& node = item.node();
  SlotRecords::Record record;
  record.origin = SlotOrigin::of(plan.grid, node.halfSize, node.origin, plan.camera.reference);
  record.firstId = node.firstPoint;
  record.place =
    glm::vec4(item.camera.matrix[0][3], item.camera.matrix[1][3], item.camera.matrix[2][3], 0.0f);
  const bool bounded = !item.item->refined && !node.leaf;
  record.radii = glm::vec4(item.item->closingRadius, item.item->radiusScale, bounded ? 1.0f : 0.0f,
    item.item->sparsestRadius);
  record.growth = item.item->growth;
  return record;
}

/// How many of the first points have their full size, a little more than that: numbers of growth
/// are rounded on their way through the slots.
std::uint32_t fullPoints(const RasterItem& item, std::uint32_t end)
{
  const PointGrowth& growth = item.item->growth;
  return growth.whole() ? end
                        : PointGrowth{ growth.first - 1e-4f, growth.perPoint }.fullPoints(end);
}

/// The size of an item's first `points` points.
SizeTerms sizeOnceDrawn(const RasterItem& item, std::uint32_t points)
{
  SizeTerms size = item.sizeTerms();
  size.growth = fullPoints(item, points) >= points ? PointGrowth() : size.growth;
  return size;
}

} // namespace

SplatGroups::SplatGroups() = default;
SplatGroups::~SplatGroups() = default;

/// In the order of the nodes: of two points at one depth the first one is seen, as in the software
/// back end.
std::int64_t SplatGroups::list(const FramePlan& plan, const GpuPool& pool, float largestPointPx,
  bool samePicture, SlotRecords& records, bool growsApart)
{
  groups_.clear();
  rounds_.clear();
  listed_.clear();
  shown_ = {};
  blended_ = false;
  records.begin(pool.memory().slotCount());
  std::int64_t points = 0;
  do
  {
    const std::size_t from = rounds_.empty() ? 0 : rounds_.back()->end();
    rounds_.push_back(std::make_unique<RasterItems>(plan, from));
    const RasterItems& items = *rounds_.back();
    shown_ = around(shown_, shownRectangle(items));
    for (const RasterItem& item : items.items())
    {
      points += add(items, item, pool, largestPointPx, records);
    }
  } while (!rounds_.back()->last());
  goesOn_ = samePicture && continuesLast(plan);
  addsNothing_ = true;
  grows_ = false;
  for (Listed& one : listed_)
  {
    Group& group = groupOf(one.group);
    blended_ = blended_ || one.group.first->passes.blended;
    const std::uint32_t first = one.group.first->item->first;
    const std::uint32_t from = goesOn_ ? std::max(first, one.drawnUpTo) : first;
    // Covered points are never seen: they would hide what stands in beside them.
    const std::uint32_t end = one.group.first->item->covered ? std::min(one.end, from) : one.end;
    one.end = growsApart ? std::max(from, fullPoints(*one.group.first, end)) : end;
    if (first < one.end)
    {
      pool.addRuns(*one.entry, first, one.end, group.all);
    }
    if (from < one.end)
    {
      pool.addRuns(*one.entry, from, one.end, group.added);
      addsNothing_ = false;
    }
    if (one.end < end)
    {
      pool.addRuns(*one.entry, one.end, end, group.growing);
      grows_ = true;
    }
  }
  return points;
}

std::int64_t SplatGroups::add(const RasterItems& items, const RasterItem& item, const GpuPool& pool,
  float largestPointPx, SlotRecords& records)
{
  const NodeColumns& node = item.node();
  const GpuPool::Entry* const entry = pool.find(node.node);
  const LayerStreams& layer = pool.streamsOf(node.layer);
  std::uint32_t end = entry ? std::min(item.item->last, entry->points) : 0;
  // Points without the values of a mark are not shown unasked.
  const GpuStream values = valueStreamOf(valueSetOf(*item.style));
  const int mark = layer.markOf(*item.style);
  end = mark >= 0 && entry ? std::min(end, entry->values(values)) : end;
  if (end <= item.item->first)
  {
    return 0;
  }
  const auto isThere = [&](GpuStream stream)
  { return layer.has(stream) && entry->values(stream) >= end; };
  SlotRecords::Record record = recordOf(item, items.plan());
  record.coloured = isThere(values);
  record.shaped = isThere(GpuStream::Shape);
  record.sized = isThere(GpuStream::Size);
  records.set(entry->slots, record);
  const bool walls = item.passes.walls();
  if (walls && !isThere(GpuStream::Height))
  {
    return 0; // heights are on their way
  }
  const bool quads = walls || largestSplat(item, items) > largestPointPx;
  listed_.push_back({ { &items, &item, record.shaped, record.sized, quads, mark, {}, {}, {} },
    entry, record, end, 0 });
  return walls ? 0 : end - item.item->first;
}

void SplatGroups::forEach(
  const std::function<void(const RasterItem&, const GpuPool::Entry&)>& visit) const
{
  for (const Listed& one : listed_)
  {
    visit(*one.group.first, *one.entry);
  }
}

SplatGroups::Group& SplatGroups::groupOf(const Group& like)
{
  const auto found = std::find_if(groups_.begin(), groups_.end(),
    [&](const Group& group)
    {
      return group.items == like.items && group.first->style == like.first->style &&
        group.shaped == like.shaped && group.sized == like.sized && group.quads == like.quads &&
        group.mark == like.mark && group.first->passes == like.first->passes;
    });
  if (found != groups_.end())
  {
    return *found;
  }
  groups_.push_back(like);
  return groups_.back();
}

/// Whether all that was drawn last is part of what is listed; says for each of these which of its
/// points are there.
bool SplatGroups::continuesLast(const FramePlan& plan)
{
  if (drawn_.empty() || !sameCamera(camera_, plan.camera) || clippingPlanes_ != plan.clippingPlanes)
  {
    return false;
  }
  std::size_t next = 0;
  for (const Drawn& old : drawn_)
  {
    while (next < listed_.size() && !listed_[next].continues(old))
    {
      ++next;
    }
    if (next == listed_.size())
    {
      return false;
    }
    listed_[next++].drawnUpTo = old.end;
  }
  return true;
}

/// As the software back end: only what pixels are made of counts. What has grown to its full size
/// is as if it never grew.
bool SplatGroups::Listed::continues(const Drawn& old) const
{
  const RasterItem& item = *group.first;
  const SizeTerms size = sizeOnceDrawn(item, old.end);
  const bool sizesComing = item.sizes && !record.sized; // the node's radius stands in for them
  return item.item->node == old.item.node && *item.style == *old.style &&
    item.passes == old.passes && item.item->first == old.item.first && end >= old.end &&
    size == old.size && (!sizesComing || record.radii == old.radii) &&
    record.coloured == old.coloured && record.shaped == old.shaped && record.sized == old.sized;
}

FramePlan SplatGroups::leaving(const FramePlan& plan) const
{
  FramePlan lost;
  static_cast<FrameSetting&>(lost) = plan;
  std::unordered_map<NodeIndex, std::uint32_t> planned;
  for (const DrawBatch& batch : plan.batches)
  {
    lost.batches.push_back({ batch.layer, batch.style, {} });
    for (const PlanItem& item : batch.items)
    {
      std::uint32_t& prefix = planned[item.node->node];
      prefix = item.first == 0 ? std::max(prefix, item.last) : prefix;
    }
  }
  for (const Drawn& old : drawn_)
  {
    PlanItem item = old.item;
    const auto found = planned.find(item.node->node);
    item.first = std::max(item.first, found == planned.end() ? 0 : found->second);
    item.last = item.growth.fullPoints(old.end);
    item.growth = PointGrowth();
    const auto batch = std::find_if(lost.batches.begin(), lost.batches.end(),
      [&](const DrawBatch& each)
      { return each.layer == item.node->layer && *each.style == *old.style; });
    if (item.first < item.last && batch != lost.batches.end() && !old.passes.walls())
    {
      batch->items.push_back(std::move(item));
    }
  }
  return lost;
}

void SplatGroups::keep(const FramePlan& plan)
{
  camera_ = plan.camera;
  clippingPlanes_ = plan.clippingPlanes;
  drawn_.clear();
  std::map<const ResolvedStyle*, std::shared_ptr<const ResolvedStyle>> styles;
  for (const DrawBatch& batch : plan.batches)
  {
    styles[batch.style.get()] = batch.style;
  }
  for (const Listed& one : listed_)
  {
    const RasterItem& item = *one.group.first;
    drawn_.push_back(
      { *item.item, styles[item.style], item.passes, one.end, sizeOnceDrawn(item, one.end),
        one.record.radii, one.record.coloured, one.record.shaped, one.record.sized });
  }
  groups_.clear();
  listed_.clear();
  rounds_.clear();
}

void SplatGroups::forget()
{
  drawn_.clear();
  groups_.clear();
  listed_.clear();
  rounds_.clear();
}

} // namespace pointfront
