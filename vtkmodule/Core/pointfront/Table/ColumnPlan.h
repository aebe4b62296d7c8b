#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Points/AttributeSchema.h"
#include "pointfront/Table/PointTable.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// Which fields of a table make up which attribute of a point.
/// Colours     three fields of 8 bits: rgb u8; of 8 or 16 bits: u16. Others are decided by all
///             values of the file: fractions from 0 to 1 are spread over 8 bits if they are 255ths,
///             over 16 if not; whole numbers up to 255 are 8 bits, up to 65,535 16 bits. What is
///             none of these is kept as attributes "red", "green", "blue".
/// Well-known  a field becomes an attribute of the type that AttributeSchema names if all its
///             values fit; else it keeps its own.
/// Own types   a binary file's are kept. Text: the smallest integer, float32 if six digits are
///             enough, else float64.
struct ColumnPlan
{
  struct Column
  {
    std::vector<std::size_t> fields; ///< one for each component
    double factor = 1.0; ///< stored = value * factor; integers are rounded
  };
  std::array<std::optional<std::size_t>, 3> position; ///< field of x, y, z; without z: 0
  AttributeSchema schema;
  std::vector<Column> columns; ///< as in the schema
  std::vector<std::string> warnings;

  /// Fields that are read for points: position and columns.
  std::vector<bool> wanted(std::size_t fieldCount) const;
  /// Errors  BadFormat: no x or y, one of them twice; `path` is for messages.
  static Result<ColumnPlan> make(const std::vector<TableField>& fields,
    const std::vector<FieldStatistics>& statistics, const std::string& path);
};

/// Fields whose values must all be known before their type can be chosen.
std::vector<bool> undecidedFields(const std::vector<TableField>& fields);

} // namespace pointfront
