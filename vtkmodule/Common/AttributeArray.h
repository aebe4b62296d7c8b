#ifndef AttributeArray_h
#define AttributeArray_h

#include "pointfrontCommonModule.h" // for the export macro

#include "pointfront/Points/AttributeSchema.h"
#include "pointfront/Store/StoredCloud.h"

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

#include <cstddef>
#include <vector>

class vtkPolyData;

namespace pointfront
{

/// One attribute of stored points on its way into a VTK array.
/// Values   an attribute with a scale or an offset becomes double with both applied; every other
///          keeps its type. "rgb" becomes UInt8 x 3 and is a colour: 16-bit colour is reduced to 8
///          bits, because VTK takes only bytes as colours without a lookup table. Unless colours
///          are asked for as they are stored: then "rgb" is an attribute like another.
/// Threads  one.
class POINTFRONTCOMMON_EXPORT AttributeArray
{
public:
  /// For so many points. `range` is the attribute's over the whole store: it tells 8-bit colours in
  /// 16-bit fields from wide ones.
  AttributeArray(const Attribute& attribute, const ColumnRange& range, std::size_t points,
    bool coloursAsStored = false);

  /// For so many points from now on; values that are there stay.
  void resize(std::size_t points);
  void squeeze() { array_->Squeeze(); }
  /// Packed values of `count` points as the store has them, to be the array's from `first` on,
  /// after those before. A 16-bit colour above 255 makes all of them wide, whatever the range says:
  /// that of a COPC file is of some points.
  void fill(const std::byte* values, std::size_t first, std::size_t count);
  /// Among the point data; a colour as the active scalars.
  void addTo(vtkPolyData* output) const;

private:
  Attribute attribute_;
  bool scaled_;
  bool colour_;
  bool wide_ = false; ///< 16-bit colour uses more than its low byte
  vtkSmartPointer<vtkDataArray> array_;
};

/// Gives it so many tuples; what is there stays. Squeeze() takes away what it has room for besides.
POINTFRONTCOMMON_EXPORT void resizeArray(vtkDataArray* array, std::size_t tuples);
/// One vertex cell a point, so that filters that select cells can select points.
POINTFRONTCOMMON_EXPORT void addVertexCells(vtkPolyData* output);

} // namespace pointfront

#endif
