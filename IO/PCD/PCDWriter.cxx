#include "PCDWriter.h"

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

void addAttribute(
  std::size_t column, const Attribute& attribute, RecordEncoder& encoder, FieldLines& lines)
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
    lines.add("rgb", ScalarType::UInt32);
    return;
  }
  const bool normal = attribute.name == "normal" && attribute.components == 3;
  ScalarType type = attribute.type;
  for (std::size_t k = 0; k < attribute.components; ++k)
  {
    type = encoder.add(column, k);
    if (colour || normal)
    {
      lines.add((colour ? colours : normals)[k], type);
    }
  }
  if (!colour && !normal)
  {
    lines.add(fieldName(attribute.name), type, attribute.components);
  }
}
} // namespace

PCDWriter::PCDWriter(std::string path)
  : RecordWriter(std::move(path))
{
}

RecordFile::Header PCDWriter::describe(
  const AttributeSchema& schema, RecordEncoder& encoder) const
{
  FieldLines lines;
  for (const char* axis : { "x", "y", "z" })
  {
    lines.add(axis, ScalarType::Float64);
  }
  for (std::size_t c = 0; c < schema.size(); ++c)
  {
    addAttribute(c, schema[c], encoder, lines);
  }
  const std::string fields = lines.text();
  return [fields](std::uint64_t points)
  {
    const std::string count = paddedCount(points);
    return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n" + fields + "WIDTH " + count +
      "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA binary\n";
  };
}

} // namespace pointfront
