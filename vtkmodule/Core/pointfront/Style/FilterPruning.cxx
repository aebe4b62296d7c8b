#include "pointfront/Style/FilterPruning.h"

#include "pointfront/Style/ClassHeights.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pointfront
{
namespace
{

using Verdict = NodePruning::Verdict;

/// Whether a node's own points may pass, and those below it.
struct MayPass
{
  bool own = true;
  bool below = true;
};

/// A condition with the ranges that it is asked with.
struct KnownCondition
{
  AttributeCondition condition;
  std::shared_ptr<const NodeRanges> ranges;
};

bool mayPass(
  const AttributeCondition& condition, const AttributeSchema& schema, const ValueRange& stored)
{
  if (stored.empty())
  {
    return false; // no points, or NaN only, which never passes
  }
  const ValueRange world = inWorldUnits(condition, schema, stored);
  return condition.mayPass(world.low, world.high);
}

/// Conditions of one filter of which the store knows something.
Result<std::vector<KnownCondition>> knownConditions(
  const StoredCloud& store, const PointFilter& filter, NodeIndex mostNodes)
{
  const AttributeSchema& schema = store.description().schema;
  std::vector<KnownCondition> known;
  for (const AttributeCondition& condition : filter.conditions)
  {
    const std::uint32_t component = condition.usesColumn()
      ? rangeComponent(schema, condition.column, static_cast<std::uint32_t>(condition.component))
      : static_cast<std::uint32_t>(condition.axis);
    const auto ranges = store.nodeRanges(component, mostNodes);
    if (!ranges)
    {
      return ranges.error();
    }
    if (*ranges)
    {
      known.push_back({ condition, *ranges });
    }
  }
  return known;
}

/// Judges the nodes that all conditions know; a point passes one filter if it meets all conditions
/// of it, so a node does if none of its conditions excludes it.
std::vector<MayPass> judged(
  const std::vector<KnownCondition>& conditions, const AttributeSchema& schema, NodeIndex nodes)
{
  std::vector<MayPass> result(nodes);
  for (const KnownCondition& known : conditions)
  {
    const NodeIndex count = std::min(nodes, known.ranges->nodeCount());
    for (NodeIndex node = 0; node < count; ++node)
    {
      MayPass& may = result[node];
      may.own = may.own && mayPass(known.condition, schema, known.ranges->own(node));
      may.below = may.below && mayPass(known.condition, schema, known.ranges->below(node));
    }
  }
  return result;
}

Verdict verdictOf(const MayPass& may)
{
  return may.own ? Verdict::Draw : may.below ? Verdict::Descend : Verdict::Skip;
}

/// Null when a style draws all points, or nothing is known of any node.
Result<std::shared_ptr<const NodePruning>> pruningOfLayer(
  const StoredCloud& store, const LayerStyling& layer, NodeIndex mostNodes)
{
  const NodeIndex nodes = std::min(store.hierarchy()->nodeCount(), mostNodes);
  std::vector<MayPass> any(nodes, MayPass{ false, false });
  for (const std::shared_ptr<const ResolvedStyle>& style : layer.styles)
  {
    const auto conditions = knownConditions(store, style->filter, mostNodes);
    if (!conditions)
    {
      return conditions.error();
    }
    if (conditions->empty())
    {
      return std::shared_ptr<const NodePruning>();
    }
    const std::vector<MayPass> may = judged(*conditions, store.description().schema, nodes);
    for (NodeIndex node = 0; node < nodes; ++node)
    {
      any[node].own = any[node].own || may[node].own;
      any[node].below = any[node].below || may[node].below;
    }
  }
  std::vector<Verdict> verdicts(nodes);
  std::transform(any.begin(), any.end(), verdicts.begin(), verdictOf);
  return std::make_shared<const NodePruning>(std::move(verdicts));
}

bool sameFilters(const LayerStyling& a, const LayerStyling& b)
{
  return std::equal(a.styles.begin(), a.styles.end(), b.styles.begin(), b.styles.end(),
    [](const auto& x, const auto& y) { return x->filter == y->filter; });
}

} // namespace

ValueRange inWorldUnits(
  const AttributeCondition& condition, const AttributeSchema& schema, const ValueRange& stored)
{
  const double scale =
    condition.usesColumn() ? schema[condition.column].scale : condition.axisScale;
  const double offset =
    condition.usesColumn() ? schema[condition.column].offset : condition.axisOffset;
  const double a = stored.low * scale + offset;
  const double b = stored.high * scale + offset;
  const ValueRange world{ std::min(a, b), std::max(a, b) };
  if (condition.heights)
  {
    const std::array<double, 2> heights = condition.heights->between(world.low, world.high);
    return { heights[0], heights[1] };
  }
  if (condition.absolute)
  {
    const bool zero = world.low <= 0.0 && world.high >= 0.0;
    return { zero ? 0.0 : std::min(std::abs(world.low), std::abs(world.high)),
      std::max(std::abs(world.low), std::abs(world.high)) };
  }
  return world;
}

Result<std::shared_ptr<const NodePruning>> pruningOf(
  const StoredCloud& store, const PointFilter& filter, NodeIndex mostNodes)
{
  const auto conditions = knownConditions(store, filter, mostNodes);
  if (!conditions)
  {
    return conditions.error();
  }
  if (conditions->empty())
  {
    return std::shared_ptr<const NodePruning>();
  }
  const NodeIndex nodes = std::min(store.hierarchy()->nodeCount(), mostNodes);
  const std::vector<MayPass> may = judged(*conditions, store.description().schema, nodes);
  std::vector<Verdict> verdicts(nodes);
  std::transform(may.begin(), may.end(), verdicts.begin(), verdictOf);
  return std::make_shared<const NodePruning>(std::move(verdicts));
}

Result<std::vector<std::shared_ptr<const NodePruning>>> pruningOf(
  const StoredCloud& store, const std::vector<LayerStyling>& layers, NodeIndex mostNodes)
{
  std::vector<std::shared_ptr<const NodePruning>> pruning(layers.size());
  for (std::size_t l = 0; l < layers.size(); ++l)
  {
    if (!layers[l].visible())
    {
      continue;
    }
    std::size_t same = 0;
    while (!layers[same].visible() || !sameFilters(layers[same], layers[l]))
    {
      ++same; // up to l itself
    }
    if (same < l)
    {
      pruning[l] = pruning[same];
      continue;
    }
    const auto own = pruningOfLayer(store, layers[l], mostNodes);
    if (!own)
    {
      return own.error();
    }
    pruning[l] = *own;
  }
  return pruning;
}

} // namespace pointfront
