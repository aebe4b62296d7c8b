#include "PointArrays.h"

#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <numeric>

namespace pointfront
{
namespace
{

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

/// More than one value over the store, or a colour that is not black.
bool showsSomething(const Attribute& attribute, const ColumnRange& range)
{
  return std::any_of(range.components.begin(), range.components.end(),
    [&](const auto& ends)
    { return ends[0] < ends[1] || (attribute.name == "rgb" && ends[1] > 0.0); });
}

} // namespace

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
    const Attribute& attribute = description.schema[column];
    const ColumnRange& range = description.ranges[column];
    columns_.push_back({ attribute.name, attribute.bytes(), showsSomething(attribute, range),
      AttributeArray(attribute, range, points) });
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
  assert(filled_ + rows.size() <= static_cast<std::size_t>(ids_->GetNumberOfValues()));
  auto* xyz = static_cast<double*>(points_->GetData()->GetVoidPointer(0));
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
    const std::vector<std::byte> bytes = gathered(node.columns[k], columns_[k].stride, rows);
    columns_[k].array.fill(bytes.data(), filled_, rows.size());
  }
  filled_ += rows.size();
}

const char* PointArrays::defaultColours() const
{
  for (const char* name : { "rgb", "classification", "intensity" })
  {
    for (const Column& column : columns_)
    {
      if (column.name == name && column.shows)
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
  addVertexCells(output);
  vtkPointData* attributes = output->GetPointData();
  for (const Column& column : columns_)
  {
    column.array.addTo(output);
  }
  if (!attributes->HasArray(elevation_->GetName()))
  {
    attributes->AddArray(elevation_);
  }
  attributes->SetActiveScalars(this->defaultColours());
  attributes->SetGlobalIds(ids_);
}

} // namespace pointfront
