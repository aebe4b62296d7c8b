#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Points/AttributeSchema.h"
#include "pointfront/Points/PointSource.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// Where one source has the values of one common column.
struct ColumnMapping
{
  std::optional<std::size_t> column; ///< column of the source; nothing: the source lacks it, zeros
  bool converted = false; ///< type, scale or offset differ from the common column
};

/// The attributes of several sources as one schema.
/// Union       columns of the same name are one column; a source that lacks it gets zeros.
/// Conversion  types that differ become the smallest type that holds both (integers of both
///             signs and 64 bits, or integers and floats: float64); scales that differ become
///             float64 world values.
struct CommonSchema
{
  AttributeSchema schema;
  std::vector<std::vector<ColumnMapping>> mappings; ///< [source][column]
  std::vector<std::string> warnings;
};

/// Which sources give attributes.
enum class SchemaOf
{
  SourcesWithPoints, ///< an empty file chooses nothing for others' points; all if none has points
  AllSources ///< those without points stand for some that have points elsewhere
};

/// `wanted`: names, or nothing for all. Error BadArgument for a name that none of these sources
/// has, with those that there are, and for columns of one name with different numbers of
/// components.
Result<CommonSchema> commonSchema(const std::vector<std::unique_ptr<PointSource>>& sources,
  const std::optional<std::vector<std::string>>& wanted,
  SchemaOf from = SchemaOf::SourcesWithPoints);

/// The base that the codes in the column `splat_radius` of the sources are multiples of; 0 where
/// there is no such column, where sources that have it do not say, or say different things.
double commonSplatRadiusBase(const std::vector<std::unique_ptr<PointSource>>& sources);

/// `count` values of `from` (packed) as `to`; components are equal in number.
void convertColumn(const Attribute& from, const std::byte* in, const Attribute& to, std::byte* out,
  std::size_t count);

} // namespace pointfront
