#include "ErrorObserver.h"
#include "Scene.h"

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
#include <vtkSSAOPass.h>

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

} // namespace
