#include "ColourChoice.h"
#include "DrawingOptions.h"

#include <gtest/gtest.h>

namespace pointfront
{

namespace
{
void addColumn(StoreDescription& store, const char* name, double low, double high)
{
  Attribute attribute;
  attribute.name = name;
  store.schema.add(attribute);
  store.ranges.push_back(ColumnRange{ { { low, high } } });
}
} // namespace

TEST(ColourChoice, DefaultIsTheFirstAttributeThatSaysSomething)
{
  StoreDescription store;
  EXPECT_EQ(defaultColourAttribute(store), "elevation");
  addColumn(store, "intensity", 3.0, 200.0);
  EXPECT_EQ(defaultColourAttribute(store), "intensity");
  addColumn(store, "classification", 2.0, 6.0);
  EXPECT_EQ(defaultColourAttribute(store), "classification");
  addColumn(store, "rgb", 0.0, 65535.0);
  EXPECT_EQ(defaultColourAttribute(store), "rgb");
}

TEST(ColourChoice, ConstantColumnsSayNothing)
{
  StoreDescription store;
  addColumn(store, "rgb", 0.0, 0.0); // a format with colour, written without any
  addColumn(store, "classification", 1.0, 1.0);
  addColumn(store, "intensity", 7.0, 7.0);
  EXPECT_EQ(defaultColourAttribute(store), "elevation");
}

TEST(ColourChoice, MissingAttributeIsAnErrorThatNamesIt)
{
  const auto choice = chooseColour("weight", {});
  ASSERT_FALSE(choice);
  EXPECT_NE(choice.error().what.find("weight"), std::string::npos);
}

TEST(ColourChoice, WhatIsMadeOfNormalsSaysHowToGetThem)
{
  for (const char* name : { "normal", "horizontality" })
  {
    const auto choice = chooseColour(name, {});
    ASSERT_FALSE(choice);
    EXPECT_NE(choice.error().what.find("--normals"), std::string::npos) << choice.error().what;
  }
  const auto local = chooseColour("local-height", {});
  ASSERT_FALSE(local);
  EXPECT_NE(local.error().what.find("--local-height"), std::string::npos);
  const auto global = chooseColour("global-height", {});
  ASSERT_TRUE(global); // every cloud has heights
  EXPECT_EQ(global->attribute, "global_height");
  EXPECT_EQ(global->range, (std::array<double, 2>{ 0.0, 1.0 }));
}

TEST(ColourTable, LightnessOfViridisRises)
{
  const ColourTable table = viridisTable();
  ASSERT_EQ(table.size(), 256u);
  const auto lightness = [&table](std::size_t i)
  { return 0.2126 * table[i][0] + 0.7152 * table[i][1] + 0.0722 * table[i][2]; };
  const std::size_t steps = 4; // single steps may be lost in the rounding to bytes
  for (std::size_t i = steps; i < table.size(); ++i)
  {
    EXPECT_GT(lightness(i), lightness(i - steps)) << i;
  }
}

TEST(ColourTable, StandardClassesAreTold)
{
  const ColourTable table = classificationTable();
  ASSERT_EQ(table.size(), 256u);
  for (std::size_t a = 0; a < 19; ++a)
  {
    for (std::size_t b = 0; b < a; ++b)
    {
      EXPECT_NE(table[a], table[b]) << a << ' ' << b;
    }
  }
}

TEST(DrawingOptions, ColoursAreBytesOrShares)
{
  using Colour = std::array<double, 3>;
  EXPECT_EQ(parseColour("255,0,51"), (Colour{ 1.0, 0.0, 0.2 }));
  EXPECT_EQ(parseColour("1,1,0.5"), (Colour{ 1.0, 1.0, 0.5 }));
  EXPECT_EQ(parseColour("0,0,0"), (Colour{ 0.0, 0.0, 0.0 }));
  EXPECT_FALSE(parseColour("256,0,0"));
  EXPECT_FALSE(parseColour("-1,0,0"));
  EXPECT_FALSE(parseColour("white"));
}

} // namespace pointfront
