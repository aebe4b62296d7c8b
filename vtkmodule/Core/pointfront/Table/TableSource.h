#pragma once

#include "pointfront/Points/PointSource.h"
#include "pointfront/Table/ColumnPlan.h"
#include "pointfront/Table/ParallelChunks.h"
#include "pointfront/Table/PointTable.h"

#include <memory>

namespace pointfront
{

/// The points of a PointTable: names become attributes as ColumnPlan says.
/// Opening    looks at all values where a type depends on them, else at the positions of some
///            sixty chunks for the bounds (a hint, as PointSource says), and at those of all others
///            if these lie on decimal steps.
/// Grid       text whose coordinates have so few decimals that the extent fits into 2^31 steps,
///            floating point whose coordinates all lie on decimal steps (DecimalStep), and
///            coordinates that are integers, have a grid of their own, with a step for each axis
///            where one for all is too fine: nothing is rounded, but for what floating point had
///            rounded off a decimal number.
///            Other floating point has none: the build chooses one and says so.
/// Positions  NaN and infinities go through: the build counts them as rejected.
class TableSource final : public PointSource
{
public:
  /// Errors  of ColumnPlan::make and of reading; Cancelled.
  static Result<std::unique_ptr<PointSource>> open(
    std::unique_ptr<PointTable> table, const SurveyOptions& options = {});
  /// The same, for who decodes rows of its own.
  static Result<std::unique_ptr<TableSource>> make(
    std::unique_ptr<PointTable> table, const SurveyOptions& options);

  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return table_->chunkCount(); }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override { return table_->chunkRows(chunk); }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override;
  /// The fields that convert() needs.
  const std::vector<bool>& wanted() const { return wanted_; }
  /// Rows of the table as points.
  void convert(const TableBlock& block, std::size_t rows, PointBatch& batch) const;

private:
  TableSource(std::unique_ptr<PointTable> table, ColumnPlan plan)
    : table_(std::move(table))
    , plan_(std::move(plan))
    , wanted_(plan_.wanted(table_->fields().size()))
  {
  }

  std::unique_ptr<PointTable> table_;
  ColumnPlan plan_;
  std::vector<bool> wanted_;
  SourceDescription description_;
};

} // namespace pointfront
