#include "PointSetSource.h"

#include "pointfront/Table/PositionSurvey.h"

#include <vtkAbstractArray.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
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

/// The points without the marks of duplicates and hidden ones; null if no point has such a mark.
vtkSmartPointer<vtkIdList> unmarked(vtkDataArray* marks, vtkIdType count)
{
  constexpr int leftOut = vtkDataSetAttributes::DUPLICATEPOINT | vtkDataSetAttributes::HIDDENPOINT;
  auto kept = vtkSmartPointer<vtkIdList>::New();
  for (vtkIdType i = 0; i < count; ++i)
  {
    if ((static_cast<int>(marks->GetComponent(i, 0)) & leftOut) == 0)
    {
      kept->InsertNextId(i);
    }
  }
  return kept->GetNumberOfIds() < count ? kept : nullptr;
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
  count_ = points_->GetNumberOfPoints();
  description_.pointCount = static_cast<std::uint64_t>(count_);
  description_.grid = gridOf(points);
}

Result<std::unique_ptr<PointSetSource>> PointSetSource::make(
  vtkPointSet* points, const SurveyOptions& options)
{
  std::unique_ptr<PointSetSource> source(new PointSetSource(points));
  if (Result<void> left = source->leaveOutMarked(points->GetPointData()); !left)
  {
    return left.error();
  }
  // Before there are attributes, which would be read with the positions.
  const Result<PositionExtent> extent = surveyPositions(*source, options);
  if (!extent)
  {
    return extent.error();
  }
  extent->describe(source->description_);
  if (Result<void> added = source->addArrays(*points); !added)
  {
    return added.error();
  }
  return source;
}

Result<void> PointSetSource::checkTuples(vtkDataArray* array)
{
  const vtkIdType tuples = array->GetNumberOfTuples();
  if (tuples == count_)
  {
    return {};
  }
  const std::string found = " point data \"" + std::string(array->GetName()) + "\" has " +
    std::to_string(tuples) + " tuples, and there are " + std::to_string(count_) + " points";
  if (tuples < count_)
  {
    return makeError(Error::Kind::BadArgument, "the" + found + ": give each point a tuple");
  }
  description_.warnings.push_back("The" + found + ": the first are stored.");
  return {};
}

Result<void> PointSetSource::leaveOutMarked(vtkPointData* attributes)
{
  auto* marks = attributes->GetArray(vtkDataSetAttributes::GhostArrayName());
  if (!points_ || !marks)
  {
    return {};
  }
  if (Result<void> enough = checkTuples(marks); !enough)
  {
    return enough;
  }
  kept_ = unmarked(marks, count_);
  if (kept_)
  {
    auto shown = vtkSmartPointer<vtkPoints>::New();
    shown->SetDataType(points_->GetDataType());
    points_->GetPoints(kept_, shown);
    points_ = shown;
    description_.pointCount = static_cast<std::uint64_t>(kept_->GetNumberOfIds());
    description_.warnings.push_back(std::to_string(count_ - kept_->GetNumberOfIds()) + " of " +
      std::to_string(count_) + " points are left out: \"" + marks->GetName() +
      "\" marks them as duplicate or hidden.");
  }
  return {};
}

Result<void> PointSetSource::addArrays(vtkPointSet& points)
{
  vtkPointData* attributes = points.GetPointData();
  for (int i = 0; points_ && i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = attributes->GetAbstractArray(i);
    const std::string name = array->GetName() ? array->GetName() : "";
    auto* numbers = vtkDataArray::SafeDownCast(array);
    const bool told = name == vtkDataSetAttributes::GhostArrayName() || name == "point_id" ||
      (name == "elevation" && numbers && isHeight(numbers, points.GetPoints()));
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
    if (Result<void> enough = checkTuples(numbers); !enough)
    {
      return enough;
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
  if (kept_)
  {
    column.TakeReference(vtkDataArray::CreateDataArray(array->GetDataType()));
    column->SetNumberOfComponents(array->GetNumberOfComponents());
    column->SetNumberOfTuples(kept_->GetNumberOfIds());
    array->GetTuples(kept_, column);
  }
  else if (!array->HasStandardMemoryLayout())
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
