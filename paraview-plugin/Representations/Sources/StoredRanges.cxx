#include "StoredRanges.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkLongArray.h"
#include "vtkLongLongArray.h"
#include "vtkObjectFactory.h"
#include "vtkShortArray.h"
#include "vtkSignedCharArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedIntArray.h"
#include "vtkUnsignedLongArray.h"
#include "vtkUnsignedLongLongArray.h"
#include "vtkUnsignedShortArray.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace pointfront
{
namespace
{

using Ranges = std::vector<std::array<double, 2>>;

/// An array of VTK's whose components have the ranges that it was told. VTK keeps ranges in several
/// places, with the array and with the data it belongs to; these four are where all of them ask.
template <class Array>
class RangedArray : public Array
{
public:
  static RangedArray* New() { VTK_STANDARD_NEW_BODY(RangedArray); }

  /// `finite`: without infinite values, as ParaView's colour maps want them.
  void tell(Ranges ranges, Ranges finite)
  {
    ranges_ = std::move(ranges);
    finite_ = std::move(finite);
  }

protected:
  bool ComputeScalarRange(double* ranges) override { return give(ranges_, ranges); }
  bool ComputeScalarRange(double* ranges, const unsigned char*, unsigned char) override
  {
    return give(ranges_, ranges);
  }
  bool ComputeFiniteScalarRange(double* ranges) override { return give(finite_, ranges); }
  bool ComputeFiniteScalarRange(double* ranges, const unsigned char*, unsigned char) override
  {
    return give(finite_, ranges);
  }

private:
  static bool give(const Ranges& told, double* ranges)
  {
    for (const std::array<double, 2>& range : told)
    {
      ranges = std::copy(range.begin(), range.end(), ranges);
    }
    return true;
  }

  Ranges ranges_;
  Ranges finite_;
};

/// The told ranges, each as wide as to hold what the array has.
Ranges widened(vtkDataArray* array, const Ranges& told)
{
  Ranges ranges;
  for (std::size_t c = 0; c < told.size(); ++c)
  {
    std::array<double, 2> own{ { 1.0, 0.0 } };
    array->GetFiniteRange(own.data(), static_cast<int>(c));
    const bool filled = array->GetNumberOfTuples() > 0 && own[0] <= own[1];
    if (!(told[c][0] <= told[c][1]))
    {
      ranges.push_back(own);
    }
    else
    {
      ranges.push_back(filled
          ? std::array<double, 2>{ std::min(told[c][0], own[0]), std::max(told[c][1], own[1]) }
          : told[c]);
    }
  }
  return ranges;
}

/// Ends that are not finite are those of the finite values of the array, which may be some of the
/// store's.
Ranges finiteOnes(vtkDataArray* array, Ranges ranges)
{
  for (std::size_t c = 0; c < ranges.size(); ++c)
  {
    std::array<double, 2> own{ { 1.0, 0.0 } };
    array->GetFiniteRange(own.data(), static_cast<int>(c));
    for (std::size_t end = 0; end < 2; ++end)
    {
      ranges[c][end] = std::isfinite(ranges[c][end]) ? ranges[c][end] : own[end];
    }
  }
  return ranges;
}

/// Whether `array` is an Array; `ranged` is one with its values then.
template <class Array>
bool madeOf(vtkDataArray* array, const Ranges& ranges, vtkSmartPointer<vtkDataArray>& ranged)
{
  Array* const typed = Array::SafeDownCast(array);
  if (!typed)
  {
    return false;
  }
  const auto made = vtkSmartPointer<RangedArray<Array>>::New();
  made->ShallowCopy(typed);
  const Ranges told = widened(array, ranges);
  made->tell(told, finiteOnes(array, told));
  ranged = made;
  return true;
}

template <class... Arrays>
vtkSmartPointer<vtkDataArray> madeOfFirst(vtkDataArray* array, const Ranges& ranges)
{
  vtkSmartPointer<vtkDataArray> ranged = array;
  (madeOf<Arrays>(array, ranges, ranged) || ...);
  return ranged;
}

} // namespace

vtkSmartPointer<vtkDataArray> withStoredRanges(vtkDataArray* array, const Ranges& ranges)
{
  if (ranges.size() != static_cast<std::size_t>(array->GetNumberOfComponents()))
  {
    return array;
  }
  return madeOfFirst<vtkDoubleArray, vtkFloatArray, vtkIdTypeArray, vtkIntArray, vtkLongArray,
    vtkLongLongArray, vtkShortArray, vtkSignedCharArray, vtkUnsignedCharArray, vtkUnsignedIntArray,
    vtkUnsignedLongArray, vtkUnsignedLongLongArray, vtkUnsignedShortArray>(array, ranges);
}

} // namespace pointfront
