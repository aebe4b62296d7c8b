// Who owns GL names: each window's context has its own, and they go where they belong.

#include "Scene.h"

#include <vector>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

/// A cloud in a window of its own, and the names that the window had without it.
struct Counted : Scene
{
  explicit Counted(const std::string& store)
    : Scene(store)
  {
    mapper->SetBackendToOpenGL();
    actor->VisibilityOff();
    draw();
    names = liveNames(window);
    actor->VisibilityOn();
    picture = draw();
    EXPECT_GT(liveNames(window), names + 2);
  }
  int names = 0;
  Picture picture;
};

vtkTypeInt64 uploaded(const Scene& scene)
{
  return vtkOpenGLPointFrontMapper::SafeDownCast(scene.mapper)->GetUploadedBytes();
}

/// The same actor in a window beside that of `scene`.
vtkSmartPointer<vtkRenderWindow> anotherWindow(const Scene& scene)
{
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(scene.actor);
  renderer->SetActiveCamera(scene.renderer->GetActiveCamera());
  auto window = vtkSmartPointer<vtkRenderWindow>::New();
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(300, 200);
  window->AddRenderer(renderer);
  return window;
}

TEST(Contexts, AnActorThatIsRemovedFreesItsNamesInItsOwnWindow)
{
  Counted first(planeStore("contexts_a", 150, 13));
  Counted second(planeStore("contexts_b", 150, 13));
  const int others = liveNames(second.window); // which is current now
  first.renderer->RemoveActor(first.actor);
  EXPECT_EQ(liveNames(first.window), first.names);
  EXPECT_EQ(liveNames(second.window), others);
  EXPECT_EQ(differing(second.picture, second.draw()), 0);
  first.renderer->AddActor(first.actor);
  EXPECT_EQ(differing(first.picture, first.draw()), 0);
}

TEST(Contexts, AMapperThatIsDestroyedLeavesNothing)
{
  Counted first(planeStore("contexts_a", 150, 13));
  Counted second(planeStore("contexts_b", 150, 13));
  const int others = liveNames(second.window);
  first.actor->SetMapper(nullptr);
  first.mapper = nullptr;
  EXPECT_EQ(liveNames(first.window), first.names);
  EXPECT_EQ(liveNames(second.window), others);
  EXPECT_EQ(differing(second.picture, second.draw()), 0);
}

TEST(Contexts, AnActorThatTakesAnotherMapperLeavesNothingOfTheFirst)
{
  Counted scene(planeStore("contexts_a", 150, 13));
  const int withOne = liveNames(scene.window);
  for (int i = 0; i < 5; ++i)
  {
    auto other = vtkSmartPointer<vtkPointFrontMapper>::New();
    other->SetInputConnection(scene.reader->GetOutputPort());
    other->SetBackendToOpenGL();
    other->CompleteOn();
    other->SetTargetError(0.05);
    scene.actor->SetMapper(other);
    scene.mapper = other; // the one before is gone
    EXPECT_EQ(differing(scene.picture, scene.draw()), 0);
  }
  EXPECT_EQ(liveNames(scene.window), withOne);
}

TEST(Contexts, AMapperInTwoWindowsUploadsOnceForEach)
{
  Counted scene(planeStore("contexts_a", 150, 13));
  const vtkTypeInt64 once = uploaded(scene);
  EXPECT_EQ(once, 150 * 150 * (12 + 4));
  const auto first = scene.window;
  const auto second = anotherWindow(scene);
  for (int i = 0; i < 3; ++i)
  {
    scene.window = second;
    EXPECT_EQ(differing(scene.picture, scene.draw()), 0);
    scene.window = first;
    EXPECT_EQ(differing(scene.picture, scene.draw()), 0);
    EXPECT_EQ(uploaded(scene), 2 * once);
  }
}

TEST(Contexts, AWindowThatGoesTakesItsNamesAndNoOthers)
{
  Counted scene(planeStore("contexts_a", 150, 13));
  const int names = liveNames(scene.window);
  const auto first = scene.window;
  for (int i = 0; i < 2; ++i)
  {
    scene.window = anotherWindow(scene);
    EXPECT_EQ(differing(scene.picture, scene.draw()), 0);
    scene.window = first; // the other is gone
    EXPECT_EQ(liveNames(scene.window), names);
    EXPECT_EQ(differing(scene.picture, scene.draw()), 0);
  }
}

// Nobody tells a mapper that no actor has: the window itself must.
TEST(Contexts, AMapperWithoutAnActorOutlivesItsContext)
{
  Counted scene(planeStore("contexts_a", 150, 13));
  scene.actor->SetMapper(scene.inMemory());
  scene.draw();
  scene.window->Finalize();
  scene.draw(); // in a new context
  const int names = liveNames(scene.window);
  scene.actor->SetMapper(scene.mapper);
  EXPECT_EQ(differing(scene.picture, scene.draw()), 0);
  EXPECT_GT(liveNames(scene.window), names);
}

// Streams of attributes stand beside positions: another colour is uploaded without them.
TEST(Contexts, AnotherColourUploadsNoPosition)
{
  Counted scene(planeStore("contexts_a", 150, 13));
  const vtkTypeInt64 before = uploaded(scene);
  const int names = liveNames(scene.window);
  scene.mapper->SetScalarModeToUsePointFieldData();
  scene.mapper->SelectColorArray("gps_time");
  scene.draw();
  EXPECT_EQ(uploaded(scene) - before, 150 * 150 * 4);
  EXPECT_EQ(liveNames(scene.window), names + 2) << "table of colours, vertex array of its program";
  const vtkTypeInt64 withTimes = scene.mapper->GetLastGPUBytes();
  scene.mapper->SelectColorArray("elevation");
  scene.draw();
  EXPECT_EQ(uploaded(scene) - before, 150 * 150 * 4) << "of no column";
  EXPECT_LE(scene.mapper->GetLastGPUBytes(), withTimes - 150 * 150 * 4)
    << "what no style reads is gone with the next frame";
}

} // namespace
