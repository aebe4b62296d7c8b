#include "PointArrays.h"

#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cassert>

namespace pointfront
{
namespace
{

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
    columns_.push_back({ attribute.name, showsSomething(attribute, range),
      AttributeArray(attribute, range, points) });
  }
}

PointArrays::~PointArrays() = default;

void PointArrays::add(const QueryBatch& batch)
{
  assert(filled_ + batch.size() <= static_cast<std::size_t>(ids_->GetNumberOfValues()));
  auto* xyz = static_cast<double*>(points_->GetData()->GetVoidPointer(0)) + 3 * filled_;
  for (std::size_t i = 0; i < batch.size(); ++i)
  {
    const auto at = static_cast<vtkIdType>(filled_ + i);
    const glm::dvec3& p = batch.points.positions[i];
    std::copy_n(&p.x, 3, xyz + 3 * i);
    elevation_->SetValue(at, p.z);
    ids_->SetValue(at, static_cast<vtkIdType>(batch.ids[i]));
  }
  for (std::size_t k = 0; k < columns_.size(); ++k)
  {
    columns_[k].array.fill(batch.points.columns[k].data(), filled_, batch.size());
  }
  filled_ += batch.size();
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
