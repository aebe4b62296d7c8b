#pragma once

#include "pointfront/Ingest/CellTable.h"
#include "pointfront/Records/RecordLayout.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// Records of one class in one cell that lie one behind the other in the pool.
struct CellRun
{
  TreePosition cell{ 0 }; ///< absolute position >> PoolBlock::shift
  std::uint32_t count = 0;
  std::uint8_t objectClass = 0;
};

/// A block of the pool: records that were read one after another, brought into the order of their
/// cells. Those of one class and cell keep their input order.
struct PoolBlock
{
  std::uint64_t first = 0; ///< number of the first of its records
  std::uint64_t count = 0;
  unsigned shift = 0;
  std::vector<CellRun> runs; ///< they follow each other without a gap
};

/// The cells of a block's records, counted as the records come, so that the block can be written
/// by cells: a part of the tree is then a run of the block, and nothing has to be sorted by parts.
/// Cells    of one size for all blocks; if a block has one for fewer than 64 records, its runs are
///          of cells twice as large, and so on: the list of runs stays small for any order of
///          points.
/// Memory   4 bytes a record, 32 a cell, reused from block to block.
/// Threads  one instance, one thread.
class BlockCells
{
public:
  explicit BlockCells(unsigned shift)
    : shift_(shift)
    , runShift_(shift)
    , slots_(leastSlots)
  {
  }

  void begin(std::size_t records); ///< the next block, of at most so many
  void add(const TreePosition& position, std::uint8_t objectClass)
  {
    const TreePosition cell{ position.x >> shift_, position.y >> shift_, position.z >> shift_ };
    Last& last = last_[objectClass]; // neighbours in a file are neighbours in space
    if (last.number == none || last.cell != cell)
    {
      last = { cell, numberOf({ cell, 0, objectClass }, cells_) };
    }
    ++cells_[last.number].count;
    numbers_[records_++] = last.number;
  }
  /// Adds the block to `counts`.
  void countInto(ClassCounts& counts) const;

  /// Runs of the block, by class and then along the Morton curve.
  std::vector<CellRun> order();
  unsigned runShift() const { return runShift_; } ///< shift of order()
  /// After order(): each record to its place.
  void scatter(const std::byte* records, std::size_t recordBytes, std::byte* to);

private:
  static constexpr std::uint32_t none = 0xffffffffu;
  static constexpr std::size_t leastSlots = 1024;
  struct Last
  {
    TreePosition cell{ 0 };
    std::uint32_t number = none;
  };
  std::uint32_t numberOf(const CellRun& cell, std::vector<CellRun>& cells);
  void coarsen();

  unsigned shift_;
  unsigned runShift_;
  std::array<Last, 256> last_{};
  std::vector<CellRun> cells_; // in the order in which they were met
  std::size_t met_ = 0; // cells of the last block that was ordered
  std::size_t records_ = 0;
  std::vector<std::uint32_t> numbers_; // number of each record's cell
  std::vector<std::uint32_t> slots_; // hash table of numbers in cells_, plus one
  std::vector<std::uint32_t> places_; // where the next record of each cell goes
};

} // namespace pointfront
