// The costs of drawing splats on OpenGL, and what it leaves behind: uploads, primitives, names; and
// which points a selection finds in them.

#include "Splats.h"

#include "pointfront/Generate/TerrainSource.h"

#include <vtkHardwareSelector.h>
#include <vtkIdTypeArray.h>
#include <vtkSelection.h>
#include <vtkSelectionNode.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

/// Ids of points that a selection of a rectangle finds.
std::set<vtkIdType> selected(Scene& scene)
{
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(scene.renderer);
  selector->SetArea(100, 60, 180, 140);
  selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_POINTS);
  const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
  std::set<vtkIdType> ids;
  for (unsigned int node = 0; node < selection->GetNumberOfNodes(); ++node)
  {
    auto* list = vtkIdTypeArray::SafeDownCast(selection->GetNode(node)->GetSelectionList());
    for (vtkIdType i = 0; list && i < list->GetNumberOfValues(); ++i)
    {
      ids.insert(list->GetValue(i));
    }
  }
  return ids;
}

TEST(Techniques, SelectionsFindTheSplatsThatAreSeen)
{
  Splats scene(surfaceStore("selected", sphereAt));
  for (const char* name : { "splats", "ewa", "spheres", "classes", "lit", "silhouettes", "solid" })
  {
    ASSERT_TRUE(scene.style->LoadJSON(techniques.at(name)));
    scene.with(vtkPointFrontMapper::SOFTWARE);
    const std::set<vtkIdType> expected = selected(scene);
    const Picture before = scene.with(vtkPointFrontMapper::OPENGL);
    const std::set<vtkIdType> found = selected(scene);
    EXPECT_GT(expected.size(), 300u) << name;
    std::size_t both = 0;
    for (const vtkIdType id : found)
    {
      both += expected.count(id);
    }
    EXPECT_GE(both, 0.99 * static_cast<double>(expected.size())) << name;
    EXPECT_LE(found.size(), 1.01 * static_cast<double>(expected.size())) << name;
    EXPECT_EQ(differing(before, scene.draw()), 0) << name;
  }
}

TEST(Techniques, AStyleEditUploadsNoPositionAgain)
{
  Splats scene(surfaceStore("edited", stairsAt));
  auto* const gl = vtkOpenGLPointFrontMapper::SafeDownCast(scene.mapper);
  ASSERT_TRUE(scene.style->LoadJSON(techniques.at("splats")));
  scene.draw();
  const vtkTypeInt64 points = scene.mapper->GetLastPointsDrawn();
  const vtkTypeInt64 first = gl->GetUploadedBytes();
  EXPECT_EQ(first, points * (12 + 4 + 4)); // positions, colours, shapes
  ASSERT_TRUE(scene.style->LoadJSON(techniques.at("ewa")));
  scene.draw();
  EXPECT_EQ(gl->GetUploadedBytes(), first) << "another technique reads the same";
  ASSERT_TRUE(scene.style->LoadJSON(techniques.at("table")));
  scene.draw();
  EXPECT_EQ(gl->GetUploadedBytes(), first + points * 4) << "other colours alone";
  ASSERT_TRUE(scene.style->LoadJSON(R"({"default": {"technique": "points",
    "size": {"mode": "fixed", "px": 2}, "color": "classification"}})"));
  scene.draw();
  EXPECT_EQ(gl->GetUploadedBytes(), first + points * 4) << "squares need no shapes";
  ASSERT_TRUE(
    scene.style->LoadJSON(R"({"default": {"technique": "solid", "color": "classification"}})"));
  scene.draw();
  EXPECT_EQ(gl->GetUploadedBytes(), first + points * (4 + 4 + 4)) << "heights, shapes again";
}

/// A view that draws its points as they come.
struct Loading
{
  double drawn = 0.0; ///< points and triangles, of all frames together
  int gained = 0; ///< frames that had more points than the one before
  vtkTypeInt64 points = 0; ///< those of the last frame

  /// Draws until `loads` says that no more comes, or the time is over.
  Loading(Scene& scene, const std::function<vtkTypeInt64()>& shown,
    const std::function<bool()>& loads, std::chrono::seconds most)
  {
    scene.window->Start(); // there is a context before the first frame
    const auto begin = std::chrono::steady_clock::now();
    do
    {
      drawn += primitivesOf(scene);
      gained += shown() > points;
      points = shown();
    } while (loads() && std::chrono::steady_clock::now() - begin < most);
  }
};

TEST(Techniques, AtRestNothingIsDrawnTwice)
{
  Splats scene(surfaceStore("rest", sphereAt));
  for (const char* name : { "metres", "lit ewa", "solid" })
  {
    ASSERT_TRUE(scene.style->LoadJSON(techniques.at(name)));
    const Picture first = scene.draw();
    const vtkIdType points = scene.mapper->GetLastPointsDrawn();
    EXPECT_LT(primitivesOf(scene), 20) << name << ": the same view";
    EXPECT_EQ(differing(first, scene.read()), 0) << name;
    scene.renderer->GetActiveCamera()->Azimuth(5.0);
    EXPECT_GT(primitivesOf(scene), points / 2) << name << ": another view";
    scene.renderer->GetActiveCamera()->Azimuth(-5.0);
    EXPECT_EQ(differing(first, scene.draw()), 0) << name;
  }
}

/// A view at rest whose points come to the GPU frame by frame (SMOOTH-5). The squares are a quad or
/// so of the window's beside the points.
TEST(Techniques, AViewThatLoadsDrawsNothingTwice)
{
  const std::string store = surfaceStore("loading", stairsAt);
  struct Style
  {
    const char* json;
    double most; ///< drawn, times the points of the complete picture
  };
  constexpr double once = 1.1, firstRows = 0.1; // the table's rows come, too
  constexpr double twice = once + 2.15; // a second pass as points come, and at the end
  for (const auto& [json, most] :
    { Style{ R"({"default": {"technique": "points",
           "size": {"mode": "fixed", "px": 2}}})",
        once },
      Style{ R"({"default": {"technique": "points", "size": {"mode": "fixed", "metres": 0.05}}})",
        once },
      Style{ R"({"default": {"technique": "splats", "size": {"mode": "fixed", "px": 4}}})", once },
      Style{ R"({"default": {"technique": "spheres", "size": {"mode": "fixed", "metres": 0.05}}})",
        once },
      Style{ R"({"default": {"technique": "splats"}})", once + firstRows },
      Style{ R"({"default": {"technique": "spheres"}})", once + firstRows },
      Style{ R"({"default": {"technique": "ewa"}})", twice + 2.0 * firstRows } })
  {
    Splats scene(store);
    ASSERT_TRUE(scene.style->LoadJSON(json));
    scene.mapper->SetTargetError(0.5);
    scene.mapper->CompleteOff();
    scene.mapper->SetGrowthTime(0.0);
    scene.mapper->SetUploadLimit(1 << 16);
    const auto loads = [&]
    { return scene.mapper->NeedsRender() || scene.mapper->GetLastRequests() > 0; };
    const Loading view(
      scene, [&] { return scene.mapper->GetLastPointsDrawn(); }, loads, std::chrono::seconds(20));
    EXPECT_TRUE(scene.mapper->GetLastComplete()) << json;
    EXPECT_GE(view.gained, 3) << json;
    EXPECT_LE(view.drawn, most * static_cast<double>(view.points))
      << json << ", " << view.gained << " frames";
    const Picture last = scene.read();
    Splats whole(store);
    ASSERT_TRUE(whole.style->LoadJSON(json));
    whole.mapper->SetTargetError(0.5);
    EXPECT_EQ(differing(whole.draw(), last), 0) << json;
  }
}

/// Children take their parents' places. Its nodes are small and many: frames see them load.
std::string townOfMeans(const std::string& name)
{
  BuildOptions options = nodesOf(100);
  options.refinement = Refinement::Replace;
  return builtStore(name, std::make_unique<TerrainSource>(200000, 11), options);
}

/// Coarse nodes that no complete view draws stand in for finer ones. (Refining.OfATreeOfMeans*
/// counts what is drawn, in frames that do not depend on the machine.)
TEST(Techniques, AViewOfATreeOfMeansThatLoadsEndsAsAtOneGo)
{
  const std::string store = townOfMeans("loading-means");
  Splats scene(store);
  scene.reader->SetOverviewPoints(100); // these would be in memory
  scene.renderer->ResetCamera();
  ASSERT_TRUE(scene.style->LoadJSON(techniques.at("splats")));
  scene.mapper->SetTargetError(0.5);
  scene.mapper->CompleteOff();
  scene.mapper->SetGrowthTime(0.0);
  const Loading view(
    scene, [&] { return scene.mapper->GetLastPointsDrawn(); },
    [&] { return scene.mapper->NeedsRender() || scene.mapper->GetLastRequests() > 0; },
    std::chrono::seconds(20));
  EXPECT_TRUE(scene.mapper->GetLastComplete());
  RecordProperty("drawn", std::to_string(view.drawn / static_cast<double>(view.points)));
  const Picture last = scene.read();
  Splats whole(store);
  whole.renderer->ResetCamera();
  ASSERT_TRUE(whole.style->LoadJSON(techniques.at("splats")));
  whole.mapper->SetTargetError(0.5);
  EXPECT_EQ(differing(whole.draw(), last), 0);
}

/// Pixels of the window in which a selection finds a point.
int pixelsFound(Scene& scene)
{
  vtkNew<vtkHardwareSelector> selector;
  const auto width = static_cast<unsigned>(scene.window->GetSize()[0]);
  const auto height = static_cast<unsigned>(scene.window->GetSize()[1]);
  selector->SetRenderer(scene.renderer);
  selector->SetArea(0, 0, width - 1, height - 1);
  selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_POINTS);
  EXPECT_TRUE(selector->CaptureBuffers());
  int found = 0;
  for (unsigned pixel = 0; pixel < width * height; ++pixel)
  {
    const unsigned place[2] = { pixel % width, pixel / width };
    found += selector->GetPixelInformation(place).Valid ? 1 : 0;
  }
  return found;
}

/// Stand-ins are not drawn for a selection, and a tree of means may have nothing else yet.
TEST(Techniques, InAViewOfATreeOfMeansThatLoadsASelectionFindsPoints)
{
  Splats scene(townOfMeans("found-means"));
  scene.reader->SetOverviewPoints(100); // these would be in memory
  scene.renderer->ResetCamera();
  ASSERT_TRUE(scene.style->LoadJSON(techniques.at("splats")));
  scene.mapper->SetTargetError(0.5);
  scene.mapper->CompleteOff();
  scene.mapper->SetGrowthTime(0.0);
  std::vector<int> found;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  do
  {
    scene.window->Render();
    found.push_back(pixelsFound(scene));
  } while ((scene.mapper->NeedsRender() || scene.mapper->GetLastRequests() > 0) &&
    std::chrono::steady_clock::now() < end);
  EXPECT_TRUE(scene.mapper->GetLastComplete());
  EXPECT_GT(found.back(), 1000);
  EXPECT_GE(*std::min_element(found.begin(), found.end()), 0.25 * found.back());
  RecordProperty("first_found", std::to_string(double(found.front()) / found.back()));
  RecordProperty("frames", static_cast<int>(found.size()));
}

/// Further clouds of a scene's window, in the scene's style: an actor each.
struct SeveralSplats : Splats
{
  struct Cloud
  {
    vtkNew<vtkPointFrontReader> reader;
    vtkNew<vtkPointFrontMapper> mapper;
    vtkNew<vtkActor> actor;
  };
  SeveralSplats(const std::vector<std::string>& stores, const char* json)
    : Splats(stores.front())
    , clouds(stores.size() - 1)
  {
    EXPECT_TRUE(style->LoadJSON(json));
    mappers.push_back(mapper);
    for (std::size_t i = 0; i < clouds.size(); ++i)
    {
      Cloud& cloud = clouds[i];
      cloud.reader->SetFileName(stores[i + 1].c_str());
      cloud.mapper->SetInputConnection(cloud.reader->GetOutputPort());
      cloud.mapper->SetStyle(style);
      cloud.mapper->CompleteOn();
      cloud.mapper->SetBackendToOpenGL();
      cloud.actor->SetMapper(cloud.mapper);
      renderer->AddActor(cloud.actor);
      mappers.push_back(cloud.mapper);
    }
    for (vtkPointFrontMapper* each : mappers)
    {
      each->SetTargetError(0.5);
      each->SetGrowthTime(0.0);
    }
  }
  vtkTypeInt64 points() const
  {
    vtkTypeInt64 sum = 0;
    for (vtkPointFrontMapper* each : mappers)
    {
      sum += each->GetLastPointsDrawn();
    }
    return sum;
  }
  bool needsRender() const
  {
    return std::any_of(mappers.begin(), mappers.end(),
      [](vtkPointFrontMapper* each) { return each->NeedsRender() || each->GetLastRequests() > 0; });
  }

  std::vector<Cloud> clouds;
  std::vector<vtkPointFrontMapper*> mappers;
};

/// Clouds of one window meet by what decided who is seen, and each goes on from its own picture.
TEST(Techniques, SeveralCloudsThatLoadDrawNothingTwice)
{
  const std::vector<std::string> stores = { surfaceStore("loading-0", stairsAt),
    surfaceStore("loading-1", sphereAt), surfaceStore("loading-2", planeAt) };
  for (const char* const json : { R"({"default": {"technique": "points",
           "size": {"mode": "fixed", "px": 2}}})",
         R"({"default": {"technique": "splats", "size": {"mode": "fixed", "metres": 0.05}}})",
         R"({"default": {"technique": "spheres", "size": {"mode": "fixed", "metres": 0.05}}})" })
  {
    SeveralSplats scene(stores, json);
    for (vtkPointFrontMapper* each : scene.mappers)
    {
      each->CompleteOff();
      each->SetUploadLimit(1 << 16);
    }
    const Loading view(
      scene, [&] { return scene.points(); }, [&] { return scene.needsRender(); },
      std::chrono::seconds(60));
    for (vtkPointFrontMapper* each : scene.mappers)
    {
      EXPECT_TRUE(each->GetLastComplete()) << json;
    }
    EXPECT_GE(view.gained, 3) << json;
    EXPECT_LE(view.drawn, 1.1 * static_cast<double>(view.points))
      << json << ", " << view.gained << " frames";
    const Picture last = scene.read();
    SeveralSplats whole(stores, json);
    EXPECT_EQ(differing(whole.draw(), last), 0) << json;
    EXPECT_EQ(whole.points(), view.points) << json;
  }
}

TEST(Techniques, DetailIsAddedToWhatIsThere)
{
  const std::string store = surfaceStore("added", stairsAt);
  for (const char* name : { "metres", "lit", "splats", "silhouettes", "solid" })
  {
    Splats whole(store);
    ASSERT_TRUE(whole.style->LoadJSON(techniques.at(name)));
    whole.mapper->SetTargetError(0.5);
    const Picture atOneGo = whole.draw();
    Splats scene(store);
    ASSERT_TRUE(scene.style->LoadJSON(techniques.at(name)));
    scene.draw();
    for (const double error : { 8.0, 4.0, 2.0, 1.0, 0.5 })
    {
      scene.mapper->SetTargetError(error);
      scene.draw();
    }
    EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), whole.mapper->GetLastPointsDrawn());
    EXPECT_EQ(differing(atOneGo, scene.read()), 0) << name;
  }
}

TEST(Techniques, LeaveNoNamesBehind)
{
  Splats scene(surfaceStore("names", planeAt));
  ASSERT_TRUE(scene.style->LoadJSON(techniques.at("lit ewa")));
  scene.actor->VisibilityOff();
  scene.draw();
  const int before = liveNames(scene.window);
  scene.actor->VisibilityOn();
  const Picture picture = scene.with(vtkPointFrontMapper::OPENGL);
  EXPECT_GT(liveNames(scene.window), before + 8);
  scene.actor->ReleaseGraphicsResources(scene.window);
  EXPECT_EQ(liveNames(scene.window), before);
  EXPECT_EQ(differing(picture, scene.draw()), 0);
  scene.actor->SetMapper(nullptr);
  scene.mapper = nullptr;
  EXPECT_EQ(liveNames(scene.window), before);
}

} // namespace
