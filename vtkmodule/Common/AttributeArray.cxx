#include "AttributeArray.h"

#include "HostVTK.h"

#include <vtkCellArray.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <cstdint>
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
      break;
  }
  return VTK_TYPE_FLOAT64;
}

bool isColour(const Attribute& attribute)
{
  return attribute.name == "rgb" && attribute.components == 3 &&
    (attribute.type == ScalarType::UInt16 || attribute.type == ScalarType::UInt8);
}

template <typename T>
T valueAt(const std::byte* values, std::size_t i)
{
  T value;
  std::memcpy(&value, values + i * sizeof(T), sizeof(T));
  return value;
}

} // namespace

AttributeArray::AttributeArray(
  const Attribute& attribute, const ColumnRange& range, std::size_t points, bool coloursAsStored)
  : attribute_(attribute)
  , scaled_(attribute.scale != 1.0 || attribute.offset != 0.0)
  , colour_(isColour(attribute) && !coloursAsStored)
{
  const int type = colour_ ? VTK_UNSIGNED_CHAR : scaled_ ? VTK_DOUBLE : vtkTypeOf(attribute.type);
  array_.TakeReference(vtkDataArray::CreateDataArray(type));
  array_->SetName(attribute.name.c_str());
  array_->SetNumberOfComponents(attribute.components);
  array_->SetNumberOfTuples(static_cast<vtkIdType>(points));
  for (const std::array<double, 2>& component : range.components)
  {
    wide_ = wide_ || component[1] > 255.0;
  }
}

void AttributeArray::resize(std::size_t points)
{
  resizeArray(array_, points);
}

void AttributeArray::fill(const std::byte* from, std::size_t first, std::size_t count)
{
  const std::size_t values = count * attribute_.components;
  if (values == 0)
  {
    return;
  }
  const std::size_t begin = first * attribute_.components;
  void* const to = array_->GetVoidPointer(static_cast<vtkIdType>(begin));
  if (colour_ && attribute_.type == ScalarType::UInt16)
  {
    auto* const bytes = static_cast<unsigned char*>(to);
    for (std::size_t i = 0; i < values && !wide_; ++i)
    {
      wide_ = valueAt<std::uint16_t>(from, i) > 255;
      if (wide_) // the range of a COPC file is that of some points; those before have dark colours
      {
        std::memset(array_->GetVoidPointer(0), 0, first * attribute_.components);
      }
    }
    for (std::size_t i = 0; i < values; ++i)
    {
      const auto value = valueAt<std::uint16_t>(from, i);
      bytes[i] = static_cast<unsigned char>(wide_ ? value >> 8 : value);
    }
  }
  else if (scaled_ && !colour_)
  {
    auto* const doubles = static_cast<double*>(to);
    visitScalar(attribute_.type,
      [&](auto zero)
      {
        for (std::size_t i = 0; i < values; ++i)
        {
          doubles[i] = static_cast<double>(valueAt<decltype(zero)>(from, i)) * attribute_.scale +
            attribute_.offset;
        }
      });
  }
  else
  {
    std::memcpy(to, from, values * sizeOf(attribute_.type));
  }
}

void AttributeArray::addTo(vtkPolyData* output) const
{
  if (colour_)
  {
    output->GetPointData()->SetScalars(array_);
  }
  else
  {
    output->GetPointData()->AddArray(array_);
  }
}

void resizeArray(vtkDataArray* array, std::size_t tuples)
{
  const auto count = static_cast<vtkIdType>(tuples);
  reserveTuples(*array, count);
  array->SetNumberOfTuples(count); // keeps what is there, for it has room
}

void addVertexCells(vtkPolyData* output)
{
  const vtkIdType points = output->GetNumberOfPoints();
  vtkNew<vtkIdTypeArray> offsets;
  vtkNew<vtkIdTypeArray> connectivity;
  offsets->SetNumberOfValues(points + 1);
  connectivity->SetNumberOfValues(points);
  std::iota(offsets->GetPointer(0), offsets->GetPointer(0) + points + 1, vtkIdType(0));
  std::iota(connectivity->GetPointer(0), connectivity->GetPointer(0) + points, vtkIdType(0));
  vtkNew<vtkCellArray> vertices;
  vertices->SetData(offsets, connectivity);
  output->SetVerts(vertices);
}

} // namespace pointfront
