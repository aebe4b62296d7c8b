#pragma once

#include "pointfront/Ingest/BlockCells.h"
#include "pointfront/Ingest/CommonSchema.h"
#include "pointfront/Ingest/RecordColumns.h"
#include "pointfront/Records/RecordLayout.h"
#include "pointfront/Records/TreeSpace.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// Why a point is not stored.
enum class Rejection : std::uint8_t
{
  NotANumber,
  Infinite,
  OutsideGrid, ///< more than 2^53 steps from the grid's origin, or beyond farthestCoordinate
  Count
};

const char* nameOf(Rejection reason);

/// Turns batches of a source into packed records, a block of batches after another.
/// Threads  one instance a thread.
class RecordPacker
{
public:
  /// `classOffset`: the byte of a record by which cells are counted apart; nothing: class 0.
  RecordPacker(const CommonSchema& common, const RecordColumns& columns, const TreeSpace& space,
    unsigned cellShift, std::optional<std::size_t> classOffset);

  /// The next block begins, of at most so many points.
  void begin(std::size_t points);
  /// Appends a batch that came from `source`; rejected points are removed from the batch first.
  /// False when a column is not what the columns left out say: see wrong().
  bool append(const AttributeSchema& sourceSchema, std::size_t source, PointBatch& batch);
  /// Common columns that must be carried after all.
  const std::vector<bool>& wrong() const { return wrong_; }

  std::size_t count() const { return count_; } ///< records of the block
  std::uint16_t largestColour() const { return largestColour_; } ///< largest colour of the block
  /// After the last append() of a block, which is counted then.
  std::vector<CellRun> order();
  unsigned runShift() const { return cells_.runShift(); }
  /// After order(): all records of the block, by cells.
  void writeTo(std::byte* to) { cells_.scatter(records_.data(), layout_.bytes(), to); }

  /// Over all blocks:
  const ClassCounts& counts() const { return counts_; }
  GridPosition low() const { return low_; } ///< grid steps
  GridPosition high() const { return high_; }
  std::uint64_t rejected(Rejection reason) const { return rejected_[std::size_t(reason)]; }

private:
  void takeSteps(const PointBatch& batch, std::size_t begin, std::size_t end);
  /// Points `begin` to `end` - 1 of the batch; those kept follow each other from `kept` on.
  std::size_t quantise(PointBatch& batch, const AttributeSchema& sourceSchema, std::size_t begin,
    std::size_t end, std::size_t kept);
  /// `count` values of the kept points of the batch from `from` on, to the records from `to` on.
  bool packColumn(const AttributeSchema& sourceSchema, const ColumnMapping& mapping,
    std::size_t column, const PointBatch& batch, std::size_t from, std::size_t to,
    std::size_t count);
  void addCells(std::size_t from);

  const CommonSchema& common_;
  const RecordColumns& columns_;
  const TreeSpace& space_;
  RecordLayout layout_;
  std::optional<std::size_t> colour_; ///< the column whose largest value matters
  std::vector<std::byte> records_;
  std::vector<std::byte> converted_;
  std::vector<bool> wrong_;
  std::size_t count_ = 0;
  std::uint16_t largestColour_ = 0;
  std::optional<std::size_t> classOffset_;
  BlockCells cells_;
  ClassCounts counts_;
  GridPosition low_{ INT64_MAX };
  GridPosition high_{ INT64_MIN };
  std::array<std::uint64_t, std::size_t(Rejection::Count)> rejected_{};
};

} // namespace pointfront
