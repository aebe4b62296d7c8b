#include "Sheet.h"

#include <vtkDepthPeelingPass.h>
#include <vtkHardwareSelector.h>
#include <vtkIdTypeArray.h>
#include <vtkSelection.h>
#include <vtkSelectionNode.h>
#include <vtkTransform.h>

#include <functional>
#include <set>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

TEST(Views, TwoViewsOfOneCloudShareWhatIsLoaded)
{
  Scene scene(planeStore("two_views", 150, 13));
  const Picture alone = scene.draw();
  const auto resident = scene.mapper->GetStore()->GetResidency().statistics().requested;

  vtkNew<vtkRenderer> right;
  right->AddActor(scene.actor);
  right->GetActiveCamera()->DeepCopy(scene.renderer->GetActiveCamera());
  right->SetViewport(0.5, 0.0, 1.0, 1.0);
  scene.renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  scene.window->AddRenderer(right);
  scene.window->SetSize(600, 200);
  const Picture both = scene.draw();
  EXPECT_EQ(scene.mapper->GetStore()->GetResidency().statistics().requested, resident);
  int different = 0;
  for (int y = 0; y < 200; ++y)
  {
    for (int x = 0; x < 300; ++x)
    {
      different += both.at(x, y) == alone.at(x, y) ? 0 : 1;
      different += both.at(x + 300, y) == alone.at(x, y) ? 0 : 1;
    }
  }
  EXPECT_EQ(different, 0);
  EXPECT_GT(alone.lit(), 5000);
}

TEST(Views, TwoCloudsInAViewHideEachOtherByDepth)
{
  const auto plane = [](const std::string& name, int z, std::uint8_t red)
  {
    return storeOf(name, 201 * 201,
      [=](std::size_t i)
      {
        Sample sample;
        sample.position = { static_cast<int>(i % 201) * 10 - 1000,
          static_cast<int>(i / 201) * 10 - 1000, z };
        sample.rgb = { red, 0, 0 };
        return sample;
      });
  };
  Scene scene(plane("lower", 0, 50));
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(plane("upper", 500, 250).c_str());
  auto mapper = vtkSmartPointer<vtkPointFrontMapper>::New();
  mapper->SetInputConnection(reader->GetOutputPort());
  mapper->CompleteOn();
  mapper->SetTargetError(0.05);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  scene.renderer->AddActor(actor);
  EXPECT_EQ(scene.draw().at(150, 100)[0], 250);
  scene.lookFrom({ 0.0, 0.0, -10.0 }, { 0.0, 0.0, 0.0 });
  EXPECT_EQ(scene.draw().at(150, 100)[0], 50);
}

TEST(Views, ResizingGivesThePictureOfANewWindow)
{
  const auto store = planeStore("resized", 150, 13);
  Scene scene(store);
  scene.draw();
  scene.window->SetSize(420, 280);
  const Picture resized = scene.draw();
  Scene fresh(store);
  fresh.window->SetSize(420, 280);
  EXPECT_EQ(differing(resized, fresh.draw()), 0);
  EXPECT_GT(resized.lit(), 5000);
}

TEST(Views, AfterReleasingTheResourcesThePictureIsTheSame)
{
  Scene scene(planeStore("released", 150, 13));
  const Picture before = scene.draw();
  scene.actor->ReleaseGraphicsResources(scene.window);
  EXPECT_EQ(differing(before, scene.draw()), 0);
}

TEST(Views, AMapperMovesToAnotherWindow)
{
  Scene scene(planeStore("moved_window", 150, 13));
  const Picture before = scene.draw();
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(scene.actor);
  renderer->SetActiveCamera(scene.renderer->GetActiveCamera());
  auto other = vtkSmartPointer<vtkRenderWindow>::New();
  other->SetOffScreenRendering(1);
  other->SetMultiSamples(0);
  other->SetSize(300, 200);
  other->AddRenderer(renderer);
  const auto first = scene.window;
  scene.window = other;
  EXPECT_EQ(differing(before, scene.draw()), 0);
  scene.window = first;
  EXPECT_EQ(differing(before, scene.draw()), 0);
}

TEST(Views, PointsOfTheSamePixelsWithMultisampling)
{
  Scene scene(planeStore("samples", 3, 500));
  scene.actor->GetProperty()->SetPointSize(9);
  scene.window->SetMultiSamples(4);
  const Picture picture = scene.draw();
  for (int i = -1; i <= 1; ++i)
  {
    const auto p = scene.project({ 0.5 * i, 0.5 * i, 0.0 });
    EXPECT_EQ(picture.at(static_cast<int>(p[0]), static_cast<int>(p[1]))[0], 255);
  }
  EXPECT_LE(picture.lit(), 9 * 121);
  EXPECT_GE(picture.lit(), 9 * 64);
}

TEST(Views, StereoDrawsBothEyes)
{
  Scene scene(planeStore("stereo", 3, 500));
  scene.actor->GetProperty()->SetPointSize(5);
  scene.lookFrom({ 0.0, 0.0, 6.0 }, { 0.0, 0.0, 2.0 });
  scene.window->SetStereoTypeToAnaglyph();
  scene.window->StereoRenderOn();
  const Picture picture = scene.draw();
  int red = 0;
  int cyan = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
  {
    red += picture.rgb[i] > 100 && picture.rgb[i + 2] < 50 ? 1 : 0;
    cyan += picture.rgb[i] < 50 && picture.rgb[i + 2] > 100 ? 1 : 0;
  }
  EXPECT_GT(red, 20);
  EXPECT_GT(cyan, 20);
}

/// VTK's own mapper takes the camera's matrices as they are.
TEST(Views, ProjectionsThatShearOrTurnPutPointsWhereVTKDoes)
{
  using Change = std::function<void(vtkCamera*, vtkRenderWindow*)>;
  const Change eye = [](vtkCamera* camera, vtkRenderWindow* window)
  {
    camera->SetEyeAngle(8.0);
    window->SetStereoTypeToLeft();
    window->StereoRenderOn();
  };
  const Change shear = [](vtkCamera* camera, vtkRenderWindow*)
  { camera->SetViewShear(0.3, 0.2, 1.0); };
  const Change oblique = [](vtkCamera* camera, vtkRenderWindow*)
  { camera->SetObliqueAngles(70.0, 60.0); };
  const Change turned = [](vtkCamera* camera, vtkRenderWindow*)
  {
    vtkNew<vtkTransform> turn;
    turn->RotateZ(25.0);
    camera->SetUserTransform(turn);
  };
  for (const bool parallel : { true, false })
  {
    for (const Change& change : { eye, shear, oblique, turned })
    {
      Sheet scene;
      vtkCamera* const camera = scene.renderer->GetActiveCamera();
      camera->SetParallelProjection(parallel);
      camera->SetParallelScale(2.5);
      change(camera, scene.window);
      scene.renderer->ResetCameraClippingRange();
      scene.mapper->SetPointSize(3.0);
      scene.expectAlike("points, whose matrices OpenGL takes from VTK");
      const Picture points = scene.with(vtkPointFrontMapper::OPENGL);
      vtkNew<vtkPointFrontStyle> style;
      ASSERT_TRUE(style->LoadJSON(R"({"default":{"technique":"splats"}})"));
      scene.mapper->SetStyle(style);
      scene.expectAlike("splats");
      const Picture splats = scene.with(vtkPointFrontMapper::SOFTWARE);
      EXPECT_LE(differing(points, splats, 40), 0.1 * points.lit()); // rims
    }
  }
}

TEST(Views, TheBoundsAreThoseOfTheWholeCloudBeforeAnythingIsLoaded)
{
  Scene scene(planeStore("bounds", 101, 20));
  scene.reader->SetOverviewPoints(0);
  const double* bounds = scene.mapper->GetBounds();
  EXPECT_NEAR(bounds[0], -1.0, 1e-9);
  EXPECT_NEAR(bounds[1], 1.0, 1e-9);
  EXPECT_EQ(bounds[4], 0.0);
  EXPECT_EQ(scene.mapper->GetStore()->GetResidency().statistics().requested, 0u);
  EXPECT_GT(scene.draw().lit(), 3000); // the handle alone draws the cloud
}

} // namespace
