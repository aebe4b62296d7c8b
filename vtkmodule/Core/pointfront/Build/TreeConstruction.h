#pragma once

#include "pointfront/Build/BlockSorter.h"
#include "pointfront/Build/NodeEmitter.h"
#include "pointfront/Build/StoreBuilder.h"
#include "pointfront/Build/TreeAssembly.h"

#include <memory>

namespace pointfront
{

/// What construction needs of a build.
struct ConstructionSite
{
  RecordPool& pool;
  std::size_t recordBytes = 0;
  const MemoryPlan& plan;
  WorkCrew& crew;
  const AttributeSchema& pooled; ///< of the records
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
  /// CPU seconds of cut(), over all threads.
  virtual double seconds() const = 0;
};

/// Of options.structure and options.refinement.
std::unique_ptr<TreeConstruction> treeConstruction(
  const BuildOptions& options, const ConstructionSite& site);

/// Memory in bytes for each point of a part, beyond what every tree needs.
std::size_t constructionBytes(const BuildOptions& options, const AttributeSchema& pooled);
/// Points of the largest part that the tree must have in memory at once, whatever memory there is;
/// 0: parts may be as small as memory wants.
std::uint64_t constructionPart(const BuildOptions& options);

} // namespace pointfront
