#pragma once

#include "AttributeArray.h"

#include "pointfront/Query/QueryBatch.h"
#include "pointfront/Store/NodeReader.h"
#include "pointfront/Store/StoredCloud.h"

#include <vtkNew.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

class vtkDoubleArray;
class vtkIdTypeArray;
class vtkPoints;
class vtkPolyData;

namespace pointfront
{

/// Stored points on their way into vtkPolyData: double points, one vertex cell a point (so that
/// filters that select cells can select points), and the chosen columns as point data.
/// Values      AttributeArray's.
/// Elevation   a further array of that name, which the mapper draws by, too: z.
/// Colours     the active scalars are the first chosen array of rgb, classification, intensity and
///             elevation that shows something: rgb unless it is black, the others if their values
///             differ.
/// Identity    global point ids are numbers in the store: (node, position in the node).
class PointArrays
{
public:
  PointArrays(
    const StoreDescription& description, const ColumnSelection& columns, std::size_t points);
  ~PointArrays();

  /// Points that were read with the columns of the constructor.
  void add(const QueryBatch& batch);
  /// Called when all promised points have been added.
  void moveTo(vtkPolyData* output);

private:
  struct Column
  {
    std::string name;
    bool shows; ///< something: it may colour the points unasked
    AttributeArray array;
  };
  const char* defaultColours() const;

  const StoreDescription& description_;
  std::size_t filled_ = 0;
  std::vector<Column> columns_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkIdTypeArray> ids_;
  vtkNew<vtkDoubleArray> elevation_;
};

} // namespace pointfront
