#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Ingest/BlockCells.h"
#include "pointfront/Ingest/CellTable.h"
#include "pointfront/Ingest/ClassLayers.h"
#include "pointfront/Ingest/MemoryPlan.h"
#include "pointfront/Ingest/RunSorter.h"
#include "pointfront/Points/WidenedColour.h"
#include "pointfront/Records/MortonOrder.h"
#include "pointfront/Records/RecordPool.h"
#include "pointfront/Records/TreeSpace.h"
#include "pointfront/Threads/WorkCrew.h"
#include "pointfront/Trees/Partition.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <vector>

namespace pointfront
{

/// Colours of files with 8 bits among files with 16 bits: those records are widened.
struct ColourWidening
{
  std::size_t offset = 0; ///< offset of the column in the record
  std::size_t components = 0;
  std::vector<Piece> runs; ///< records to be widened, ascending

  void widen(std::byte* record) const
  {
    for (std::size_t k = 0; k < components; ++k)
    {
      std::uint16_t value;
      std::memcpy(&value, record + offset + 2 * k, sizeof(value));
      value = widenedColour(value);
      std::memcpy(record + offset + 2 * k, &value, sizeof(value));
    }
  }
};

/// The records of the pool when all have been read, and what becomes of them when they are loaded.
struct PoolPreparation
{
  std::uint64_t points = 0; ///< records 0 to points - 1
  TreeSpace space; ///< with its origin; positions in the pool are absolute steps
  unsigned rootLog2 = 0; ///< log2 of the root cube's side
  std::vector<PoolBlock> blocks; ///< blocks of the pool
  std::optional<ColourWidening> widening;
  ClassLayers layers;
  bool findable = false; ///< TreeConstruction::nodeOf() will be called
};

/// Counted cells in Morton order, moved to where they are in the tree.
std::vector<CountedCell> countedCells(const CellTable& table, const TreeSpace& space);

/// For each layer, the bucket of each counted cell, plus one.
using BucketTables = std::vector<CellTable>;

/// Finds buckets of neighbouring records of the pool without a look-up each.
class BucketFinder
{
public:
  BucketFinder(const BucketTables& tables, const ClassLayers& layers, const TreeSpace& space)
    : tables_(tables)
    , layers_(layers)
    , space_(space)
    , last_(tables.size())
  {
  }
  std::uint32_t operator()(const std::byte* record)
  {
    const std::size_t layer = layers_.layerOf(record);
    const TreePosition cell = tables_[layer].cellOf(space_.relativeSteps(positionOf(record)));
    Last& last = last_[layer];
    if (last.bucket == 0 || cell != last.cell)
    {
      last = { cell, tables_[layer].find(cell) };
    }
    return static_cast<std::uint32_t>(last.bucket - 1);
  }

private:
  struct Last
  {
    TreePosition cell{ 0 };
    std::uint64_t bucket = 0;
  };
  const BucketTables& tables_;
  const ClassLayers& layers_;
  const TreeSpace& space_;
  std::vector<Last> last_; // the last cell of each layer
};

/// Walks over the whole pool, block by block, on all threads.
/// Threads  called from one thread, runs on the crew; load() may be called from any thread.
class BlockSorter
{
public:
  BlockSorter(RecordPool& pool, std::size_t recordBytes, const MemoryPlan& plan, WorkCrew& crew)
    : pool_(pool)
    , recordBytes_(recordBytes)
    , plan_(plan)
    , crew_(crew)
  {
  }

  /// Counts once more by layers, from cells of 2^finest steps on, never beyond 2^coarsest.
  Result<ClassCounts> count(const PoolPreparation& points, unsigned finest, unsigned coarsest);

  /// The pieces of each bucket, in input order. Most are runs of blocks, which are there already;
  /// runs of cells that several buckets share are sorted by bucket, each in its own place. Inside
  /// a piece equal positions keep their input order; others are in the order of cells.
  Result<std::vector<std::vector<Piece>>> sort(
    const PoolPreparation& points, const BucketTables& buckets, std::uint32_t bucketCount);

  /// The records of some pieces, with positions relative to the root and colours widened.
  Result<std::vector<std::byte>> load(
    const PoolPreparation& points, const std::vector<Piece>& pieces) const;

  RecordPool& pool() const { return pool_; }
  std::size_t recordBytes() const { return recordBytes_; }
  const MemoryPlan& plan() const { return plan_; }
  WorkCrew& crew() const { return crew_; }
  /// CPU seconds of sort(), over all threads.
  double seconds() const { return seconds_; }

private:
  RecordPool& pool_;
  std::size_t recordBytes_;
  MemoryPlan plan_;
  WorkCrew& crew_;
  double seconds_ = 0.0;
};

} // namespace pointfront
