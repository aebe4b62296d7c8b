#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Build/CellTable.h"
#include "pointfront/Build/MemoryPlan.h"
#include "pointfront/Build/Partition.h"
#include "pointfront/Build/PointIngest.h"
#include "pointfront/Build/RecordPool.h"
#include "pointfront/Build/WorkCrew.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace pointfront
{

/// A run of records of one part in the pool.
struct Piece
{
  std::uint64_t first = 0;
  std::uint64_t count = 0;
};

/// Colours of files with 8 bits among files with 16 bits: those records are multiplied by 257.
struct ColourWidening
{
  std::size_t offset = 0; ///< of the column in the record
  std::size_t components = 0;
  std::vector<Piece> runs; ///< records to be widened, ascending
};

/// The pool's records, cut into parts: each block of the pool is sorted by part in its own place,
/// so that a part is one piece from each block that it touches. No second copy on disk, no file
/// a part; the pieces of a part are in input order.
/// Threads   build() and its kin run on the crew; load() may be called from any thread.
class PartPool
{
public:
  PartPool(RecordPool& pool, std::size_t recordBytes, const MemoryPlan& plan, WorkCrew& crew);

  /// Moves positions to the root's origin, widens colours, cuts into parts.
  Result<void> build(const IngestedPoints& points, const TreeSpace& space, unsigned rootLog2,
    const std::optional<ColourWidening>& widening);

  const Partition& partition() const { return *partition_; }
  /// The records of a part, in input order.
  Result<std::vector<std::byte>> load(std::uint32_t part) const;
  /// CPU seconds of build(), over all threads.
  double seconds() const { return seconds_; }

private:
  Result<CellCounts> countAgain(std::uint64_t points, unsigned shift);
  Result<void> sortBlocks(std::uint64_t points, const TreeSpace& space,
    const std::optional<ColourWidening>& widening, const CellTable& partOf);
  Result<void> refine(std::uint32_t part);
  void refineByOrder(std::uint32_t part);

  RecordPool& pool_;
  std::size_t recordBytes_;
  MemoryPlan plan_;
  WorkCrew& crew_;
  std::optional<Partition> partition_;
  std::vector<std::vector<Piece>> pieces_; // of each part
  double seconds_ = 0.0;
};

} // namespace pointfront
