#pragma once

#include "vtkSmartPointer.h"

#include <array>
#include <vector>

class vtkDataArray;

namespace pointfront
{

/// An array with the values of `array`, whose range is told and not computed: lowest and highest
/// value of each component, widened where the array has more. A component whose lowest is above its
/// highest keeps the range of its values, and so does the length of a vector. The copy shares the
/// array's memory; arrays made of it (NewInstance) are plain ones. `array` itself if its type is no
/// common one, or if there are not as many ranges as components.
vtkSmartPointer<vtkDataArray> withStoredRanges(
  vtkDataArray* array, const std::vector<std::array<double, 2>>& ranges);

} // namespace pointfront
