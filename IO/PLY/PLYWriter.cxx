#include "PLYWriter.h"

#include "pointfront/Table/FieldRole.h"

#include <utility>

namespace pointfront
{
namespace
{
const char* typeName(ScalarType type)
{
  switch (type)
  {
    case ScalarType::Int8:
      return "char";
    case ScalarType::UInt8:
      return "uchar";
    case ScalarType::Int16:
      return "short";
    case ScalarType::UInt16:
      return "ushort";
    case ScalarType::Int32:
      return "int";
    case ScalarType::UInt32:
      return "uint";
    case ScalarType::Float32:
      return "float";
    case ScalarType::Int64:
    case ScalarType::UInt64:
    case ScalarType::Float64:
      break;
  }
  return "double";
}

/// `name`: of an attribute whose components have no names of their own.
std::string propertyName(const Attribute& attribute, const std::string& name, std::size_t component)
{
  static const char* const colours[3] = { "red", "green", "blue" };
  static const char* const normals[3] = { "nx", "ny", "nz" };
  if (attribute.components == 3 && attribute.name == "rgb")
  {
    return colours[component];
  }
  if (attribute.components == 3 && attribute.name == "normal")
  {
    return normals[component];
  }
  return attribute.components == 1 ? name : name + "[" + std::to_string(component) + "]";
}
} // namespace

PLYWriter::PLYWriter(std::string path)
  : RecordWriter(std::move(path))
{
}

RecordFile::Header PLYWriter::describe(
  const AttributeSchema& schema, const FieldNames& names, RecordEncoder& encoder) const
{
  std::string properties = "property double x\nproperty double y\nproperty double z\n";
  for (std::size_t c = 0; c < schema.size(); ++c)
  {
    const bool wide = schema[c].type == ScalarType::Int64 || schema[c].type == ScalarType::UInt64;
    for (std::size_t k = 0; k < schema[c].components; ++k)
    {
      const ScalarType type =
        encoder.add(c, k, wide ? std::make_optional(ScalarType::Float64) : std::nullopt);
      properties += std::string("property ") + typeName(type) + " " +
        propertyName(schema[c], names[c], k) + "\n";
    }
  }
  return [properties](std::uint64_t points)
  {
    return "ply\nformat binary_little_endian 1.0\nelement vertex " + paddedCount(points) + "\n" +
      properties + "end_header\n";
  };
}

} // namespace pointfront
