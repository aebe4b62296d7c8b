#include "XYZWriter.h"

#include "DecimalText.h"

#include "pointfront/Disk/OutputFile.h"
#include "pointfront/Table/FieldRole.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::size_t flushBytes = 1 << 20;

/// Columns are separated by blanks or commas, so names have none.
std::string plainName(const std::string& attribute)
{
  std::string name = attribute;
  const auto ends = [](char c)
  { return c == ' ' || c == ',' || c == '"' || (c >= 0 && c < ' ') || c == 0x7f; };
  std::replace_if(name.begin(), name.end(), ends, '_');
  return name;
}

/// `name`: of an attribute whose components have no names of their own.
std::string columnName(const Attribute& attribute, const std::string& name, std::size_t component)
{
  static const char* const colours[3] = { "red", "green", "blue" };
  static const char* const normals[3] = { "nx", "ny", "nz" };
  if (attribute.components == 3 && (attribute.name == "rgb" || attribute.name == "normal"))
  {
    return (attribute.name == "rgb" ? colours : normals)[component];
  }
  return attribute.components == 1 ? name : name + "[" + std::to_string(component) + "]";
}

bool isScaled(const Attribute& attribute)
{
  return attribute.scale != 1.0 || attribute.offset != 0.0;
}

bool isFloat(const Attribute& attribute)
{
  return attribute.type == ScalarType::Float32 || attribute.type == ScalarType::Float64;
}
} // namespace

struct XYZWriter::State
{
  /// How the components of one attribute are written.
  struct Column
  {
    Attribute attribute;
    bool fixed = false; ///< scaled integers: with `decimals`
    int decimals = 0;
  };

  std::string path;
  char separator = ' ';
  std::unique_ptr<OutputFile> file;
  std::vector<Column> columns;
  std::vector<std::string> findings;
  int decimals[3] = { 0, 0, 0 }; ///< decimals of x, y and z
  std::string text; ///< not yet written

  Result<void> flush()
  {
    Result<void> done = file->append(reinterpret_cast<const std::byte*>(text.data()), text.size());
    text.clear();
    return done;
  }

  void appendPoint(const PointBatch& batch, std::size_t point);
};

XYZWriter::XYZWriter(std::string path, Style style)
  : state_(std::make_unique<State>())
{
  state_->separator = style == Style::CSV ? ',' : ' ';
  state_->path = std::move(path);
}

XYZWriter::~XYZWriter() = default;

std::string XYZWriter::path() const
{
  return state_->path;
}

Result<void> XYZWriter::begin(const SinkDescription& description)
{
  assert(!state_->file);
  Result<std::unique_ptr<OutputFile>> file = OutputFile::create(state_->path);
  if (!file)
  {
    return file.error();
  }
  state_->file = std::move(*file);
  for (int axis = 0; axis < 3; ++axis)
  {
    state_->decimals[axis] =
      decimalsOf(description.grid.scale[axis], description.grid.offset[axis]);
  }
  const std::string separator(1, state_->separator);
  state_->text = (separator == "," ? "x" : "# x") + separator + "y" + separator + "z";
  const FieldNames names(description.schema, plainName);
  state_->findings = names.findings();
  for (std::size_t c = 0; c < description.schema.size(); ++c)
  {
    const Attribute& attribute = description.schema[c];
    const bool fixed = isScaled(attribute) && !isFloat(attribute);
    state_->columns.push_back(
      { attribute, fixed, fixed ? decimalsOf(attribute.scale, attribute.offset) : 0 });
    for (std::size_t k = 0; k < attribute.components; ++k)
    {
      state_->text += separator + columnName(attribute, names[c], k);
    }
  }
  state_->text += "\n";
  return {};
}

void XYZWriter::State::appendPoint(const PointBatch& batch, std::size_t point)
{
  const glm::dvec3& p = batch.positions[point];
  for (int axis = 0; axis < 3; ++axis)
  {
    text.append(axis == 0 ? 0 : 1, separator);
    appendFixed(text, p[axis], decimals[axis]);
  }
  for (std::size_t c = 0; c < columns.size(); ++c)
  {
    const Attribute& attribute = columns[c].attribute;
    const std::byte* from = batch.columns[c].data() + point * attribute.bytes();
    for (std::size_t k = 0; k < attribute.components; ++k, from += sizeOf(attribute.type))
    {
      text += separator;
      if (columns[c].fixed)
      {
        const double value = scalarValue(attribute.type, from);
        appendFixed(text, attribute.offset + attribute.scale * value, columns[c].decimals);
      }
      else if (isScaled(attribute))
      {
        const double value = attribute.offset + attribute.scale * scalarValue(attribute.type, from);
        appendScalar(text, ScalarType::Float64, reinterpret_cast<const std::byte*>(&value));
      }
      else
      {
        appendScalar(text, attribute.type, from);
      }
    }
  }
  text += '\n';
}

Result<void> XYZWriter::append(const PointBatch& batch)
{
  assert(state_->file);
  for (std::size_t i = 0; i < batch.size(); ++i)
  {
    state_->appendPoint(batch, i);
    if (state_->text.size() >= flushBytes)
    {
      if (auto done = state_->flush(); !done)
      {
        return done;
      }
    }
  }
  return {};
}

Result<void> XYZWriter::finish()
{
  assert(state_->file);
  if (auto done = state_->flush(); !done)
  {
    return done;
  }
  return state_->file->publish();
}

std::vector<std::string> XYZWriter::findings() const
{
  return state_->findings;
}

} // namespace pointfront
