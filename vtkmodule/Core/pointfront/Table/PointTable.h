#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Points/PointSource.h"
#include "pointfront/Points/ScalarType.h"
#include "pointfront/Table/FieldStatistics.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// A field: one number in every row of a foreign file.
/// Name   as the file gives it; "name[k]" is component k of an array field.
struct TableField
{
  std::string name;
  std::optional<ScalarType> type; ///< nothing: text, its values decide
};

/// Rows of a chunk as numbers, one column a field. Columns that nobody asked for are empty.
/// Exactness  every type of up to 32 bits and every float is exact in a double; integers of 64 bits
///            are so up to 2^53, beyond by `wholes`.
struct TableBlock
{
  std::vector<std::vector<double>> columns;
  /// The same numbers as the bits of 64-bit integers, signed where the double is negative; empty
  /// for columns whose doubles are exact. The whole may be empty, too.
  std::vector<std::vector<std::uint64_t>> wholes;

  void resize(std::size_t rows, const std::vector<bool>& wanted)
  {
    columns.resize(wanted.size());
    wholes.clear();
    for (std::size_t f = 0; f < wanted.size(); ++f)
    {
      columns[f].resize(wanted[f] ? rows : 0);
    }
  }
  /// Room for the exact integers of a wanted column.
  std::vector<std::uint64_t>& wholesOf(std::size_t field)
  {
    wholes.resize(columns.size());
    wholes[field].resize(columns[field].size());
    return wholes[field];
  }
};

/// A foreign file of the usual form: rows of named numbers, cut into chunks. The table does not
/// know what the names mean: TableSource turns it into points.
/// Threads   read() is thread-safe; the rest is constant.
class PointTable
{
public:
  virtual ~PointTable() = default;
  virtual const std::string& path() const = 0;
  virtual const std::string& format() const = 0; ///< for messages: "PLY ascii" ...
  virtual const std::vector<TableField>& fields() const = 0;
  /// Faults of the file that the table survived, each a full sentence.
  virtual const std::vector<std::string>& warnings() const = 0;
  virtual std::uint64_t chunkCount() const = 0;
  virtual std::uint64_t chunkRows(std::uint64_t chunk) const = 0;
  /// Fills the wanted columns with chunkRows(chunk) values each. A row that is no row (text) is NaN
  /// in every column.
  virtual Result<void> read(
    std::uint64_t chunk, const std::vector<bool>& wanted, TableBlock& block) const = 0;
  /// Points that the file's header claims, if it does.
  virtual std::optional<std::uint64_t> headerPointCount() const { return std::nullopt; }
  /// One for each field if the table had to look at every value anyway (text); else empty.
  virtual std::vector<FieldStatistics> statistics() const { return {}; }
  /// The grid that all positions lie on, if the file says so; else their digits decide.
  virtual std::optional<QuantisationGrid> grid() const { return std::nullopt; }
  /// The origin of its coordinates: added to every position.
  virtual glm::dvec3 origin() const { return glm::dvec3(0.0); }
  /// SourceDescription::scanners; `positions` is where the points are, as far as that is known.
  virtual std::vector<ScannerPlace> scanners(const Bounds& positions) const
  {
    static_cast<void>(positions);
    return {};
  }
};

} // namespace pointfront
