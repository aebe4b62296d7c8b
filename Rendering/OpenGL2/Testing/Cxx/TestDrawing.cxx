#include "Scene.h"

#include <vtkPlane.h>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

// 10 above the plane, 30 degrees: 5.36 units on 200 pixels, 37.3 pixels a unit.
TEST(Drawing, DrawsEachPointOnce)
{
  Scene scene(planeStore("each_once", 100, 20));
  scene.draw();
  EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), 10000);
  EXPECT_TRUE(scene.mapper->GetLastComplete());
  EXPECT_FALSE(scene.mapper->NeedsRender());
}

TEST(Drawing, APlaneHasNoHoles)
{
  Scene scene(planeStore("no_holes", 201, 10)); // 2 m: a point each 0.37 pixels
  const Picture picture = scene.draw();
  const auto low = scene.project({ -0.95, -0.95, 0.0 });
  const auto high = scene.project({ 0.95, 0.95, 0.0 });
  int holes = 0;
  for (int y = static_cast<int>(low[1]); y <= static_cast<int>(high[1]); ++y)
  {
    for (int x = static_cast<int>(low[0]); x <= static_cast<int>(high[0]); ++x)
    {
      holes += picture.at(x, y)[0] == 255 ? 0 : 1;
    }
  }
  EXPECT_EQ(holes, 0);
  EXPECT_GT(high[0] - low[0], 60.0);
}

TEST(Drawing, APointIsWhereTheCameraPutsItInItsColourAndDepth)
{
  const GridPosition at{ 700, -400, 500 };
  const auto store = storeOf("one_point", 2,
    [&](std::size_t i)
    {
      Sample sample;
      sample.position = i == 0 ? at : GridPosition{ -800, 300, 0 };
      sample.rgb = { 200, static_cast<std::uint8_t>(i == 0 ? 100 : 30), 50 };
      return sample;
    });
  Scene scene(store);
  scene.actor->GetProperty()->SetPointSize(3);
  const Picture picture = scene.draw();
  const auto where = scene.project({ 0.7, -0.4, 0.5 });
  EXPECT_EQ(picture.at(static_cast<int>(where[0]), static_cast<int>(where[1])),
    (std::array<int, 3>{ 200, 100, 50 }));
  EXPECT_EQ(picture.lit(), 18); // two squares of 3 x 3
  const double depth = scene.renderer->GetZ(static_cast<int>(where[0]), static_cast<int>(where[1]));
  EXPECT_NEAR(depth, where[2], 1e-5);
}

TEST(Drawing, EqualsVtksMapperOfAllPointsInMemory)
{
  const auto store = storeOf("against_vtk", 60000,
    [random = Random(7)](std::size_t) mutable
    {
      Sample sample;
      for (int axis = 0; axis < 3; ++axis)
      {
        sample.position[axis] = std::llround(4000.0 * random.uniform() - 2000.0);
        sample.rgb[static_cast<std::size_t>(axis)] = static_cast<std::uint8_t>(random.next());
      }
      return sample;
    });
  Scene scene(store);
  for (const glm::dvec3& eye :
    { glm::dvec3(0.0, 0.0, 10.0), glm::dvec3(7.0, 3.0, 4.0), glm::dvec3(-2.0, -8.0, 1.0) })
  {
    scene.lookFrom(eye, glm::dvec3(0.0));
    scene.actor->SetMapper(scene.mapper);
    const Picture ours = scene.draw();
    EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), 60000);
    scene.actor->SetMapper(scene.inMemory());
    const Picture theirs = scene.draw();
    EXPECT_GT(theirs.lit(), 10000);
    // Points at the border of two pixels: VTK's floats round the other way for a few in thousand.
    EXPECT_LE(differing(ours, theirs, 8), 300 * 200 / 500);
  }
}

TEST(Drawing, ThePointBudgetHolds)
{
  Scene scene(planeStore("budget", 200, 10));
  scene.mapper->SetPointBudget(15000);
  scene.draw();
  EXPECT_LE(scene.mapper->GetLastPointsDrawn(), 15000);
  EXPECT_GT(scene.mapper->GetLastPointsDrawn(), 5000);
  EXPECT_TRUE(scene.mapper->GetLastComplete());
}

TEST(Drawing, TheSelectionOfDetailCanBeChangedBetweenFrames)
{
  Scene scene(planeStore("selection", 200, 10));
  EXPECT_EQ(scene.mapper->GetDetailSelection(), vtkPointFrontMapper::RENDERING_FRONT);
  scene.mapper->SetTargetError(0.05); // every point
  const Picture front = scene.draw();
  EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), 40000);
  scene.mapper->SetDetailSelectionToViewSpecific();
  scene.mapper->SetOverviewPoints(1000);
  EXPECT_EQ(differing(front, scene.draw(), 0), 0);
  EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), 40000);
  EXPECT_TRUE(scene.mapper->GetLastComplete());
  scene.mapper->SetTargetError(4.0); // 300 x 200 pixels: 3,750 points
  scene.draw();
  EXPECT_GE(scene.mapper->GetLastPointsDrawn(), 1000);
  EXPECT_LE(scene.mapper->GetLastPointsDrawn(), 8000);
  scene.mapper->SetPointBudget(2000);
  scene.draw();
  EXPECT_LE(scene.mapper->GetLastPointsDrawn(), 2000);
  EXPECT_TRUE(scene.mapper->GetLastLimitedByPoints());
  scene.mapper->SetDetailSelectionToRenderingFront();
  scene.mapper->SetPointBudget(0);
  scene.mapper->SetTargetError(0.05);
  EXPECT_EQ(differing(front, scene.draw(), 0), 0);
}

TEST(Drawing, PointSizeIsThePropertysOrTheMappers)
{
  Scene scene(planeStore("sizes", 2, 1000));
  scene.actor->GetProperty()->SetPointSize(4);
  EXPECT_EQ(scene.draw().lit(), 4 * 16);
  scene.mapper->SetPointSize(7);
  EXPECT_EQ(scene.draw().lit(), 4 * 49);
}

TEST(Drawing, AClippingPlaneCutsAtItsCoordinate)
{
  Scene scene(planeStore("clipped", 101, 20));
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0.305, 0.0, 0.0); // between two columns of points
  plane->SetNormal(-1.0, 0.0, 0.0);
  scene.mapper->AddClippingPlane(plane);
  const Picture picture = scene.draw();
  const auto kept = scene.project({ 0.3, 0.0, 0.0 });
  const auto gone = scene.project({ 0.32, 0.0, 0.0 });
  int right = 0;
  for (int y = 0; y < picture.height; ++y)
  {
    for (int x = static_cast<int>(kept[0]) + 1; x < picture.width; ++x)
    {
      right += picture.at(x, y)[0] > 0 ? 1 : 0;
    }
  }
  EXPECT_EQ(right, 0) << "gone would be at " << gone[0];
  EXPECT_GT(picture.at(static_cast<int>(kept[0]), static_cast<int>(kept[1]))[0], 0);
  scene.mapper->RemoveAllClippingPlanes();
  EXPECT_GT(scene.draw().lit(), picture.lit() * 5 / 4);
}

TEST(Drawing, TheActorsTransformMovesThePoints)
{
  Scene scene(planeStore("moved", 3, 500));
  scene.actor->SetPosition(0.25, 0.5, 1.0);
  scene.actor->RotateZ(90.0);
  scene.actor->SetScale(1.5, 0.5, 1.0);
  scene.actor->GetProperty()->SetPointSize(3);
  const Picture ours = scene.draw();
  scene.actor->SetMapper(scene.inMemory());
  EXPECT_EQ(differing(ours, scene.draw()), 0);
  EXPECT_EQ(ours.lit(), 81);
}

TEST(Drawing, AParallelViewEqualsVtks)
{
  Scene scene(planeStore("parallel", 150, 13));
  scene.renderer->GetActiveCamera()->ParallelProjectionOn();
  scene.renderer->GetActiveCamera()->SetParallelScale(0.731);
  const Picture ours = scene.draw();
  scene.actor->SetMapper(scene.inMemory());
  const Picture theirs = scene.draw();
  EXPECT_GT(ours.lit(), 8000);
  EXPECT_LE(differing(ours, theirs), 300);
}

} // namespace
