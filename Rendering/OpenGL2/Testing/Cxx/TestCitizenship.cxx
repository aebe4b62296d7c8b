#include "ErrorObserver.h"
#include "Scene.h"
#include "vtkPointFrontStyle.h"

#include <vtkAssembly.h>
#include <vtkCameraPass.h>
#include <vtkEDLShading.h>
#include <vtkFieldData.h>
#include <vtkHardwareSelector.h>
#include <vtkIdTypeArray.h>
#include <vtkLookupTable.h>
#include <vtkOpenGLRenderer.h>
#include <vtkOpenGLState.h>
#include <vtkPointData.h>
#include <vtkRenderStepsPass.h>
#include <vtkSelection.h>
#include <vtkSelectionNode.h>
#include <vtkSphereSource.h>
#include <vtkSSAOPass.h>

#include <limits>
#include <sstream>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

TEST(Citizenship, TheFactoryGivesTheOpenGLMapper)
{
  auto mapper = vtkSmartPointer<vtkPointFrontMapper>::New();
  EXPECT_TRUE(mapper->IsA("vtkOpenGLPointFrontMapper"));
  EXPECT_TRUE(mapper->IsA("vtkPolyDataMapper"));
}

TEST(Citizenship, OpacityBlendsAndDepthPeelingSorts)
{
  for (const bool peeling : { false, true })
  {
    Scene scene(planeStore("opacity", 3, 500));
    scene.actor->GetProperty()->SetPointSize(9);
    scene.actor->GetProperty()->SetOpacity(0.5);
    scene.renderer->SetBackground(0.0, 0.0, 1.0);
    scene.renderer->SetUseDepthPeeling(peeling);
    const auto p = scene.project({ 0.5, 0.5, 0.0 });
    const Picture picture = scene.draw();
    const auto colour = picture.at(static_cast<int>(p[0]), static_cast<int>(p[1]));
    EXPECT_NEAR(colour[0], 128, 2) << "peeling " << peeling;
    EXPECT_NEAR(colour[2], 255, 2) << "peeling " << peeling;
    EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), 9);
  }
}

TEST(Citizenship, ATransparentTableMakesTheActorTranslucent)
{
  Scene scene(planeStore("translucent", 3, 500));
  scene.mapper->GetBounds();
  EXPECT_FALSE(scene.actor->HasTranslucentPolygonalGeometry());
  vtkNew<vtkLookupTable> table;
  table->SetAlphaRange(0.3, 1.0);
  table->Build();
  scene.mapper->SetLookupTable(table);
  scene.mapper->SetScalarModeToUsePointFieldData();
  scene.mapper->SelectColorArray("classification");
  EXPECT_TRUE(scene.actor->HasTranslucentPolygonalGeometry());
}

namespace
{

/// Pixels of a plane of 9 points in either back end, coloured by a table.
void expectColour(const std::function<void(Scene&)>& change, const std::array<int, 3>& colour)
{
  for (const int backend : { vtkPointFrontMapper::OPENGL, vtkPointFrontMapper::SOFTWARE })
  {
    Scene scene(planeStore("tabled", 3, 500));
    scene.mapper->SetBackend(backend);
    scene.actor->GetProperty()->SetPointSize(9);
    scene.mapper->SetColorModeToMapScalars();
    scene.mapper->SetScalarModeToUsePointFieldData();
    change(scene);
    const auto p = scene.project({ 0.5, 0.5, 0.0 });
    const auto seen = scene.draw().at(static_cast<int>(p[0]), static_cast<int>(p[1]));
    for (std::size_t c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(seen[c], colour[c], 2) << backend << ", " << c;
    }
  }
}

vtkNew<vtkLookupTable> redToBlue()
{
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(2);
  table->SetTableValue(0, 1.0, 0.0, 0.0, 1.0);
  table->SetTableValue(1, 0.0, 0.0, 1.0, 1.0);
  return table;
}

} // namespace

/// VTK maps with the property's opacity in place of the table's.
TEST(Citizenship, TheAlphaOfATableDoesNotCount)
{
  const auto fill = [](Scene& scene)
  {
    const auto table = redToBlue();
    table->SetAlpha(0.5);
    scene.mapper->SetLookupTable(table);
    scene.mapper->SetScalarRange(-1.0, 1.0);
    scene.mapper->SelectColorArray("gps_time");
  };
  expectColour(fill, { 0, 0, 255 });
  const auto forced = [&](Scene& scene)
  {
    fill(scene);
    scene.actor->GetProperty()->SetOpacity(0.5);
    scene.actor->ForceOpaqueOn();
  };
  expectColour(forced, { 0, 0, 128 }); // VTK blends it over the background
}

TEST(Citizenship, ARangeOfOneValueHasTwoColours)
{
  for (const double value : { 0.25, 0.5, 0.75 })
  {
    const auto fill = [&](Scene& scene)
    {
      scene.mapper->SetLookupTable(redToBlue());
      scene.mapper->SetScalarRange(value, value);
      scene.mapper->SelectColorArray("gps_time");
    };
    const bool above = 0.5 > value;
    expectColour(fill, { above ? 0 : 255, 0, above ? 255 : 0 });
  }
}

TEST(Citizenship, HardwareSelectionGivesTheIdInTheStore)
{
  Scene scene(planeStore("selected", 101, 20));
  scene.draw();
  // The overview of all points has the ids of the store as global ids, in the same order.
  scene.reader->SetOverviewPoints(1000000);
  scene.reader->Update();
  vtkPolyData* all = scene.reader->GetOutput();
  auto* ids = vtkIdTypeArray::SafeDownCast(all->GetPointData()->GetGlobalIds());
  ASSERT_NE(ids, nullptr);
  for (const glm::dvec3& at : { glm::dvec3(0.4, -0.2, 0.0), glm::dvec3(-0.8, 0.6, 0.0) })
  {
    const auto p = scene.project(at);
    vtkNew<vtkHardwareSelector> selector;
    selector->SetRenderer(scene.renderer);
    const auto x = static_cast<unsigned int>(p[0]);
    const auto y = static_cast<unsigned int>(p[1]);
    selector->SetArea(x, y, x, y);
    selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_POINTS);
    const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
    ASSERT_EQ(selection->GetNumberOfNodes(), 1u);
    auto* list = vtkIdTypeArray::SafeDownCast(selection->GetNode(0)->GetSelectionList());
    ASSERT_EQ(list->GetNumberOfValues(), 1);
    const vtkIdType index = ids->LookupValue(list->GetValue(0));
    ASSERT_GE(index, 0);
    double found[3];
    all->GetPoint(index, found);
    EXPECT_NEAR(found[0], at.x, 0.03); // a pixel
    EXPECT_NEAR(found[1], at.y, 0.03);
  }
}

TEST(Citizenship, EyeDomeLightingAndAmbientOcclusionPassesWork)
{
  Scene scene(planeStore("passes", 201, 10));
  const Picture plain = scene.draw();
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkEDLShading> edl;
  edl->SetDelegatePass(steps);
  static_cast<vtkOpenGLRenderer*>(scene.renderer.GetPointer())->SetPass(edl);
  const Picture shaded = scene.draw();
  EXPECT_GT(shaded.lit(), plain.lit() * 9 / 10);
  EXPECT_GT(differing(plain, shaded, 8), 50); // the border of the plane is shaded
  vtkNew<vtkSSAOPass> ssao;
  ssao->SetDelegatePass(steps);
  static_cast<vtkOpenGLRenderer*>(scene.renderer.GetPointer())->SetPass(ssao);
  EXPECT_GT(scene.draw().lit(), plain.lit() * 9 / 10);
  edl->ReleaseGraphicsResources(scene.window);
  ssao->ReleaseGraphicsResources(scene.window);
}

TEST(Citizenship, PointsAsSpheresAreLit)
{
  Scene scene(planeStore("spheres", 1, 500));
  scene.actor->GetProperty()->SetPointSize(31);
  scene.actor->GetProperty()->RenderPointsAsSpheresOn();
  const Picture picture = scene.draw();
  const auto middle = picture.at(150, 100)[0];
  EXPECT_GT(middle, 200);
  EXPECT_LT(picture.at(150 + 13, 100)[0], middle - 50);
  EXPECT_EQ(picture.at(150 + 14, 100 + 14)[0], 0); // round
}

TEST(Citizenship, TheStateOfOtherActorsIsLeftAlone)
{
  Scene scene(planeStore("state", 50, 20));
  Scene other(planeStore("state_other", 3, 500));
  other.actor->GetProperty()->SetPointSize(5);
  other.actor->SetMapper(other.inMemory());
  const Picture alone = other.draw();
  // Ours is drawn first, far behind; the other must look as it did.
  scene.actor->SetPosition(0.0, 0.0, -30.0);
  scene.actor->SetScale(0.001);
  scene.mapper->SetPointSize(11);
  other.renderer->RemoveActor(other.actor);
  other.renderer->AddActor(scene.actor);
  other.renderer->AddActor(other.actor);
  const Picture both = other.draw();
  int outside = 0;
  for (int y = 0; y < 200; ++y)
  {
    for (int x = 0; x < 300; ++x)
    {
      const bool middle = std::abs(x - 150) < 8 && std::abs(y - 100) < 8;
      outside += middle || both.at(x, y) == alone.at(x, y) ? 0 : 1;
    }
  }
  EXPECT_EQ(outside, 0);
  EXPECT_EQ(alone.lit(), 9 * 25);
}

/// VTK's mappers draw points whatever the property says of faces.
TEST(Citizenship, PointsHaveNoFacesToCull)
{
  for (const std::string technique : { "", "splats", "ewa" })
  {
    for (const int backend : { vtkPointFrontMapper::OPENGL, vtkPointFrontMapper::SOFTWARE })
    {
      Scene scene(planeStore("faces", 30, 50));
      scene.mapper->SetBackend(backend);
      vtkNew<vtkPointFrontStyle> style;
      const std::string sheet = R"({"default": {"technique": ")" + technique +
        R"(", "size": {"mode": "fixed", "metres": 0.2}}})";
      ASSERT_TRUE(technique.empty() || style->LoadJSON(sheet));
      scene.mapper->SetStyle(technique.empty() ? nullptr : style.GetPointer());
      const Picture usual = scene.draw();
      EXPECT_GT(usual.lit(), 800);
      vtkProperty* const property = scene.actor->GetProperty();
      auto* const window = vtkOpenGLRenderWindow::SafeDownCast(scene.window);
      for (const int sides : { 1, 2, 3 })
      {
        property->SetFrontfaceCulling(sides & 1);
        property->SetBackfaceCulling(sides >> 1);
        EXPECT_EQ(differing(scene.draw(), usual), 0) << technique << backend << sides;
        EXPECT_EQ(window->GetState()->GetEnumState(GL_CULL_FACE), glIsEnabled(GL_CULL_FACE) != 0);
      }
    }
  }
}

TEST(Citizenship, AnInputWithoutAStoreIsAnErrorNotACrash)
{
  Scene scene(planeStore("no_store", 3, 500));
  scene.reader->Update();
  vtkNew<vtkPolyData> nameless;
  nameless->DeepCopy(scene.reader->GetOutput());
  nameless->GetFieldData()->Initialize();
  scene.mapper->SetInputData(nameless);
  vtkNew<ErrorObserver> errors;
  scene.mapper->AddObserver(vtkCommand::ErrorEvent, errors);
  EXPECT_EQ(scene.draw().lit(), 0);
  EXPECT_TRUE(errors->GetError());
  EXPECT_NE(errors->GetErrorMessage().find("names no store"), std::string::npos);
  errors->Clear();
  EXPECT_EQ(scene.draw().lit(), 0);
  EXPECT_FALSE(errors->GetError()) << "once a cause";
}

TEST(Citizenship, AnUnknownAttributeIsNamedInAWarning)
{
  Scene scene(planeStore("unknown", 3, 500));
  scene.mapper->SetScalarModeToUsePointFieldData();
  scene.mapper->SelectColorArray("temperature");
  vtkNew<ErrorObserver> warnings;
  scene.mapper->AddObserver(vtkCommand::WarningEvent, warnings);
  EXPECT_EQ(scene.draw().lit(), 9); // drawn in the property's colour
  EXPECT_NE(warnings->GetWarningMessage().find("temperature"), std::string::npos);
}

/// A cloud in an assembly before another part: vtkAssembly draws by going through its paths.
TEST(Citizenship, AnAssemblyDrawsItsCloudAndWhatFollows)
{
  for (const int backend : { vtkPointFrontMapper::OPENGL, vtkPointFrontMapper::SOFTWARE })
  {
    Scene scene(planeStore("assembled", 101, 20));
    scene.mapper->SetBackend(backend);
    const int alone = static_cast<int>(scene.draw().lit());
    vtkNew<vtkSphereSource> ball;
    ball->SetCenter(0.0, 0.0, 0.5);
    ball->SetRadius(0.2);
    vtkNew<vtkPolyDataMapper> ballMapper;
    ballMapper->SetInputConnection(ball->GetOutputPort());
    vtkNew<vtkActor> ballActor;
    ballActor->SetMapper(ballMapper);
    vtkNew<vtkAssembly> assembly;
    assembly->AddPart(scene.actor);
    assembly->AddPart(ballActor);
    scene.renderer->RemoveActor(scene.actor);
    scene.renderer->AddActor(assembly);
    for (int frame = 0; frame < 3; ++frame)
    {
      EXPECT_GE(scene.draw().lit(), alone * 9 / 10) << backend;
    }
  }
}

TEST(Citizenship, AFlattenedActorIsSeen)
{
  for (const int backend : { vtkPointFrontMapper::OPENGL, vtkPointFrontMapper::SOFTWARE })
  {
    Scene scene(planeStore("flattened", 101, 20));
    scene.mapper->SetBackend(backend);
    const auto whole = scene.draw().lit();
    for (const double height : { 0.0, 1e-300 })
    {
      scene.actor->SetScale(1.0, 1.0, height); // it is a plane
      EXPECT_EQ(scene.draw().lit(), whole) << backend << ", " << height;
    }
  }
}

TEST(Citizenship, AnInputThatIsTakenAwayLeavesNothing)
{
  Scene scene(planeStore("taken", 3, 500));
  scene.draw();
  EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), 9);
  vtkNew<vtkPolyData> nameless;
  scene.mapper->SetInputData(nameless);
  EXPECT_EQ(scene.draw().lit(), 0);
  EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), 0);
}

TEST(Citizenship, ACopyHasAllSettings)
{
  vtkNew<vtkPointFrontStyle> style;
  const auto mapper = vtkSmartPointer<vtkPointFrontMapper>::New();
  mapper->SetPointSize(3.0);
  mapper->SetTargetError(2.0);
  mapper->CompleteOn();
  mapper->SetPointBudget(7);
  mapper->SetGPUMemoryBudget(1 << 20);
  mapper->SetBackendToOpenGL();
  mapper->SetDetailSelectionToViewSpecific();
  mapper->SetGrowthTime(9.0);
  mapper->SetClassVisibility(2, false);
  mapper->SetStyle(style);
  mapper->SelectColorArray("intensity");
  const auto copy = vtkSmartPointer<vtkPointFrontMapper>::New();
  copy->ShallowCopy(mapper);
  std::ostringstream said, expected;
  copy->PrintSelf(said, vtkIndent());
  mapper->PrintSelf(expected, vtkIndent());
  const auto settings = [](const std::string& text)
  { return text.substr(text.find("TargetError")); };
  EXPECT_EQ(settings(said.str()), settings(expected.str()));
  EXPECT_FALSE(copy->GetClassVisibility(2));
  EXPECT_EQ(copy->GetStyle(), style);
  EXPECT_STREQ(copy->GetArrayName(), "intensity");
}

TEST(Citizenship, ATargetErrorIsANumber)
{
  const auto mapper = vtkSmartPointer<vtkPointFrontMapper>::New();
  vtkNew<ErrorObserver> errors;
  mapper->AddObserver(vtkCommand::ErrorEvent, errors);
  mapper->SetTargetError(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(errors->GetError());
  EXPECT_EQ(mapper->GetTargetError(), 1.0);
  mapper->SetTargetError(1e9);
  EXPECT_EQ(mapper->GetTargetError(), 1000.0);
}

} // namespace
