#pragma once

#include "pointfront/Base/MemoryMap.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Table/ParallelChunks.h"
#include "pointfront/Table/PointTable.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{

/// How lines are rows of numbers.
struct TextLayout
{
  /// The kind of one cell of a row.
  struct Cell
  {
    std::optional<std::size_t> field; ///< nothing: skipped, whatever it says
    bool list = false; ///< a count, and as many cells behind it; all skipped
  };
  std::vector<Cell> cells; ///< further cells of a row are ignored
  std::size_t fieldCount = 0;
  char separator = ' '; ///< ' ': blanks and tabs, many are one; else one stands between cells
  char decimalPoint = '.';
  char lineEnd = '\n'; ///< a '\r' before it belongs to it
  bool comments = true; ///< lines that begin with # // or % are none
  bool countLines = false; ///< a lone integer says how many rows follow (PTS), and is no row
};

/// The bytes of a file that hold rows.
struct TextRegion
{
  std::size_t begin = 0;
  std::size_t end = 0;
  std::uint64_t firstLine = 1; ///< number of the line that begins at `begin`, for messages
};

/// A part of a mapped text file as a table, in chunks of about 1 MiB of whole lines.
/// Opening   one parallel pass over the text that parses every number: it counts rows, so that
///           chunks can be read in any order, and finds out which lines are no rows, how many
///           decimals there are and between which values each field lies.
/// Rows      blank lines and comments are none. A line with too few cells, or with a cell that is
///           no number, is a row whose every field is NaN: counted, and rejected by the build.
/// Threads   read() is thread-safe.
class TextRows
{
public:
  /// `map` outlives the rows. Errors  Cancelled; NoMemory; of MemoryMap::checkWhole().
  static Result<TextRows> open(const MemoryMap& map, const TextRegion& region, TextLayout layout,
    const SurveyOptions& options);

  std::uint64_t rows() const { return rows_; }
  std::uint64_t chunkCount() const { return chunks_.size(); }
  std::uint64_t chunkRows(std::uint64_t chunk) const
  {
    return chunks_[static_cast<std::size_t>(chunk)].rows;
  }
  /// Errors  of MemoryMap::checkWhole().
  Result<void> read(std::uint64_t chunk, const std::vector<bool>& wanted, TableBlock& block) const;

  const std::vector<FieldStatistics>& statistics() const { return statistics_; }
  std::uint64_t badRows() const { return badRows_; }
  std::uint64_t promisedRows() const { return promisedRows_; } ///< sum of the count lines
  /// "3 of 10 lines are no points; the first is line 7: 'x y'", or nothing if there are none.
  std::string complaint() const;

private:
  struct Chunk
  {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::uint64_t rows = 0;
  };
  struct Findings; ///< the findings of one chunk, see TextRows.cxx

  explicit TextRows(const MemoryMap& map, TextLayout layout)
    : map_(&map)
    , layout_(std::move(layout))
  {
  }
  void cut(const TextRegion& region);
  Findings look(const Chunk& chunk) const;
  const char* text(std::size_t offset) const
  {
    return reinterpret_cast<const char*>(map_->data()) + offset;
  }

  const MemoryMap* map_;
  TextLayout layout_;
  std::vector<Chunk> chunks_;
  std::vector<FieldStatistics> statistics_;
  std::uint64_t rows_ = 0;
  std::uint64_t badRows_ = 0;
  std::uint64_t promisedRows_ = 0;
  std::uint64_t firstBadLine_ = 0;
  std::string firstBad_; ///< its text, shortened
};

/// The first `count` lines of `text` that are not blank end at the offset returned; `lines` counts
/// all that were passed, `found` those that were not blank (fewer if the text ends before).
struct SkippedLines
{
  std::size_t end = 0;
  std::uint64_t lines = 0;
  std::uint64_t found = 0;
};
SkippedLines skipLines(
  const char* text, std::size_t begin, std::size_t end, std::uint64_t count, char lineEnd = '\n');

} // namespace pointfront
