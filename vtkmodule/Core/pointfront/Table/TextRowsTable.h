#pragma once

#include "pointfront/Table/TextRows.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pointfront
{

/// A table whose rows are lines of text.
class TextRowsTable : public PointTable
{
public:
  TextRowsTable(const TextRowsTable&) = delete;
  TextRowsTable& operator=(const TextRowsTable&) = delete;

  std::uint64_t chunkCount() const override { return rows_->chunkCount(); }
  std::uint64_t chunkRows(std::uint64_t chunk) const override { return rows_->chunkRows(chunk); }
  Result<void> read(
    std::uint64_t chunk, const std::vector<bool>& wanted, TableBlock& block) const override
  {
    return rows_->read(chunk, wanted, block);
  }
  std::vector<FieldStatistics> statistics() const override { return rows_->statistics(); }

protected:
  TextRowsTable() = default;

  /// Before all others. `map` is the table's own: the rows keep its address.
  /// Errors  as TextRows::open().
  Result<void> openRows(
    const MemoryMap& map, const TextRegion& region, TextLayout layout, const SurveyOptions& survey)
  {
    Result<TextRows> rows = TextRows::open(map, region, std::move(layout), survey);
    if (!rows)
    {
      return rows.error();
    }
    rows_.emplace(std::move(*rows));
    return {};
  }
  const TextRows& rows() const { return *rows_; }
  /// Appends what is to be said of lines that are no rows.
  void complain(std::vector<std::string>& warnings) const
  {
    if (std::string complaint = rows_->complaint(); !complaint.empty())
    {
      warnings.push_back(std::move(complaint));
    }
  }

private:
  std::optional<TextRows> rows_;
};

} // namespace pointfront
