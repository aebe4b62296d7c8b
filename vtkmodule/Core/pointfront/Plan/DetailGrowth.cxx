#include "pointfront/Plan/DetailGrowth.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pointfront
{
namespace
{

/// Share of a prefix over which sizes fall from full to nothing.
constexpr double fallingShare = 0.2;
/// Share of the time that nodes change places in: the new ones are whole from it on, the old ones
/// until then.
constexpr double halfway = 0.5;
constexpr double longestStep = 0.5;

} // namespace

bool GrowthMoment::sees(const Bounds& place) const
{
  const auto reaches = [&](const glm::dvec4& side)
  {
    const glm::dvec3 normal(side);
    const glm::dvec3 farthest(normal.x > 0.0 ? place.high.x : place.low.x,
      normal.y > 0.0 ? place.high.y : place.low.y, normal.z > 0.0 ? place.high.z : place.low.z);
    return glm::dot(normal, farthest) + side.w >= 0.0;
  };
  return std::all_of(sides.begin(), sides.end(), reaches);
}

const DetailGrowth::State* DetailGrowth::States::find(NodeIndex node) const
{
  const auto found = nodes.find(node);
  return found == nodes.end() ? nullptr : &found->second;
}

DetailGrowth::State& DetailGrowth::States::add(NodeIndex node, NodeIndex parent)
{
  if (parent != noNode)
  {
    parents.insert(parent);
  }
  State& state = nodes[node];
  state.parent = parent;
  return state;
}

bool DetailGrowth::States::hasRelatives(NodeIndex node, NodeIndex parent) const
{
  return parents.count(node) != 0 || (parent != noNode && nodes.count(parent) != 0);
}

void DetailGrowth::begin(const GrowthMoment& moment, bool ordered)
{
  const double passed = begun_ ? std::max(0.0, moment.seconds - moment_.seconds) : 0.0;
  const bool first = !begun_ || ordered != ordered_ || moment.duration <= 0.0;
  before_ = first ? States() : std::move(now_);
  now_ = {};
  last_ = first ? GrowthMoment() : moment_;
  moment_ = moment;
  ordered_ = ordered;
  begun_ = true;
  growing_ = false;
  whole_ = true;
  step_ = moment.duration > 0.0 ? std::min(longestStep, passed / moment.duration) : 0.0;
}

void DetailGrowth::reset()
{
  begun_ = false;
  growing_ = false;
  whole_ = true;
  before_ = {};
  now_ = {};
}

DetailGrowth::Shown DetailGrowth::grow(
  const std::shared_ptr<const NodeColumns>& node, std::uint32_t points, bool wasSeen)
{
  if (moment_.duration <= 0.0 || points == 0)
  {
    return { points, points, {} };
  }
  State& state = now_.add(node->node, node->parent);
  state.points = points;
  state.node = node;
  return ordered_ ? growOrdered(state, *node, wasSeen) : growWhole(state, *node, wasSeen);
}

DetailGrowth::Shown DetailGrowth::growOrdered(State& now, const NodeColumns& node, bool wasSeen)
{
  const State* const before = before_.find(node.node);
  const double points = now.points;
  const double falling = std::max(1.0, std::floor(fallingShare * points));
  const double whole = points + falling;
  // All there is of a node is whole in motion too: what is finer follows.
  const double wanted = moment_.moving && now.points < node.size() ? points : whole;
  now.shown = wanted;
  if (before || (wasSeen && before_.find(node.parent)))
  {
    const double last = before ? std::min(before->shown, whole) : 0.0;
    const double most = step_ * whole;
    now.shown = last + std::clamp(wanted - last, -most, most);
  }
  growing_ = growing_ || now.shown != wanted;
  if (now.shown >= whole)
  {
    return { now.points, now.points, {} };
  }
  whole_ = false;
  Shown result;
  result.points = std::min(now.points, static_cast<std::uint32_t>(std::ceil(now.shown)));
  // A prefix that does not change counts as it is wanted, in motion too: small points at its end
  // are no reason for larger splats.
  result.spread = static_cast<std::uint32_t>(std::clamp(now.shown * points / wanted, 1.0, points));
  result.growth.first = static_cast<float>(now.shown / falling);
  result.growth.perPoint = static_cast<float>(1.0 / falling);
  return result;
}

DetailGrowth::Shown DetailGrowth::growWhole(State& now, const NodeColumns& node, bool wasSeen)
{
  const State* const before = before_.find(node.node);
  now.shown = 1.0;
  if (before || (wasSeen && before_.hasRelatives(node.node, node.parent)))
  {
    now.shown = std::min(1.0, (before ? before->shown : 0.0) + step_);
  }
  growing_ = growing_ || now.shown < 1.0;
  whole_ = whole_ && now.shown >= 1.0;
  const PointGrowth growth{ static_cast<float>(std::min(1.0, now.shown / halfway)), 0.0f };
  return { growth.first > 0.0f ? now.points : 0, now.points, growth };
}

std::vector<DetailGrowth::Leaving> DetailGrowth::finish()
{
  std::vector<Leaving> leaving;
  const States drawn = ordered_ || moment_.duration <= 0.0 ? States() : now_;
  for (const auto& [index, old] : before_.nodes)
  {
    const double shown = old.shown - step_;
    const auto node = old.node.lock();
    if (shown > 0.0 && node && !drawn.find(index) && drawn.hasRelatives(index, old.parent))
    {
      const PointGrowth growth{ static_cast<float>(std::min(1.0, shown / halfway)), 0.0f };
      leaving.push_back({ node, old.points, growth });
      State& state = now_.add(index, old.parent);
      state.points = old.points;
      state.node = old.node;
      state.shown = shown;
      growing_ = true;
      whole_ = false;
    }
  }
  before_ = {};
  std::sort(leaving.begin(), leaving.end(),
    [](const Leaving& a, const Leaving& b) { return a.node->node < b.node->node; });
  return leaving;
}

} // namespace pointfront
