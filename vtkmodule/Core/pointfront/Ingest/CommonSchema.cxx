#include "pointfront/Ingest/CommonSchema.h"

#include "pointfront/Base/NearestName.h"
#include "pointfront/Ingest/SourcesWithPoints.h"
#include "pointfront/Points/AttributeNames.h"
#include "pointfront/Points/SplatRadius.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pointfront
{
namespace
{
bool isFloat(ScalarType type)
{
  return type == ScalarType::Float32 || type == ScalarType::Float64;
}

bool isSigned(ScalarType type)
{
  return type == ScalarType::Int8 || type == ScalarType::Int16 || type == ScalarType::Int32 ||
    type == ScalarType::Int64;
}

/// The smallest type that holds all values of both, see CommonSchema.
ScalarType commonType(ScalarType a, ScalarType b)
{
  if (a == b)
  {
    return a;
  }
  if (isFloat(a) || isFloat(b))
  {
    return ScalarType::Float64;
  }
  const std::size_t largest = std::max(sizeOf(a), sizeOf(b));
  if (isSigned(a) == isSigned(b))
  {
    return sizeOf(a) == largest ? a : b;
  }
  const std::size_t unsignedBytes = isSigned(a) ? sizeOf(b) : sizeOf(a);
  switch (std::max(largest, 2 * unsignedBytes))
  {
    case 2:
      return ScalarType::Int16;
    case 4:
      return ScalarType::Int32;
    case 8:
      return ScalarType::Int64;
    default:
      return ScalarType::Float64;
  }
}

bool sameScale(const Attribute& a, const Attribute& b)
{
  return a.scale == b.scale && a.offset == b.offset;
}

Attribute merged(const Attribute& a, const Attribute& b)
{
  Attribute common = a;
  if (!sameScale(a, b))
  {
    common.type = ScalarType::Float64;
    common.scale = 1.0;
    common.offset = 0.0;
    return common;
  }
  common.type = commonType(a.type, b.type);
  return common;
}

std::string quoted(const std::string& text)
{
  return "'" + text + "'";
}

std::string listOf(const AttributeSchema& schema)
{
  std::string list;
  for (const Attribute& attribute : schema)
  {
    list += (list.empty() ? "" : ", ") + attribute.name;
  }
  return list.empty() ? "none" : list;
}

using Sources = std::vector<std::unique_ptr<PointSource>>;

/// All columns of all sources, in the order in which they are met first.
Result<AttributeSchema> unionOf(
  const std::vector<PointSource*>& sources, std::vector<std::string>& warnings)
{
  std::vector<Attribute> all;
  for (PointSource* const source : sources)
  {
    for (const Attribute& attribute : source->description().schema)
    {
      const auto known = std::find_if(all.begin(), all.end(),
        [&](const Attribute& other) { return other.name == attribute.name; });
      if (known == all.end())
      {
        all.push_back(attribute);
        continue;
      }
      if (known->components != attribute.components)
      {
        return makeError(Error::Kind::BadArgument,
          "attribute " + quoted(attribute.name) + " has " + std::to_string(attribute.components) +
            " components in " + quoted(source->description().path) + " and " +
            std::to_string(known->components) +
            " in a file before it; leave it out, or build two stores");
      }
      const Attribute common = merged(*known, attribute);
      if (!(common == *known))
      {
        warnings.push_back("Attribute " + quoted(attribute.name) + " is stored as " +
          std::string(nameOf(common.type)) + " because its type or scale differs in " +
          quoted(source->description().path) + ".");
      }
      *known = common;
    }
  }
  AttributeSchema schema;
  for (Attribute& attribute : all)
  {
    schema.add(std::move(attribute));
  }
  return schema;
}

/// Inputs that cannot give an attribute: a name that only those without points know is not
/// misspelt.
std::string whoLacks(const std::string& name, const Sources& sources)
{
  const bool known = std::any_of(sources.begin(), sources.end(),
    [&](const auto& source) { return source->description().schema.find(name).has_value(); });
  return known ? "only inputs without points have an attribute " : "no input has an attribute ";
}

Result<AttributeSchema> selected(
  const AttributeSchema& all, const std::vector<std::string>& wanted, const Sources& sources)
{
  std::vector<bool> keep(all.size(), false);
  for (const std::string& name : wanted)
  {
    const auto column = all.find(name);
    if (!column)
    {
      return makeError(Error::Kind::BadArgument,
        whoLacks(name, sources) + quoted(name) + "; there are: " + listOf(all) +
          didYouMean(name, attributeNames(all)));
    }
    keep[*column] = true;
  }
  AttributeSchema schema;
  for (std::size_t c = 0; c < all.size(); ++c)
  {
    if (keep[c])
    {
      schema.add(all[c]);
    }
  }
  return schema;
}

std::vector<ColumnMapping> mappingOf(const SourceDescription& source, const AttributeSchema& schema,
  std::vector<std::string>& warnings)
{
  std::vector<ColumnMapping> mapping(schema.size());
  std::string missing;
  for (std::size_t c = 0; c < schema.size(); ++c)
  {
    const Attribute& common = schema[c];
    for (std::size_t own = 0; own < source.schema.size(); ++own)
    {
      const Attribute& attribute = source.schema[own];
      if (attribute.name == common.name)
      {
        mapping[c].column = own;
        mapping[c].converted = attribute.type != common.type || !sameScale(attribute, common);
      }
    }
    if (!mapping[c].column)
    {
      missing += (missing.empty() ? "" : ", ") + common.name;
    }
  }
  if (!missing.empty() && source.pointCount > 0)
  {
    warnings.push_back(quoted(source.path) + " lacks " + missing + "; zeros are stored instead.");
  }
  return mapping;
}

template <typename T>
T valueAt(const std::byte* data, std::size_t i)
{
  T value;
  std::memcpy(&value, data + i * sizeof(T), sizeof(T));
  return value;
}

template <typename To, typename From>
void convertValues(const Attribute& from, const std::byte* in, const Attribute& to, std::byte* out,
  std::size_t values)
{
  const bool rescale = !sameScale(from, to); // then `to` is float64 without a scale
  for (std::size_t i = 0; i < values; ++i)
  {
    const From value = valueAt<From>(in, i);
    const To converted = rescale
      ? static_cast<To>(static_cast<double>(value) * from.scale + from.offset)
      : static_cast<To>(value);
    std::memcpy(out + i * sizeof(To), &converted, sizeof(To));
  }
}

template <typename To>
void convertTo(const Attribute& from, const std::byte* in, const Attribute& to, std::byte* out,
  std::size_t values)
{
  visitScalar(
    from.type, [&](auto zero) { convertValues<To, decltype(zero)>(from, in, to, out, values); });
}
} // namespace

Result<CommonSchema> commonSchema(
  const Sources& sources, const std::optional<std::vector<std::string>>& wanted, SchemaOf from)
{
  CommonSchema common;
  const bool filled = from == SchemaOf::SourcesWithPoints;
  Result<AttributeSchema> schema =
    unionOf(filled ? sourcesWithPoints(sources) : allSources(sources), common.warnings);
  if (schema && wanted)
  {
    schema = selected(*schema, *wanted, sources);
  }
  if (!schema)
  {
    return schema.error();
  }
  common.schema = std::move(*schema);
  for (const auto& source : sources)
  {
    common.mappings.push_back(mappingOf(source->description(), common.schema, common.warnings));
  }
  return common;
}

double commonSplatRadiusBase(const std::vector<std::unique_ptr<PointSource>>& sources)
{
  std::optional<double> base;
  for (const auto& source : sources)
  {
    const SourceDescription& description = source->description();
    const auto column = description.schema.find(splatRadiusAttribute);
    if (!column)
    {
      continue;
    }
    const bool codes = description.schema[*column].bytes() == 1;
    const double own = codes ? description.splatRadiusBase : 0.0;
    base = !base || *base == own ? own : 0.0;
  }
  return base.value_or(0.0);
}

void convertColumn(const Attribute& from, const std::byte* in, const Attribute& to, std::byte* out,
  std::size_t count)
{
  const std::size_t values = count * from.components;
  switch (to.type)
  {
    case ScalarType::Int16:
      return convertTo<std::int16_t>(from, in, to, out, values);
    case ScalarType::UInt16:
      return convertTo<std::uint16_t>(from, in, to, out, values);
    case ScalarType::Int32:
      return convertTo<std::int32_t>(from, in, to, out, values);
    case ScalarType::UInt32:
      return convertTo<std::uint32_t>(from, in, to, out, values);
    case ScalarType::Int64:
      return convertTo<std::int64_t>(from, in, to, out, values);
    case ScalarType::UInt64:
      return convertTo<std::uint64_t>(from, in, to, out, values);
    // A range is no wider than that of a source; the type alone says how much may be written.
    case ScalarType::Int8:
      return convertTo<std::int8_t>(from, in, to, out, values);
    case ScalarType::UInt8:
      return convertTo<std::uint8_t>(from, in, to, out, values);
    case ScalarType::Float32:
      return convertTo<float>(from, in, to, out, values);
    case ScalarType::Float64:
      return convertTo<double>(from, in, to, out, values);
  }
}

} // namespace pointfront
