// Detail that grows (SMOOTH-6), through VTK: both back ends alike, and nothing of it left at rest.

#include "Scene.h"

#include "vtkPointFrontStyle.h"

#include <chrono>
#include <map>
#include <string>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

const std::map<std::string, std::string> growingStyles = {
  { "opaque", R"({"default": {"technique": "splats"}})" },
  { "blended", R"({"default": {"technique": "splats", "blended": true}})" },
  { "spheres", R"({"default": {"technique": "spheres"}})" },
  { "squares", R"({"default": {"technique": "points", "size": {"mode": "fixed", "px": 6}}})" },
};

std::string hillsStore()
{
  return builtStore("growing", hills(60000, 3000.0, millimetres()));
}

struct Growing : Scene
{
  vtkNew<vtkPointFrontStyle> style;

  explicit Growing(const std::string& store, const std::string& technique)
    : Scene(store)
  {
    EXPECT_TRUE(style->LoadJSON(growingStyles.at(technique)));
    mapper->SetStyle(style);
    mapper->CompleteOff();
    mapper->SetTargetError(6.0);
    mapper->SetTargetFrameTime(10000.0); // time does not limit the detail
    lookFrom({ 0.5, -6.0, 6.0 }, { 0.0, 0.0, 0.0 });
  }
  /// In motion until another frame would be the same.
  Picture inMotion()
  {
    window->SetDesiredUpdateRate(30.0);
    return settled();
  }
  Picture atRest()
  {
    window->SetDesiredUpdateRate(0.0001);
    return settled();
  }
  Picture settled()
  {
    const auto begin = std::chrono::steady_clock::now();
    do
    {
      window->Render();
    } while ((mapper->NeedsRender() || mapper->GetLastRequests() > 0) && // still under way
      std::chrono::steady_clock::now() - begin < std::chrono::seconds(20));
    EXPECT_FALSE(mapper->NeedsRender());
    return read();
  }
};

} // namespace

TEST(Growing, TheBackEndsDrawItAlike)
{
  const std::string store = hillsStore();
  for (const auto& [technique, json] : growingStyles)
  {
    Growing scene(store, technique);
    scene.mapper->SetBackendToSoftware();
    const Picture software = scene.inMotion();
    EXPECT_FALSE(scene.mapper->GetLastComplete()) << technique;
    scene.mapper->SetBackendToOpenGL();
    const Picture gl = scene.inMotion();
    EXPECT_GT(gl.lit(), 4000) << technique;
    EXPECT_LE(differing(software, gl, 2), 0.005 * 300 * 200) << technique;

    scene.mapper->SetGrowthTime(0.0);
    EXPECT_GT(differing(gl, scene.inMotion(), 2), 50) << technique << " did not grow";
  }
}

TEST(Growing, AtRestNothingIsLeftOfIt)
{
  const std::string store = hillsStore();
  for (const auto& [technique, json] : growingStyles)
  {
    for (const int backend : { vtkPointFrontMapper::SOFTWARE, vtkPointFrontMapper::OPENGL })
    {
      Growing scene(store, technique);
      scene.mapper->SetBackend(backend);
      scene.inMotion();
      const Picture grown = scene.atRest();
      EXPECT_TRUE(scene.mapper->GetLastComplete());
      Growing never(store, technique);
      never.mapper->SetBackend(backend);
      never.mapper->SetGrowthTime(0.0);
      never.mapper->CompleteOn();
      EXPECT_EQ(differing(grown, never.draw()), 0) << technique << ", back end " << backend;
    }
  }
}

/// As long as it takes, and not longer.
TEST(Growing, TakesItsTime)
{
  Growing scene(hillsStore(), "opaque");
  scene.mapper->SetBackendToSoftware();
  scene.atRest();
  scene.mapper->SetGrowthTime(400.0);
  scene.mapper->SetTargetError(1.0);
  const auto begin = std::chrono::steady_clock::now();
  scene.atRest();
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  EXPECT_GE(taken.count(), 0.2);
  EXPECT_LT(taken.count(), 10.0);
}
