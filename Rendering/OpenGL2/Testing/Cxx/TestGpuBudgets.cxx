// Budgets of GPU memory: what pools take, share and give back.

#include "Clouds.h"

#include "PerWindow.h"

#include <vtkActorCollection.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>

#include <algorithm>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

TEST(GpuBudgets, TheCloudsOfAWindowShareItsGpuMemory)
{
  constexpr vtkTypeInt64 budget = 5 << 20; // 79 slots; the scene takes some 140
  Clouds scene(6);
  scene.setGpuBudget(budget);
  scene.settle();
  EXPECT_GT(scene.gpuBytes(), budget / 2);
  EXPECT_LT(scene.spread(), 1.5);
  for (vtkPointFrontMapper* mapper : scene.all())
  {
    EXPECT_TRUE(mapper->GetLastLimitedByGPUMemory());
    EXPECT_FALSE(mapper->GetLastLimitedByPoints());
    EXPECT_TRUE(mapper->GetLastComplete());
    EXPECT_GT(mapper->GetLastPointsDrawn(), 2000);
  }
  // One cloud takes the memory that another leaves idle.
  scene.first.lookFrom({ -6.0, -3.0, 5.0 }, { -6.0, -3.0, 0.0 });
  scene.settle();
  const vtkIdType near = scene.first.mapper->GetLastPointsDrawn();
  scene.first.lookFrom({ 3.0, -3.0, 5.0 }, { 3.0, -3.0, 0.0 });
  scene.settle();
  EXPECT_GT(scene.mappers[2]->GetLastPointsDrawn(), near * 3 / 4);
  // A path, frame by frame, some of them in motion.
  scene.first.mapper->CompleteOff();
  for (int step = 0; step < 60; ++step)
  {
    scene.first.window->SetDesiredUpdateRate(step % 20 < 12 ? 15.0 : 0.0001);
    const double x = -6.0 + 0.15 * step;
    scene.first.lookFrom({ x, -3.0, 3.0 + 0.6 * (step % 30) }, { x, -3.0, 0.0 });
    scene.first.window->Render();
    EXPECT_LE(scene.gpuBytes(), budget) << "step " << step;
  }
}

TEST(GpuBudgets, ABudgetOfGpuMemoryMayChange)
{
  Scene scene(planeStore("gpu", 500, 5));
  const Picture everything = scene.draw();
  EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), 250000);
  EXPECT_FALSE(scene.mapper->GetLastLimitedByGPUMemory());
  constexpr vtkTypeInt64 budget = 4 << 20;
  EXPECT_GT(scene.mapper->GetLastGPUBytes(), budget);
  scene.mapper->SetGPUMemoryBudget(budget);
  scene.draw();
  EXPECT_LE(scene.mapper->GetLastGPUBytes(), budget);
  const Picture few = scene.draw();
  EXPECT_LE(scene.mapper->GetLastGPUBytes(), budget);
  EXPECT_TRUE(scene.mapper->GetLastLimitedByGPUMemory());
  EXPECT_GT(scene.mapper->GetLastPointsDrawn(), 20000);
  Scene fresh(scene.reader->GetFileName());
  fresh.mapper->SetGPUMemoryBudget(budget);
  EXPECT_EQ(differing(few, fresh.draw()), 0) << "slots keep their points when blocks go";
  // Other colours take other memory, never more than there is.
  scene.mapper->ScalarVisibilityOff();
  scene.draw();
  const vtkIdType flat = scene.mapper->GetLastPointsDrawn();
  EXPECT_LE(scene.mapper->GetLastGPUBytes(), budget);
  scene.mapper->ScalarVisibilityOn();
  EXPECT_EQ(differing(few, scene.draw()), 0);
  EXPECT_LE(scene.mapper->GetLastGPUBytes(), budget);
  EXPECT_LE(scene.mapper->GetLastPointsDrawn(), flat);
  scene.mapper->SetGPUMemoryBudget(0);
  EXPECT_EQ(differing(everything, scene.draw()), 0);
  // Less than a slot: nothing fits, and nothing breaks.
  scene.mapper->SetGPUMemoryBudget(1000);
  scene.draw(); // its slots go
  scene.draw(); // and another cloud's might have gone
  scene.draw();
  EXPECT_EQ(scene.mapper->GetLastGPUBytes(), 0);
  EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), 0);
  EXPECT_FALSE(scene.mapper->NeedsRender());
}

TEST(GpuBudgets, ACloudWithoutRoomIsNamedOnce)
{
  Clouds scene(3);
  scene.setGpuBudget(200 << 10);
  std::vector<int> warnings(3, 0);
  const std::vector<vtkPointFrontMapper*> mappers = scene.all();
  for (std::size_t i = 0; i < mappers.size(); ++i)
  {
    countEvents(mappers[i], vtkCommand::WarningEvent, warnings[i]);
  }
  scene.first.window->Render();
  EXPECT_FALSE(mappers[2]->GetLastComplete()) << "others may come down";
  EXPECT_TRUE(mappers[2]->NeedsRender());
  scene.settle();
  scene.settle();
  int drawn = 0;
  for (std::size_t i = 0; i < mappers.size(); ++i)
  {
    const bool shows = mappers[i]->GetLastPointsDrawn() > 0;
    drawn += shows ? 1 : 0;
    EXPECT_TRUE(mappers[i]->GetLastComplete()) << i;
    EXPECT_TRUE(mappers[i]->GetLastLimitedByGPUMemory()) << i;
    EXPECT_EQ(mappers[i]->GetLastLeftOut(), shows ? "" : mappers[i]->GetStore()->GetFileName());
    EXPECT_EQ(warnings[i], shows ? 0 : 1) << i;
  }
  EXPECT_EQ(drawn, 1) << "a node for each of three takes twice as much";
  for (vtkPointFrontMapper* const mapper : mappers)
  {
    const double error = mapper->GetLastError();
    EXPECT_GE(error, mapper->GetLastPointsDrawn() > 0 ? 0.02 : 2.0 * mappers[0]->GetLastError());
  }
  scene.setGpuBudget(400 << 10);
  scene.settle();
  for (vtkPointFrontMapper* const mapper : mappers)
  {
    EXPECT_GT(mapper->GetLastPointsDrawn(), 0);
    EXPECT_EQ(mapper->GetLastLeftOut(), "");
  }
}

// Mappers of a window that is gone count for no other, though it often has the same address.
TEST(GpuBudgets, AWindowSharesNothingWithOneThatIsGone)
{
  auto window = vtkSmartPointer<vtkRenderWindow>::New();
  const vtkWindow* const first = window;
  const auto held = perWindow<int>(window);
  std::vector<vtkSmartPointer<vtkRenderWindow>> others;
  window = nullptr;
  for (int tries = 0; tries < 1000 && window != first; ++tries)
  {
    window = vtkSmartPointer<vtkRenderWindow>::New();
    others.push_back(window);
  }
  EXPECT_NE(perWindow<int>(window), held);
  EXPECT_EQ(perWindow<int>(window).use_count(), 1);
}

/// One frame within a budget that was lowered before it, whichever cloud is drawn first.
void lowerTo(Clouds& scene, vtkTypeInt64 budget, double updateRate)
{
  scene.setGpuBudget(budget);
  scene.first.window->SetDesiredUpdateRate(updateRate);
  scene.first.window->Render();
  EXPECT_LE(scene.gpuBytes(), budget) << "update rate " << updateRate;
}

TEST(GpuBudgets, ALoweredBudgetOfGpuMemoryHoldsInTheFirstFrame)
{
  constexpr vtkTypeInt64 budget = 5 << 20;
  constexpr double atRest = 0.0001;
  Clouds scene(6);
  scene.settle();
  ASSERT_GT(scene.gpuBytes(), budget * 3 / 2);
  lowerTo(scene, budget, atRest);
  const Picture first = scene.first.read();
  const vtkIdType drawn = scene.drawn();
  for (vtkPointFrontMapper* mapper : scene.all())
  {
    EXPECT_GT(mapper->GetLastPointsDrawn(), 2000) << "nobody's memory goes to the others for good";
  }
  scene.settle();
  EXPECT_GT(drawn, scene.drawn() * 3 / 4) << "what is left is on screen in that frame";
  EXPECT_GT(first.lit(), scene.first.read().lit() * 3 / 4);
  // In steps, in motion, where fronts move by a few nodes a frame.
  scene.setGpuBudget(0);
  scene.settle();
  for (vtkPointFrontMapper* mapper : scene.all())
  {
    mapper->CompleteOff();
  }
  for (const vtkTypeInt64 less : { vtkTypeInt64(7) << 20, budget, budget / 2, budget / 8 })
  {
    lowerTo(scene, less, 15.0);
    lowerTo(scene, less, 15.0);
    EXPECT_GT(scene.first.mapper->GetLastPointsDrawn(), 0);
  }
  scene.first.window->SetDesiredUpdateRate(atRest);
  scene.settle();
}

/// Two renderers show one cloud: the memory of either is the other's budget.
TEST(GpuBudgets, ALoweredBudgetOfGpuMemoryHoldsForAllViews)
{
  constexpr vtkTypeInt64 budget = 3 << 20;
  Scene scene(planeStore("views", 500, 5));
  scene.renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  vtkNew<vtkRenderer> other;
  other->SetViewport(0.5, 0.0, 1.0, 1.0);
  other->AddActor(scene.actor);
  scene.window->AddRenderer(other);
  other->GetActiveCamera()->SetPosition(0.6, 0.0, 3.0);
  other->GetActiveCamera()->SetFocalPoint(0.6, 0.0, 0.0);
  other->GetActiveCamera()->SetClippingRange(0.5, 50.0);
  scene.draw();
  ASSERT_GT(scene.mapper->GetLastGPUBytes(), budget);
  vtkTypeInt64 most = 0;
  vtkNew<vtkCallbackCommand> watch; // after each renderer's frame
  watch->SetClientData(&most);
  watch->SetCallback(
    [](vtkObject* caller, unsigned long, void* data, void*)
    {
      auto* actor =
        vtkActor::SafeDownCast(static_cast<vtkRenderer*>(caller)->GetActors()->GetLastActor());
      auto* mapper = static_cast<vtkPointFrontMapper*>(actor->GetMapper());
      auto* bytes = static_cast<vtkTypeInt64*>(data);
      *bytes = std::max(*bytes, mapper->GetLastWindowGPUBytes());
    });
  scene.renderer->AddObserver(vtkCommand::EndEvent, watch);
  other->AddObserver(vtkCommand::EndEvent, watch);
  scene.mapper->SetGPUMemoryBudget(budget);
  const Picture first = scene.draw();
  EXPECT_LE(most, budget);
  scene.draw();
  const Picture settled = scene.draw();
  EXPECT_LE(most, budget);
  EXPECT_GT(settled.lit(), 1000);
  EXPECT_LT(differing(first, settled), settled.lit() / 4) << "no view loses its picture";
}

TEST(GpuBudgets, APoolGivesBackWhatItMayNotKeep)
{
  Scene scene(planeStore("pool", 500, 5));
  scene.mapper->SetPointBudget(0);
  const Picture before = scene.draw();
  EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), 250000);
  const vtkTypeInt64 large = scene.mapper->GetLastGPUBytes();
  scene.mapper->SetPointBudget(20000);
  scene.draw();
  EXPECT_LE(scene.mapper->GetLastPointsDrawn(), 20000);
  scene.draw(); // the points that the frame before still drew can go now
  const Picture few = scene.draw();
  EXPECT_LT(scene.mapper->GetLastGPUBytes(), large / 2);
  Scene fresh(scene.reader->GetFileName());
  fresh.mapper->SetPointBudget(20000);
  EXPECT_EQ(differing(few, fresh.draw()), 0) << "slots keep their points when they move";
  scene.mapper->SetPointBudget(0);
  EXPECT_EQ(differing(before, scene.draw()), 0);
}

TEST(GpuBudgets, AStillFrameTakesTheSlotsThatItNeeds)
{
  constexpr vtkTypeInt64 slot = 4096 * 16; // bytes: positions and values
  Scene scene(planeStore("slots", 800, 5));
  scene.mapper->SetPointBudget(280000);
  scene.draw();
  scene.mapper->SetPointBudget(330000); // a little more than there is room for
  scene.draw();
  // Each node rounds up to slots; a quarter more than the budget may be kept.
  const vtkTypeInt64 needed = 330000 / 4096 + scene.mapper->GetLastNodesDrawn();
  const vtkTypeInt64 kept = 330000 / 4096 * 5 / 4 + 2;
  EXPECT_GT(scene.mapper->GetLastPointsDrawn(), 290000);
  EXPECT_LE(scene.mapper->GetLastGPUBytes(), std::max(needed, kept) * slot);
  const Picture moved = scene.draw();
  Scene fresh(scene.reader->GetFileName());
  fresh.mapper->SetPointBudget(330000);
  EXPECT_EQ(differing(moved, fresh.draw()), 0) << "what was dropped is uploaded again";
}

} // namespace
