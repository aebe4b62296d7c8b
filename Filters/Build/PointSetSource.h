#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Points/ColumnSource.h"
#include "pointfront/Table/ParallelChunks.h"

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <memory>
#include <vector>

class vtkDataArray;
class vtkIdList;
class vtkPointData;
class vtkPoints;
class vtkPointSet;

namespace pointfront
{

/// The points of a VTK data set with their point data, as they lie there when it is made.
/// Names     unsigned char arrays "RGB", "RGBA" or "Colors" are "rgb", "Normals" of floats are
///           "normal"; all others keep theirs.
/// Opening   looks at all positions.
/// Grid      the one of the field data "store_grid" (scales, offsets), if all points lie on it;
///           else a decimal one, if all lie on that (PositionSurvey).
/// Left out  points that "vtkGhostType" marks as duplicate or hidden, with a warning that counts
///           them, and the marks, "point_id" (a number in another store) and "elevation" where it
///           is z, without a word; arrays that hold no numbers, or more than 16 components, with a
///           warning; tuples of an array beyond the points', with a warning.
class PointSetSource final : public ColumnSource
{
public:
  /// Errors  BadArgument: an array has fewer tuples than there are points. VTK lets one be set, and
  ///         what lies behind its end is not the caller's.
  static Result<std::unique_ptr<PointSetSource>> make(
    vtkPointSet* points, const SurveyOptions& options = {});
  ~PointSetSource() override;

private:
  explicit PointSetSource(vtkPointSet* points);
  /// A warning where an array has more tuples than there are points.
  Result<void> checkTuples(vtkDataArray* array);
  Result<void> leaveOutMarked(vtkPointData* attributes);
  Result<void> addArrays(vtkPointSet& points);
  void add(vtkDataArray* array);
  glm::dvec3 position(std::uint64_t point) const override;

  vtkSmartPointer<vtkPoints> points_;
  vtkIdType count_ = 0; ///< points of the data set
  vtkSmartPointer<vtkIdList> kept_; ///< those of them that are stored; null: all
  std::vector<vtkSmartPointer<vtkDataArray>> arrays_; ///< kept alive; of contiguous tuples
};

} // namespace pointfront
