#include "Overview.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <optional>

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

/// One attribute on its way into a VTK array.
class ArrayFiller
{
public:
  ArrayFiller(const Attribute& attribute, const ColumnRange& range, std::size_t points)
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

  bool isColour() const { return colour_; }
  vtkDataArray* array() const { return array_; }

private:
  Attribute attribute_;
  bool scaled_;
  bool colour_;
  bool wide_ = false; ///< 16-bit colour uses more than its low byte
  vtkSmartPointer<vtkDataArray> array_;
};

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

/// First rank of each of the table's nodes that `parts` names.
std::map<NodeIndex, std::uint64_t> ranksOf(
  const Hierarchy& hierarchy, const std::vector<OverviewPart>& parts)
{
  std::map<NodeIndex, std::uint64_t> ranks;
  for (const OverviewPart& part : parts)
  {
    ranks[part.node] = hierarchy.node(part.node).firstPoint;
  }
  return ranks;
}

} // namespace

std::vector<OverviewPart> chooseOverview(const Hierarchy& hierarchy, std::uint64_t maxPoints)
{
  std::vector<OverviewPart> parts;
  std::vector<NodeIndex> level(hierarchy.roots());
  std::uint64_t left = maxPoints;
  while (!level.empty() && left > 0)
  {
    std::sort(level.begin(), level.end());
    std::uint64_t points = 0;
    for (const NodeIndex node : level)
    {
      points += hierarchy.node(node).pointCount;
    }
    const bool whole = points <= left;
    std::vector<NodeIndex> below;
    for (const NodeIndex index : level)
    {
      const Node node = hierarchy.node(index);
      const std::uint64_t count =
        whole
          ? node.pointCount
          : static_cast<std::uint64_t>(static_cast<double>(node.pointCount) *
                                       (static_cast<double>(left) / static_cast<double>(points)));
      if (count > 0)
      {
        parts.push_back({index, static_cast<std::uint32_t>(count)});
      }
      if (whole)
      {
        hierarchy.appendChildren(index, node, below);
      }
    }
    left -= std::min(left, points);
    // With mean representatives a level stands for all above it but the leaves.
    if (hierarchy.refinement() == Refinement::Replace && whole && !below.empty())
    {
      std::uint64_t next = 0;
      for (const NodeIndex child : below)
      {
        next += hierarchy.node(child).pointCount;
      }
      std::uint64_t leaves = 0;
      for (const OverviewPart& part : parts)
      {
        leaves += hierarchy.node(part.node).leaf() ? part.pointCount : 0;
      }
      if (leaves + next > maxPoints)
      {
        break;
      }
      const auto replaced = [&](const OverviewPart& part)
      { return !hierarchy.node(part.node).leaf(); };
      parts.erase(std::remove_if(parts.begin(), parts.end(), replaced), parts.end());
      left = maxPoints - leaves;
    }
    level = std::move(below);
  }
  std::sort(parts.begin(), parts.end(),
    [](const OverviewPart& a, const OverviewPart& b) { return a.node < b.node; });
  return parts;
}

std::vector<OverviewPart> overviewPiece(
  const std::vector<OverviewPart>& parts, int piece, int pieces)
{
  std::uint64_t total = 0;
  for (const OverviewPart& part : parts)
  {
    total += part.pointCount;
  }
  std::vector<OverviewPart> chosen;
  std::uint64_t before = 0;
  for (const OverviewPart& part : parts)
  {
    // A part belongs to the piece in which its middle point lies.
    const std::uint64_t middle = before + part.pointCount / 2;
    const auto owner =
      middle * static_cast<std::uint64_t>(pieces) / std::max<std::uint64_t>(total, 1);
    if (owner == static_cast<std::uint64_t>(piece))
    {
      chosen.push_back(part);
    }
    before += part.pointCount;
  }
  return chosen;
}

Result<void> fillOverview(const StoredCloud& store, const std::vector<OverviewPart>& parts,
  const ColumnSelection& columns, vtkPolyData* output, const std::function<bool(double)>& advance)
{
  const StoreDescription& description = store.description();
  if (std::optional<Error> damage = store.hierarchy()->fault()) // met while parts were chosen
  {
    return *damage;
  }
  const auto ranks = ranksOf(*store.hierarchy(), parts);
  std::size_t total = 0;
  for (const OverviewPart& part : parts)
  {
    total += part.pointCount;
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(total));
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("point_id");
  ids->SetNumberOfValues(static_cast<vtkIdType>(total));
  std::vector<ArrayFiller> fillers;
  for (const std::uint32_t column : columns)
  {
    fillers.emplace_back(description.schema[column], description.ranges[column], total);
  }
  auto* xyz = static_cast<double*>(points->GetVoidPointer(0));
  std::size_t first = 0;
  for (const OverviewPart& part : parts)
  {
    if (!advance(static_cast<double>(first) / static_cast<double>(std::max<std::size_t>(total, 1))))
    {
      return makeError(Error::Kind::Cancelled, "reading of the overview was stopped");
    }
    auto read = store.read(part.node, columns);
    if (!read)
    {
      return read.error();
    }
    const std::uint64_t rank = ranks.at(part.node);
    for (std::uint32_t i = 0; i < part.pointCount; ++i)
    {
      const glm::dvec3 p =
        description.grid.toWorld(read->origin + GridPosition(read->positions[i]));
      xyz[3 * (first + i)] = p.x;
      xyz[3 * (first + i) + 1] = p.y;
      xyz[3 * (first + i) + 2] = p.z;
      ids->SetValue(static_cast<vtkIdType>(first + i), static_cast<vtkIdType>(rank + i));
    }
    for (std::size_t k = 0; k < fillers.size(); ++k)
    {
      fillers[k].fill(read->columns[k], first, part.pointCount);
    }
    first += part.pointCount;
  }
  output->SetPoints(points);
  addVertices(output, static_cast<vtkIdType>(total));
  for (const ArrayFiller& filler : fillers)
  {
    if (filler.isColour())
    {
      output->GetPointData()->SetScalars(filler.array());
    }
    else
    {
      output->GetPointData()->AddArray(filler.array());
    }
  }
  output->GetPointData()->SetGlobalIds(ids);
  return {};
}

} // namespace pointfront
