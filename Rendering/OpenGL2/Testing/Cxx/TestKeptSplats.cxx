// OpenGL keeps visible points while the view moves (SMOOTH-7).

#include "Scene.h"

#include "vtkPointFrontStyle.h"

#include <chrono>
#include <map>
#include <string>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

const std::map<std::string, std::string> keptStyles = {
  { "discs", R"({"default": {"technique": "splats"}})" },
  { "blended", R"({"default": {"technique": "splats", "blended": true}})" },
  { "spheres", R"({"default": {"technique": "spheres"}, "shading": {"mode": "lit"}})" },
  { "turned", R"({"default": {"technique": "splats", "orientation": [0.1, 0.2, 1]}})" },
  { "pixels", R"({"default": {"technique": "points", "size": {"mode": "fixed", "px": 1}},
     "shading": {"mode": "lit"}})" },
  { "plain", R"({"default": {"technique": "points", "size": {"mode": "fixed", "px": 1}}})" },
};

constexpr double distance = 10.0;
constexpr double angle = 30.0;
constexpr int height = 200;
/// The size of a pixel at the surface.
const double pixel = 2.0 * distance * std::tan(0.5 * angle * 3.14159265358979 / 180.0) / height;

/// A surface that fills the picture, complete at rest.
struct Pan : Scene
{
  vtkNew<vtkPointFrontStyle> style;

  explicit Pan(const std::string& store, const std::string& technique)
    : Scene(store)
  {
    EXPECT_TRUE(style->LoadJSON(keptStyles.at(technique)));
    mapper->SetStyle(style);
    mapper->CompleteOff();
    mapper->SetGrowthTime(0.0);
    mapper->SetTargetError(0.5);
    to(0.0);
  }
  void to(double pixels)
  {
    const glm::dvec3 at(pixels * pixel, 0.0, 0.0);
    lookFrom(at + glm::dvec3(0.0, 0.0, distance), at);
  }
  Picture atRest()
  {
    window->SetDesiredUpdateRate(0.0001);
    const auto begin = std::chrono::steady_clock::now();
    const auto isRecent = [&]
    { return std::chrono::steady_clock::now() - begin < std::chrono::seconds(20); };
    do // nothing is due between two arrivals, and the view is not complete yet
    {
      window->Render();
    } while ((mapper->NeedsRender() || !mapper->GetLastComplete()) && isRecent());
    EXPECT_TRUE(mapper->GetLastComplete());
    return read();
  }
  /// Ten pixels to the right in ten frames, for which next to no time is allotted.
  Picture inMotion()
  {
    mapper->SetTargetFrameTime(0.001);
    window->SetDesiredUpdateRate(30.0);
    for (int pixels = 1; pixels < 10; ++pixels)
    {
      to(pixels);
      draw();
    }
    to(10.0);
    return draw();
  }
  vtkIdType kept() const { return mapper->GetLastPointsKept(); }
};

/// All columns but the right edge, where the pan shows new parts of the scene.
constexpr int columns = 280;

double coverage(const Picture& picture)
{
  int covered = 0;
  for (int y = 0; y < picture.height; ++y)
  {
    for (int x = 0; x < columns; ++x)
    {
      const std::array<int, 3> rgb = picture.at(x, y);
      covered += rgb[0] + rgb[1] + rgb[2] > 0 ? 1 : 0;
    }
  }
  return static_cast<double>(covered) / (picture.height * columns);
}

/// Mean over pixels and channels.
double difference(const Picture& a, const Picture& b)
{
  double sum = 0.0;
  for (int y = 0; y < a.height; ++y)
  {
    for (int x = 0; x < columns; ++x)
    {
      for (std::size_t c = 0; c < 3; ++c)
      {
        sum += std::abs(a.at(x, y)[c] - b.at(x, y)[c]);
      }
    }
  }
  return sum / (3.0 * columns * a.height);
}

/// A plane of patches of some pixels, which few points do not show.
std::string patches()
{
  return storeOf("kept_patches", 500 * 500,
    [](std::size_t i)
    {
      const auto column = static_cast<int>(i) % 500, row = static_cast<int>(i) / 500;
      Sample sample;
      sample.position = { (2 * column - 499) * 10, (2 * row - 499) * 10, 0 };
      const bool light = (column / 6 + row / 6) % 2 == 0;
      sample.rgb = light ? std::array<std::uint8_t, 3>{ 250, 220, 90 }
                         : std::array<std::uint8_t, 3>{ 30, 60, 120 };
      return sample;
    });
}

} // namespace

TEST(KeptSplats, APanOfTenPixelsKeepsCoverageAndDetail)
{
  const std::string store = patches();
  for (const auto& [technique, json] : keptStyles)
  {
    Pan scene(store, technique);
    EXPECT_GT(coverage(scene.atRest()), 0.99) << technique;
    EXPECT_EQ(scene.kept(), 0) << technique;
    const vtkIdType all = scene.mapper->GetLastPointsDrawn();
    const Picture moved = scene.inMotion();
    EXPECT_LT(scene.mapper->GetLastPointsDrawn(), all / 10 * 7) << technique;
    EXPECT_GT(scene.kept(), 1000) << technique;
    EXPECT_LE(scene.kept(), 300 * 200) << technique;
    EXPECT_GE(coverage(moved), 0.99) << technique;
    // Nothing of it is left in a complete picture.
    const Picture complete = scene.atRest();
    EXPECT_EQ(scene.kept(), 0) << technique;
    Pan never(store, technique);
    never.to(10.0);
    EXPECT_EQ(differing(complete, never.atRest()), 0) << technique;
    // Without what was seen the same frame shows less. Splats of the few are larger: they hide some
    // of it, spheres most.
    scene.inMotion();
    scene.mapper->ReleaseGraphicsResources(scene.window);
    const Picture fresh = scene.draw();
    EXPECT_EQ(scene.kept(), 0) << technique;
    EXPECT_LT(scene.mapper->GetLastPointsDrawn(), all / 10 * 7) << technique;
    EXPECT_LT(difference(moved, complete), 0.8 * difference(fresh, complete)) << technique;
  }
}

/// Who is hidden for a frame, by another point of its pixel, is there in the next one.
TEST(KeptSplats, LastAsLongAsTheMotion)
{
  const std::string store = patches();
  for (const std::string technique : { "discs", "blended", "plain" })
  {
    Pan scene(store, technique);
    scene.atRest();
    scene.mapper->SetTargetFrameTime(0.001);
    scene.window->SetDesiredUpdateRate(30.0);
    vtkIdType first = 0;
    for (int frame = 1; frame <= 16; ++frame) // over two borders of pixels
    {
      scene.to(0.15 * frame);
      scene.draw();
      first = frame == 1 ? scene.kept() : first;
      ASSERT_GE(scene.kept(), first) << technique << ", frame " << frame;
      ASSERT_LE(scene.kept(), 300 * 200) << technique;
    }
    EXPECT_GT(first, 10000) << technique;
    scene.atRest();
    EXPECT_EQ(scene.kept(), 0) << technique;
  }
}

/// Each cloud of a window keeps its own.
TEST(KeptSplats, OfSeveralCloudsAreKept)
{
  const std::string store = patches();
  Pan alone(store, "discs");
  alone.atRest();
  alone.inMotion();
  const vtkIdType kept = alone.kept();
  Pan scene(store, "discs");
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(store.c_str());
  vtkNew<vtkPointFrontMapper> second;
  second->SetInputConnection(reader->GetOutputPort());
  second->SetBackend(vtkPointFrontMapper::OPENGL);
  second->SetStyle(scene.style);
  second->CompleteOff();
  second->SetGrowthTime(0.0);
  second->SetTargetError(0.5);
  vtkNew<vtkActor> actor;
  actor->SetMapper(second);
  actor->SetPosition(0.0, 0.0, -0.5);
  scene.renderer->AddActor(actor);
  scene.atRest();
  second->SetTargetFrameTime(0.001);
  scene.inMotion();
  EXPECT_GT(scene.kept(), kept / 2);
  EXPECT_GT(second->GetLastPointsKept(), kept / 2);
}

/// A camera that turns and comes nearer, with and without perspective, sees the same points as the
/// software back end keeps, and where they are.
TEST(KeptSplats, AreThoseOfTheSoftwareBackEnd)
{
  const std::string store = patches();
  for (const bool parallel : { false, true })
  {
    std::map<int, vtkIdType> kept;
    for (const int backend : { vtkPointFrontMapper::SOFTWARE, vtkPointFrontMapper::OPENGL })
    {
      Pan scene(store, "discs");
      scene.mapper->SetBackend(backend);
      vtkCamera* const camera = scene.renderer->GetActiveCamera();
      camera->SetParallelProjection(parallel);
      camera->SetParallelScale(2.6);
      scene.atRest();
      camera->SetParallelScale(2.5);
      camera->SetPosition(2.0, -1.0, distance - 1.0);
      camera->SetViewUp(0.05, 1.0, 0.0);
      camera->SetClippingRange(0.6, 50.0);
      scene.mapper->SetTargetFrameTime(0.001);
      scene.window->SetDesiredUpdateRate(30.0);
      const Picture moved = scene.draw();
      kept[backend] = scene.kept();
      EXPECT_GT(scene.kept(), 10000);
      scene.mapper->ReleaseGraphicsResources(scene.window);
      const Picture fresh = scene.draw();
      EXPECT_EQ(scene.kept(), 0);
      const Picture complete = scene.atRest();
      EXPECT_LT(difference(moved, complete), 0.65 * difference(fresh, complete))
        << parallel << ", back end " << backend;
    }
    EXPECT_NEAR(static_cast<double>(kept[vtkPointFrontMapper::OPENGL]),
      static_cast<double>(kept[vtkPointFrontMapper::SOFTWARE]), 200.0);
  }
}
