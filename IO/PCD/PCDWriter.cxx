#include "PCDWriter.h"

#include "pointfront/Base/NumberText.h"
#include "pointfront/Table/FieldRole.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <optional>
#include <utility>

namespace pointfront
{
namespace
{
char typeLetter(ScalarType type)
{
  switch (type)
  {
    case ScalarType::Int8:
    case ScalarType::Int16:
    case ScalarType::Int32:
    case ScalarType::Int64:
      return 'I';
    case ScalarType::Float32:
    case ScalarType::Float64:
      return 'F';
    default:
      return 'U';
  }
}

/// The four lines of a header that say what the fields are.
class FieldLines
{
public:
  void add(const std::string& name, ScalarType type, std::size_t count = 1)
  {
    names_ += " " + name;
    sizes_ += " " + std::to_string(sizeOf(type));
    types_ += std::string(" ") + typeLetter(type);
    counts_ += " " + std::to_string(count);
  }
  std::string text() const
  {
    return "FIELDS" + names_ + "\nSIZE" + sizes_ + "\nTYPE" + types_ + "\nCOUNT" + counts_ + "\n";
  }

private:
  std::string names_;
  std::string sizes_;
  std::string types_;
  std::string counts_;
};

/// `name`: of an attribute that the format gives none.
void addAttribute(std::size_t column, const Attribute& attribute, const std::string& name,
  RecordEncoder& encoder, FieldLines& lines)
{
  static const char* const colours[3] = { "red", "green", "blue" };
  static const char* const normals[3] = { "normal_x", "normal_y", "normal_z" };
  const bool colour = attribute.name == "rgb" && attribute.components == 3;
  if (colour && attribute.type == ScalarType::UInt8)
  {
    constexpr std::uint8_t opaque = 255;
    for (const std::size_t k : { 2u, 1u, 0u }) // 0xAARRGGBB, little endian
    {
      encoder.add(column, k);
    }
    encoder.addByte(opaque);
    lines.add("rgb", ScalarType::Float32); // so PCL matches it; only its bits count
    return;
  }
  const bool normal = attribute.name == "normal" && attribute.components == 3;
  const bool exact =
    attribute.scale == 1.0 && attribute.offset == 0.0 && sizeOf(attribute.type) <= 2;
  const bool single = normal || (attribute.name == "intensity" && exact);
  ScalarType type = attribute.type;
  for (std::size_t k = 0; k < attribute.components; ++k)
  {
    type = encoder.add(column, k, single ? std::make_optional(ScalarType::Float32) : std::nullopt);
    if (colour || normal)
    {
      lines.add((colour ? colours : normals)[k], type);
    }
  }
  if (!colour && !normal)
  {
    lines.add(name, type, attribute.components);
  }
}
} // namespace

PCDWriter::PCDWriter(std::string path, Coordinates coordinates)
  : RecordWriter(std::move(path))
  , coordinates_(coordinates)
{
}

std::vector<std::string> PCDWriter::findings() const
{
  std::vector<std::string> all = findings_;
  const std::vector<std::string> rounded = RecordWriter::findings();
  all.insert(all.end(), rounded.begin(), rounded.end());
  return all;
}

CoordinateCoding PCDWriter::coordinates(const SinkDescription& description)
{
  if (coordinates_ == Coordinates::Float64)
  {
    return {};
  }
  CoordinateCoding coding{ ScalarType::Float32, {} };
  const Bounds& bounds = description.bounds;
  if (bounds.empty())
  {
    return coding;
  }
  constexpr double half = 0x1p-24; // half of a float32's last place, as a share of the number
  const auto rounding = [&](const glm::dvec3& origin)
  { return half * glm::max(glm::abs(bounds.low - origin), glm::abs(bounds.high - origin)); };
  const auto tellsApart = [&](const glm::dvec3& by)
  { return glm::all(glm::lessThan(by, 0.499 * description.grid.scale)); };
  if (tellsApart(rounding(coding.origin)))
  {
    return coding;
  }
  coding.origin = glm::round(bounds.centre());
  findings_.push_back("Its coordinates are relative to " + numberText(coding.origin.x, 17) + " " +
    numberText(coding.origin.y, 17) + " " + numberText(coding.origin.z, 17) +
    ", as a comment of its header says; --double keeps them as they are.");
  if (const glm::dvec3 by = rounding(coding.origin); !tellsApart(by))
  {
    findings_.push_back("Its coordinates are float32, which rounds them by up to " +
      numberText(by.x, 3) + ", " + numberText(by.y, 3) + " and " + numberText(by.z, 3) +
      " units in x, y, z; --double keeps all digits, but PCL reads no points from it.");
  }
  return coding;
}

namespace
{
/// A line of the header for coordinates that are not relative to zero.
std::string originLine(const glm::dvec3& origin)
{
  std::string line = "# ORIGIN";
  for (int axis = 0; axis < 3; ++axis)
  {
    line += ' ' + numberText(origin[axis], 17);
  }
  return origin == glm::dvec3(0.0) ? std::string() : line + '\n';
}
} // namespace

RecordFile::Header PCDWriter::describe(
  const AttributeSchema& schema, const FieldNames& names, RecordEncoder& encoder) const
{
  FieldLines lines;
  for (const char* axis : { "x", "y", "z" })
  {
    lines.add(axis, encoder.coordinates().type);
  }
  for (std::size_t c = 0; c < schema.size(); ++c)
  {
    addAttribute(c, schema[c], names[c], encoder, lines);
  }
  const std::string fields =
    originLine(encoder.coordinates().origin) + "VERSION 0.7\n" + lines.text();
  return [fields](std::uint64_t points)
  {
    const std::string count = paddedCount(points);
    return "# .PCD v0.7 - Point Cloud Data file format\n" + fields + "WIDTH " + count +
      "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA binary\n";
  };
}

} // namespace pointfront
