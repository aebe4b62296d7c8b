#include "pointfront/Points/ColumnSource.h"

#include <gtest/gtest.h>

#include <cstring>

namespace
{
using namespace pointfront;

/// Point i lies at (i, 0, -i).
class CountedPoints final : public ColumnSource
{
public:
  explicit CountedPoints(std::uint64_t points) { description_.pointCount = points; }
  bool add(const Attribute& attribute, const void* values, std::size_t stride)
  {
    return addColumn(attribute, values, stride);
  }

private:
  glm::dvec3 position(std::uint64_t point) const override
  {
    return { double(point), 0.0, -double(point) };
  }
};

Attribute attributeOf(const char* name, ScalarType type, std::uint8_t components)
{
  Attribute attribute;
  attribute.name = name;
  attribute.type = type;
  attribute.components = components;
  return attribute;
}

TEST(ColumnSource, EveryChunkHasItsOwnPointsAndLeavesOutWhatLiesBetweenTwoValues)
{
  constexpr std::uint64_t points = 70000; // more than a chunk
  std::vector<std::uint8_t> colours;
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < points; ++i)
  {
    numbers.push_back(i);
    for (const unsigned channel : { i, i / 256, i / 65536, 77u })
    {
      colours.push_back(static_cast<std::uint8_t>(channel));
    }
  }
  CountedPoints source(points);
  ASSERT_TRUE(source.add(attributeOf("number", ScalarType::UInt32, 1), numbers.data(), 4));
  ASSERT_TRUE(source.add(attributeOf("rgb", ScalarType::UInt8, 3), colours.data(), 4));
  ASSERT_EQ(source.chunkCount(), 2u);
  std::uint32_t number = 0;
  for (std::uint64_t chunk = 0; chunk < source.chunkCount(); ++chunk)
  {
    PointBatch batch;
    ASSERT_TRUE(source.read(chunk, batch));
    ASSERT_EQ(batch.size(), source.chunkPoints(chunk));
    for (std::size_t i = 0; i < batch.size(); ++i, ++number)
    {
      std::uint32_t stored = 0;
      std::memcpy(&stored, batch.columns[0].data() + 4 * i, 4);
      ASSERT_EQ(stored, number);
      ASSERT_EQ(std::memcmp(batch.columns[1].data() + 3 * i, colours.data() + 4 * number, 3), 0);
      ASSERT_EQ(batch.positions[i], glm::dvec3(number, 0.0, -double(number)));
    }
  }
  EXPECT_EQ(number, points);
}

TEST(ColumnSource, TheSecondAttributeOfANameIsRefused)
{
  const double value = 1.0;
  CountedPoints source(1);
  EXPECT_TRUE(source.add(attributeOf("height", ScalarType::Float64, 1), &value, 8));
  EXPECT_FALSE(source.add(attributeOf("height", ScalarType::Float64, 1), &value, 8));
  EXPECT_EQ(source.description().schema.size(), 1u);
}

} // namespace
