// Splats on OpenGL are those of the software back end: each technique, on each made-up surface, in
// perspective and parallel views, beside other actors, under selections and with layers of their
// own.

#include "Scene.h"

#include "pointfront/Points/SplatRadius.h"
#include "pointfront/Style/StyleSheet.h"
#include "vtkPointFrontStyle.h"

#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkHardwareSelector.h>
#include <vtkIdTypeArray.h>
#include <vtkPlane.h>
#include <vtkPoints.h>
#include <vtkSelection.h>
#include <vtkSelectionNode.h>
#include <vtkShaderProperty.h>

#include <glm/geometric.hpp>

#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

struct Surfel
{
  glm::dvec3 position;
  glm::dvec3 normal;
};
using Surface = Surfel (*)(double u, double v); ///< u, v in [0, 1]

Surfel planeAt(double u, double v)
{
  return { { 4.0 * u - 2.0, 4.0 * v - 2.0, 0.3 * u },
    glm::normalize(glm::dvec3(-0.075, 0.0, 1.0)) };
}

Surfel sphereAt(double u, double v)
{
  const double height = 2.0 * u - 1.0;
  const double around = 6.283185307 * v;
  const double wide = std::sqrt(1.0 - height * height);
  const glm::dvec3 normal(wide * std::cos(around), wide * std::sin(around), height);
  return { 1.5 * normal, normal };
}

Surfel stairsAt(double u, double v)
{
  const double along = 8.0 * u;
  const double step = std::floor(along);
  const double part = along - step;
  const bool tread = part < 0.5;
  const double x = 0.5 * step + (tread ? part : 0.5);
  const double z = 0.4 * step + (tread ? 0.0 : 0.8 * (part - 0.5));
  return { { x - 2.0, 4.0 * v - 2.0, z - 1.5 },
    tread ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(-1.0, 0.0, 0.0) };
}

/// A roof at a height of 40, and the ground; its walls are 8.3 high (surfaceStore).
Surfel roofAt(double u, double v)
{
  const bool roof = u >= 0.5;
  return { { 4.0 * (roof ? 2.0 * u - 1.0 : 2.0 * u) - 2.0, 4.0 * v - 2.0, roof ? 40.0 : 0.0 },
    { 0.0, 0.0, 1.0 } };
}

/// 40,000 points with normals, radii, sizes, colours and two classes. One in 97 has no normal.
std::string surfaceStore(const std::string& name, Surface surface)
{
  constexpr int side = 200;
  AttributeSchema schema;
  schema.add({ "rgb", ScalarType::UInt8, 3 });
  schema.add({ "classification", ScalarType::UInt8, 1 });
  Attribute normal{ "normal", ScalarType::Int16, 3 };
  normal.scale = 1.0 / 32767.0;
  schema.add(normal);
  schema.add(splatRadiusColumn());
  schema.add({ "reach", ScalarType::Float32, 1 });
  schema.add({ "height_above_ground", ScalarType::Float32, 1 });
  const QuantisationGrid grid = millimetres(glm::dvec3(0.0));
  auto cloud = std::make_unique<CloudSource>(name, schema, grid);
  for (int i = 0; i < side * side; ++i)
  {
    const double u = (i % side + 0.25 * (i / side % 4)) / side;
    const double v = (i / side + 0.5) / side;
    const Surfel surfel = surface(u, v);
    cloud->addPosition(surfel.position);
    const auto byte = [](double x) { return static_cast<std::uint8_t>(255.0 * x); };
    cloud->addValue(0, std::array<std::uint8_t, 3>{ byte(u), byte(v), byte(0.5 * (u + v)) });
    cloud->addValue(1, static_cast<std::uint8_t>(v < 0.5 ? 2 : 6));
    std::array<std::int16_t, 3> stored{};
    for (int axis = 0; axis < 3 && i % 97 != 0; ++axis)
    {
      stored[static_cast<std::size_t>(axis)] =
        static_cast<std::int16_t>(std::lround(32767.0 * surfel.normal[axis]));
    }
    cloud->addValue(2, stored);
    cloud->addValue(3, i % 89 == 0 ? unknownSplatRadius : encodeSplatRadius(0.02 + 0.01 * u, 0.02));
    cloud->addValue(4, static_cast<float>(0.01 + 0.03 * v));
    cloud->addValue(5, static_cast<float>(i % 7 == 0 ? 0.0 : 0.3 + 0.2 * surfel.position.z));
  }
  cloud->editDescription().splatRadiusBase = 0.02;
  BuildOptions options;
  options.outputPath = ::testing::TempDir() + name + ".pfront";
  options.nodePoints = 2000;
  options.overwrite = true;
  options.threads = 1;
  const auto built = buildStore(one(std::move(cloud)), options);
  EXPECT_TRUE(built.ok()) << (built.ok() ? "" : built.error().what);
  return options.outputPath;
}

struct Splats : Scene
{
  vtkNew<vtkPointFrontStyle> style;

  explicit Splats(const std::string& store)
    : Scene(store)
  {
    lookFrom({ 3.0, -5.0, 4.0 }, { 0.0, 0.0, 0.0 });
    mapper->SetStyle(style);
    mapper->SetTargetError(2.0);
  }
  Picture with(int backend)
  {
    mapper->SetBackend(backend);
    return draw();
  }
  /// Nearly all pixels alike; the rest are those where two splats are equally near but for
  /// rounding, and rims.
  void expectAlike(const std::string& what, int tolerance = 2)
  {
    constexpr double share = 0.995;
    const Picture software = with(vtkPointFrontMapper::SOFTWARE);
    const Picture gl = with(vtkPointFrontMapper::OPENGL);
    const double pixels = static_cast<double>(gl.width) * gl.height;
    EXPECT_GT(gl.lit(), 4000) << what;
    EXPECT_LE(differing(software, gl, tolerance), (1.0 - share) * pixels) << what;
  }
  void setParallel(bool parallel)
  {
    renderer->GetActiveCamera()->SetParallelProjection(parallel);
    renderer->GetActiveCamera()->SetParallelScale(2.2);
  }
};

const std::map<std::string, std::string> techniques = {
  { "squares", R"({"default": {"technique": "points", "size": {"mode": "fixed", "px": 3}},
     "shading": {"mode": "edl", "strength": 0.4}})" },
  { "discs", R"({"default": {"technique": "points"}})" },
  { "splats", R"({"default": {"technique": "splats"}})" },
  { "blended", R"({"default": {"technique": "splats", "blended": true}})" },
  { "paraboloids", R"({"default": {"technique": "splats", "orientation": "view"}})" },
  { "fixed", R"({"default": {"technique": "splats", "orientation": [0.1, 0.2, 1]}})" },
  { "spheres", R"({"default": {"technique": "spheres"}})" },
  { "silhouettes", R"({"default": {"technique": "silhouettes"}})" },
  { "facing silhouettes", R"({"default": {"technique": "silhouettes", "orientation": "view",
     "rim_color": "#8020c0"}, "shading": {"mode": "edl"}})" },
  { "exact silhouettes", R"({"default": {"technique": "silhouettes", "accuracy": "exact",
     "size": {"mode": "fixed", "metres": 0.2}}})" },
  { "solid", R"({"default": {"technique": "solid", "wall_color": ["#f0e0d0", "#103060"]}})" },
  { "facing solid", R"({"default": {"technique": "solid", "orientation": "view"}})" },
  { "lit solid", R"({"default": {"technique": "solid", "wall_color": "#a0a0a0"},
     "shading": {"mode": "lit"}})" },
  { "solid class", R"({"default": {"technique": "ewa"}, "classes": {"6": {"technique": "solid",
     "color": "#ff8000"}, "2": {"technique": "silhouettes"}}})" },
  { "ewa", R"({"default": {"technique": "ewa"}})" },
  { "ewa exact", R"({"default": {"technique": "ewa", "accuracy": "exact"}})" },
  { "ewa full", R"({"default": {"technique": "ewa", "accuracy": "full"}})" },
  { "lit", R"({"default": {"technique": "spheres"}, "shading": {"mode": "lit"}})" },
  { "lit ewa", R"({"default": {"technique": "ewa"}, "shading": {"mode": "lit"}})" },
  { "metres", R"({"default": {"technique": "splats", "size": {"mode": "fixed", "metres": 0.1}}})" },
  { "sizes", R"({"default": {"technique": "splats",
     "size": {"mode": "attribute", "attribute": "reach"}}})" },
  { "elevation", R"({"default": {"technique": "splats", "color": "elevation"}})" },
  { "table", R"({"default": {"technique": "ewa", "color": "classification"}})" },
  { "constant", R"({"default": {"technique": "splats", "color": "#4080c0"}})" },
  { "two colours", R"({"default": {"technique": "splats",
     "color": {"multiply": ["rgb", "classification"]}}})" },
  { "classes", R"({"default": {"technique": "ewa"}, "classes": {"6": {"technique": "spheres",
     "color": "#ff8000", "size": {"mode": "spacing", "factor": 1.5}}}})" },
  { "filtered", R"({"default": {"technique": "splats", "where": "reach in [0.015, 0.03]"}})" },
};

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
  vtkNew<vtkPoints> corners; // of a wall through the surface
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

/// Points and triangles that a frame hands to GL.
int primitivesOf(Scene& scene)
{
  scene.window->MakeCurrent();
  GLuint query = 0;
  glGenQueries(1, &query);
  glBeginQuery(GL_PRIMITIVES_GENERATED, query);
  scene.window->Render();
  glEndQuery(GL_PRIMITIVES_GENERATED);
  GLuint count = 0;
  glGetQueryObjectuiv(query, GL_QUERY_RESULT, &count);
  glDeleteQueries(1, &query);
  return static_cast<int>(count);
}

// Such an actor was drawn as plain points without the style's filters, and nothing was said.
TEST(Techniques, AnActorsOwnShaderCodeIsForPlainPointsAndThatIsTold)
{
  Splats scene(surfaceStore("own_shader", planeAt));
  scene.style->LoadJSON(R"({"default": {"technique": "splats", "where": "reach > 0.02"}})");
  const Picture before = scene.with(vtkPointFrontMapper::OPENGL);
  std::string warning;
  vtkNew<vtkCallbackCommand> told;
  told->SetClientData(&warning);
  told->SetCallback([](vtkObject*, unsigned long, void* client, void* data)
    { *static_cast<std::string*>(client) += static_cast<const char*>(data); });
  scene.mapper->AddObserver(vtkCommand::WarningEvent, told);
  scene.actor->GetShaderProperty()->AddFragmentShaderReplacement(
    "//VTK::Light::Impl", true, "gl_FragData[0] = vec4(1.0, 0.0, 1.0, 1.0);\n", false);
  for (const int backend : { vtkPointFrontMapper::OPENGL, vtkPointFrontMapper::SOFTWARE })
  {
    EXPECT_LE(differing(before, scene.with(backend), 2), 300) << backend;
  }
  EXPECT_NE(warning.find("own shader code is not used"), std::string::npos);
}

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
    EXPECT_LE(differing(atOneGo, scene.read(), 2), 60) << name; // equally near: who came first
  }
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

TEST(Techniques, LeaveNoNamesBehind)
{
  Splats scene(surfaceStore("names", planeAt));
  ASSERT_TRUE(scene.style->LoadJSON(techniques.at("lit ewa")));
  const auto names = [&]
  {
    scene.window->MakeCurrent();
    int live = 0;
    for (GLuint name = 1; name < 4096; ++name)
    {
      live += glIsTexture(name) == GL_TRUE || glIsVertexArray(name) == GL_TRUE ||
          glIsFramebuffer(name) == GL_TRUE || glIsBuffer(name) == GL_TRUE
        ? 1
        : 0;
    }
    return live;
  };
  scene.actor->VisibilityOff();
  scene.draw();
  const int before = names();
  scene.actor->VisibilityOn();
  const Picture picture = scene.with(vtkPointFrontMapper::OPENGL);
  EXPECT_GT(names(), before + 8);
  scene.actor->ReleaseGraphicsResources(scene.window);
  EXPECT_EQ(names(), before);
  EXPECT_EQ(differing(picture, scene.draw()), 0);
  scene.actor->SetMapper(nullptr);
  scene.mapper = nullptr;
  EXPECT_EQ(names(), before);
}

} // namespace
