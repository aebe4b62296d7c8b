// Clouds among what else applications put into a scene: shadows, other actors, filters, tables.
#include "ErrorObserver.h"
#include "Sheet.h"
#include "vtkPointFrontStyle.h"

#include <vtkElevationFilter.h>
#include <vtkLight.h>
#include <vtkLookupTable.h>
#include <vtkMaskPoints.h>
#include <vtkPlaneSource.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

constexpr int bothBackEnds[] = { vtkPointFrontMapper::OPENGL, vtkPointFrontMapper::SOFTWARE };

/// Draws a check in both back ends, as plain points and by a style.
void inAllWays(const std::function<void(Scene&, const std::string&)>& check, double opacity = 1.0)
{
  for (const int backend : bothBackEnds)
  {
    for (const bool styled : { false, true })
    {
      Scene scene(planeStore("scenes", 101, 20)); // a square of two metres
      scene.mapper->SetBackend(backend);
      scene.actor->GetProperty()->SetPointSize(3);
      if (styled)
      {
        vtkNew<vtkPointFrontStyle> style;
        style->SetTechnique("splats");
        style->SetOpacity(opacity);
        scene.mapper->SetStyle(style);
      }
      check(scene,
        std::string(backend == vtkPointFrontMapper::OPENGL ? "OpenGL" : "software") +
          (styled ? ", styled" : ", plain"));
    }
  }
}

/// A red square about the z axis.
vtkSmartPointer<vtkActor> redSquare(double side, double z)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-side / 2, -side / 2, z);
  plane->SetPoint1(side / 2, -side / 2, z);
  plane->SetPoint2(-side / 2, side / 2, z);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(plane->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(1.0, 0.0, 0.0);
  return actor;
}

/// Pixels that are red alone.
int redOf(const Picture& picture)
{
  int red = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
  {
    red += picture.rgb[i] > 100 && picture.rgb[i + 1] < 50 ? 1 : 0;
  }
  return red;
}

/// Pixels with green, which red squares do not have.
int greenOf(const Picture& picture)
{
  int green = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
  {
    green += picture.rgb[i + 1] > 100 ? 1 : 0;
  }
  return green;
}

/// VTK's points are not lit; what lies behind them may be in the shadow of other things.
TEST(Scenes, ShadowsLeaveThePointsAsTheyAre)
{
  inAllWays(
    [](Scene& scene, const std::string& way)
    {
      scene.renderer->AddActor(redSquare(6.0, -1.0));
      vtkNew<vtkLight> light;
      light->SetPositional(1);
      light->SetConeAngle(40.0);
      light->SetPosition(0.0, 4.0, 12.0);
      light->SetFocalPoint(0.0, 0.0, 0.0);
      scene.renderer->RemoveAllLights();
      scene.renderer->AddLight(light);
      scene.lookFrom({ 0.0, -6.0, 8.0 }, glm::dvec3(0.0));
      const Picture without = scene.draw();
      scene.renderer->UseShadowsOn();
      for (int frame = 0; frame < 2; ++frame)
      {
        const Picture with = scene.draw();
        EXPECT_GT(greenOf(without), 3000) << way;
        EXPECT_EQ(greenOf(with), greenOf(without)) << way;
        EXPECT_GT(redOf(with), 3000) << way;
        EXPECT_TRUE(scene.mapper->GetLastComplete()) << way;
      }
    });
}

/// The front of each actor has the points of its own view.
TEST(Scenes, AMapperDrawsAllPointsInEachOfItsActors)
{
  inAllWays(
    [](Scene& scene, const std::string& way)
    {
      scene.mapper->SetTargetError(0.5);
      scene.lookFrom({ 1.5, 0.0, 3.0 }, { 1.5, 0.0, 0.0 }); // the first one half outside
      vtkNew<vtkActor> second;
      second->SetMapper(scene.mapper);
      second->SetPosition(2.5, 0.0, 0.0);
      second->GetProperty()->SetPointSize(3);
      scene.actor->SetVisibility(false);
      scene.renderer->AddActor(second);
      const int alone = scene.draw().lit();
      const vtkIdType ofSecond = scene.mapper->GetLastPointsDrawn();
      scene.renderer->RemoveActor(second);
      scene.actor->SetVisibility(true);
      const int first = scene.draw().lit();
      const vtkIdType ofFirst = scene.mapper->GetLastPointsDrawn();
      scene.renderer->AddActor(second);
      const Picture both = scene.draw();
      EXPECT_GT(alone, 8000) << way;
      EXPECT_GT(first, 2000) << way;
      EXPECT_EQ(both.lit(), first + alone) << way;
      EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), ofFirst + ofSecond) << way;
      EXPECT_EQ(differing(both, scene.draw()), 0) << way << ", another frame";
      EXPECT_TRUE(scene.mapper->GetLastComplete()) << way;
      scene.window->SetDesiredUpdateRate(10.0); // in motion, each goes on from its own last frame
      for (const double x : { 1.4, 1.45, 1.5 })
      {
        scene.lookFrom({ x, 0.0, 3.0 }, { x, 0.0, 0.0 });
        EXPECT_GT(scene.draw().lit(), both.lit() / 2) << way;
      }
      scene.window->SetDesiredUpdateRate(0.001);
      EXPECT_EQ(differing(both, scene.draw()), 0) << way << ", at rest";
      scene.renderer->RemoveActor(scene.actor);
      EXPECT_EQ(scene.draw().lit(), alone) << way << ", one left";
      EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), ofSecond) << way;
    });
}

/// Coincident topology moves depths towards the eye, and nothing else.
TEST(Scenes, AnOffsetBringsPointsBeforeASurface)
{
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  inAllWays(
    [](Scene& scene, const std::string& way)
    {
      const auto surface = redSquare(3.0, 0.05); // 2.5e-4 of the depths' range before the points
      surface->GetMapper()->SetRelativeCoincidentTopologyPolygonOffsetParameters(-2.0, -2.0);
      scene.renderer->AddActor(surface);
      scene.mapper->SetRelativeCoincidentTopologyPointOffsetParameter(8.0); // none in all
      EXPECT_EQ(greenOf(scene.draw()), 0) << way;
      scene.mapper->SetRelativeCoincidentTopologyPointOffsetParameter(-30.0);
      EXPECT_GT(greenOf(scene.draw()), 5000) << way;
    });
  vtkMapper::SetResolveCoincidentTopologyToOff();
  inAllWays(
    [](Scene& scene, const std::string& way)
    {
      scene.renderer->AddActor(redSquare(3.0, 0.05));
      scene.mapper->SetRelativeCoincidentTopologyPointOffsetParameter(-30.0);
      EXPECT_EQ(greenOf(scene.draw()), 0) << way << ", switched off";
    });
}

/// A style says how points are drawn; a table that is left over does not count.
TEST(Scenes, ATransparentTableBesideAStyleIsNothing)
{
  for (const int backend : bothBackEnds)
  {
    Scene scene(planeStore("left_over", 101, 20));
    scene.mapper->SetBackend(backend);
    vtkNew<vtkLookupTable> table;
    table->SetAlphaRange(0.2, 1.0);
    table->Build();
    scene.mapper->SetLookupTable(table);
    scene.mapper->SetScalarModeToUsePointFieldData();
    scene.mapper->SelectColorArray("classification");
    scene.mapper->GetBounds();
    EXPECT_TRUE(scene.actor->HasTranslucentPolygonalGeometry()) << backend;
    vtkNew<vtkPointFrontStyle> style;
    style->SetTechnique("splats");
    scene.mapper->SetStyle(style);
    EXPECT_FALSE(scene.actor->HasTranslucentPolygonalGeometry()) << backend;
    vtkNew<ErrorObserver> warnings;
    scene.mapper->AddObserver(vtkCommand::WarningEvent, warnings);
    EXPECT_GT(scene.draw().lit(), 3000) << backend;
    EXPECT_FALSE(warnings->GetWarning()) << warnings->GetWarningMessage();
  }
}

/// Whether a mapper warns of an input, in one of several frames.
int warningsOf(Scene& scene, std::string& said)
{
  int count = 0;
  vtkNew<ErrorObserver> warnings;
  const unsigned long tag = scene.mapper->AddObserver(vtkCommand::WarningEvent, warnings);
  for (int frame = 0; frame < 3; ++frame)
  {
    warnings->Clear();
    scene.draw();
    count += warnings->GetWarning() ? 1 : 0;
    said += warnings->GetWarningMessage();
  }
  scene.mapper->RemoveObserver(tag);
  return count;
}

TEST(Scenes, AFilterThatChangesPointsIsToldOf)
{
  Scene scene(planeStore("filtered", 101, 20));
  std::string said;
  EXPECT_EQ(warningsOf(scene, said), 0) << said;
  vtkNew<vtkMaskPoints> some;
  some->SetInputConnection(scene.reader->GetOutputPort());
  scene.mapper->SetInputConnection(some->GetOutputPort());
  EXPECT_EQ(warningsOf(scene, said), 1) << "once";
  EXPECT_NE(said.find("filter"), std::string::npos) << said;
  scene.mapper->SetInputConnection(scene.reader->GetOutputPort());
  EXPECT_EQ(warningsOf(scene, said), 0) << said;
  vtkNew<vtkPolyData> moved; // by hand, without a pipeline
  scene.reader->Update();
  moved->DeepCopy(scene.reader->GetOutput());
  for (vtkIdType i = 0; i < moved->GetNumberOfPoints(); ++i)
  {
    const double* const at = moved->GetPoint(i);
    moved->GetPoints()->SetPoint(i, at[0] + 3.0, at[1], at[2]);
  }
  moved->GetPoints()->Modified();
  scene.mapper->SetInputData(moved);
  EXPECT_EQ(warningsOf(scene, said), 1) << "once";
}

TEST(Scenes, WhatKeepsThePointsIsNotToldOf)
{
  Scene scene(planeStore("kept_points", 101, 20));
  std::string said;
  vtkNew<vtkElevationFilter> heights;
  heights->SetInputConnection(scene.reader->GetOutputPort());
  scene.mapper->SetInputConnection(heights->GetOutputPort());
  EXPECT_EQ(warningsOf(scene, said), 0) << said;
  vtkNew<vtkPolyData> handed;
  handed->ShallowCopy(scene.reader->GetOutput());
  scene.mapper->SetInputData(handed);
  EXPECT_EQ(warningsOf(scene, said), 0) << said;
  scene.reader->SetOverviewPoints(0);
  scene.mapper->SetInputConnection(scene.reader->GetOutputPort());
  EXPECT_EQ(warningsOf(scene, said), 0) << said;
  scene.mapper->SetInputConnection(heights->GetOutputPort());
  EXPECT_EQ(warningsOf(scene, said), 0) << said;
}

TEST(Scenes, ColoursThatVTKWouldMakeOtherwiseAreToldOf)
{
  Scene scene(planeStore("otherwise", 101, 20));
  scene.mapper->SetScalarModeToUsePointFieldData();
  scene.mapper->SelectColorArray("classification");
  std::string said;
  EXPECT_EQ(warningsOf(scene, said), 0) << said;
  scene.mapper->SetColorModeToDirectScalars();
  EXPECT_EQ(warningsOf(scene, said), 1) << "once";
  EXPECT_NE(said.find("classification"), std::string::npos) << said;
  said.clear();
  scene.mapper->SetColorModeToMapScalars();
  scene.mapper->SelectColorArray("rgb");
  scene.mapper->SetArrayComponent(-1);
  scene.mapper->GetLookupTable()->SetVectorModeToMagnitude();
  EXPECT_EQ(warningsOf(scene, said), 0) << said;
  scene.mapper->GetLookupTable()->SetVectorSize(2);
  EXPECT_EQ(warningsOf(scene, said), 1) << "once";
  EXPECT_NE(said.find("VectorSize"), std::string::npos) << said;
}

} // namespace
