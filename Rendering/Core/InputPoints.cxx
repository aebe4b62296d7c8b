#include "InputPoints.h"

#include "vtkPointFrontStore.h"

#include <vtkAlgorithm.h>
#include <vtkAlgorithmOutput.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{

/// The data that a pipeline begins with, along first connections; null where it has none.
vtkPolyData* beginningOf(vtkAlgorithm* consumer)
{
  vtkPolyData* first = nullptr;
  while (consumer && consumer->GetNumberOfInputPorts() > 0 &&
    consumer->GetNumberOfInputConnections(0) > 0)
  {
    vtkAlgorithmOutput* const from = consumer->GetInputConnection(0, 0);
    consumer = from->GetProducer();
    first = consumer ? vtkPolyData::SafeDownCast(consumer->GetOutputDataObject(from->GetIndex()))
                     : nullptr;
  }
  return first;
}

/// Filters that leave points alone share them with their input.
bool isReplaced(vtkPolyData& input, vtkPolyData* first)
{
  const bool ofStore =
    first && vtkPointFrontStore::GetStoreName(first) == vtkPointFrontStore::GetStoreName(&input);
  return ofStore && first->GetNumberOfPoints() > 0 && first->GetPoints() != input.GetPoints();
}

/// Far outside of the store's box; a file may give its box a little too small.
bool isElsewhere(vtkPolyData& input, vtkPointFrontStore& store)
{
  double box[6];
  store.GetBounds(box);
  const double longest = std::max({ box[1] - box[0], box[3] - box[2], box[5] - box[4] });
  double seen[6];
  input.GetBounds(seen);
  bool outside = false;
  for (int axis = 0; axis < 3 && input.GetNumberOfPoints() > 0; ++axis)
  {
    const double low = box[2 * axis];
    const double high = box[2 * axis + 1];
    const double slack = 0.1 * longest + 1e-6 * std::max(std::abs(low), std::abs(high));
    outside = outside || seen[2 * axis] < low - slack || seen[2 * axis + 1] > high + slack;
  }
  return outside;
}

} // namespace

bool hasOtherPoints(vtkPolyDataMapper& mapper, vtkPointFrontStore& store)
{
  vtkPolyData* const input =
    mapper.GetNumberOfInputConnections(0) > 0 ? mapper.GetInput() : nullptr;
  return input && (isReplaced(*input, beginningOf(&mapper)) || isElsewhere(*input, store));
}

} // namespace pointfront
