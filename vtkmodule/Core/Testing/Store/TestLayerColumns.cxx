#include "pointfront/Store/LayerColumns.h"

#include <gtest/gtest.h>

using namespace pointfront;

TEST(LayerColumns, TheUnionOfTwoIsThatOfEachLayer)
{
  LayerColumns a;
  a.layers = { { 1 }, { 2, 5 } };
  LayerColumns b(ColumnSelection{ 3 });
  b.add(a);
  EXPECT_EQ(b.of(0), (ColumnSelection{ 1, 3 }));
  EXPECT_EQ(b.of(1), (ColumnSelection{ 2, 3, 5 }));
  EXPECT_EQ(b.of(2), (ColumnSelection{ 3 }));
  EXPECT_EQ(b.any(), (ColumnSelection{ 1, 2, 3, 5 }));
  EXPECT_TRUE(LayerColumns().empty());
  EXPECT_FALSE(a.empty());
}
