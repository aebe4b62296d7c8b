#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Trees/BlockSorter.h"
#include "pointfront/Trees/KdCut.h"
#include "pointfront/Trees/PartTree.h"

#include <cstdint>
#include <vector>

namespace pointfront
{

/// The pool's records, cut into the parts of a kd-tree for each layer. Records are moved once for
/// all levels of the upper trees; after that only the cells that a median divides are touched
/// again, each run of them in its own place and with no more memory than a block.
/// Order     the records of a part come block by block, those of divided cells behind the others;
///           those at equal positions in input order, whatever the blocks and threads were.
/// Threads   build() runs on the crew; load() may be called from any thread.
class KdPool
{
public:
  /// Cells along an edge of the root cube that medians are found in, before any are joined.
  static constexpr unsigned histogramCellsLog2 = 10;

  KdPool(RecordPool& pool, std::size_t recordBytes, const MemoryPlan& plan, WorkCrew& crew)
    : sorter_(pool, recordBytes, plan, crew)
  {
  }

  /// `counts`: of the layers' classes; their cells had 2^hintedShift steps at first. `points` must
  /// outlive this.
  Result<void> build(
    const PoolPreparation& points, ClassCounts counts, unsigned hintedShift, const KdRule& rule);

  const std::vector<PartNode>& tree() const { return tree_; }
  /// Shares that each node of tree() owes to those above it, from the root down.
  const std::vector<std::vector<KdShare>>& shares() const { return shares_; }
  /// The records of a part.
  Result<std::vector<std::byte>> load(std::uint32_t part) const;
  /// The node of tree() that surely contains a record: its part, or above a divided cell the one
  /// that all its points lie below; PartNode::none for a point that was not counted. After build()
  /// with findable points.
  std::uint32_t nodeOf(const std::byte* record) const;
  double seconds() const { return sorter_.seconds() + seconds_; }

private:
  Result<ClassCounts> settled(
    const PoolPreparation& points, ClassCounts counts, unsigned hintedShift, std::uint64_t clump);
  void append(const KdCut& cut, std::size_t cells);
  CellTable bucketTable(
    const std::vector<CountedCell>& cells, unsigned shift, std::size_t firstPlace) const;
  std::uint32_t nodeOfPlace(std::uint32_t place) const;
  Result<void> distribute(std::uint32_t place, std::vector<Piece> pieces);
  Result<void> divide(const KdPlace& place, const std::vector<Piece>& pieces,
    std::vector<Piece>& left, std::vector<Piece>& right);

  BlockSorter sorter_;
  const PoolPreparation* points_ = nullptr;
  std::vector<PartNode> tree_;
  std::vector<std::vector<KdShare>> shares_;
  std::vector<KdPlace> places_; // places of all layers
  std::vector<std::uint32_t> divided_; // places of cells that are divided
  std::vector<std::vector<Piece>> pieces_; // pieces of each part
  std::vector<std::uint64_t> counts_; // points of each part
  // Order of findable points:
  ClassLayers layers_;
  BucketTables buckets_;
  std::vector<std::uint32_t> nodeOfPart_;
  double seconds_ = 0.0;
};

} // namespace pointfront
