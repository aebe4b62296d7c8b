#include "ExtractedPoints.h"

#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <string>
#include <utility>

namespace pointfront
{

namespace
{
constexpr std::uint64_t firstRoom = 1 << 16; // points
} // namespace

ExtractedPoints::ExtractedPoints(
  const StoreDescription& description, std::uint64_t mostPoints, bool coloursAsStored)
  : mostPoints_(mostPoints)
{
  positions_->SetDataTypeToDouble();
  ids_->SetName("point_id");
  for (std::size_t c = 0; c < description.schema.size(); ++c)
  {
    const ColumnRange range = c < description.ranges.size() ? description.ranges[c] : ColumnRange();
    attributes_.emplace_back(description.schema[c], range, 0, coloursAsStored);
  }
}

void ExtractedPoints::resize(std::uint64_t points)
{
  room_ = points;
  resizeArray(positions_->GetData(), points);
  resizeArray(ids_, points);
  for (AttributeArray& attribute : attributes_)
  {
    attribute.resize(points);
  }
}

Result<void> ExtractedPoints::add(const QueryBatch& batch)
{
  const std::uint64_t first = points_;
  points_ += batch.size();
  if (points_ > mostPoints_)
  {
    return makeError(Error::Kind::NoMemory,
      "more than " + std::to_string(mostPoints_) +
        " points are chosen; choose less, a coarser Spacing, or raise MaximumNumberOfPoints");
  }
  if (points_ > room_)
  {
    resize(std::max({ points_, 2 * room_, firstRoom }));
  }
  auto* const xyz = static_cast<double*>(positions_->GetData()->GetVoidPointer(0)) + 3 * first;
  vtkIdType* const ids = ids_->GetPointer(static_cast<vtkIdType>(first));
  for (std::size_t i = 0; i < batch.size(); ++i)
  {
    std::copy_n(&batch.points.positions[i].x, 3, xyz + 3 * i);
    ids[i] = static_cast<vtkIdType>(batch.ids[i]);
  }
  for (std::size_t c = 0; c < attributes_.size(); ++c)
  {
    attributes_[c].fill(batch.points.columns[c].data(), first, batch.size());
  }
  return {};
}

void ExtractedPoints::moveTo(vtkPolyData* output, bool vertexCells)
{
  resize(points_);
  positions_->Squeeze();
  ids_->Squeeze();
  output->SetPoints(positions_);
  if (vertexCells)
  {
    addVertexCells(output);
  }
  for (AttributeArray& attribute : attributes_)
  {
    attribute.squeeze();
    attribute.addTo(output);
  }
  output->GetPointData()->SetGlobalIds(ids_);
}

std::vector<std::uint64_t> ascendingIds(vtkIdTypeArray* ids)
{
  const vtkIdType* const from = ids->GetPointer(0);
  std::vector<std::uint64_t> numbers(from, from + ids->GetNumberOfValues());
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

std::vector<std::uint64_t> pieceOf(
  const std::vector<std::uint64_t>& ids, unsigned piece, unsigned pieces)
{
  const auto at = [&](unsigned p)
  { return ids.begin() + static_cast<std::ptrdiff_t>(ids.size() * std::size_t(p) / pieces); };
  return { at(piece), at(piece + 1) };
}

} // namespace pointfront
