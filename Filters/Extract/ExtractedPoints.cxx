#include "ExtractedPoints.h"

#include "AttributeArray.h"

#include <vtkDataArray.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <string>
#include <utility>

namespace pointfront
{

Result<void> ExtractedPoints::add(QueryBatch& batch)
{
  points_ += batch.size();
  if (points_ > mostPoints_)
  {
    return makeError(Error::Kind::NoMemory,
      "more than " + std::to_string(mostPoints_) +
        " points are chosen; choose less, a coarser Spacing, or raise MaximumNumberOfPoints");
  }
  batches_.push_back(std::move(batch));
  return {};
}

void ExtractedPoints::moveTo(const StoreDescription& description, vtkPolyData* output)
{
  const auto count = static_cast<vtkIdType>(points_);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("point_id");
  ids->SetNumberOfValues(count);
  std::vector<AttributeArray> arrays;
  for (std::size_t c = 0; c < description.schema.size(); ++c)
  {
    const ColumnRange range = c < description.ranges.size() ? description.ranges[c] : ColumnRange();
    arrays.emplace_back(description.schema[c], range, points_);
  }
  std::size_t first = 0;
  for (QueryBatch& batch : batches_)
  {
    const QueryBatch from = std::move(batch);
    auto* const xyz =
      static_cast<double*>(points->GetData()->GetVoidPointer(static_cast<vtkIdType>(3 * first)));
    for (std::size_t i = 0; i < from.size(); ++i)
    {
      const glm::dvec3& p = from.points.positions[i];
      std::copy_n(&p.x, 3, xyz + 3 * i);
      ids->SetValue(static_cast<vtkIdType>(first + i), static_cast<vtkIdType>(from.ids[i]));
    }
    for (std::size_t c = 0; c < arrays.size(); ++c)
    {
      arrays[c].fill(from.points.columns[c].data(), first, from.size());
    }
    first += from.size();
  }
  batches_.clear();
  output->SetPoints(points);
  addVertexCells(output);
  for (const AttributeArray& array : arrays)
  {
    array.addTo(output);
  }
  output->GetPointData()->SetGlobalIds(ids);
}

std::vector<std::uint64_t> ascendingIds(vtkIdTypeArray* ids)
{
  const vtkIdType* const from = ids->GetPointer(0);
  std::vector<std::uint64_t> ranks(from, from + ids->GetNumberOfValues());
  std::sort(ranks.begin(), ranks.end());
  ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
  return ranks;
}

std::vector<std::uint64_t> pieceOf(
  const std::vector<std::uint64_t>& ids, unsigned piece, unsigned pieces)
{
  const auto at = [&](unsigned p)
  { return ids.begin() + static_cast<std::ptrdiff_t>(ids.size() * std::size_t(p) / pieces); };
  return { at(piece), at(piece + 1) };
}

} // namespace pointfront
