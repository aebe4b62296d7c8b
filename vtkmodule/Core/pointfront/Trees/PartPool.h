#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Trees/BlockSorter.h"
#include "pointfront/Trees/Partition.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace pointfront
{

/// The pool's records, cut into the parts of an octree, or of one for each layer.
/// Threads   build() runs on the crew; load() may be called from any thread.
class PartPool
{
public:
  PartPool(RecordPool& pool, std::size_t recordBytes, const MemoryPlan& plan, WorkCrew& crew);

  /// `counts`: of the layers' classes. `points` must outlive this.
  Result<void> build(const PoolPreparation& points, ClassCounts counts);

  const Partition& partition() const { return *partition_; }
  /// The records of a part; those at equal positions in input order.
  Result<std::vector<std::byte>> load(std::uint32_t part) const;
  /// CPU seconds of build(), over all threads.
  double seconds() const { return sorter_.seconds() + seconds_; }

private:
  BucketTables cut(const PoolPreparation& points, const ClassCounts& counts);
  Result<void> refine(std::uint32_t part);
  void refineByOrder(std::uint32_t part);

  BlockSorter sorter_;
  const PoolPreparation* points_ = nullptr;
  std::optional<Partition> partition_;
  std::vector<std::vector<Piece>> pieces_; // pieces of each part
  double seconds_ = 0.0;
};

} // namespace pointfront
