#include "LASPointLayout.h"

#include <array>
#include <cassert>
#include <map>

namespace pointfront
{
namespace
{
constexpr std::array<LASFormatParts, lasHighestPointFormat + 1> formatParts{ {
  { 20, 0, 0, 0, 0 },
  { 28, 20, 0, 0, 0 },
  { 26, 0, 20, 0, 0 },
  { 34, 20, 28, 0, 0 },
  { 57, 20, 0, 0, 28 },
  { 63, 20, 28, 0, 34 },
  { 30, 22, 0, 0, 0 },
  { 36, 22, 30, 0, 0 },
  { 38, 22, 30, 36, 0 },
  { 59, 22, 0, 0, 30 },
  { 67, 22, 30, 36, 38 },
} };

void add(LASPointLayout& layout, const Attribute& attribute, const LASField& field)
{
  layout.schema.add(attribute);
  layout.fields.push_back(field);
}

void addCopy(
  LASPointLayout& layout, const char* name, ScalarType type, int components, std::size_t offset)
{
  LASField field;
  field.offset = static_cast<std::uint16_t>(offset);
  add(layout, Attribute{ name, type, static_cast<std::uint8_t>(components) }, field);
}

void addBits(LASPointLayout& layout, const char* name, std::size_t offset, int shift, int mask)
{
  const LASField field{ LASField::Kind::Bits, static_cast<std::uint8_t>(shift),
    static_cast<std::uint8_t>(mask), static_cast<std::uint16_t>(offset) };
  add(layout, Attribute{ name, ScalarType::UInt8 }, field);
}

void addAngle(LASPointLayout& layout, LASField::Kind kind, std::size_t offset)
{
  LASField field;
  field.kind = kind;
  field.offset = static_cast<std::uint16_t>(offset);
  add(layout, Attribute{ "scan_angle", ScalarType::Float32 }, field);
}

/// Bytes 12 to 19 of formats 0 to 5.
void addLegacyCore(LASPointLayout& layout)
{
  addCopy(layout, "intensity", ScalarType::UInt16, 1, 12);
  addBits(layout, "return_number", 14, 0, 7);
  addBits(layout, "return_count", 14, 3, 7);
  addBits(layout, "classification", 15, 0, 31);
  addBits(layout, "classification_flags", 15, 5, 7);
  addBits(layout, "scan_direction", 14, 6, 1);
  addBits(layout, "edge_of_flight_line", 14, 7, 1);
  addAngle(layout, LASField::Kind::Angle8, 16);
  addCopy(layout, "user_data", ScalarType::UInt8, 1, 17);
  addCopy(layout, "point_source_id", ScalarType::UInt16, 1, 18);
}

/// Bytes 12 to 21 of formats 6 to 10.
void addCore(LASPointLayout& layout)
{
  addCopy(layout, "intensity", ScalarType::UInt16, 1, 12);
  addBits(layout, "return_number", 14, 0, 15);
  addBits(layout, "return_count", 14, 4, 15);
  addCopy(layout, "classification", ScalarType::UInt8, 1, 16);
  addBits(layout, "classification_flags", 15, 0, 15);
  addBits(layout, "scan_direction", 15, 6, 1);
  addBits(layout, "edge_of_flight_line", 15, 7, 1);
  addBits(layout, "scanner_channel", 15, 4, 3);
  addAngle(layout, LASField::Kind::Angle16, 18);
  addCopy(layout, "user_data", ScalarType::UInt8, 1, 17);
  addCopy(layout, "point_source_id", ScalarType::UInt16, 1, 20);
}

void addWavePacket(LASPointLayout& layout, std::size_t offset)
{
  addCopy(layout, "wave_descriptor", ScalarType::UInt8, 1, offset);
  addCopy(layout, "wave_offset", ScalarType::UInt64, 1, offset + 1);
  addCopy(layout, "wave_size", ScalarType::UInt32, 1, offset + 9);
  addCopy(layout, "wave_return_location", ScalarType::Float32, 1, offset + 13);
  addCopy(layout, "wave_vector", ScalarType::Float32, 3, offset + 17);
}
} // namespace

const LASFormatParts& lasFormatParts(int pointFormat)
{
  assert(pointFormat >= 0 && pointFormat <= lasHighestPointFormat);
  return formatParts[static_cast<std::size_t>(pointFormat)];
}

std::size_t lasMinimumPointBytes(int pointFormat)
{
  return lasFormatParts(pointFormat).bytes;
}

LASPointLayout makeLASPointLayout(int pointFormat, const std::vector<Attribute>& extra)
{
  const LASFormatParts& parts = lasFormatParts(pointFormat);
  LASPointLayout layout;
  layout.pointFormat = pointFormat;
  layout.pointBytes = parts.bytes;
  pointFormat < 6 ? addLegacyCore(layout) : addCore(layout);
  if (parts.gpsTime != 0)
  {
    addCopy(layout, "gps_time", ScalarType::Float64, 1, parts.gpsTime);
  }
  if (parts.rgb != 0)
  {
    addCopy(layout, "rgb", ScalarType::UInt16, 3, parts.rgb);
  }
  if (parts.nir != 0)
  {
    addCopy(layout, "nir", ScalarType::UInt16, 1, parts.nir);
  }
  if (parts.wave != 0)
  {
    addWavePacket(layout, parts.wave);
  }
  std::map<std::string, int> copies; // copies of each name: a hostile file may repeat one for ever
  for (const Attribute& attribute : extra)
  {
    LASField field;
    field.offset = static_cast<std::uint16_t>(layout.pointBytes);
    Attribute named = attribute;
    int& copy = copies.try_emplace(attribute.name, 1).first->second;
    while (!layout.schema.add(named))
    {
      named.name = attribute.name + "_" + std::to_string(++copy);
    }
    layout.fields.push_back(field);
    layout.pointBytes += attribute.bytes();
  }
  return layout;
}

} // namespace pointfront
