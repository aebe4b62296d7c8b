#pragma once

#include "pointfront/Ingest/CommonSchema.h"
#include "pointfront/Points/AttributeSchema.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace pointfront
{

/// The value that all points have in a column, of Attribute::bytes().
using ConstantValue = std::vector<std::byte>;

/// Which columns of the common schema records carry while a store is built. Those that have one
/// value for all points stay out of them, and 16-bit colours whose values fit take 8 bits: a
/// record is moved some five times, and first touching a page of it costs more than all of these.
/// Threads  const after construction.
class RecordColumns
{
public:
  RecordColumns() = default;
  /// All columns as they are, but for those with a value; `narrow`: colours of 8 bits.
  /// `constants` has an entry for each column, or none at all.
  RecordColumns(const AttributeSchema& common, std::vector<std::optional<ConstantValue>> constants,
    std::optional<std::size_t> narrow);

  const AttributeSchema& schema() const { return schema_; } ///< schema of the columns carried
  /// The place of a common column in schema(); nothing for a constant one.
  const std::optional<std::size_t>& place(std::size_t column) const { return places_[column]; }
  const std::optional<ConstantValue>& constant(std::size_t column) const
  {
    return constants_[column];
  }
  /// The common column whose 16-bit values are carried as 8 bits.
  const std::optional<std::size_t>& narrowed() const { return narrowed_; }

  /// The same, with those common columns carried as they are.
  RecordColumns carrying(const AttributeSchema& common, const std::vector<bool>& columns) const;

private:
  AttributeSchema schema_;
  std::vector<std::optional<std::size_t>> places_;
  std::vector<std::optional<ConstantValue>> constants_;
  std::optional<std::size_t> narrowed_;
};

/// The columns that may be left out of records, told apart from those that must not.
struct ColumnGuess
{
  std::vector<bool> mayBeConstant; ///< for each common column
  bool mayBeNarrow = false; ///< 16-bit colours, to 8
};

/// A guess from some chunks all over the sources. Whoever packs the points meets what differs, and
/// begins again without that column: the store is the same, only the time is lost.
/// Reading a chunk that fails is no Error here: the build meets it again.
RecordColumns guessColumns(const std::vector<std::unique_ptr<PointSource>>& sources,
  const CommonSchema& common, const ColumnGuess& guess);

/// Column "rgb" if its values are 16 bits wide.
std::optional<std::size_t> wideColourColumn(const AttributeSchema& schema);

/// True if each of `count` values of `bytes` bytes is `value`.
bool allAre(const std::byte* values, std::size_t bytes, std::size_t count, const std::byte* value);

} // namespace pointfront
