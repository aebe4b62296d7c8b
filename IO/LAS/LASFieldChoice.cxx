#include "LASFieldChoice.h"

#include "ExtraBytesNames.h"

#include "pointfront/Base/NumberText.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace pointfront
{
namespace
{
bool isFloat(ScalarType type)
{
  return type == ScalarType::Float32 || type == ScalarType::Float64;
}

struct Range
{
  double low;
  double high;
};

Range rangeOf(ScalarType type)
{
  return visitScalar(type,
    [](auto zero)
    {
      using T = decltype(zero);
      return Range{ static_cast<double>(std::numeric_limits<T>::lowest()),
        static_cast<double>(std::numeric_limits<T>::max()) };
    });
}

/// The values of a column. Nothing if nobody looked: the description then has no range, or that of
/// the type.
std::optional<Range> knownRange(const SinkDescription& description, std::size_t column)
{
  if (column >= description.largest.size() || column >= description.smallest.size())
  {
    return std::nullopt;
  }
  const Range own{ description.smallest[column], description.largest[column] };
  const Range all = rangeOf(description.schema[column].type);
  const bool asked = own.low > all.low || own.high < all.high;
  return asked ? std::make_optional(own) : std::nullopt;
}

/// How much of a column a field of the record holds.
enum class Fit
{
  Whole,
  Partly, ///< single values, each of which fits or not
  Not
};

/// The largest number of a field; the smallest of an integer is 0.
double largestOf(const Attribute& attribute, const LASField& field)
{
  constexpr double finestStep = 0.006; // degrees
  switch (field.kind)
  {
    case LASField::Kind::Bits:
      return field.mask;
    case LASField::Kind::Angle8:
      return std::numeric_limits<std::int8_t>::max();
    case LASField::Kind::Angle16:
      return finestStep * std::numeric_limits<std::int16_t>::max();
    case LASField::Kind::Copy:
      break;
  }
  return rangeOf(attribute.type).high;
}

/// A column of the field's type fits unless larger values are known, for a field of few bits; one
/// of another type does if its values are known to. LAS rounds angles anyway.
Fit fitOf(const SinkDescription& description, std::size_t column, const Attribute& attribute,
  const LASField& field)
{
  const Attribute& own = description.schema[column];
  if (own.components != attribute.components || own.scale != 1.0 || own.offset != 0.0)
  {
    return Fit::Not;
  }
  const std::optional<Range> known = knownRange(description, column);
  const Range range = known.value_or(rangeOf(own.type));
  const double largest = largestOf(attribute, field);
  if (attribute.name == "scan_angle")
  {
    return known && std::max(-range.low, range.high) > largest ? Fit::Partly : Fit::Whole;
  }
  constexpr double exactInteger = 9007199254740992.0; // 2^53
  const bool exact = attribute.type == ScalarType::Float64 &&
    (sizeOf(own.type) <= 4 || (range.low >= -exactInteger && range.high <= exactInteger));
  const bool same = own.type == attribute.type;
  if (isFloat(attribute.type) || isFloat(own.type))
  {
    return same || exact ? Fit::Whole : Fit::Not;
  }
  if ((same && !known) || (range.low >= 0.0 && range.high <= largest))
  {
    return Fit::Whole;
  }
  return attribute.components == 1 ? Fit::Partly : Fit::Not;
}

std::string shortNumber(double value)
{
  return numberText(value, 9);
}

/// The field of exactly that name: 'Intensity' is another attribute.
std::optional<std::size_t> fieldNamed(const std::string& name, const AttributeSchema& fields)
{
  const std::optional<std::size_t> field = fields.find(name);
  return field && fields[*field].name == name ? field : std::nullopt;
}

/// A name that no attribute of the schema has.
std::string exactName(const AttributeSchema& schema, const std::string& name)
{
  std::string free = name + "_exact";
  for (int copy = 2; schema.find(free); ++copy)
  {
    free = name + "_exact_" + std::to_string(copy);
  }
  return free;
}

/// Attributes that are not LAS fields, and where each comes from. Arrays of more than three have
/// no data type in LAS: bytes stay together, others go one by one.
void addExtra(std::size_t column, const Attribute& attribute, std::vector<Attribute>& extra,
  std::vector<std::optional<LASExport::Origin>>& origins)
{
  if (attribute.components <= 3 || attribute.type == ScalarType::UInt8)
  {
    extra.push_back(attribute);
    origins.push_back(LASExport::Origin{ column, 0, attribute.type });
    return;
  }
  for (std::size_t k = 0; k < attribute.components; ++k)
  {
    Attribute single = attribute;
    single.name += "[" + std::to_string(k) + "]";
    single.components = 1;
    extra.push_back(single);
    origins.push_back(LASExport::Origin{ column, k * sizeOf(attribute.type), attribute.type });
  }
}

} // namespace

bool hasFineAngles(const SinkDescription& description)
{
  const std::optional<std::size_t> column = fieldNamed("scan_angle", description.schema);
  const std::optional<Range> range = column ? knownRange(description, *column) : std::nullopt;
  return range &&
    (range->low < -90.0 || range->high > 90.0 || range->low != std::floor(range->low) ||
      range->high != std::floor(range->high));
}

std::vector<Attribute> chooseLASFields(
  const SinkDescription& description, int pointFormat, LASExport& plan)
{
  const AttributeSchema& schema = description.schema;
  const LASPointLayout own = makeLASPointLayout(pointFormat, {});
  plan.origins.assign(own.schema.size(), std::nullopt);
  plan.exactNames.assign(own.schema.size(), "");
  std::vector<Attribute> extra;
  for (std::size_t c = 0; c < schema.size(); ++c)
  {
    const std::optional<std::size_t> field = fieldNamed(schema[c].name, own.schema);
    const Fit fit =
      field ? fitOf(description, c, own.schema[*field], own.fields[*field]) : Fit::Not;
    if (fit != Fit::Not)
    {
      constexpr std::uint8_t unassigned = 1; // the class of points that nobody classified
      LASExport::Origin origin{ c, 0, schema[c].type };
      origin.partly = fit == Fit::Partly;
      origin.instead = schema[c].name == "classification" ? unassigned : 0;
      plan.origins[*field] = origin;
    }
    if (fit == Fit::Whole)
    {
      continue;
    }
    Attribute exact = schema[c];
    if (field)
    {
      exact.name = plan.exactNames[*field] = exactName(schema, exact.name);
    }
    addExtra(c, exact, extra, plan.origins);
  }
  const std::vector<std::string> names = shortenExtraBytesNames(own.schema, extra);
  plan.changes.insert(plan.changes.end(), names.begin(), names.end());
  plan.layout = makeLASPointLayout(pointFormat, extra);
  plan.exactNames.resize(plan.layout.schema.size());
  return extra;
}

std::vector<std::string> fieldFindings(const LASExport& plan, const LASTotals& totals)
{
  std::vector<std::string> found;
  for (std::size_t c = 0; c < plan.exactNames.size(); ++c)
  {
    if (plan.exactNames[c].empty())
    {
      continue;
    }
    const std::string name = "'" + plan.layout.schema[c].name + "'";
    const std::uint64_t replaced = c < totals.replaced.size() ? totals.replaced[c] : 0;
    const std::string kept = "extra bytes '" + plan.exactNames[c] + "'";
    if (!plan.origins[c])
    {
      found.push_back(name + " has values that LAS's own field (" +
        std::string(nameOf(plan.layout.schema[c].type)) + ") does not hold: the field is 0, and " +
        kept + " hold them.");
    }
    else if (replaced > 0)
    {
      found.push_back(std::to_string(replaced) + " values of " + name +
        " are beyond LAS's own field, which ends at " +
        shortNumber(largestOf(plan.layout.schema[c], plan.layout.fields[c])) + ": it is " +
        std::to_string(plan.origins[c]->instead) + " there, and " + kept +
        " hold the values of all points.");
    }
    else
    {
      found.push_back("LAS's own field holds all values of " + name +
        ", which was not known before; " + kept + " hold them once more.");
    }
  }
  if (totals.roundedAngles > 0)
  {
    found.push_back(std::to_string(totals.roundedAngles) +
      " scan angles are rounded to the steps of LAS point format " +
      std::to_string(plan.layout.pointFormat) + ", " +
      (plan.layout.pointFormat < 6 ? "whole degrees." : "0.006 degrees."));
  }
  return found;
}

} // namespace pointfront
