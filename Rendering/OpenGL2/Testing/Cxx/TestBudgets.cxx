// What the clouds of a window, the stores of a process and the classes of a store share.

#include "Scene.h"

#include "pointfront/Residency/LoadScheduler.h"

#include <vtkActorCollection.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>

#include <array>
#include <memory>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

/// Hills beside each other, seen together from above; one mapper each.
struct Clouds
{
  explicit Clouds(int count) : first(store(0))
  {
    first.mapper->SetTargetError(0.02);
    for (int c = 1; c < count; ++c)
    {
      add(c);
    }
    first.lookFrom({0.0, 0.0, 40.0}, {0.0, 0.0, 0.0});
  }
  static std::string store(int number)
  {
    const double x = 3.0 * (number % 4) - 6.0;
    const double y = 3.0 * (number / 4) - 3.0;
    BuildOptions options;
    options.outputPath = ::testing::TempDir() + "cloud" + std::to_string(number) + ".pfront";
    options.nodePoints = 2000;
    options.overwrite = true;
    options.threads = 1;
    EXPECT_TRUE(buildStore(
      one(hills(40000, 3000.0, millimetres({x, y, 0.0}))), options).ok());
    return options.outputPath;
  }
  void add(int number)
  {
    readers.push_back(vtkSmartPointer<vtkPointFrontReader>::New());
    readers.back()->SetFileName(store(number).c_str());
    mappers.push_back(vtkSmartPointer<vtkPointFrontMapper>::New());
    mappers.back()->SetInputConnection(readers.back()->GetOutputPort());
    mappers.back()->CompleteOn();
    mappers.back()->SetTargetError(0.02);
    actors.push_back(vtkSmartPointer<vtkActor>::New());
    actors.back()->SetMapper(mappers.back());
    first.renderer->AddActor(actors.back());
  }
  std::vector<vtkPointFrontMapper*> all() const
  {
    std::vector<vtkPointFrontMapper*> list{first.mapper};
    list.insert(list.end(), mappers.begin(), mappers.end());
    return list;
  }
  void setPointBudget(vtkIdType points) const
  {
    for (vtkPointFrontMapper* mapper : all())
    {
      mapper->SetPointBudget(points);
    }
  }
  void setGpuBudget(vtkTypeInt64 bytes)
  {
    gpuBudget = bytes;
    for (vtkPointFrontMapper* mapper : all())
    {
      mapper->SetGPUMemoryBudget(bytes);
    }
  }
  /// Frames until nobody wants another one, each within the budget of GPU memory.
  void settle()
  {
    int frames = 0;
    bool again = true;
    while (again && ++frames < 200)
    {
      first.window->Render();
      if (gpuBudget > 0)
      {
        EXPECT_LE(gpuBytes(), gpuBudget) << "frame " << frames;
      }
      again = false;
      for (vtkPointFrontMapper* mapper : all())
      {
        again = again || mapper->NeedsRender();
      }
    }
    EXPECT_LT(frames, 200);
  }
  vtkIdType drawn() const
  {
    vtkIdType sum = 0;
    for (vtkPointFrontMapper* mapper : all())
    {
      sum += mapper->GetLastPointsDrawn();
    }
    return sum;
  }
  /// The most that there was of all of them while they were drawn.
  vtkTypeInt64 gpuBytes() const
  {
    vtkTypeInt64 most = 0;
    for (vtkPointFrontMapper* mapper : all())
    {
      most = std::max(most, mapper->GetLastWindowGPUBytes());
    }
    return most;
  }
  /// Largest threshold over smallest.
  double spread() const
  {
    double least = 1e30;
    double most = 0.0;
    for (vtkPointFrontMapper* mapper : all())
    {
      least = std::min(least, mapper->GetLastThreshold());
      most = std::max(most, mapper->GetLastThreshold());
    }
    return most / least;
  }

  Scene first;
  std::vector<vtkSmartPointer<vtkPointFrontReader>> readers;
  std::vector<vtkSmartPointer<vtkPointFrontMapper>> mappers;
  std::vector<vtkSmartPointer<vtkActor>> actors;
  vtkTypeInt64 gpuBudget = 0;
};

/// The process's budget for the length of a test.
class ProcessBudget
{
public:
  explicit ProcessBudget(vtkTypeInt64 bytes) : before_(vtkPointFrontStore::GetProcessMemoryBudget())
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

TEST(Budgets, TheCloudsOfAWindowShareItsGpuMemory)
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
  // What one cloud leaves idle, another takes.
  scene.first.lookFrom({-6.0, -3.0, 5.0}, {-6.0, -3.0, 0.0});
  scene.settle();
  const vtkIdType near = scene.first.mapper->GetLastPointsDrawn();
  scene.first.lookFrom({3.0, -3.0, 5.0}, {3.0, -3.0, 0.0});
  scene.settle();
  EXPECT_GT(scene.mappers[2]->GetLastPointsDrawn(), near * 3 / 4);
  // A path, frame by frame, some of them in motion.
  scene.first.mapper->CompleteOff();
  for (int step = 0; step < 60; ++step)
  {
    scene.first.window->SetDesiredUpdateRate(step % 20 < 12 ? 15.0 : 0.0001);
    const double x = -6.0 + 0.15 * step;
    scene.first.lookFrom({x, -3.0, 3.0 + 0.6 * (step % 30)}, {x, -3.0, 0.0});
    scene.first.window->Render();
    EXPECT_LE(scene.gpuBytes(), budget) << "step " << step;
  }
}

TEST(Budgets, ALoweredBudgetOfPointsHoldsInTheFirstFrame)
{
  Clouds scene(6);
  scene.settle();
  ASSERT_EQ(scene.drawn(), 240000);
  for (const vtkIdType budget : {150000, 60000, 20000})
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
  scene.first.lookFrom({-6.0, -3.0, 4.0}, {-6.0, -3.0, 0.0});
  scene.settle();
  EXPECT_EQ(hidden->GetLastPointsDrawn(), 0);
  EXPECT_FALSE(hidden->NeedsRender());
  EXPECT_FALSE(scene.first.mapper->GetLastLimitedByPoints()) << "all of them are its own";
}

TEST(Budgets, ABudgetOfGpuMemoryMayChange)
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
  scene.draw();
  scene.draw();
  EXPECT_EQ(scene.mapper->GetLastGPUBytes(), 0);
  EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), 0);
  EXPECT_FALSE(scene.mapper->NeedsRender());
}

/// One frame within a budget that was lowered before it, whichever cloud is drawn first.
void lowerTo(Clouds& scene, vtkTypeInt64 budget, double updateRate)
{
  scene.setGpuBudget(budget);
  scene.first.window->SetDesiredUpdateRate(updateRate);
  scene.first.window->Render();
  EXPECT_LE(scene.gpuBytes(), budget) << "update rate " << updateRate;
}

TEST(Budgets, ALoweredBudgetOfGpuMemoryHoldsInTheFirstFrame)
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
  for (const vtkTypeInt64 less : {vtkTypeInt64(7) << 20, budget, budget / 2, budget / 8})
  {
    lowerTo(scene, less, 15.0);
    lowerTo(scene, less, 15.0);
    EXPECT_GT(scene.first.mapper->GetLastPointsDrawn(), 0);
  }
  scene.first.window->SetDesiredUpdateRate(atRest);
  scene.settle();
}

/// Two renderers show one cloud: the memory of either is the other's budget.
TEST(Budgets, ALoweredBudgetOfGpuMemoryHoldsForAllViews)
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
  watch->SetCallback([](vtkObject* caller, unsigned long, void* data, void*)
    {
      auto* actor = vtkActor::SafeDownCast(
        static_cast<vtkRenderer*>(caller)->GetActors()->GetLastActor());
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

TEST(Budgets, APoolGivesBackWhatItMayNotKeep)
{
  Scene scene(planeStore("pool", 500, 5));
  scene.mapper->SetPointBudget(0);
  const Picture before = scene.draw();
  EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), 250000);
  const vtkTypeInt64 large = scene.mapper->GetLastGPUBytes();
  scene.mapper->SetPointBudget(20000);
  scene.draw();
  EXPECT_LE(scene.mapper->GetLastPointsDrawn(), 20000);
  scene.draw(); // what the frame before still drew can go now
  const Picture few = scene.draw();
  EXPECT_LT(scene.mapper->GetLastGPUBytes(), large / 2);
  Scene fresh(scene.reader->GetFileName());
  fresh.mapper->SetPointBudget(20000);
  EXPECT_EQ(differing(few, fresh.draw()), 0) << "slots keep their points when they move";
  scene.mapper->SetPointBudget(0);
  EXPECT_EQ(differing(before, scene.draw()), 0);
}

TEST(Budgets, AStillFrameTakesTheSlotsThatItNeeds)
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

TEST(Budgets, TheStoresOfAProcessShareItsMemory)
{
  constexpr vtkTypeInt64 budget = 2000000;
  const ProcessBudget memory(budget);
  Clouds scene(6); // 240,000 points of 12 bytes and more
  scene.settle();
  const auto statistics =
    scene.first.mapper->GetStore()->GetResidency().scheduler().statistics();
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
  BuildOptions options;
  options.outputPath = ::testing::TempDir() + "quarter.pfront";
  options.nodePoints = 500;
  options.overwrite = true;
  ASSERT_TRUE(buildStore(one(hills(10000, 3000.0, millimetres({-6.0, -3.0, 0.0}))), options));
  Scene small(options.outputPath);
  for (Scene* scene : {&large, &small})
  {
    scene->mapper->SetDetailSelectionToViewSpecific();
    scene->mapper->SetTargetError(1.0);
    scene->window->SetSize(30, 20); // fewer pixels than the overview has points
    scene->lookFrom({-6.0, -3.0, 30.0}, {-6.0, -3.0, 0.0});
  }
  vtkIdType before = 0;
  for (const vtkIdType overview : {5000, 10000})
  {
    large.mapper->SetOverviewPoints(overview);
    small.mapper->SetOverviewPoints(overview);
    for (Scene* scene : {&large, &small, &large, &small}) // from the second on both are open
    {
      scene->draw();
    }
    const double ratio = double(large.mapper->GetLastPointsDrawn()) /
                         double(small.mapper->GetLastPointsDrawn());
    EXPECT_NEAR(ratio, 4.0, 0.4);
    const vtkIdType both =
      large.mapper->GetLastPointsDrawn() + small.mapper->GetLastPointsDrawn();
    EXPECT_LE(both, overview * 11 / 10);
    EXPECT_GT(both, before * 3 / 2);
    before = both;
  }
}

/// Two classes in one place: left of each pair red (class 2), right blue (class 6).
std::string layeredStore()
{
  AttributeSchema schema;
  schema.add({"rgb", ScalarType::UInt8, 3});
  schema.add({"classification", ScalarType::UInt8, 1});
  const QuantisationGrid grid = millimetres();
  auto cloud = std::make_unique<CloudSource>("layered", schema, grid);
  for (int row = 0; row < 200; ++row)
  {
    for (int column = 0; column < 200; ++column)
    {
      const bool red = column % 2 == 0;
      cloud->addPosition(grid.toWorld(GridPosition(column * 20 - 2000, row * 20 - 2000, 0)));
      cloud->addValue(
        0, red ? std::array<std::uint8_t, 3>{255, 0, 0} : std::array<std::uint8_t, 3>{0, 0, 255});
      cloud->addValue(1, static_cast<std::uint8_t>(red ? 2 : 6));
    }
  }
  BuildOptions options;
  options.outputPath = ::testing::TempDir() + "layered.pfront";
  options.layering = Layering::ObjectClass;
  options.nodePoints = 1000;
  options.overwrite = true;
  options.threads = 1;
  EXPECT_TRUE(buildStore(one(std::move(cloud)), options).ok());
  return options.outputPath;
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
