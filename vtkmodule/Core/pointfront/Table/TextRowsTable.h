#pragma once

#include "pointfront/Table/TextRows.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
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

  /// Lets the values decide where a field's own type cannot hold them all, and says so. No values:
  /// the type stays.
  static void widenTypes(const std::vector<FieldStatistics>& values,
    std::vector<TableField>& fields, std::vector<std::string>& warnings)
  {
    for (std::size_t f = 0; f < fields.size(); ++f)
    {
      if (fields[f].type && !values[f].empty() && !holds(*fields[f].type, values[f]))
      {
        warnings.push_back("'" + fields[f].name + "' has values that its type, " +
          std::string(nameOf(*fields[f].type)) + ", does not hold; they are kept as they are.");
        fields[f].type.reset();
      }
    }
  }

private:
  static bool holds(ScalarType type, const FieldStatistics& values)
  {
    return visitScalar(type,
      [&](auto zero)
      {
        using T = decltype(zero);
        const bool inside = values.low >= static_cast<double>(std::numeric_limits<T>::lowest()) &&
          values.high <= static_cast<double>(std::numeric_limits<T>::max());
        return inside && (std::is_floating_point_v<T> || (values.whole && values.notFinite == 0));
      });
  }

  std::optional<TextRows> rows_;
};

} // namespace pointfront
