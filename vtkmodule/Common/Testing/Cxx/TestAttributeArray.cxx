#include "AttributeArray.h"

#include <gtest/gtest.h>

#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <vector>

namespace pointfront
{
namespace
{

const Attribute colourAttribute{ "rgb", ScalarType::UInt16, 3 };

/// The bytes that VTK gets of 16-bit colours, filled point by point.
std::vector<int> colourBytes(const std::vector<std::uint16_t>& colours, double largest)
{
  ColumnRange range;
  range.components.assign(3, { 0.0, largest });
  const std::size_t points = colours.size() / 3;
  AttributeArray array(colourAttribute, range, points);
  for (std::size_t i = 0; i < points; ++i)
  {
    array.fill(reinterpret_cast<const std::byte*>(colours.data() + 3 * i), i, 1);
  }
  vtkNew<vtkPolyData> data;
  array.addTo(data);
  vtkDataArray* const got = data->GetPointData()->GetArray("rgb");
  std::vector<int> bytes;
  for (vtkIdType i = 0; i < got->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      bytes.push_back(static_cast<int>(got->GetComponent(i, c)));
    }
  }
  return bytes;
}

} // namespace

TEST(AttributeArray, ColoursAreBytesOfTheirDepth)
{
  EXPECT_EQ(colourBytes({ 1, 2, 255 }, 255.0), (std::vector<int>{ 1, 2, 255 }));
  EXPECT_EQ(colourBytes({ 1, 2, 0x8034 }, 65535.0), (std::vector<int>{ 0, 0, 0x80 }));
}

/// The range is that of the first points of a COPC file, which are dark.
TEST(AttributeArray, AWideColourIsSeenThoughTheRangeIsOfOthers)
{
  EXPECT_EQ(colourBytes({ 0, 0, 7, 0x8034, 0x4056, 0xf078, 0, 0, 9 }, 7.0),
    (std::vector<int>{ 0, 0, 0, 0x80, 0x40, 0xf0, 0, 0, 0 }));
}

} // namespace pointfront
