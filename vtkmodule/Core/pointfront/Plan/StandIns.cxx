#include "pointfront/Plan/StandIns.h"

#include "pointfront/Plan/MeasuredRadius.h"

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{

/// Share of the points of the complete view that are drawn in addition.
constexpr double standInBudget = 0.05;
/// The same where whole levels stand in.
constexpr double wholeLevelsBudget = 0.09;

} // namespace

StandIns::StandIns(const ExpectedNodes& expected)
  : expected_(expected)
{
  const bool wholeLevels = expected.refinement() == Refinement::Replace;
  const double budget = wholeLevels ? wholeLevelsBudget : standInBudget;
  double left = budget * static_cast<double>(expected.points());
  double coarser = 0.0; // points of the level above
  for (const std::uint64_t count : expected.refinedPoints())
  {
    const auto points = static_cast<double>(count);
    const double taken = points <= left ? points : wholeLevels ? 0.0 : left;
    // Fewer than the level above are no finer than that.
    const bool finer = taken > coarser && points > 0.0;
    shares_.push_back(finer ? taken / points : 0.0);
    left -= finer ? taken : left;
    coarser = points;
  }
}

double StandIns::shareOf(std::uint8_t level) const
{
  return level < shares_.size() ? shares_[level] : 0.0;
}

void StandIns::noteWhole(const std::shared_ptr<const NodeColumns>& node, const TabledNode& complete)
{
  noted_.push_back({ node, &complete });
}

/// The share of this node's points is alone in its place: of the nodes above it no more is there.
PlanItem StandIns::itemOf(const Noted& noted) const
{
  const NodeColumns& node = *noted.node;
  const auto points = static_cast<std::uint32_t>(node.size());
  const std::uint32_t most = noted.complete->item.pointCount;
  const double share = shareOf(noted.complete->row.level) * most;
  const float ratio = noted.complete->item.spacingRatio;
  PlanItem item;
  item.node = noted.node;
  item.last = std::clamp(static_cast<std::uint32_t>(share), 1u, most);
  const double r2 = std::min(0.75, double(ratio) * double(ratio));
  const double density = double(item.last) / points * (1.0 - r2);
  const auto scale = static_cast<float>(1.0 / std::sqrt(density));
  const MeasuredRadius whole(node, points, points, node.leaf, ratio);
  item.spacing = whole.spacing * scale;
  item.radiusScale = scale;
  item.closingRadius = whole.closing * scale;
  item.sparsestRadius = item.closingRadius;
  item.unfinished = true;
  item.covered = noted.covered;
  return item;
}

std::vector<DrawBatch> StandIns::batches()
{
  std::sort(noted_.begin(), noted_.end(),
    [](const Noted& a, const Noted& b) { return a.node->node < b.node->node; });
  // Nodes below a node that close the surface by themselves, or with what is below them. Children
  // stand behind their parents in every table.
  std::unordered_map<NodeIndex, std::uint32_t> closed;
  std::vector<DrawBatch> batches;
  std::vector<std::uint8_t> open; // levels of which something is to be seen
  for (std::size_t i = noted_.size(); i-- > 0;)
  {
    Noted& noted = noted_[i];
    const NodeColumns& node = *noted.node;
    const std::uint32_t finer = expected_.finerNodes(node.node);
    const auto below = closed.find(node.node);
    noted.covered = finer == (below == closed.end() ? 0u : below->second);
    const std::uint8_t level = noted.complete->row.level;
    const bool stands = finer > 0 && shareOf(level) > 0.0;
    closed[node.parent] += noted.covered || stands ? 1u : 0u;
    if (!stands)
    {
      continue;
    }
    const auto like = std::find_if(batches.begin(), batches.end(),
      [&](const DrawBatch& batch) { return batch.layer == node.layer && batch.level == level; });
    DrawBatch& batch = like == batches.end()
      ? batches.emplace_back(DrawBatch{ node.layer, nullptr, {}, level })
      : *like;
    batch.items.push_back(itemOf(noted));
    if (!noted.covered)
    {
      open.push_back(level);
    }
  }
  std::stable_sort(batches.begin(), batches.end(),
    [](const DrawBatch& a, const DrawBatch& b) { return a.level > b.level; });
  // All layers of a level are one picture.
  const auto isOver = [&](const DrawBatch& one)
  { return std::find(open.begin(), open.end(), one.level) == open.end(); };
  batches.erase(std::remove_if(batches.begin(), batches.end(), isOver), batches.end());
  return batches;
}

} // namespace pointfront
