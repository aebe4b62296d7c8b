#pragma once

#include "pointfront/Build/CellTable.h"
#include "pointfront/Build/CommonSchema.h"
#include "pointfront/Build/RecordLayout.h"
#include "pointfront/Build/TreeSpace.h"

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
  OutsideGrid, ///< more than 2^53 steps from the grid's origin
  Count
};

const char* nameOf(Rejection reason);

/// Turns batches of a source into packed records, one batch after another.
/// Threads  one instance a thread.
class RecordPacker
{
public:
  /// `classOffset`: the byte of a record by which cells are counted apart; nothing: class 0.
  RecordPacker(const CommonSchema& schema, const TreeSpace& space, unsigned cellShift,
    std::optional<std::size_t> classOffset);

  /// Packs a batch that came from `source`; rejected points are removed from the batch first.
  void pack(const AttributeSchema& sourceSchema, std::size_t source, PointBatch& batch);

  const std::vector<std::byte>& records() const { return records_; }
  std::size_t count() const { return count_; }                   ///< of the last batch
  std::uint16_t largestColour() const { return largestColour_; } ///< of the last batch

  /// Over all batches:
  const ClassCounts& counts() const { return counts_; }
  const GridPosition& low() const { return low_; } ///< grid steps
  const GridPosition& high() const { return high_; }
  std::uint64_t rejected(Rejection reason) const { return rejected_[std::size_t(reason)]; }

private:
  /// Points `begin` to `end` - 1 of the batch; count_ grows by those kept.
  void quantise(
    PointBatch& batch, const AttributeSchema& sourceSchema, std::size_t begin, std::size_t end);
  /// Column values of the kept points from `begin` on.
  void packColumn(const AttributeSchema& sourceSchema, const ColumnMapping& mapping,
    std::size_t column, const PointBatch& batch, std::size_t begin);
  void countCells();

  const CommonSchema& schema_;
  const TreeSpace& space_;
  RecordLayout layout_;
  std::optional<std::size_t> colour_; ///< the column whose largest value matters
  std::vector<std::byte> records_;
  std::vector<std::byte> converted_;
  std::size_t count_ = 0;
  std::uint16_t largestColour_ = 0;
  /// Neighbours in a file are neighbours in space: points of one class that follow each other in a
  /// cell are counted at once.
  struct Run
  {
    TreePosition cell{0};
    std::uint64_t count = 0;
  };
  void endRun(std::uint8_t objectClass, unsigned shift);
  std::optional<std::size_t> classOffset_;
  std::array<Run, 256> runs_{}; // of each class
  ClassCounts counts_;
  GridPosition low_{INT64_MAX};
  GridPosition high_{INT64_MIN};
  std::array<std::uint64_t, std::size_t(Rejection::Count)> rejected_{};
};

} // namespace pointfront
