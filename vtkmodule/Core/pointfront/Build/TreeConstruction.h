#pragma once

#include "pointfront/Build/StoreBuilder.h"
#include "pointfront/Trees/BlockSorter.h"
#include "pointfront/Trees/NodeEmitter.h"
#include "pointfront/Trees/TreeAssembly.h"

#include <memory>

namespace pointfront
{

/// The parts of a build that construction needs.
struct ConstructionSite
{
  RecordPool& pool;
  std::size_t recordBytes = 0;
  const MemoryPlan& plan;
  WorkCrew& crew;
  const AttributeSchema& pooled; ///< columns of the records
};

/// One kind of tree, from the pool's records to nodes: the only place that knows which.
/// Threads  called from one thread; what assembly() names is called from all of the crew's.
class TreeConstruction
{
public:
  virtual ~TreeConstruction() = default;
  /// Cuts the pool into parts. `counts`: of the layers' classes, from cells of 2^hintedShift on.
  virtual Result<void> cut(
    const PoolPreparation& points, ClassCounts counts, unsigned hintedShift) = 0;
  /// How the parts become trees. `emitter` and this must outlive the assembly.
  virtual AssemblyPlan assembly(const NodeEmitter& emitter) const = 0;
  /// Where in the tree of assembly() a record of the pool belongs: the deepest node that surely
  /// contains it, a part but for places that several parts share; PartNode::none if it is not one
  /// of the pool's. After cut() with findable points.
  virtual std::uint32_t nodeOf(const std::byte* record) const = 0;
  /// Builds and joins parts of which some have only a sample of their points.
  virtual std::unique_ptr<TreeBuilder> partialBuilder(const NodeEmitter& emitter) const = 0;
  /// Children that partialBuilder() joins at once, at most: nodes of the upper tree are left out
  /// for that, or not if they have as many already.
  virtual std::size_t partialChildren() const = 0;
  /// A finished subtree of the assembly as partialBuilder() joins it.
  virtual OpenSubtree reopened(OpenSubtree finished) const = 0;
  /// CPU seconds of cut(), over all threads.
  virtual double seconds() const = 0;
};

/// Makes the construction for options.structure and options.refinement.
std::unique_ptr<TreeConstruction> treeConstruction(
  const BuildOptions& options, const ConstructionSite& site);

/// Memory in bytes for each point of a part, beyond what every tree needs.
std::size_t constructionBytes(const BuildOptions& options, const AttributeSchema& pooled);
/// The same for each point of a block, while blocks are read and sorted by cells.
std::size_t constructionBlockBytes(const BuildOptions& options);
/// Memory in bytes for each thread that counts the points of cells while blocks are read.
std::uint64_t constructionTableBytes(const BuildOptions& options, std::uint64_t points);
/// Points of the largest part that the tree must have in memory at once, whatever memory there is;
/// 0: parts may be as small as memory wants.
std::uint64_t constructionPart(const BuildOptions& options);

/// How many cells along the extent, as a power of two, should be counted while points are read, so
/// that they need not be counted again.
unsigned countedCellsLog2(const BuildOptions& options);

} // namespace pointfront
