// Budgets that the clouds of a window, the stores of a process and the classes of a store share.

#include "Clouds.h"

#include "pointfront/Residency/LoadScheduler.h"

#include <array>
#include <memory>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

/// The process's budget for the length of a test.
class ProcessBudget
{
public:
  explicit ProcessBudget(vtkTypeInt64 bytes)
    : before_(vtkPointFrontStore::GetProcessMemoryBudget())
  {
    vtkPointFrontStore::SetProcessMemoryBudget(bytes);
  }
  ~ProcessBudget() { vtkPointFrontStore::SetProcessMemoryBudget(before_); }

private:
  vtkTypeInt64 before_;
};

TEST(Budgets, TheCloudsOfAWindowShareItsPoints)
{
  Clouds scene(6);
  scene.settle();
  EXPECT_EQ(scene.drawn(), 240000);
  constexpr vtkIdType budget = 60000;
  scene.setPointBudget(budget);
  scene.settle();
  EXPECT_LE(scene.drawn(), budget);
  EXPECT_GT(scene.drawn(), budget * 3 / 4);
  EXPECT_LT(scene.spread(), 1.5);
  for (vtkPointFrontMapper* mapper : scene.all())
  {
    EXPECT_TRUE(mapper->GetLastLimitedByPoints());
    EXPECT_TRUE(mapper->GetLastComplete());
  }
  // One more takes its part of the same budget, one that goes leaves it.
  scene.add(6);
  scene.setPointBudget(budget);
  scene.settle();
  EXPECT_LE(scene.drawn(), budget);
  EXPECT_GT(scene.mappers.back()->GetLastPointsDrawn(), budget / 14);
  scene.first.renderer->RemoveActor(scene.actors.back());
  scene.actors.pop_back();
  scene.mappers.pop_back();
  scene.settle();
  EXPECT_LE(scene.drawn(), budget);
  EXPECT_GT(scene.drawn(), budget * 3 / 4);
}

TEST(Budgets, ALoweredBudgetOfPointsHoldsInTheFirstFrame)
{
  Clouds scene(6);
  scene.settle();
  ASSERT_EQ(scene.drawn(), 240000);
  for (const vtkIdType budget : { 150000, 60000, 20000 })
  {
    scene.setPointBudget(budget);
    scene.first.window->Render();
    const vtkIdType drawn = scene.drawn();
    EXPECT_LE(drawn, budget);
    scene.settle();
    EXPECT_GT(drawn, scene.drawn() * 3 / 4) << "no cloud is away for a frame";
  }
}

TEST(Budgets, WhatIsNotSeenLeavesItsPartToTheOthers)
{
  constexpr vtkIdType budget = 30000;
  Clouds scene(2);
  scene.setPointBudget(budget);
  scene.setGpuBudget(3 << 20);
  scene.settle();
  vtkPointFrontMapper* hidden = scene.mappers[0];
  const vtkIdType shared = scene.first.mapper->GetLastPointsDrawn();
  EXPECT_LT(shared, budget * 2 / 3);
  const vtkIdType before = hidden->GetLastPointsDrawn();
  scene.actors[0]->VisibilityOff();
  scene.settle();
  EXPECT_GT(scene.first.mapper->GetLastPointsDrawn(), shared * 3 / 2);
  EXPECT_FALSE(hidden->NeedsRender()) << "a render would not change it";
  scene.actors[0]->VisibilityOn();
  scene.settle();
  EXPECT_EQ(scene.first.mapper->GetLastPointsDrawn(), shared);
  EXPECT_EQ(hidden->GetLastPointsDrawn(), before);
  // Out of sight VTK does not draw it either.
  scene.first.lookFrom({ -6.0, -3.0, 4.0 }, { -6.0, -3.0, 0.0 });
  scene.settle();
  EXPECT_EQ(hidden->GetLastPointsDrawn(), 0);
  EXPECT_FALSE(hidden->NeedsRender());
  EXPECT_FALSE(scene.first.mapper->GetLastLimitedByPoints()) << "all of them are its own";
}

TEST(Budgets, TheStoresOfAProcessShareItsMemory)
{
  constexpr vtkTypeInt64 budget = 2000000;
  const ProcessBudget memory(budget);
  Clouds scene(6); // 240,000 points of 12 bytes and more
  scene.settle();
  const auto statistics = scene.first.mapper->GetStore()->GetResidency().scheduler().statistics();
  EXPECT_EQ(statistics.stores, 6u);
  EXPECT_LE(statistics.residentBytes, static_cast<std::size_t>(budget));
  EXPECT_LE(statistics.threads, 16u);
  EXPECT_LT(scene.spread(), 1.5);
  for (vtkPointFrontMapper* mapper : scene.all())
  {
    EXPECT_TRUE(mapper->GetLastLimitedByMemory());
    EXPECT_GT(mapper->GetLastPointsDrawn(), 6000);
  }
  // At rest nothing is read.
  const auto read = [&]
  {
    std::uint64_t bytes = 0;
    for (vtkPointFrontMapper* mapper : scene.all())
    {
      bytes += mapper->GetStore()->GetResidency().statistics().bytesRead;
    }
    return bytes;
  };
  const std::uint64_t before = read();
  for (int frame = 0; frame < 10; ++frame)
  {
    scene.first.window->Render();
  }
  EXPECT_EQ(read(), before);
}

/// One that is four times as large as the other.
TEST(Budgets, TheStoresOfAProcessShareTheOverviewByTheirSizes)
{
  Scene large(Clouds::store(0)); // 40,000 points
  Scene small(
    builtStore("quarter", hills(10000, 3000.0, millimetres({ -6.0, -3.0, 0.0 })), nodesOf(500)));
  for (Scene* scene : { &large, &small })
  {
    scene->mapper->SetDetailSelectionToViewSpecific();
    scene->mapper->SetTargetError(1.0);
    scene->window->SetSize(30, 20); // fewer pixels than the overview has points
    scene->lookFrom({ -6.0, -3.0, 30.0 }, { -6.0, -3.0, 0.0 });
  }
  vtkIdType before = 0;
  for (const vtkIdType overview : { 5000, 10000 })
  {
    large.mapper->SetOverviewPoints(overview);
    small.mapper->SetOverviewPoints(overview);
    for (Scene* scene : { &large, &small, &large, &small }) // from the second on both are open
    {
      scene->draw();
    }
    const double ratio =
      double(large.mapper->GetLastPointsDrawn()) / double(small.mapper->GetLastPointsDrawn());
    EXPECT_NEAR(ratio, 4.0, 0.4);
    const vtkIdType both = large.mapper->GetLastPointsDrawn() + small.mapper->GetLastPointsDrawn();
    EXPECT_LE(both, overview * 11 / 10);
    EXPECT_GT(both, before * 3 / 2);
    before = both;
  }
}

/// Two classes in one place: left of each pair red (class 2), right blue (class 6).
std::string layeredStore()
{
  AttributeSchema schema;
  schema.add({ "rgb", ScalarType::UInt8, 3 });
  schema.add({ "classification", ScalarType::UInt8, 1 });
  const QuantisationGrid grid = millimetres();
  auto cloud = std::make_unique<CloudSource>("layered", schema, grid);
  for (int row = 0; row < 200; ++row)
  {
    for (int column = 0; column < 200; ++column)
    {
      const bool red = column % 2 == 0;
      cloud->addPosition(grid.toWorld(GridPosition(column * 20 - 2000, row * 20 - 2000, 0)));
      cloud->addValue(0,
        red ? std::array<std::uint8_t, 3>{ 255, 0, 0 } : std::array<std::uint8_t, 3>{ 0, 0, 255 });
      cloud->addValue(1, static_cast<std::uint8_t>(red ? 2 : 6));
    }
  }
  BuildOptions options = nodesOf(1000);
  options.layering = Layering::ObjectClass;
  return builtStore("layered", std::move(cloud), options);
}

/// Pixels of a colour: channel 0 red, 2 blue.
int lit(const Picture& picture, std::size_t channel)
{
  int count = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
  {
    count += picture.rgb[i + channel] > 0 ? 1 : 0;
  }
  return count;
}

TEST(Budgets, AClassHasASwitchAThresholdAndAShare)
{
  Scene scene(layeredStore());
  scene.actor->GetProperty()->LightingOff();
  scene.draw();
  EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), 40000);
  scene.mapper->SetClassVisibility(6, false);
  EXPECT_FALSE(scene.mapper->GetClassVisibility(6));
  Picture picture = scene.draw();
  EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), 20000);
  EXPECT_GT(lit(picture, 0), 1000);
  EXPECT_EQ(lit(picture, 2), 0);

  scene.mapper->SetClassVisibility(6, true);
  scene.mapper->SetClassTargetErrorFactor(6, 100.0);
  picture = scene.draw();
  EXPECT_LT(scene.mapper->GetLastPointsDrawn(), 30000);
  EXPECT_GT(scene.mapper->GetLastPointsDrawn(), 20000);
  EXPECT_GT(lit(picture, 0), 2 * lit(picture, 2));

  // Its errors weigh little beside the other's; its share is kept for it nevertheless.
  scene.mapper->SetClassTargetErrorFactor(6, 8.0);
  scene.mapper->SetPointBudget(8000);
  const int few = lit(scene.draw(), 2);
  scene.mapper->SetClassBudgetShare(6, 0.5);
  EXPECT_GT(lit(scene.draw(), 2), 2 * few);
  EXPECT_LE(scene.mapper->GetLastPointsDrawn(), 8000);

  scene.mapper->ClearClassLimits();
  EXPECT_EQ(scene.mapper->GetClassBudgetShare(6), 0.0);
  EXPECT_EQ(scene.mapper->GetClassTargetErrorFactor(6), 1.0);
  EXPECT_TRUE(scene.mapper->GetClassVisibility(6));
  scene.mapper->SetPointBudget(0);
  scene.draw();
  EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), 40000);
}

} // namespace
