// Which nodes a batch that is seen in a lens only has to draw.

#include "pointfront/Plan/LensCulling.h"

#include <gtest/gtest.h>

#include <memory>

using namespace pointfront;

/// A node's own points may begin far inside of the box of its row. What counts is that box, not one
/// of its size that begins where they do.
TEST(LensCulling, ANodeReachesAsFarAsTheBoxOfItsRow)
{
  FramePlan plan;
  plan.camera =
    FrameCamera::perspective({ 0, 0, 1000 }, { 0, 0, 0 }, { 0, 1, 0 }, 0.9, 1.0, 1e5, 1000, 1000);
  Node row;
  row.halfSize = glm::vec3(50.0f);
  auto columns = std::make_shared<NodeColumns>();
  columns->describe(row);
  columns->origin = plan.grid.toGrid({ 49.0, -50.0, -50.0 });
  PlanItem item;
  item.node = columns;
  ResolvedStyle style;
  style.size.mode = SplatSize::Mode::World;
  style.size.value = 1.0;
  const auto reaches = [&](float x)
  {
    FrameLens lens;
    lens.centrePx = { x, 500.0f }; // about a pixel a unit, the node's centre at 500
    lens.halfSizePx = { 10.0f, 10.0f };
    return mayReach(plan, item, style, lens);
  };
  EXPECT_TRUE(reaches(500.0f));
  EXPECT_TRUE(reaches(550.0f));
  EXPECT_FALSE(reaches(666.0f));
  EXPECT_FALSE(reaches(340.0f));
}
