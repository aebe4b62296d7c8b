#include "pointfront/Build/TreeConstruction.h"

#include "pointfront/Means/KdMeanBuilder.h"
#include "pointfront/Means/MeanSubtreeBuilder.h"
#include "pointfront/Trees/KdPool.h"
#include "pointfront/Trees/KdSubtreeBuilder.h"
#include "pointfront/Trees/PartPool.h"
#include "pointfront/Trees/SubtreeBuilder.h"

#include <algorithm>

namespace pointfront
{
namespace
{
class OctreeConstruction final : public TreeConstruction
{
public:
  OctreeConstruction(const BuildOptions& options, const ConstructionSite& site)
    : refinement_(options.refinement)
    , recordBytes_(site.recordBytes)
    , pooled_(site.pooled)
    , parts_(site.pool, site.recordBytes, site.plan, site.crew)
  {
    rule_.nodePoints = options.nodePoints;
  }
  Result<void> cut(
    const PoolPreparation& points, ClassCounts counts, unsigned /*hintedShift*/) override
  {
    layers_ = points.layers;
    return parts_.build(points, std::move(counts));
  }
  AssemblyPlan assembly(const NodeEmitter& emitter) const override
  {
    AssemblyPlan plan;
    plan.tree = parts_.partition().tree();
    plan.load = [this](std::uint32_t part) { return parts_.load(part); };
    plan.builder = [this, &emitter] { return builder(emitter); };
    return plan;
  }
  std::uint32_t nodeOf(const std::byte* record) const override
  {
    return parts_.partition().nodeAt(layers_.layerOf(record), positionOf(record));
  }
  std::unique_ptr<TreeBuilder> partialBuilder(const NodeEmitter& emitter) const override
  {
    return builder(emitter);
  }
  std::size_t partialChildren() const override { return 0; }
  OpenSubtree reopened(OpenSubtree finished) const override { return finished; }
  double seconds() const override { return parts_.seconds(); }

private:
  std::unique_ptr<TreeBuilder> builder(const NodeEmitter& emitter) const
  {
    if (refinement_ == Refinement::Add)
    {
      return std::make_unique<SubtreeBuilder>(emitter, rule_, recordBytes_);
    }
    return std::make_unique<MeanSubtreeBuilder>(
      emitter, rule_, MeanRecord(emitter.space(), pooled_), recordBytes_, parts_.partition());
  }

  Refinement refinement_;
  std::size_t recordBytes_;
  const AttributeSchema& pooled_;
  SamplingRule rule_;
  ClassLayers layers_;
  PartPool parts_;
};

KdRule kdRule(const BuildOptions& options)
{
  KdRule rule;
  rule.nodePoints = options.nodePoints;
  rule.leavesOnly = options.refinement == Refinement::Replace;
  return rule;
}

class KdConstruction final : public TreeConstruction
{
public:
  KdConstruction(const BuildOptions& options, const ConstructionSite& site)
    : rule_(kdRule(options))
    , recordBytes_(site.recordBytes)
    , pooled_(site.pooled)
    , parts_(site.pool, site.recordBytes, site.plan, site.crew)
  {
  }
  Result<void> cut(const PoolPreparation& points, ClassCounts counts, unsigned hintedShift) override
  {
    return parts_.build(points, std::move(counts), hintedShift, rule_);
  }
  AssemblyPlan assembly(const NodeEmitter& emitter) const override
  {
    AssemblyPlan plan;
    plan.tree = parts_.tree();
    plan.load = [this](std::uint32_t part) { return parts_.load(part); };
    plan.builder = [this, &emitter]() -> std::unique_ptr<TreeBuilder>
    {
      return rule_.leavesOnly ? meanBuilder(emitter)
                              : std::make_unique<KdSubtreeBuilder>(
                                  emitter, rule_, recordBytes_, parts_.tree(), parts_.shares());
    };
    return plan;
  }
  std::uint32_t nodeOf(const std::byte* record) const override { return parts_.nodeOf(record); }
  /// A balanced tree needs all points: what is above the finished parts is an octree's sample.
  /// Means need no balance.
  std::unique_ptr<TreeBuilder> partialBuilder(const NodeEmitter& emitter) const override
  {
    if (rule_.leavesOnly)
    {
      return meanBuilder(emitter);
    }
    SamplingRule rule;
    rule.nodePoints = rule_.nodePoints;
    return std::make_unique<SubtreeBuilder>(emitter, rule, recordBytes_);
  }
  /// A binary tree of samples would have nearly nothing at its root.
  std::size_t partialChildren() const override { return rule_.leavesOnly ? 0 : 8; }
  /// The root has its points; those owed to the nodes above become a node that has them.
  OpenSubtree reopened(OpenSubtree finished) const override
  {
    if (rule_.leavesOnly)
    {
      return finished;
    }
    constexpr float coarser = 1.5f; // than its child, like any node
    auto above = std::make_unique<BuiltNode>();
    above->row.spacing = coarser * finished.root->row.spacing;
    above->row.splatRadius = coarser * finished.root->row.splatRadius;
    above->children.push_back(std::move(finished.root));
    return { std::move(above), std::move(finished.records) };
  }
  double seconds() const override { return parts_.seconds(); }

private:
  std::unique_ptr<TreeBuilder> meanBuilder(const NodeEmitter& emitter) const
  {
    return std::make_unique<KdMeanBuilder>(
      emitter, rule_, MeanRecord(emitter.space(), pooled_), recordBytes_);
  }

  KdRule rule_;
  std::size_t recordBytes_;
  const AttributeSchema& pooled_;
  KdPool parts_;
};
} // namespace

std::unique_ptr<TreeConstruction> treeConstruction(
  const BuildOptions& options, const ConstructionSite& site)
{
  if (options.structure == Structure::KdTree)
  {
    return std::make_unique<KdConstruction>(options, site);
  }
  return std::make_unique<OctreeConstruction>(options, site);
}

std::size_t constructionBytes(const BuildOptions& options, const AttributeSchema& pooled)
{
  const bool kdTree = options.structure == Structure::KdTree;
  // Positions and lists of points.
  const std::size_t lists = kdTree ? sizeof(TreePosition) + 2 * sizeof(std::uint32_t) : 0;
  if (options.refinement == Refinement::Add)
  {
    return lists;
  }
  // The inputs of a node, and a representative for every third of them; in a kd-tree for every
  // second one, and inputs twice while they are sorted.
  const std::size_t representative = MeanRecord(TreeSpace(), pooled).bytes();
  return lists + sizeof(TreePosition) +
    (kdTree ? 2 * sizeof(MeanInput) + representative : sizeof(MeanInput) + representative / 2);
}

std::size_t constructionBlockBytes(const BuildOptions& options)
{
  // The cells of a kd-tree's histogram are so small that a block has one for every few points: its
  // run, in a list that grows by doubling and in the coarser one, and its slot.
  return options.structure == Structure::KdTree ? 2 * sizeof(CellRun) : 0;
}

std::uint64_t constructionTableBytes(const BuildOptions& options, std::uint64_t points)
{
  // The small cells of a kd-tree fill the table up to its limit, again and again: it has four slots
  // a cell, and as much again while it becomes a coarser one.
  constexpr std::uint64_t slotsACell = 8;
  return options.structure == Structure::KdTree
    ? std::min<std::uint64_t>(points, CellCounts::limit) * slotsACell * sizeof(CellTable::Entry)
    : 0;
}

std::uint64_t constructionPart(const BuildOptions& options)
{
  // A part owes about as much to the nodes above it as one node has.
  return options.structure == Structure::KdTree
    ? kdRule(options).partPoints() + 2ull * options.nodePoints
    : 0;
}

unsigned countedCellsLog2(const BuildOptions& options)
{
  return options.structure == Structure::KdTree ? KdPool::histogramCellsLog2 : rootCellsLog2;
}

} // namespace pointfront
