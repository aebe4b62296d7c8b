#include "pointfront/Table/FieldRole.h"

#include <cctype>

namespace pointfront
{
namespace
{
/// Lower case, letters and digits only.
std::string folded(std::string_view name)
{
  std::string text;
  for (const char c : name)
  {
    if (c != ' ' && c != '_' && c != '-' && c != '"' && c != '\'')
    {
      text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
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
};

constexpr auto position = FieldRole::Kind::Position;
constexpr auto vector = FieldRole::Kind::Vector;
constexpr ComponentName componentNames[] = {
  { "x", position, "", 0 }, { "y", position, "", 1 }, { "z", position, "", 2 },
  { "easting", position, "", 0 }, { "northing", position, "", 1 },
  { "elevation", position, "", 2 }, { "longitude", position, "", 0 },
  { "latitude", position, "", 1 }, { "altitude", position, "", 2 },
  { "red", vector, "rgb", 0 }, { "green", vector, "rgb", 1 }, { "blue", vector, "rgb", 2 },
  { "r", vector, "rgb", 0 }, { "g", vector, "rgb", 1 }, { "b", vector, "rgb", 2 },
  { "diffusered", vector, "rgb", 0 }, { "diffusegreen", vector, "rgb", 1 },
  { "diffuseblue", vector, "rgb", 2 },
  { "nx", vector, "normal", 0 }, { "ny", vector, "normal", 1 }, { "nz", vector, "normal", 2 },
  { "normalx", vector, "normal", 0 }, { "normaly", vector, "normal", 1 },
  { "normalz", vector, "normal", 2 },
  { "normal[0]", vector, "normal", 0 }, { "normal[1]", vector, "normal", 1 },
  { "normal[2]", vector, "normal", 2 },
};

struct AttributeName
{
  std::string_view name;
  std::string_view attribute;
  ScalarType type;
};

constexpr AttributeName attributeNames[] = {
  { "intensity", "intensity", ScalarType::UInt16 }, { "i", "intensity", ScalarType::UInt16 },
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
  { "nir", "nir", ScalarType::UInt16 }, { "infrared", "nir", ScalarType::UInt16 },
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
  for (const ComponentName& row : componentNames)
  {
    if (row.name == key)
    {
      return { row.kind, std::string(row.attribute), row.component, {} };
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

} // namespace pointfront
