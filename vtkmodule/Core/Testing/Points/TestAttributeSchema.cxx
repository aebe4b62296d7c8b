#include "pointfront/Points/AttributeSchema.h"

#include <gtest/gtest.h>

namespace pointfront
{

TEST(AttributeSchema, NamesAreUniqueAndFoundExactFirst)
{
  AttributeSchema schema;
  EXPECT_TRUE(schema.add({ "RGB", ScalarType::UInt8, 3 }));
  EXPECT_TRUE(schema.add({ "rgb", ScalarType::UInt16, 3 }));
  EXPECT_FALSE(schema.add({ "rgb", ScalarType::UInt8, 3 }));
  EXPECT_EQ(schema.size(), 2u);
  EXPECT_EQ(schema.find("rgb"), 1u);
  EXPECT_EQ(schema.find("Rgb"), 0u); // no exact match: the first that differs in case only
  EXPECT_FALSE(schema.find("rg"));
  EXPECT_EQ(schema.pointBytes(), 3u + 6u);
}

TEST(ScalarType, NumbersAndNamesGoBothWays)
{
  for (std::uint8_t number = 1; number <= 10; ++number)
  {
    const auto type = scalarTypeOf(number);
    ASSERT_TRUE(type);
    EXPECT_EQ(scalarTypeOf(nameOf(*type)), type);
    EXPECT_GE(sizeOf(*type), 1u);
  }
  EXPECT_FALSE(scalarTypeOf(std::uint8_t(0)));
  EXPECT_FALSE(scalarTypeOf(std::uint8_t(11)));
  EXPECT_EQ(sizeOf(ScalarType::Float64), 8u);
}

} // namespace pointfront
