#include "pointfront/Query/QueryPlan.h"

#include "pointfront/Disk/StopOfReads.h"
#include "pointfront/Query/ChosenColumns.h"
#include "pointfront/Style/ClassHeights.h"
#include "pointfront/Style/FilterPruning.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <iterator>
#include <memory>
#include <utility>

namespace pointfront
{
namespace
{

/// The classes as a condition on the classification.
Result<AttributeCondition> classCondition(
  const StoreDescription& store, const std::vector<std::uint8_t>& classes)
{
  const std::optional<std::size_t> column = store.schema.find("classification");
  if (!column)
  {
    return makeError(Error::Kind::BadArgument,
      store.path + ": the store has no classification of one byte to choose classes by");
  }
  if (store.schema[*column].bytes() != 1)
  {
    return makeError(Error::Kind::BadArgument,
      store.path + ": 'classification' is " + std::string(nameOf(store.schema[*column].type)) +
        ", and classes are of one byte (0 to 255); choose by a condition ('classification == 2')");
  }
  const Attribute& attribute = store.schema[*column];
  AttributeCondition condition;
  condition.column = static_cast<std::uint32_t>(*column);
  for (const std::uint8_t code : classes)
  {
    const double stored =
      attribute.type == ScalarType::Int8 ? static_cast<std::int8_t>(code) : double(code);
    condition.values.push_back(stored * attribute.scale + attribute.offset);
  }
  std::sort(condition.values.begin(), condition.values.end());
  return condition;
}

std::vector<std::byte> keptValues(
  const std::vector<std::byte>& from, const std::vector<std::uint32_t>& kept, std::size_t bytes)
{
  std::vector<std::byte> to(kept.size() * bytes);
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    std::memcpy(to.data() + i * bytes, from.data() + kept[i] * bytes, bytes);
  }
  return to;
}

std::vector<glm::dvec3> worldPositions(const QuantisationGrid& grid, const NodeColumns& node)
{
  std::vector<glm::dvec3> positions(node.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    positions[i] = grid.toWorld(node.origin + GridPosition(node.positions[i]));
  }
  return positions;
}

/// Tight: of a node's own points, not of all below it.
Bounds boxOf(const std::vector<glm::dvec3>& positions)
{
  Bounds box;
  for (const glm::dvec3& p : positions)
  {
    box.add(p);
  }
  return box;
}

} // namespace

Result<void> QueryPlan::chooseColumns(const StoreDescription& store, const PointQuery& query)
{
  Result<ChosenColumns> wanted = query.attributes || query.spacing > 0.0
    ? ChosenColumns::make(store, query.attributes)
    : ChosenColumns::ofInput(store);
  if (!wanted)
  {
    return wanted.error();
  }
  const ColumnSelection tested = filter_.columns();
  std::set_union(wanted->columns.begin(), wanted->columns.end(), tested.begin(), tested.end(),
    std::back_inserter(read_));
  for (const std::uint32_t column : wanted->columns)
  {
    out_.push_back(static_cast<std::size_t>(
      std::lower_bound(read_.begin(), read_.end(), column) - read_.begin()));
  }
  description_ = std::move(wanted->description);
  return {};
}

Result<void> QueryPlan::chooseConditions(
  const StoreDescription& store, const Hierarchy& hierarchy, const PointQuery& query)
{
  if (!(query.spacing >= 0.0))
  {
    return makeError(Error::Kind::BadArgument, "a spacing is 0 or more");
  }
  std::shared_ptr<const ClassHeights> heights;
  if (query.where.wantsHeights(store))
  {
    heights = std::make_shared<const ClassHeights>(store, hierarchy);
  }
  Result<PointFilter> filter = query.where.resolve(store, heights);
  if (!filter)
  {
    return filter.error();
  }
  filter_ = std::move(*filter);
  if (!query.classes.empty())
  {
    Result<AttributeCondition> classes = classCondition(store, query.classes);
    if (!classes)
    {
      return classes.error();
    }
    filter_.conditions.push_back(std::move(*classes));
  }
  return {};
}

Overlap QueryPlan::overlap(const Bounds& box) const
{
  Overlap least = Overlap::Inside;
  for (const std::shared_ptr<const Region>& region : regions_)
  {
    least = std::min(least, region->overlap(box));
  }
  return least;
}

namespace
{
/// Nodes whose children's rows are asked for together. Where rows are read as they are looked into,
/// those that are not here then come beside each other.
constexpr std::size_t nodesAtOnce = 64;

struct OpenNode
{
  NodeIndex index = noNode;
  Node row;
};

/// Waits until the row of each child was here, or is lost, if the table reads rows on demand.
void awaitChildren(const Hierarchy& hierarchy, const std::vector<OpenNode>& nodes)
{
  if (hierarchy.missingRows() == nullptr)
  {
    return;
  }
  std::vector<std::pair<const OpenNode*, std::uint8_t>> coming;
  for (const OpenNode& node : nodes)
  {
    for (std::uint8_t c = 0; c < node.row.childCount; ++c)
    {
      coming.emplace_back(&node, c);
    }
  }
  for (;;)
  {
    const std::uint64_t seen = hierarchy.arrivals();
    // A small cache may have dropped others meanwhile: each is waited for once.
    coming.erase(std::remove_if(coming.begin(), coming.end(),
                   [&](const auto& one)
                   {
                     const auto& [parent, c] = one;
                     Node child;
                     return hierarchy.peekChild(parent->index, parent->row, c, child) !=
                       RowState::Coming;
                   }),
      coming.end());
    if (coming.empty() || StopOfReads::asked())
    {
      return;
    }
    hierarchy.waitForArrival(
      seen, std::chrono::steady_clock::now() + std::chrono::milliseconds(100));
  }
}
} // namespace

/// Those at most one level finer than the wanted spacing; with mean representatives only the last
/// ones of each branch.
Result<void> QueryPlan::chooseNodes(
  const Hierarchy& hierarchy, double spacing, const NodePruning* pruning)
{
  using Verdict = NodePruning::Verdict;
  std::vector<NodeIndex> open(hierarchy.roots());
  std::vector<OpenNode> refined;
  while (!open.empty() || !refined.empty())
  {
    if (open.empty() || refined.size() == nodesAtOnce)
    {
      awaitChildren(hierarchy, refined);
      for (const OpenNode& node : refined)
      {
        hierarchy.appendChildren(node.index, node.row, open);
      }
      refined.clear();
      continue;
    }
    const NodeIndex index = open.back();
    open.pop_back();
    const Node node = hierarchy.node(index);
    const Overlap place = overlap(node.box());
    const Verdict verdict = pruning != nullptr ? pruning->of(index) : Verdict::Draw;
    if (place == Overlap::Outside || verdict == Verdict::Skip)
    {
      continue;
    }
    const bool finer = !node.leaf() && (spacing <= 0.0 || double(node.spacing) > spacing);
    const bool own = hierarchy.refinement() == Refinement::Add || !finer;
    if (node.pointCount > 0 && own && verdict == Verdict::Draw)
    {
      nodes_.push_back({ index, node.pointCount, place != Overlap::Inside });
    }
    if (finer)
    {
      refined.push_back({ index, node });
    }
  }
  std::sort(nodes_.begin(), nodes_.end(),
    [](const PlannedNode& a, const PlannedNode& b) { return a.node < b.node; });
  if (std::optional<Error> damage = hierarchy.fault())
  {
    return *damage;
  }
  if (StopOfReads::asked()) // rows that were not read would be nodes that are left out
  {
    return makeError(Error::Kind::Cancelled, "nobody wants these points any more");
  }
  return {};
}

Result<QueryPlan> QueryPlan::makeWithoutNodes(
  const StoreDescription& store, const Hierarchy& hierarchy, const PointQuery& query)
{
  QueryPlan plan;
  plan.regions_ = query.regions;
  plan.grid_ = store.grid;
  plan.storeSchema_ = store.schema;
  if (Result<void> done = plan.chooseConditions(store, hierarchy, query); !done)
  {
    return done.error();
  }
  if (Result<void> done = plan.chooseColumns(store, query); !done)
  {
    return done.error();
  }
  return plan;
}

Result<QueryPlan> QueryPlan::make(const StoredCloud& store, const PointQuery& query)
{
  Result<QueryPlan> plan = makeWithoutNodes(store.description(), *store.hierarchy(), query);
  if (!plan)
  {
    return plan;
  }
  const auto pruning = pruningOf(store, plan->filter_);
  if (!pruning)
  {
    return pruning.error();
  }
  Result<void> done = plan->chooseNodes(*store.hierarchy(), query.spacing, pruning->get());
  return done ? std::move(plan) : done.error();
}

Result<QueryPlan> QueryPlan::make(
  const StoreDescription& store, const Hierarchy& hierarchy, const PointQuery& query)
{
  Result<QueryPlan> plan = makeWithoutNodes(store, hierarchy, query);
  if (!plan)
  {
    return plan;
  }
  Result<void> done = plan->chooseNodes(hierarchy, query.spacing, nullptr);
  return done ? std::move(plan) : done.error();
}

std::uint64_t QueryPlan::mostPoints() const
{
  std::uint64_t points = 0;
  for (const PlannedNode& node : nodes_)
  {
    points += node.points;
  }
  return points;
}

QueryPlan QueryPlan::piece(unsigned piece, unsigned pieces) const
{
  QueryPlan part = *this;
  part.nodes_.clear();
  const std::uint64_t total = std::max<std::uint64_t>(mostPoints(), 1);
  std::uint64_t before = 0;
  for (const PlannedNode& node : nodes_)
  {
    // A node belongs to the piece in which its middle point lies. In floating point, for points
    // times pieces may overflow; the same on all ranks.
    const double middle = double(before) + 0.5 * node.points;
    const double owner = middle * pieces / double(total);
    if (std::min(static_cast<unsigned>(owner), pieces - 1) == piece)
    {
      part.nodes_.push_back(node);
    }
    before += node.points;
  }
  return part;
}

std::optional<std::vector<std::uint32_t>> QueryPlan::passing(
  const NodeColumns& node, const std::vector<glm::dvec3>& positions, bool tested) const
{
  std::vector<std::uint8_t> keep(node.size());
  filter_.evaluate(node, storeSchema_, 0, static_cast<std::uint32_t>(node.size()), keep.data());
  const Bounds box = tested ? boxOf(positions) : Bounds();
  for (std::size_t r = 0; tested && r < regions_.size(); ++r)
  {
    if (regions_[r]->overlap(box) != Overlap::Inside)
    {
      regions_[r]->keepInside(box, positions.data(), positions.size(), keep.data());
    }
  }
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i < keep.size(); ++i)
  {
    if (keep[i] != 0)
    {
      kept.push_back(static_cast<std::uint32_t>(i));
    }
  }
  if (kept.size() == keep.size())
  {
    return std::nullopt;
  }
  return kept;
}

QueryBatch QueryPlan::choose(std::size_t task, NodeColumns&& node) const
{
  QueryBatch batch;
  batch.node = node.node;
  std::vector<glm::dvec3> positions = worldPositions(grid_, node);
  std::optional<std::vector<std::uint32_t>> kept;
  if (nodes_[task].tested || !filter_.empty())
  {
    kept = passing(node, positions, nodes_[task].tested);
  }
  PointBatch& points = batch.points;
  points.columns.resize(out_.size());
  if (!kept)
  {
    batch.ids.resize(positions.size());
    points.positions = std::move(positions);
    for (std::size_t i = 0; i < batch.ids.size(); ++i)
    {
      batch.ids[i] = node.firstPoint + i;
    }
    for (std::size_t c = 0; c < out_.size(); ++c)
    {
      points.columns[c] = std::move(node.columns[out_[c]]);
    }
    return batch;
  }
  batch.ids.reserve(kept->size());
  points.positions.reserve(kept->size());
  for (const std::uint32_t i : *kept)
  {
    batch.ids.push_back(node.firstPoint + i);
    points.positions.push_back(positions[i]);
  }
  for (std::size_t c = 0; c < out_.size(); ++c)
  {
    points.columns[c] = keptValues(node.columns[out_[c]], *kept, schema()[c].bytes());
  }
  return batch;
}

NodeSweep QueryPlan::sweep() const
{
  NodeSweep sweep;
  sweep.count = nodes_.size();
  sweep.columns = read_;
  sweep.resultBytes = sizeof(std::uint64_t) + sizeof(glm::dvec3) + schema().pointBytes();
  sweep.node = [this](std::size_t i) { return nodes_[i].node; };
  sweep.points = [this](std::size_t i) { return nodes_[i].points; };
  sweep.choose = [this](std::size_t i, NodeColumns&& node) { return choose(i, std::move(node)); };
  return sweep;
}

Result<QueryReport> QueryPlan::run(
  const NodeReader& reader, const QueryOptions& options, const QueryConsumer& consume) const
{
  return sweepNodes(reader, sweep(), options, consume);
}

std::size_t QueryPlan::leastMemoryBytes(const NodeReader& reader) const
{
  return leastSweepBytes(reader, sweep());
}

Result<QueryReport> queryPoints(const StoredCloud& store, const PointQuery& query,
  const QueryOptions& options, const QueryConsumer& consume)
{
  const Result<QueryPlan> plan = QueryPlan::make(store, query);
  if (!plan)
  {
    return plan.error();
  }
  return plan->run(store, options, consume);
}

} // namespace pointfront
