#include "PointArrays.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <cassert>
#include <cstring>
#include <numeric>

namespace pointfront
{
namespace
{

int vtkTypeOf(ScalarType type)
{
  switch (type)
  {
  case ScalarType::Int8:
    return VTK_TYPE_INT8;
  case ScalarType::UInt8:
    return VTK_TYPE_UINT8;
  case ScalarType::Int16:
    return VTK_TYPE_INT16;
  case ScalarType::UInt16:
    return VTK_TYPE_UINT16;
  case ScalarType::Int32:
    return VTK_TYPE_INT32;
  case ScalarType::UInt32:
    return VTK_TYPE_UINT32;
  case ScalarType::Int64:
    return VTK_TYPE_INT64;
  case ScalarType::UInt64:
    return VTK_TYPE_UINT64;
  case ScalarType::Float32:
    return VTK_TYPE_FLOAT32;
  case ScalarType::Float64:
    return VTK_TYPE_FLOAT64;
  }
  return VTK_TYPE_FLOAT64;
}

template <typename T>
double componentAs(const std::byte* bytes, std::size_t i)
{
  T value;
  std::memcpy(&value, bytes + i * sizeof(T), sizeof(T));
  return static_cast<double>(value);
}

double component(ScalarType type, const std::byte* bytes, std::size_t i)
{
  switch (type)
  {
  case ScalarType::Int8:
    return componentAs<std::int8_t>(bytes, i);
  case ScalarType::UInt8:
    return componentAs<std::uint8_t>(bytes, i);
  case ScalarType::Int16:
    return componentAs<std::int16_t>(bytes, i);
  case ScalarType::UInt16:
    return componentAs<std::uint16_t>(bytes, i);
  case ScalarType::Int32:
    return componentAs<std::int32_t>(bytes, i);
  case ScalarType::UInt32:
    return componentAs<std::uint32_t>(bytes, i);
  case ScalarType::Int64:
    return componentAs<std::int64_t>(bytes, i);
  case ScalarType::UInt64:
    return componentAs<std::uint64_t>(bytes, i);
  case ScalarType::Float32:
    return componentAs<float>(bytes, i);
  case ScalarType::Float64:
    return componentAs<double>(bytes, i);
  }
  return 0.0;
}

/// The bytes of the points at `rows`, `stride` bytes each.
std::vector<std::byte> gathered(
  const std::vector<std::byte>& bytes, std::size_t stride, const std::vector<std::uint32_t>& rows)
{
  std::vector<std::byte> chosen(rows.size() * stride);
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    std::memcpy(chosen.data() + i * stride, bytes.data() + rows[i] * stride, stride);
  }
  return chosen;
}

void addVertices(vtkPolyData* output, vtkIdType points)
{
  vtkNew<vtkIdTypeArray> offsets;
  vtkNew<vtkIdTypeArray> connectivity;
  offsets->SetNumberOfValues(points + 1);
  connectivity->SetNumberOfValues(points);
  for (vtkIdType i = 0; i < points; ++i)
  {
    offsets->SetValue(i, i);
    connectivity->SetValue(i, i);
  }
  offsets->SetValue(points, points);
  vtkNew<vtkCellArray> vertices;
  vertices->SetData(offsets, connectivity);
  output->SetVerts(vertices);
}

} // namespace

/// One attribute on its way into a VTK array.
class PointArrays::Column
{
public:
  Column(const Attribute& attribute, const ColumnRange& range, std::size_t points)
      : attribute_(attribute), scaled_(attribute.scale != 1.0 || attribute.offset != 0.0),
        colour_(attribute.name == "rgb" && attribute.components == 3 &&
                (attribute.type == ScalarType::UInt16 || attribute.type == ScalarType::UInt8))
  {
    const int type =
      colour_ ? VTK_UNSIGNED_CHAR : (scaled_ ? VTK_DOUBLE : vtkTypeOf(attribute.type));
    array_.TakeReference(vtkDataArray::CreateDataArray(type));
    array_->SetName(attribute.name.c_str());
    array_->SetNumberOfComponents(attribute.components);
    array_->SetNumberOfTuples(static_cast<vtkIdType>(points));
    // Files that fill 16-bit fields with 8-bit colours are common.
    for (const auto& component : range.components)
    {
      wide_ = wide_ || component[1] > 255.0;
      shows_ = shows_ || component[0] < component[1] || (colour_ && component[1] > 0.0);
    }
  }

  /// The values of `count` points, to be the array's points from `first` on.
  void fill(const std::vector<std::byte>& bytes, std::size_t first, std::size_t count)
  {
    const std::size_t values = count * attribute_.components;
    const auto at = static_cast<vtkIdType>(first * attribute_.components);
    if (colour_ && attribute_.type == ScalarType::UInt16)
    {
      auto* out = static_cast<unsigned char*>(array_->GetVoidPointer(at));
      for (std::size_t i = 0; i < values; ++i)
      {
        std::uint16_t value;
        std::memcpy(&value, bytes.data() + 2 * i, 2);
        out[i] = static_cast<unsigned char>(wide_ ? value >> 8 : value);
      }
    }
    else if (scaled_ && !colour_)
    {
      auto* out = static_cast<double*>(array_->GetVoidPointer(at));
      for (std::size_t i = 0; i < values; ++i)
      {
        out[i] = component(attribute_.type, bytes.data(), i) * attribute_.scale + attribute_.offset;
      }
    }
    else
    {
      std::memcpy(array_->GetVoidPointer(at), bytes.data(), values * sizeOf(attribute_.type));
    }
  }

  /// Whether the store's points have more than one value of it, or a colour that is not black.
  bool showsSomething() const { return shows_; }
  const std::string& name() const { return attribute_.name; }
  std::size_t stride() const { return attribute_.components * sizeOf(attribute_.type); }
  vtkDataArray* array() const { return array_; }

private:
  Attribute attribute_;
  bool scaled_;
  bool colour_;
  bool shows_ = false;
  bool wide_ = false; ///< 16-bit colour uses more than its low byte
  vtkSmartPointer<vtkDataArray> array_;
};

PointArrays::PointArrays(
  const StoreDescription& description, const ColumnSelection& columns, std::size_t points)
  : description_(description)
{
  points_->SetDataTypeToDouble();
  points_->SetNumberOfPoints(static_cast<vtkIdType>(points));
  elevation_->SetName("elevation");
  elevation_->SetNumberOfValues(static_cast<vtkIdType>(points));
  ids_->SetName("point_id");
  ids_->SetNumberOfValues(static_cast<vtkIdType>(points));
  for (const std::uint32_t column : columns)
  {
    columns_.emplace_back(description.schema[column], description.ranges[column], points);
  }
}

PointArrays::~PointArrays() = default;

void PointArrays::addPrefix(const NodeColumns& node, std::uint32_t count)
{
  std::vector<std::uint32_t> rows(count);
  std::iota(rows.begin(), rows.end(), 0u);
  this->addRows(node, rows);
}

void PointArrays::addRows(const NodeColumns& node, const std::vector<std::uint32_t>& rows)
{
  assert(static_cast<vtkIdType>(filled_ + rows.size()) <= ids_->GetNumberOfValues());
  auto* xyz = static_cast<double*>(points_->GetVoidPointer(0));
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const std::size_t at = filled_ + i;
    const glm::dvec3 p =
      description_.grid.toWorld(node.origin + GridPosition(node.positions[rows[i]]));
    xyz[3 * at] = p.x;
    xyz[3 * at + 1] = p.y;
    xyz[3 * at + 2] = p.z;
    elevation_->SetValue(static_cast<vtkIdType>(at), p.z);
    ids_->SetValue(static_cast<vtkIdType>(at), static_cast<vtkIdType>(node.firstPoint + rows[i]));
  }
  for (std::size_t k = 0; k < columns_.size(); ++k)
  {
    const std::vector<std::byte> bytes = gathered(node.columns[k], columns_[k].stride(), rows);
    columns_[k].fill(bytes, filled_, rows.size());
  }
  filled_ += rows.size();
}

const char* PointArrays::defaultColours() const
{
  for (const char* name : {"rgb", "classification", "intensity"})
  {
    for (const Column& column : columns_)
    {
      if (column.name() == name && column.showsSomething())
      {
        return name;
      }
    }
  }
  double range[2];
  elevation_->GetRange(range);
  return range[0] < range[1] ? "elevation" : nullptr;
}

void PointArrays::moveTo(vtkPolyData* output)
{
  output->SetPoints(points_);
  addVertices(output, points_->GetNumberOfPoints());
  vtkPointData* attributes = output->GetPointData();
  for (const Column& column : columns_)
  {
    attributes->AddArray(column.array());
  }
  if (!attributes->HasArray(elevation_->GetName()))
  {
    attributes->AddArray(elevation_);
  }
  attributes->SetActiveScalars(this->defaultColours());
  attributes->SetGlobalIds(ids_);
}

} // namespace pointfront
