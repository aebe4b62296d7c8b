#include "PLYWriter.h"

#include "pointfront/Table/RecordFile.h"

#include <cassert>
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

std::string propertyName(const Attribute& attribute, std::size_t component)
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
  const std::string name = fieldName(attribute.name);
  return attribute.components == 1 ? name : name + "[" + std::to_string(component) + "]";
}
} // namespace

struct PLYWriter::State
{
  std::string path;
  std::unique_ptr<RecordFile> file;
};

PLYWriter::PLYWriter(std::string path)
  : state_(std::make_unique<State>())
{
  state_->path = std::move(path);
}

PLYWriter::~PLYWriter() = default;

Result<void> PLYWriter::begin(const SinkDescription& description)
{
  assert(!state_->file);
  const AttributeSchema& schema = description.schema;
  RecordEncoder encoder(schema);
  std::string properties = "property double x\nproperty double y\nproperty double z\n";
  for (std::size_t c = 0; c < schema.size(); ++c)
  {
    const bool wide =
      schema[c].type == ScalarType::Int64 || schema[c].type == ScalarType::UInt64;
    for (std::size_t k = 0; k < schema[c].components; ++k)
    {
      const ScalarType type = encoder.add(c, k, wide);
      properties += std::string("property ") + typeName(type) + " " +
        propertyName(schema[c], k) + "\n";
    }
  }
  const auto header = [properties](std::uint64_t points)
  {
    return "ply\nformat binary_little_endian 1.0\nelement vertex " + paddedCount(points) + "\n" +
      properties + "end_header\n";
  };
  Result<std::unique_ptr<RecordFile>> file =
    RecordFile::create(state_->path, std::move(encoder), header);
  if (!file)
  {
    return file.error();
  }
  state_->file = std::move(*file);
  return {};
}

Result<void> PLYWriter::append(const PointBatch& batch)
{
  assert(state_->file);
  return state_->file->append(batch);
}

Result<void> PLYWriter::finish()
{
  assert(state_->file);
  return state_->file->finish();
}

} // namespace pointfront
