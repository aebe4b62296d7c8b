#include "PointSetSource.h"

#include "pointfront/Table/PositionSurvey.h"

#include <vtkAbstractArray.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPointSet.h>
#include <vtkStringArray.h>

#include <cmath>
#include <optional>
#include <string>

namespace pointfront
{
namespace
{

constexpr int mostComponents = 16;

std::optional<ScalarType> typeOf(int vtkType)
{
  switch (vtkType)
  {
    case VTK_CHAR:
    case VTK_SIGNED_CHAR:
      return ScalarType::Int8;
    case VTK_UNSIGNED_CHAR:
      return ScalarType::UInt8;
    case VTK_SHORT:
      return ScalarType::Int16;
    case VTK_UNSIGNED_SHORT:
      return ScalarType::UInt16;
    case VTK_INT:
      return ScalarType::Int32;
    case VTK_UNSIGNED_INT:
      return ScalarType::UInt32;
    case VTK_LONG:
    case VTK_LONG_LONG:
    case VTK_ID_TYPE:
      return ScalarType::Int64;
    case VTK_UNSIGNED_LONG:
    case VTK_UNSIGNED_LONG_LONG:
      return ScalarType::UInt64;
    case VTK_FLOAT:
      return ScalarType::Float32;
    case VTK_DOUBLE:
      return ScalarType::Float64;
    default:
      return std::nullopt;
  }
}

bool isColour(vtkDataArray* array, const std::string& name)
{
  const int components = array->GetNumberOfComponents();
  return array->GetDataType() == VTK_UNSIGNED_CHAR && (components == 3 || components == 4) &&
    (name == "rgb" || name == "RGB" || name == "RGBA" || name == "Colors");
}

bool isHeight(vtkDataArray* array, vtkPoints* points)
{
  double place[3];
  const vtkIdType count = points->GetNumberOfPoints();
  if (array->GetNumberOfTuples() != count)
  {
    return false;
  }
  for (vtkIdType i = 0; i < count; ++i)
  {
    points->GetPoint(i, place);
    if (array->GetComponent(i, 0) != place[2])
    {
      return false;
    }
  }
  return array->GetNumberOfComponents() == 1;
}

/// As vtkPointFrontReader's output names it in ParaView.
std::string referenceSystemOf(vtkPointSet* points)
{
  auto* text = vtkStringArray::SafeDownCast(points->GetFieldData()->GetAbstractArray("store_crs"));
  const std::string wkt = text && text->GetNumberOfValues() == 1 ? text->GetValue(0) : "";
  return wkt.find('[') != std::string::npos ? wkt : "";
}

/// The grid that vtkPointFrontReader's output names in ParaView, if all points still lie on it: a
/// filter hands the name on and may move the points.
std::optional<QuantisationGrid> gridOf(vtkPointSet* points)
{
  constexpr double rounding = 1e-3; // steps; what doubles round is far less
  auto* told = vtkDataArray::SafeDownCast(points->GetFieldData()->GetAbstractArray("store_grid"));
  if (!told || told->GetNumberOfTuples() != 1 || told->GetNumberOfComponents() != 6)
  {
    return std::nullopt;
  }
  const double* const values = told->GetTuple6(0);
  QuantisationGrid grid;
  grid.scale = { values[0], values[1], values[2] };
  grid.offset = { values[3], values[4], values[5] };
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(grid.scale[axis] > 0.0) || !std::isfinite(grid.scale[axis]) ||
      !std::isfinite(grid.offset[axis]))
    {
      return std::nullopt;
    }
  }
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    double place[3];
    points->GetPoint(i, place);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double steps = (place[axis] - grid.offset[axis]) / grid.scale[axis];
      if (!(std::abs(steps) < mostStepsInDouble) || std::abs(steps - std::round(steps)) > rounding)
      {
        return std::nullopt;
      }
    }
  }
  return grid;
}

} // namespace

PointSetSource::PointSetSource(vtkPointSet* points)
  : points_(points->GetPoints())
{
  description_.path = "the points of the pipeline";
  description_.format = points->GetClassName();
  description_.crsWkt = referenceSystemOf(points);
  if (!points_)
  {
    return;
  }
  description_.pointCount = static_cast<std::uint64_t>(points_->GetNumberOfPoints());
  description_.grid = gridOf(points);
}

Result<std::unique_ptr<PointSetSource>> PointSetSource::make(
  vtkPointSet* points, const SurveyOptions& options)
{
  std::unique_ptr<PointSetSource> source(new PointSetSource(points));
  // Before there are attributes, which would be read with the positions.
  const Result<PositionExtent> extent = surveyPositions(*source, options);
  if (!extent)
  {
    return extent.error();
  }
  extent->describe(source->description_);
  if (Result<void> added = source->addArrays(points->GetPointData()); !added)
  {
    return added.error();
  }
  return source;
}

Result<void> PointSetSource::addArrays(vtkPointData* attributes)
{
  for (int i = 0; points_ && i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = attributes->GetAbstractArray(i);
    const std::string name = array->GetName() ? array->GetName() : "";
    auto* numbers = vtkDataArray::SafeDownCast(array);
    const bool told = name == vtkDataSetAttributes::GhostArrayName() || name == "point_id" ||
      (name == "elevation" && numbers && isHeight(numbers, points_));
    if (told)
    {
      continue;
    }
    if (name.empty() || !numbers || !typeOf(numbers->GetDataType()) ||
      numbers->GetNumberOfComponents() > mostComponents)
    {
      description_.warnings.push_back("The point data \"" + name +
        "\" are left out: a store holds named numbers of 1 to 16 components.");
      continue;
    }
    const auto tuples = static_cast<std::uint64_t>(numbers->GetNumberOfTuples());
    if (const std::uint64_t count = description_.pointCount; tuples != count)
    {
      const std::string found = "\"" + name + "\" has " + std::to_string(tuples) +
        " tuples, and there are " + std::to_string(count) + " points";
      if (tuples < count)
      {
        return makeError(
          Error::Kind::BadArgument, "the point data " + found + ": give each point a tuple");
      }
      description_.warnings.push_back("The point data " + found + ": the first are stored.");
    }
    this->add(numbers);
  }
  return {};
}

PointSetSource::~PointSetSource() = default;

void PointSetSource::add(vtkDataArray* array)
{
  Attribute attribute;
  attribute.name = array->GetName();
  attribute.type = *typeOf(array->GetDataType());
  attribute.components = static_cast<std::uint8_t>(array->GetNumberOfComponents());
  if (isColour(array, attribute.name))
  {
    attribute.name = "rgb";
    attribute.components = 3;
  }
  else if (attribute.name == "Normals" && attribute.type == ScalarType::Float32 &&
    attribute.components == 3)
  {
    attribute.name = "normal";
  }
  vtkSmartPointer<vtkDataArray> column = array;
  if (!array->HasStandardMemoryLayout())
  {
    column.TakeReference(vtkDataArray::CreateDataArray(array->GetDataType()));
    column->DeepCopy(array);
  }
  // A colour's column may have an alpha, which stays behind.
  const auto stride =
    static_cast<std::size_t>(column->GetNumberOfComponents() * column->GetDataTypeSize());
  if (!addColumn(attribute, column->GetVoidPointer(0), stride))
  {
    description_.warnings.push_back(
      "The point data \"" + attribute.name + "\" are there twice: the first are stored.");
    return;
  }
  arrays_.push_back(column);
}

glm::dvec3 PointSetSource::position(std::uint64_t point) const
{
  double place[3];
  points_->GetPoint(static_cast<vtkIdType>(point), place);
  return { place[0], place[1], place[2] };
}

} // namespace pointfront
