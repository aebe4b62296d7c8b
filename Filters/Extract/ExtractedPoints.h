#pragma once

#include "AttributeArray.h"

#include "pointfront/Query/QueryBatch.h"
#include "pointfront/Store/StoredCloud.h"

#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <cstdint>
#include <vector>

class vtkPolyData;

namespace pointfront
{

/// Batches of a query on their way into VTK's arrays, which grow as they come.
/// Memory   the arrays, which hold each point once. While they grow they are larger than what is in
///          them; the system gives memory to what was written only.
/// Threads  one.
class ExtractedPoints
{
public:
  /// `description` has the schema of the batches; `coloursAsStored` as AttributeArray's.
  ExtractedPoints(
    const StoreDescription& description, std::uint64_t mostPoints, bool coloursAsStored);

  /// NoMemory where they would be more than `mostPoints`.
  Result<void> add(const QueryBatch& batch);
  /// Double points, a vertex cell each if they are wanted, their attributes (AttributeArray), and
  /// numbers in the store as global ids called "point_id".
  void moveTo(vtkPolyData* output, bool vertexCells);

private:
  /// Makes room for so many points; what is there stays.
  void resize(std::uint64_t points);

  std::uint64_t mostPoints_;
  std::uint64_t points_ = 0;
  std::uint64_t room_ = 0;
  vtkNew<vtkPoints> positions_;
  vtkNew<vtkIdTypeArray> ids_;
  std::vector<AttributeArray> attributes_;
};

/// Ids out of a VTK array: ascending, each once; negative ones are left to the query to refuse.
std::vector<std::uint64_t> ascendingIds(vtkIdTypeArray* ids);
/// The share of a list that a piece has: neighbours, about as many in each.
std::vector<std::uint64_t> pieceOf(
  const std::vector<std::uint64_t>& ids, unsigned piece, unsigned pieces);

} // namespace pointfront
