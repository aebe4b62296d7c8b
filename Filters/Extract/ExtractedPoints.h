#pragma once

#include "pointfront/Query/QueryBatch.h"
#include "pointfront/Store/StoredCloud.h"

#include <cstdint>
#include <vector>

class vtkIdTypeArray;
class vtkPolyData;

namespace pointfront
{

/// Batches of a query, kept until all are there and the arrays' size is known.
/// Memory   the points as the store has them; twice that for a moment while arrays are filled, for
///          each batch is given back once it is copied.
/// Threads  one.
class ExtractedPoints
{
public:
  explicit ExtractedPoints(std::uint64_t mostPoints)
    : mostPoints_(mostPoints)
  {
  }

  /// NoMemory where they would be more than `mostPoints`.
  Result<void> add(QueryBatch& batch);
  /// Double points, a vertex cell each, their attributes (AttributeArray), and ranks in the store
  /// as global ids called "point_id". `description` has the schema of the batches.
  void moveTo(const StoreDescription& description, vtkPolyData* output);

private:
  std::uint64_t mostPoints_;
  std::uint64_t points_ = 0;
  std::vector<QueryBatch> batches_;
};

/// Ranks out of a VTK array: ascending, each once; negative ones are left to the query to refuse.
std::vector<std::uint64_t> ascendingIds(vtkIdTypeArray* ids);
/// The share of a list that a piece has: neighbours, about as many in each.
std::vector<std::uint64_t> pieceOf(
  const std::vector<std::uint64_t>& ids, unsigned piece, unsigned pieces);

} // namespace pointfront
