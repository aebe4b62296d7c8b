#include "pointfront/Table/FieldRole.h"

#include "pointfront/Base/LetterCase.h"

#include <algorithm>
#include <array>

namespace pointfront
{
namespace
{
/// Lower case, letters and digits only.
std::string folded(std::string_view name)
{
  std::string text;
  for (const char c : lowered(name))
  {
    if (c != ' ' && c != '_' && c != '-' && c != '"' && c != '\'')
    {
      text += c;
    }
  }
  constexpr std::string_view scalar = "scalar";
  if (text.size() > scalar.size() && text.compare(0, scalar.size(), scalar) == 0)
  {
    text.erase(0, scalar.size());
  }
  return text;
}

struct ComponentName
{
  std::string_view name;
  FieldRole::Kind kind;
  std::string_view attribute;
  unsigned component;
  unsigned preference = 0;
};

constexpr auto position = FieldRole::Kind::Position;
constexpr auto vector = FieldRole::Kind::Vector;
constexpr ComponentName componentNames[] = {
  { "x", position, "", 0 },
  { "y", position, "", 1 },
  { "z", position, "", 2 },
  { "easting", position, "", 0, 1 },
  { "northing", position, "", 1, 1 },
  { "elevation", position, "", 2, 1 },
  { "longitude", position, "", 0, 1 },
  { "latitude", position, "", 1, 1 },
  { "altitude", position, "", 2, 1 },
  { "lon", position, "", 0, 1 },
  { "lat", position, "", 1, 1 },
  { "alt", position, "", 2, 1 },
  { "long", position, "", 0, 1 },
  { "lng", position, "", 0, 1 },
  { "elev", position, "", 2, 1 },
  { "east", position, "", 0, 1 },
  { "north", position, "", 1, 1 },
  { "rechtswert", position, "", 0, 1 },
  { "hochwert", position, "", 1, 1 },
  { "pointx", position, "", 0, 1 },
  { "pointy", position, "", 1, 1 },
  { "pointz", position, "", 2, 1 },
  { "points:0", position, "", 0, 1 },
  { "points:1", position, "", 1, 1 },
  { "points:2", position, "", 2, 1 },
  { "xcoord", position, "", 0, 1 },
  { "ycoord", position, "", 1, 1 },
  { "zcoord", position, "", 2, 1 },
  { "xcoordinate", position, "", 0, 1 },
  { "ycoordinate", position, "", 1, 1 },
  { "zcoordinate", position, "", 2, 1 },
  { "coordx", position, "", 0, 1 },
  { "coordy", position, "", 1, 1 },
  { "coordz", position, "", 2, 1 },
  { "e", position, "", 0, 2 },
  { "n", position, "", 1, 2 },
  { "h", position, "", 2, 2 },
  { "height", position, "", 2, 2 },
  { "normals:0", vector, "normal", 0 },
  { "normals:1", vector, "normal", 1 },
  { "normals:2", vector, "normal", 2 },
  { "red", vector, "rgb", 0 },
  { "green", vector, "rgb", 1 },
  { "blue", vector, "rgb", 2 },
  { "r", vector, "rgb", 0 },
  { "g", vector, "rgb", 1 },
  { "b", vector, "rgb", 2 },
  { "diffusered", vector, "rgb", 0 },
  { "diffusegreen", vector, "rgb", 1 },
  { "diffuseblue", vector, "rgb", 2 },
  { "nx", vector, "normal", 0 },
  { "ny", vector, "normal", 1 },
  { "nz", vector, "normal", 2 },
  { "normalx", vector, "normal", 0 },
  { "normaly", vector, "normal", 1 },
  { "normalz", vector, "normal", 2 },
  { "normal[0]", vector, "normal", 0 },
  { "normal[1]", vector, "normal", 1 },
  { "normal[2]", vector, "normal", 2 },
};

/// A name without the unit behind it; the same if there is none.
std::string_view withoutUnit(std::string_view name)
{
  static constexpr std::string_view units[] = { "m", "ft", "us-ft", "usft", "feet", "foot", "metre",
    "metres", "meter", "meters", "deg", "degree", "degrees", "dd", "mm", "cm", "km" };
  while (!name.empty() && (name.back() == ' ' || name.back() == '"'))
  {
    name.remove_suffix(1);
  }
  const bool bracket = !name.empty() && (name.back() == ')' || name.back() == ']');
  const std::size_t at = bracket ? name.find_last_of("([") : name.find_last_of(" _");
  if (at == std::string_view::npos || at == 0)
  {
    return name;
  }
  const std::string unit = folded(name.substr(at + 1, name.size() - at - (bracket ? 2 : 1)));
  for (const std::string_view known : units)
  {
    if (unit == folded(known))
    {
      return name.substr(0, at);
    }
  }
  return name;
}

struct AttributeName
{
  std::string_view name;
  std::string_view attribute;
  ScalarType type;
};

constexpr AttributeName attributeNames[] = {
  { "intensity", "intensity", ScalarType::UInt16 },
  { "i", "intensity", ScalarType::UInt16 },
  { "classification", "classification", ScalarType::UInt8 },
  { "class", "classification", ScalarType::UInt8 },
  { "classificationflags", "classification_flags", ScalarType::UInt8 },
  { "returnnumber", "return_number", ScalarType::UInt8 },
  { "returnnum", "return_number", ScalarType::UInt8 },
  { "returncount", "return_count", ScalarType::UInt8 },
  { "numberofreturns", "return_count", ScalarType::UInt8 },
  { "numreturns", "return_count", ScalarType::UInt8 },
  { "scandirection", "scan_direction", ScalarType::UInt8 },
  { "scandirectionflag", "scan_direction", ScalarType::UInt8 },
  { "edgeofflightline", "edge_of_flight_line", ScalarType::UInt8 },
  { "edgeofflightlineflag", "edge_of_flight_line", ScalarType::UInt8 },
  { "scannerchannel", "scanner_channel", ScalarType::UInt8 },
  { "scanangle", "scan_angle", ScalarType::Float32 },
  { "scananglerank", "scan_angle", ScalarType::Float32 },
  { "userdata", "user_data", ScalarType::UInt8 },
  { "pointsourceid", "point_source_id", ScalarType::UInt16 },
  { "ptsrcid", "point_source_id", ScalarType::UInt16 },
  { "gpstime", "gps_time", ScalarType::Float64 },
  { "nir", "nir", ScalarType::UInt16 },
  { "infrared", "nir", ScalarType::UInt16 },
};

std::string keptName(std::string_view name)
{
  constexpr std::string_view scalar = "scalar_";
  if (name.size() > scalar.size() && name.substr(0, scalar.size()) == scalar)
  {
    name.remove_prefix(scalar.size());
  }
  return std::string(name);
}
} // namespace

FieldRole roleOf(std::string_view name)
{
  const std::string key = folded(name);
  if (key.empty())
  {
    return { FieldRole::Kind::Padding, {}, 0, {} };
  }
  const std::string bare = folded(withoutUnit(name));
  for (const ComponentName& row : componentNames)
  {
    if (row.name == key || (row.kind == position && row.name == bare))
    {
      return { row.kind, std::string(row.attribute), row.component, {}, row.preference };
    }
  }
  for (const AttributeName& row : attributeNames)
  {
    if (row.name == key)
    {
      return { FieldRole::Kind::Attribute, std::string(row.attribute), 0, row.type };
    }
  }
  return { FieldRole::Kind::Attribute, keptName(name), 0, {} };
}

std::vector<FieldRole> rolesOf(const std::vector<std::string>& names)
{
  constexpr unsigned leastSure = 2;
  constexpr unsigned none = leastSure + 1;
  std::vector<FieldRole> roles;
  std::array<unsigned, 3> best{ none, none, none };
  for (const std::string& name : names)
  {
    roles.push_back(roleOf(name));
    const FieldRole& role = roles.back();
    if (role.kind == position)
    {
      best[role.component] = std::min(best[role.component], role.preference);
    }
  }
  if (best[0] == none || best[1] == none)
  {
    best[0] = best[0] == leastSure ? none : best[0];
    best[1] = best[1] == leastSure ? none : best[1];
  }
  for (std::size_t f = 0; f < names.size(); ++f)
  {
    FieldRole& role = roles[f];
    if (role.kind == position && role.preference != best[role.component])
    {
      role = { FieldRole::Kind::Attribute, keptName(names[f]), 0, {} };
    }
  }
  return roles;
}

FieldNames::FieldNames(const AttributeSchema& schema, Cleaned cleaned)
  : names_(schema.size())
{
  std::vector<std::size_t> turns[3]; // who needs no other name comes first
  for (std::size_t c = 0; c < schema.size(); ++c)
  {
    const std::string& own = schema[c].name;
    if (schema[c].components == 3 && (own == "rgb" || own == "normal"))
    {
      names_[c] = own;
      vectors_.insert(own);
      taken_.insert(own);
      continue;
    }
    const FieldRole role = roleOf(own);
    const bool readAsItself = role.kind == FieldRole::Kind::Attribute && role.attribute == own;
    turns[cleaned(own) != own ? 2 : readAsItself ? 0 : 1].push_back(c);
  }
  for (const std::vector<std::size_t>& turn : turns)
  {
    for (const std::size_t c : turn)
    {
      const std::string name = cleaned(schema[c].name);
      names_[c] = name;
      for (int copy = 2; !take(names_[c]); ++copy)
      {
        names_[c] = name + "_" + std::to_string(copy);
      }
    }
  }
  for (std::size_t c = 0; c < schema.size(); ++c)
  {
    if (names_[c] != schema[c].name)
    {
      findings_.push_back(
        "The attribute '" + schema[c].name + "' is written as '" + names_[c] + "'.");
    }
  }
}

bool FieldNames::take(const std::string& name)
{
  const FieldRole role = roleOf(name);
  const bool coordinate = role.kind == position && role.preference == 0;
  const bool component = role.kind == vector && vectors_.count(role.attribute) > 0;
  if (coordinate || component || role.kind == FieldRole::Kind::Padding)
  {
    return false;
  }
  return taken_.insert(role.kind == FieldRole::Kind::Attribute ? role.attribute : name).second;
}

} // namespace pointfront
