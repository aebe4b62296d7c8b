// Splats on OpenGL are those of the software back end: each technique, on each made-up surface, in
// perspective and parallel views, beside other actors and under clipping planes.

#include "ErrorObserver.h"
#include "Splats.h"

#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkPlane.h>
#include <vtkPoints.h>
#include <vtkShaderProperty.h>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

TEST(Techniques, AreThoseOfTheSoftwareBackEnd)
{
  const std::map<std::string, Surface> surfaces = { { "plane", planeAt }, { "sphere", sphereAt },
    { "stairs", stairsAt } };
  for (const auto& [name, surface] : surfaces)
  {
    Splats scene(surfaceStore(name, surface));
    for (const auto& [technique, json] : techniques)
    {
      ASSERT_TRUE(scene.style->LoadJSON(json)) << technique;
      for (const bool parallel : { false, true })
      {
        if (parallel && surface != stairsAt)
        {
          continue;
        }
        scene.setParallel(parallel);
        // A height that lies between two entries of a colour map may get either.
        scene.expectAlike(name + ", " + technique + (parallel ? ", parallel" : ""),
          technique == "elevation" ? 4 : 2);
      }
    }
  }
}

TEST(Techniques, ASplatMayBeLargerThanAnyPointOfGL)
{
  Splats scene(surfaceStore("large", planeAt));
  ASSERT_TRUE(scene.style->LoadJSON(
    R"({"default": {"technique": "splats", "size": {"mode": "fixed", "metres": 1.5}}})"));
  scene.lookFrom({ 0.2, -0.4, 1.2 }, { 0.2, 0.4, 0.15 }); // discs of 400 pixels
  scene.expectAlike("near");
  ASSERT_TRUE(scene.style->LoadJSON(
    R"({"default": {"technique": "spheres", "size": {"mode": "fixed", "metres": 0.5}}})"));
  scene.expectAlike("spheres, near");
}

TEST(Techniques, FollowActorsClippingPlanesAndPartsOfWindows)
{
  const std::string store = surfaceStore("moved", stairsAt);
  for (const char* name : { "ewa", "silhouettes", "solid" })
  {
    const std::string what = std::string(name) + ", ";
    Splats scene(store);
    ASSERT_TRUE(scene.style->LoadJSON(techniques.at(name)));
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(0.3, 0.0, 0.0);
    plane->SetNormal(-1.0, 0.3, 0.0);
    scene.mapper->AddClippingPlane(plane);
    scene.expectAlike(what + "clipped");
    scene.actor->SetPosition(0.4, -0.3, 0.2);
    scene.actor->RotateZ(30.0);
    scene.actor->RotateX(20.0);
    scene.actor->SetScale(1.2, 1.2, 1.5);
    scene.expectAlike(what + "moved and clipped");
    scene.window->SetSize(420, 260);
    scene.renderer->SetViewport(0.1, 0.2, 0.8, 0.9);
    scene.expectAlike(what + "a part of a window");
    scene.renderer->GetActiveCamera()->SetWindowCenter(0.3, -0.2);
    scene.expectAlike(what + "off-axis");
  }
}

TEST(Techniques, WallsGoDownBehindTheEye)
{
  Splats scene(surfaceStore("below", planeAt));
  ASSERT_TRUE(scene.style->LoadJSON(
    R"({"default": {"technique": "solid", "wall_color": ["#f0e0d0", "#103060"]}})"));
  scene.actor->SetScale(1.0, 1.0, 8.0); // walls of some 2.4
  scene.lookFrom({ 0.1, -2.2, -1.5 }, { 0.0, 0.0, 1.0 });
  scene.expectAlike("from below");
}

TEST(Techniques, OtherActorsIntersectSplats)
{
  Splats scene(surfaceStore("beside", sphereAt));
  ASSERT_TRUE(scene.style->LoadJSON(techniques.at("blended")));
  vtkNew<vtkPoints> corners; // corners of a wall through the surface
  for (const glm::dvec2& corner :
    { glm::dvec2(-2.0, -1.0), { 2.0, -1.0 }, { 2.0, 1.8 }, { -2.0, 1.8 } })
  {
    corners->InsertNextPoint(corner.x, -0.8 + 0.2 * corner.x, corner.y);
  }
  vtkNew<vtkCellArray> sides;
  sides->InsertNextCell({ 0, 1, 2, 3 });
  vtkNew<vtkPolyData> wall;
  wall->SetPoints(corners);
  wall->SetPolys(sides);
  vtkNew<vtkPolyDataMapper> wallMapper;
  wallMapper->SetInputData(wall);
  vtkNew<vtkActor> actor;
  actor->SetMapper(wallMapper);
  scene.renderer->AddActor(actor);
  scene.expectAlike("a wall in the surface");
  actor->GetProperty()->SetOpacity(0.5);
  scene.expectAlike("a translucent wall");
}

/// Walls of points that are far above the view, whose nodes nobody needs for their points.
TEST(Techniques, WallsComeDownFromAboveTheView)
{
  Splats scene(surfaceStore("above", roofAt));
  ASSERT_TRUE(scene.style->LoadJSON(
    R"({"default": {"technique": "solid", "wall_color": ["#f0e0d0", "#103060"]}})"));
  scene.lookFrom({ 0.0, -12.0, 33.0 }, { 0.0, 0.0, 33.0 }); // heights from 32.6 to 33.4
  scene.renderer->GetActiveCamera()->SetViewUp(0.0, 0.0, 1.0);
  scene.renderer->GetActiveCamera()->SetViewAngle(4.0);
  scene.expectAlike("from aside");
  EXPECT_GT(scene.mapper->GetLastPointsDrawn(), 15000) << "all of the roof";
}

TEST(Techniques, ATranslucentActorIsOneSurface)
{
  Splats scene(surfaceStore("veil", planeAt));
  ASSERT_TRUE(scene.style->LoadJSON(techniques.at("blended")));
  const Picture opaque = scene.with(vtkPointFrontMapper::OPENGL);
  scene.actor->GetProperty()->SetOpacity(0.5);
  const Picture half = scene.draw();
  int off = 0;
  for (int y = 60; y < 140; ++y)
  {
    for (int x = 110; x < 190; ++x)
    {
      for (std::size_t c = 0; c < 3; ++c)
      {
        off += std::abs(2 * half.at(x, y)[c] - opaque.at(x, y)[c]) > 3;
      }
    }
  }
  EXPECT_EQ(off, 0) << "each pixel is half of its colour, however many splats lie there";
}

// Such an actor was drawn as plain points without the style's filters, and nothing was said.
TEST(Techniques, AnActorsOwnShaderCodeIsForPlainPointsAndThatIsTold)
{
  Splats scene(surfaceStore("own_shader", planeAt));
  scene.style->LoadJSON(R"({"default": {"technique": "splats", "where": "reach > 0.02"}})");
  const Picture before = scene.with(vtkPointFrontMapper::OPENGL);
  vtkNew<ErrorObserver> told;
  scene.mapper->AddObserver(vtkCommand::WarningEvent, told);
  scene.actor->GetShaderProperty()->AddFragmentShaderReplacement(
    "//VTK::Light::Impl", true, "gl_FragData[0] = vec4(1.0, 0.0, 1.0, 1.0);\n", false);
  for (const int backend : { vtkPointFrontMapper::OPENGL, vtkPointFrontMapper::SOFTWARE })
  {
    EXPECT_LE(differing(before, scene.with(backend), 2), 300) << backend;
  }
  EXPECT_NE(told->GetWarningMessage().find("own shader code is not used"), std::string::npos);
}

TEST(Techniques, CloudsOfAWindowShareItsTarget)
{
  Splats scene(surfaceStore("shared", sphereAt));
  Splats other(surfaceStore("other", planeAt));
  ASSERT_TRUE(scene.style->LoadJSON(techniques.at("blended")));
  scene.mapper->SetBackendToOpenGL();
  other.mapper->SetStyle(scene.style);
  other.renderer->RemoveActor(other.actor);
  scene.renderer->AddActor(other.actor);
  const auto both = [&](int backend)
  {
    other.mapper->SetBackend(backend);
    return scene.with(backend);
  };
  const Picture software = both(vtkPointFrontMapper::SOFTWARE);
  const Picture gl = both(vtkPointFrontMapper::OPENGL);
  EXPECT_LE(differing(software, gl, 2), 300);
  EXPECT_EQ(differing(gl, scene.draw()), 0);
}

TEST(Techniques, AQualitySetsErrorAndTechnique)
{
  Splats scene(surfaceStore("quality", planeAt));
  scene.mapper->SetStyle(nullptr);
  scene.mapper->SetBackendToSoftware();
  vtkIdType points = 0;
  for (const char* name : { "draft", "balanced", "exact" })
  {
    ASSERT_TRUE(scene.mapper->SetQuality(name));
    EXPECT_GT(scene.draw().lit(), 4000) << name;
    EXPECT_GT(scene.mapper->GetLastPointsDrawn(), points) << name;
    points = scene.mapper->GetLastPointsDrawn();
  }
  EXPECT_EQ(scene.mapper->GetTargetError(), 0.5);
  EXPECT_EQ(scene.mapper->GetStyle()->GetTechnique(), "ewa");
  vtkObject::GlobalWarningDisplayOff();
  EXPECT_FALSE(scene.mapper->SetQuality("best"));
  vtkObject::GlobalWarningDisplayOn();
  EXPECT_EQ(scene.mapper->GetTargetError(), 0.5) << "nothing changed";
}

} // namespace
