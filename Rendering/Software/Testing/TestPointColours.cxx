// Colours of points, against a reference.

#include "PlanOfPoints.h"
#include "PointColours.h"
#include "ReferenceColours.h"

#include <gtest/gtest.h>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

/// All ways of this node's values to colours, by name.
std::vector<std::pair<const char*, ResolvedStyle>> colourings()
{
  auto map = std::make_shared<ColourMap>();
  map->entries = { { 10, 20, 30, 255 }, { 200, 0, 50, 255 }, { 0, 255, 1, 255 } };
  map->range = { 1.0, 7.0 };
  std::vector<std::pair<const char*, ResolvedStyle>> all;
  ResolvedStyle style;
  style.flat = { 1, 2, 3, 255 };
  all.emplace_back("flat", style);
  style.colouring.kind = PointColouring::Kind::Direct;
  all.emplace_back("rgb", style);
  ResolvedStyle normals = style;
  normals.colouring.column = 1;
  normals.colouring.colourRange = { -1.0, 1.0 };
  all.emplace_back("normal as colour", normals);
  ResolvedStyle byClass = style;
  byClass.colouring.kind = PointColouring::Kind::Table;
  byClass.colouring.column = 3;
  byClass.map = map;
  all.emplace_back("classification", byClass);
  ResolvedStyle upright = byClass;
  upright.colouring.column = 1;
  upright.colouring.component = 2;
  upright.colouring.absolute = true;
  all.emplace_back("horizontality", upright);
  ResolvedStyle height = byClass;
  height.colouring.kind = PointColouring::Kind::Elevation;
  auto heights = std::make_shared<ColourMap>(*map);
  heights->range = { -0.2, 0.2 };
  height.map = heights;
  all.emplace_back("elevation", height);
  for (const ColourCombination combination :
    { ColourCombination::Multiply, ColourCombination::Mix, ColourCombination::HueValue })
  {
    ResolvedStyle both = style;
    both.second = { combination, 77, height.colouring, height.map, {} };
    all.emplace_back("combined", both);
  }
  return all;
}

} // namespace

TEST(SoftwareColours, AreThoseOfTheReference)
{
  PlanOfPoints scene;
  const std::vector<TestPoint> points = wavySurface(200, 8);
  scene.add(points, 0.0, 5);
  const NodeColumns& node = *scene.plan.batches[0].items[0].node;
  for (const auto& [name, style] : colourings())
  {
    SCOPED_TRACE(name);
    const std::vector<std::uint32_t> expected =
      referenceColours(style, node, *scene.plan.schema, scene.plan.grid);
    const StyleColours tables(style, *scene.plan.schema);
    const PointColours colours(scene.plan, style, tables, node);
    std::vector<std::uint32_t> filled(200);
    colours.fill(0, 200, filled.data());
    for (std::uint32_t i = 0; i < 200; ++i)
    {
      ASSERT_EQ(filled[i], expected[i]) << i;
      ASSERT_EQ(colours.at(i), expected[i]) << i;
    }
  }
}

TEST(SoftwareColours, ANodeWithoutTheColumnIsFlat)
{
  PlanOfPoints scene;
  scene.add(wavySurface(10, 8));
  NodeColumns node = *scene.plan.batches[0].items[0].node;
  node.selection.clear();
  node.columns.clear();
  ResolvedStyle style;
  style.colouring.kind = PointColouring::Kind::Direct;
  style.flat = { 9, 8, 7, 255 };
  const StyleColours tables(style, *scene.plan.schema);
  EXPECT_EQ(PointColours(scene.plan, style, tables, node).at(3), 0xff070809u);
}
