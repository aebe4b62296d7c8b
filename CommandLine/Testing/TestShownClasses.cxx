#include "ShownClasses.h"

#include "pointfront/Store/StoredCloud.h"

#include <gtest/gtest.h>

namespace pointfront
{

namespace
{
StoreDescription layered()
{
  StoreDescription store;
  store.path = "town.pfront";
  store.pointCount = 60;
  store.layers = { { 2, "ground", 30, 3 }, { 5, "high vegetation", 20, 2 },
    { 6, "building", 10, 1 } };
  return store;
}
} // namespace

TEST(ShownClasses, AllWithoutAChoice)
{
  const auto shown = ShownClasses::choose({}, layered());
  ASSERT_TRUE(shown);
  EXPECT_EQ(shown->points, 60u);
  EXPECT_EQ(shown->layers, std::vector<LayerLimits>(3));
}

TEST(ShownClasses, HidesTheOthers)
{
  const auto shown = ShownClasses::choose({ 2, 6, 9 }, layered());
  ASSERT_TRUE(shown);
  EXPECT_EQ(shown->points, 40u);
  EXPECT_TRUE(shown->layers[0].visible);
  EXPECT_FALSE(shown->layers[1].visible);
  EXPECT_TRUE(shown->layers[2].visible);
}

TEST(ShownClasses, NeedsATreeForEachClass)
{
  StoreDescription plain = layered();
  plain.layers = { { 0, "all", 60, 6 } };
  const auto shown = ShownClasses::choose({ 2 }, plain);
  ASSERT_FALSE(shown);
  EXPECT_NE(shown.error().what.find("--layers class"), std::string::npos);
}

} // namespace pointfront
