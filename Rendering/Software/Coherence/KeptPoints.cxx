#include "KeptPoints.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <iterator>
#include <utility>

namespace pointfront
{
namespace
{

/// The share of the most points that is left when there are more: copying takes its time, and more
/// come with each frame.
constexpr double leftShare = 0.875;

/// A node of these points only; all else is as in `model`.
std::shared_ptr<const NodeColumns> copied(
  const NodeColumns& model, const std::vector<VisiblePoint>& points)
{
  auto columns = std::make_shared<NodeColumns>();
  columns->node = model.node;
  columns->origin = model.origin;
  columns->firstPoint = model.firstPoint;
  columns->halfSize = model.halfSize;
  columns->spacing = model.spacing;
  columns->splatRadius = model.splatRadius;
  columns->layer = model.layer;
  columns->parent = model.parent;
  columns->leaf = model.leaf;
  columns->selection = model.selection;
  columns->columns.resize(model.columns.size());
  columns->positions.reserve(points.size());
  for (const VisiblePoint& point : points)
  {
    columns->positions.push_back(point.from->positions[point.point]);
  }
  for (std::size_t c = 0; c < model.columns.size(); ++c)
  {
    const std::size_t bytes = model.columns[c].size() / std::max<std::size_t>(1, model.size());
    columns->columns[c].resize(points.size() * bytes);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      std::memcpy(columns->columns[c].data() + i * bytes,
        points[i].from->columns[c].data() + points[i].point * bytes, bytes);
    }
  }
  return columns;
}

bool before(const VisiblePoint& a, const VisiblePoint& b)
{
  return a.indexInNode < b.indexInNode;
}

} // namespace

std::vector<VisiblePoint> KeptNode::all() const
{
  std::vector<VisiblePoint> points;
  points.reserve(indices_.size());
  for (std::uint32_t i = 0; i < indices_.size(); ++i)
  {
    points.push_back({ indices_[i], i, item_.node.get() });
  }
  return points;
}

void KeptNode::add(const std::vector<VisiblePoint>& points, const PlanItem& as, std::uint32_t frame)
{
  if (points.empty())
  {
    return;
  }
  const NodeColumns& model = *points.front().from;
  if (!indices_.empty() && item_.node->selection != model.selection)
  {
    indices_.clear();
    seen_.clear();
  }
  const std::vector<VisiblePoint> old = all();
  std::vector<VisiblePoint> fresh;
  std::set_difference(
    points.begin(), points.end(), old.begin(), old.end(), std::back_inserter(fresh), before);
  if (fresh.empty())
  {
    return;
  }
  std::vector<VisiblePoint> merged;
  merged.reserve(old.size() + fresh.size());
  std::merge(
    old.begin(), old.end(), fresh.begin(), fresh.end(), std::back_inserter(merged), before);
  std::vector<std::uint32_t> seen;
  seen.reserve(merged.size());
  for (const VisiblePoint& point : merged)
  {
    seen.push_back(point.from == item_.node.get() ? seen_[point.point] : frame);
  }
  if (old.empty())
  {
    item_ = as;
  }
  take(merged, std::move(seen));
}

void KeptNode::take(const std::vector<VisiblePoint>& points, std::vector<std::uint32_t> seen)
{
  std::vector<std::uint32_t> indices;
  indices.reserve(points.size());
  for (const VisiblePoint& point : points)
  {
    indices.push_back(point.indexInNode);
  }
  item_.node = points.empty() ? nullptr : copied(*points.front().from, points);
  indices_ = std::move(indices);
  seen_ = std::move(seen);
  item_.first = 0;
  item_.last = static_cast<std::uint32_t>(indices_.size());
}

void KeptNode::dropUnseen(std::uint32_t frame, std::uint64_t& more)
{
  std::vector<VisiblePoint> left;
  std::vector<std::uint32_t> seen;
  for (const VisiblePoint& point : all())
  {
    const std::uint32_t last = seen_[point.point];
    const bool stays = last > frame || (last == frame && more > 0);
    more -= last == frame && stays ? 1 : 0;
    if (stays)
    {
      left.push_back(point);
      seen.push_back(last);
    }
  }
  if (left.size() < indices_.size())
  {
    take(left, std::move(seen));
  }
}

void KeptNode::setPlanned(std::uint32_t points)
{
  const auto first = std::lower_bound(indices_.begin(), indices_.end(), points);
  item_.first = static_cast<std::uint32_t>(first - indices_.begin());
}

void bound(KeptNodes& nodes, std::uint64_t points)
{
  std::uint64_t count = 0;
  for (const auto& [node, kept] : nodes)
  {
    count += kept.seen().size();
  }
  if (count <= points)
  {
    return;
  }
  std::map<std::uint32_t, std::uint64_t, std::greater<>> bySight; // the latest first
  for (const auto& [node, kept] : nodes)
  {
    for (const std::uint32_t frame : kept.seen())
    {
      ++bySight[frame];
    }
  }
  auto left = static_cast<std::uint64_t>(leftShare * static_cast<double>(points));
  std::uint32_t frame = 0; // only some of those that were seen in it stay
  for (const auto& [number, seen] : bySight)
  {
    frame = number;
    if (seen >= left)
    {
      break;
    }
    left -= seen;
  }
  for (auto node = nodes.begin(); node != nodes.end();)
  {
    node->second.dropUnseen(frame, left);
    node = node->second.indices().empty() ? nodes.erase(node) : std::next(node);
  }
}

} // namespace pointfront
