#include "pointfront/Table/ColumnPlan.h"

#include "pointfront/Table/FieldRole.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace pointfront
{
namespace
{
constexpr std::size_t mostComponents = 16; // components of an attribute, see Attribute
constexpr double largestExactInteger = 9007199254740992.0; // 2^53

bool isFloat(ScalarType type)
{
  return type == ScalarType::Float32 || type == ScalarType::Float64;
}

/// Largest value of an unsigned type of a well-known attribute.
double largestOf(ScalarType type)
{
  return type == ScalarType::UInt8 ? 255.0 : 65535.0;
}

bool always(ScalarType inner, ScalarType outer)
{
  return inner == outer || (inner == ScalarType::UInt8 && outer == ScalarType::UInt16) ||
    (outer == ScalarType::Float64) ||
    (outer == ScalarType::Float32 && !isFloat(inner) && sizeOf(inner) <= 2);
}

ScalarType smallestInteger(double low, double high)
{
  if (low >= 0.0)
  {
    return high <= 255.0     ? ScalarType::UInt8
      : high <= 65535.0      ? ScalarType::UInt16
      : high <= 4294967295.0 ? ScalarType::UInt32
                             : ScalarType::Int64;
  }
  const double reach = std::max(-low - 1.0, high);
  return reach <= 127.0     ? ScalarType::Int8
    : reach <= 32767.0      ? ScalarType::Int16
    : reach <= 2147483647.0 ? ScalarType::Int32
                            : ScalarType::Int64;
}

/// Text of few digits, none of which float32 loses: its smallest number with all of them is 1e-38.
bool shortText(const FieldStatistics& values)
{
  return values.digits <= 6 && values.decimals <= 37;
}

/// The type that text of those values is stored with.
ScalarType textType(const FieldStatistics& values)
{
  const double reach = values.empty() ? 0.0 : std::max(std::abs(values.low), std::abs(values.high));
  if (values.whole && values.notFinite == 0 && !values.empty() && reach <= largestExactInteger)
  {
    return smallestInteger(values.low, values.high);
  }
  if (values.wideIntegers())
  {
    return values.beyondInt64 ? ScalarType::UInt64 : ScalarType::Int64;
  }
  const bool short32 = shortText(values) && reach < 1e37;
  return short32 ? ScalarType::Float32 : ScalarType::Float64;
}

ScalarType ownType(const TableField& field, const FieldStatistics& values)
{
  return field.type ? *field.type : textType(values);
}

ScalarType knownType(const TableField& field, const FieldStatistics& values, ScalarType wished)
{
  if (field.type && always(*field.type, wished))
  {
    return wished;
  }
  if (isFloat(wished))
  {
    const bool text = !field.type && !values.wideIntegers();
    return text && (wished == ScalarType::Float64 || shortText(values)) ? wished
                                                                        : ownType(field, values);
  }
  const bool fits = values.whole && values.notFinite == 0 &&
    (values.empty() || (values.low >= 0.0 && values.high <= largestOf(wished)));
  return fits ? wished : ownType(field, values);
}

struct ColourCoding
{
  ScalarType type;
  double factor;
};

/// How three numbers of a file are a colour; nothing if they are none.
std::optional<ColourCoding> colourCoding(
  const std::array<TableField, 3>& fields, const FieldStatistics& values)
{
  ScalarType widest = ScalarType::UInt8;
  bool fraction = values.pointSeen;
  bool integers = true;
  for (const TableField& field : fields)
  {
    integers = integers && field.type && always(*field.type, ScalarType::UInt16);
    widest = field.type == ScalarType::UInt16 ? ScalarType::UInt16 : widest;
    fraction = fraction || (field.type && isFloat(*field.type));
  }
  if (integers || values.empty())
  {
    return ColourCoding{ widest, 1.0 };
  }
  if (values.low < 0.0 || values.high > 65535.0)
  {
    return std::nullopt;
  }
  if (fraction && values.high <= 1.0)
  {
    constexpr double mostOff = 0.15; // error of a 255th that is rounded to three decimals
    const bool eightBit = values.off255 <= mostOff || values.high * 65535.0 <= 255.0;
    return eightBit ? ColourCoding{ ScalarType::UInt8, 255.0 }
                    : ColourCoding{ ScalarType::UInt16, 65535.0 };
  }
  if (values.high <= 255.0)
  {
    return values.whole ? ColourCoding{ ScalarType::UInt8, 1.0 }
                        : ColourCoding{ ScalarType::UInt16, 257.0 };
  }
  return ColourCoding{ ScalarType::UInt16, 1.0 };
}

/// "name[12]" -> name and 12.
std::optional<std::pair<std::string, std::size_t>> arrayElement(const std::string& name)
{
  const std::size_t open = name.rfind('[');
  if (open == std::string::npos || open == 0 || name.back() != ']' || name.size() - open > 6)
  {
    return std::nullopt;
  }
  const std::string number = name.substr(open + 1, name.size() - open - 2);
  if (number.empty() || number.find_first_not_of("0123456789") != std::string::npos)
  {
    return std::nullopt;
  }
  return std::make_pair(name.substr(0, open), static_cast<std::size_t>(std::stoul(number)));
}

/// Collects the columns of one plan.
class Planner
{
public:
  Planner(const std::vector<TableField>& fields, const std::vector<FieldStatistics>& statistics,
    const std::string& path)
    : fields_(fields)
    , statistics_(statistics)
    , path_(path)
    , used_(fields.size(), false)
  {
    std::vector<std::string> names;
    names.reserve(fields.size());
    for (const TableField& field : fields)
    {
      names.push_back(field.name);
    }
    roles_ = rolesOf(names);
  }

  Result<ColumnPlan> plan();

private:
  Result<void> findPosition();
  /// The field of each component, if all are there.
  std::optional<std::array<std::size_t, 3>> vectorOf(const char* attribute) const;
  void addColour();
  void addNormal();
  void addArrays();
  void addRest();
  void addColumn(Attribute attribute, std::vector<std::size_t> fields, double factor);
  void warnOfRounding(const Attribute& attribute, const FieldStatistics& values);

  const std::vector<TableField>& fields_;
  const std::vector<FieldStatistics>& statistics_;
  const std::string& path_;
  std::vector<FieldRole> roles_;
  std::vector<bool> used_;
  /// First field -> column: attributes come in the order of the file.
  std::multimap<std::size_t, std::pair<Attribute, ColumnPlan::Column>> found_;
  ColumnPlan plan_;
};

Result<void> Planner::findPosition()
{
  for (std::size_t f = 0; f < fields_.size(); ++f)
  {
    const FieldRole& role = roles_[f];
    if (role.kind != FieldRole::Kind::Position)
    {
      continue;
    }
    std::optional<std::size_t>& axis = plan_.position[role.component];
    if (axis && role.preference == 0)
    {
      return makeError(Error::Kind::BadFormat,
        path_ + ": '" + fields_[f].name + "' is there twice; name the columns otherwise");
    }
    if (!axis)
    {
      axis = f;
      used_[f] = true;
    }
  }
  if (!plan_.position[0] || !plan_.position[1])
  {
    std::string names;
    for (const TableField& field : fields_)
    {
      names += (names.empty() ? "" : ", ") + field.name;
    }
    return makeError(
      Error::Kind::BadFormat, path_ + ": no x and y among its fields (" + names + ")");
  }
  if (!plan_.position[2])
  {
    plan_.warnings.push_back("There is no z among the fields: every z is 0.");
  }
  return {};
}

std::optional<std::array<std::size_t, 3>> Planner::vectorOf(const char* attribute) const
{
  std::array<std::size_t, 3> components{};
  unsigned found = 0;
  for (std::size_t f = 0; f < fields_.size(); ++f)
  {
    const FieldRole& role = roles_[f];
    if (role.kind == FieldRole::Kind::Vector && role.attribute == attribute &&
      (found & (1u << role.component)) == 0)
    {
      components[role.component] = f;
      found |= 1u << role.component;
    }
  }
  return found == 7u ? std::make_optional(components) : std::nullopt;
}

void Planner::addColumn(Attribute attribute, std::vector<std::size_t> fields, double factor)
{
  for (const std::size_t f : fields)
  {
    used_[f] = true;
  }
  const std::size_t first = *std::min_element(fields.begin(), fields.end());
  found_.emplace(
    first, std::make_pair(std::move(attribute), ColumnPlan::Column{ std::move(fields), factor }));
}

void Planner::addColour()
{
  const auto rgb = vectorOf("rgb");
  if (!rgb)
  {
    return;
  }
  std::array<TableField, 3> fields;
  FieldStatistics values;
  for (std::size_t k = 0; k < 3; ++k)
  {
    fields[k] = fields_[(*rgb)[k]];
    values.add(statistics_[(*rgb)[k]]);
  }
  const std::string names =
    "'" + fields[0].name + "', '" + fields[1].name + "', '" + fields[2].name + "'";
  if (const auto coding = colourCoding(fields, values))
  {
    if (values.notFinite > 0) // a few must not cost all points their colour
    {
      plan_.warnings.push_back(std::to_string(values.notFinite) + " values of the colour " + names +
        " are NaN or infinite: NaN becomes 0, an infinity the nearer end of the colours.");
    }
    addColumn(Attribute{ "rgb", coding->type, 3 }, { rgb->begin(), rgb->end() }, coding->factor);
    return;
  }
  plan_.warnings.push_back("The fields " + names + " are no colour (values from " +
    std::to_string(values.low) + " to " + std::to_string(values.high) +
    "): kept as attributes of their own.");
}

void Planner::addNormal()
{
  if (const auto normal = vectorOf("normal"))
  {
    const Attribute attribute{ "normal", ScalarType::Float32, 3 };
    addColumn(attribute, { normal->begin(), normal->end() }, 1.0);
  }
}

void Planner::warnOfRounding(const Attribute& attribute, const FieldStatistics& values)
{
  if (values.rounded && isFloat(attribute.type))
  {
    plan_.warnings.push_back("The integers of '" + attribute.name +
      "' are rounded to doubles: some are beyond 2^53, and not all of its values are integers that "
      "64 bits hold.");
  }
}

/// a[0], a[1] ... one behind the other.
void Planner::addArrays()
{
  for (std::size_t f = 0; f < fields_.size(); ++f)
  {
    const auto head = arrayElement(fields_[f].name);
    if (used_[f] || !head || head->second != 0)
    {
      continue;
    }
    std::vector<std::size_t> elements;
    FieldStatistics values;
    for (std::size_t next = f; next < fields_.size() && !used_[next]; ++next)
    {
      const auto element = arrayElement(fields_[next].name);
      if (!element || element->first != head->first || element->second != elements.size() ||
        fields_[next].type != fields_[f].type)
      {
        break;
      }
      elements.push_back(next);
      values.add(statistics_[next]);
    }
    if (elements.size() <= mostComponents)
    {
      Attribute attribute{ head->first, ownType(fields_[f], values),
        static_cast<std::uint8_t>(elements.size()) };
      warnOfRounding(attribute, values);
      addColumn(std::move(attribute), std::move(elements), 1.0);
      continue;
    }
    plan_.warnings.push_back("The field '" + head->first + "' is left out: it has " +
      std::to_string(elements.size()) + " components, more than the " +
      std::to_string(mostComponents) + " that an attribute can have.");
    for (const std::size_t element : elements)
    {
      used_[element] = true;
    }
  }
}

void Planner::addRest()
{
  for (std::size_t f = 0; f < fields_.size(); ++f)
  {
    const FieldRole& role = roles_[f];
    if (used_[f] || role.kind == FieldRole::Kind::Padding)
    {
      continue;
    }
    const bool known = role.kind == FieldRole::Kind::Attribute;
    Attribute attribute;
    attribute.name = known ? role.attribute : fields_[f].name;
    attribute.type = role.type ? knownType(fields_[f], statistics_[f], *role.type)
                               : ownType(fields_[f], statistics_[f]);
    if (!fields_[f].type)
    {
      warnOfRounding(attribute, statistics_[f]);
    }
    addColumn(std::move(attribute), { f }, 1.0);
  }
}

Result<ColumnPlan> Planner::plan()
{
  if (Result<void> done = findPosition(); !done)
  {
    return done.error();
  }
  addColour();
  addNormal();
  addArrays();
  addRest();
  std::map<std::string, int> copies;
  for (auto& [first, column] : found_)
  {
    Attribute named = column.first;
    int& copy = copies.try_emplace(named.name, 1).first->second;
    while (!plan_.schema.add(named))
    {
      named.name = column.first.name + "_" + std::to_string(++copy);
    }
    plan_.columns.push_back(std::move(column.second));
  }
  return std::move(plan_);
}
} // namespace

std::vector<bool> ColumnPlan::wanted(std::size_t fieldCount) const
{
  std::vector<bool> fields(fieldCount, false);
  for (const auto& axis : position)
  {
    if (axis)
    {
      fields[*axis] = true;
    }
  }
  for (const Column& column : columns)
  {
    for (const std::size_t f : column.fields)
    {
      fields[f] = true;
    }
  }
  return fields;
}

Result<ColumnPlan> ColumnPlan::make(const std::vector<TableField>& fields,
  const std::vector<FieldStatistics>& statistics, const std::string& path)
{
  return Planner(fields, statistics, path).plan();
}

std::vector<bool> undecidedFields(const std::vector<TableField>& fields)
{
  std::vector<bool> undecided(fields.size(), false);
  for (std::size_t f = 0; f < fields.size(); ++f)
  {
    const FieldRole role = roleOf(fields[f].name);
    const ScalarType type = fields[f].type.value_or(ScalarType::Float64);
    const bool colour = role.kind == FieldRole::Kind::Vector && role.attribute == "rgb";
    undecided[f] = (colour && !always(type, ScalarType::UInt16)) ||
      (role.type && !always(type, *role.type) && !isFloat(*role.type));
  }
  return undecided;
}

} // namespace pointfront
