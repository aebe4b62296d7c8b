#include "pointfront/Store/HeldColours.h"

#include "pointfront/Points/WidenedColour.h"

#include <algorithm>

namespace pointfront
{

HeldColours heldColours(const StoreDescription& cloud)
{
  const auto column = cloud.schema.find("rgb");
  if (!column || *column >= cloud.ranges.size())
  {
    return HeldColours::None;
  }
  double largest = 0.0;
  for (const std::array<double, 2>& ends : cloud.ranges[*column].components)
  {
    largest = std::max(largest, ends[1]);
  }
  const ScalarType type = cloud.schema[*column].type;
  if (type != ScalarType::UInt16 || largest <= 0.0)
  {
    return type == ScalarType::UInt8 ? HeldColours::Eight : HeldColours::None;
  }
  const bool store = cloud.structure == "octree" || cloud.structure == "kdtree";
  return largest > largestOf8Bits || (store && !cloud.rangesAreSampled) ? HeldColours::Sixteen
                                                                        : HeldColours::Eight;
}

} // namespace pointfront
