// Walls in one plane, as points above each other have: a scanner sees a facade so. Which wall is
// seen must not hang on how a machine rounds their depths.

#include "PlanOfPoints.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace pointfront;
using namespace pointfront::test;

TEST(WallTies, ShowTheWallWhoseTopIsNearest)
{
  constexpr int edge = 100; // pixels, and a unit at the walls
  constexpr std::size_t storeys = 9;
  PlanOfPoints scene;
  scene.style->technique = Technique::Solid;
  scene.style->accuracy = SplatAccuracy::Exact;
  scene.style->size = { SplatSize::Mode::World, 0.1, 0 };
  scene.style->normalColumn = 1;
  scene.style->heightColumn = 4;
  std::vector<TestPoint> column(storeys);
  for (std::size_t i = 0; i < storeys; ++i)
  {
    const auto storey = static_cast<std::uint8_t>(i * 5 % storeys); // in no order
    column[i].position = { 0.0, 0.0, 0.1 * storey - 0.4 };
    column[i].normal = { 0.0f, 0.0f, 1.0f };
    column[i].height = 0.1f * static_cast<float>(storey);
    column[i].rgb = { storey, 0, 0 };
  }
  scene.add(column);
  const glm::dvec3 eye(0.0, -3.0, 0.0), up(0.0, 0.0, 1.0);
  for (const bool parallel : { false, true })
  {
    scene.plan.camera = parallel
      ? FrameCamera::parallelView(eye, { 0, 0, 0 }, up, 0.5, 0.1, 30.0, edge, edge)
      : FrameCamera::perspective(
          eye, { 0, 0, 0 }, up, 2.0 * std::atan(0.5 / 3.0), 0.1, 30.0, edge, edge);
    const SoftwareTarget target = scene.draw();
    for (int y = 12; y < 88; ++y)
    {
      const double storey = (y + 0.5 - 10.0) / 10.0;
      const double part = storey - std::floor(storey);
      if (part > 0.2 && part < 0.8) // no disc, seen edge-on
      {
        const std::uint32_t seen = target.rgba[static_cast<std::size_t>(y * edge + edge / 2)];
        EXPECT_EQ(seen & 255u, 1u + static_cast<unsigned>(storey)) << parallel << ", row " << y;
      }
    }
  }
}
