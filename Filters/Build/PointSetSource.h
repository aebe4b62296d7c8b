#pragma once

#include "pointfront/Points/PointSource.h"

#include <vtkSmartPointer.h>

#include <vector>

class vtkDataArray;
class vtkPoints;
class vtkPointSet;

namespace pointfront
{

/// The points of a VTK data set with their point data, as they lie there when it is made.
/// Names     unsigned char arrays "RGB", "RGBA" or "Colors" are "rgb", "Normals" of floats are
///           "normal"; all others keep theirs.
/// Grid      the one of the field data "store_grid" (scales, offsets), if all points lie on it.
/// Left out  ghost marks, "point_id" (a rank in another store) and "elevation" where it is z,
///           without a word; arrays that hold no numbers, or more than 16 components, with a
///           warning.
class PointSetSource final : public PointSource
{
public:
  explicit PointSetSource(vtkPointSet* points);
  ~PointSetSource() override;

  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override;
  std::uint64_t chunkPoints(std::uint64_t chunk) const override;
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override;

private:
  void add(vtkDataArray* array);

  SourceDescription description_;
  vtkSmartPointer<vtkPoints> points_;
  std::vector<vtkSmartPointer<vtkDataArray>> columns_; ///< as in the schema, of contiguous tuples
};

} // namespace pointfront
