// Pictures that threads of this process draw, in VTK's framebuffer: the same as OpenGL's, whatever
// is in the scene beside them.

#include "Sheet.h"

#include <vtkEDLShading.h>
#include <vtkHardwareSelector.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkLookupTable.h>
#include <vtkOpenGLFXAAPass.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkRenderStepsPass.h>
#include <vtkSelection.h>
#include <vtkSelectionNode.h>
#include <vtkSSAOPass.h>

#include <array>
#include <set>
#include <string>
#include <vector>

using namespace pointfront;
using namespace pointfront::test;

TEST(SoftwareBackend, IsAutomaticWhereGlIsAProgram)
{
  Sheet automatic;
  automatic.draw();
  const std::string gl = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const bool program = gl.find("llvmpipe") != std::string::npos;
  auto mapper = vtkSmartPointer<vtkPointFrontMapper>::New();
  EXPECT_EQ(mapper->GetBackend(), vtkPointFrontMapper::AUTOMATIC);
  mapper->SetInputConnection(automatic.reader->GetOutputPort());
  mapper->CompleteOn();
  automatic.mapper = mapper;
  automatic.actor->SetMapper(mapper);
  EXPECT_GT(automatic.draw().lit(), 2000);
  auto* drawn = vtkOpenGLPointFrontMapper::SafeDownCast(mapper);
  EXPECT_EQ(drawn->GetUploadedBytes() == 0, program) << gl;
  EXPECT_EQ(mapper->GetLastGPUBytes() == 0, program) << gl;
  EXPECT_TRUE(mapper->GetLastComplete());
}

TEST(SoftwareBackend, DrawsWhatOpenGLDraws)
{
  Sheet scene;
  scene.expectAlike("1 px");
  scene.mapper->SetPointSize(4.0);
  scene.expectAlike("4 px");
  scene.mapper->SetPointSize(0.0);
  scene.actor->GetProperty()->SetPointSize(3);
  scene.expectAlike("the property's size");
  scene.renderer->GetActiveCamera()->ParallelProjectionOn();
  scene.renderer->GetActiveCamera()->SetParallelScale(2.0);
  scene.expectAlike("parallel");
  scene.renderer->GetActiveCamera()->ParallelProjectionOff();
  scene.renderer->GetActiveCamera()->SetWindowCenter(0.4, -0.3);
  scene.expectAlike("off-axis");
}

TEST(SoftwareBackend, DrawsTheColoursThatOpenGLDraws)
{
  Sheet scene;
  scene.mapper->SetPointSize(2.0);
  scene.mapper->SetScalarModeToUsePointFieldData();
  vtkNew<vtkLookupTable> table;
  table->SetTableRange(-0.2, 0.25);
  table->SetBelowRangeColor(1.0, 0.0, 1.0, 1.0);
  table->UseBelowRangeColorOn();
  table->Build();
  scene.mapper->SetLookupTable(table);
  scene.mapper->UseLookupTableScalarRangeOn();
  for (const char* name : { "gps_time", "classification", "elevation" })
  {
    scene.mapper->SelectColorArray(name);
    scene.expectAlike(name, 0.03); // neighbours of one depth differ more in some tables
  }
  scene.mapper->ScalarVisibilityOff();
  scene.actor->GetProperty()->SetColor(1.0, 0.5, 0.1);
  scene.expectAlike("flat");
}

/// Water: all of it has one height, here one between two entries of the table.
TEST(SoftwareBackend, FlatGroundBetweenTwoColoursHasThatOfOpenGL)
{
  for (const double height : { 0.0, 17.3, 412.007 })
  {
    SCOPED_TRACE(height);
    const std::string store = storeOf("water" + std::to_string(static_cast<int>(height)), 60 * 60,
      [](std::size_t i)
      {
        Sample sample;
        sample.position = { static_cast<int>(i % 60) * 50 - 1500,
          static_cast<int>(i / 60) * 50 - 1500, 0 };
        return sample;
      },
      { 0.0, 0.0, height });
    Scene scene(store, { 0.0, 0.0, height });
    scene.mapper->SetPointSize(9.0);
    scene.mapper->SetScalarModeToUsePointFieldData();
    scene.mapper->SelectColorArray("elevation");
    scene.mapper->UseLookupTableScalarRangeOn();
    for (int entries = 2; entries <= 256; entries *= 2)
    {
      vtkNew<vtkLookupTable> table;
      table->SetNumberOfTableValues(entries);
      table->SetTableRange(height - 4.1, height + 4.1);
      for (int entry = 0; entry < entries; ++entry)
      {
        table->SetTableValue(entry, entry % 2, 1.0 - entry % 2, 1.0);
      }
      scene.mapper->SetLookupTable(table);
      for (int move = 0; move < 4; ++move) // the eye is what floats count from
      {
        scene.lookFrom({ 0.3 * move, -2.0, height + 6.0 + 0.37 * move }, { 0.0, 0.0, height });
        scene.mapper->SetBackendToOpenGL();
        const Picture gl = scene.draw();
        scene.mapper->SetBackendToSoftware();
        const Picture software = scene.draw();
        EXPECT_GT(gl.lit(), 2000);
        EXPECT_LE(differing(gl, software, 2), gl.lit() / 50) << entries << " entries";
      }
    }
  }
}

/// Floats of heights below an eye at 1,000 metres are 0.06 mm apart, entries 0.15 mm.
TEST(SoftwareBackend, HeightsFarBelowTheEyeHaveTheColoursOfOpenGL)
{
  Scene scene(storeOf("ripples", 60 * 60,
    [](std::size_t i)
    {
      Sample sample;
      const int x = static_cast<int>(i % 60), y = static_cast<int>(i / 60);
      sample.position = { x * 50 - 1500, y * 50 - 1500, (7 * x + 3 * y) % 41 - 20 };
      return sample;
    }));
  scene.mapper->SetPointSize(2.0);
  scene.mapper->SetScalarModeToUsePointFieldData();
  scene.mapper->SelectColorArray("elevation");
  scene.mapper->UseLookupTableScalarRangeOn();
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(256);
  table->SetTableRange(-0.019, 0.019);
  for (int entry = 0; entry < 256; ++entry)
  {
    table->SetTableValue(entry, entry % 2, 1.0 - entry % 2, 1.0);
  }
  scene.mapper->SetLookupTable(table);
  scene.lookFrom({ 0.3, -2.0, 1013.7 }, { 0.0, 0.0, 0.0 });
  scene.renderer->GetActiveCamera()->SetViewAngle(0.15);
  scene.renderer->GetActiveCamera()->SetClippingRange(900.0, 1100.0);
  const Picture gl = scene.draw();
  scene.mapper->SetBackendToSoftware();
  EXPECT_GT(gl.lit(), 10000);
  EXPECT_LE(differing(gl, scene.draw(), 2), gl.lit() / 50);
}

TEST(SoftwareBackend, FollowsActorsAndClippingPlanes)
{
  Sheet scene;
  scene.mapper->SetPointSize(2.0);
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0.3, 0.0, 0.0);
  plane->SetNormal(-1.0, 0.3, 0.0);
  scene.mapper->AddClippingPlane(plane);
  scene.expectAlike("clipped");
  scene.actor->SetPosition(0.4, -0.3, 0.2);
  scene.actor->RotateZ(30.0);
  scene.actor->SetScale(1.3, 0.8, 1.0);
  scene.expectAlike("moved and clipped");
}

TEST(SoftwareBackend, DepthIsOpenGLsToSixDigits)
{
  Sheet scene;
  for (const bool parallel : { false, true })
  {
    scene.renderer->GetActiveCamera()->SetParallelProjection(parallel);
    scene.renderer->GetActiveCamera()->SetParallelScale(2.0);
    const Picture gl = scene.with(vtkPointFrontMapper::OPENGL);
    const std::vector<float> glDepths = scene.depths();
    const Picture software = scene.with(vtkPointFrontMapper::SOFTWARE);
    const std::vector<float> depths = scene.depths();
    ASSERT_EQ(depths.size(), glDepths.size());
    int compared = 0;
    for (std::size_t i = 0; i < depths.size(); ++i)
    {
      const int x = static_cast<int>(i) % gl.width;
      const int y = static_cast<int>(i) / gl.width;
      if (gl.at(x, y) == software.at(x, y))
      {
        ASSERT_NEAR(depths[i], glDepths[i], 1e-6 * glDepths[i]) << x << ", " << y;
        compared += glDepths[i] < 1.0f ? 1 : 0;
      }
    }
    EXPECT_GT(compared, 2000);
  }
}

TEST(SoftwareBackend, OtherActorsIntersectIt)
{
  Sheet scene;
  scene.mapper->SetPointSize(3.0);
  const auto front = scene.addPyramid({ 0.5, 0.0, 0.3 }, 2.0); // half above the sheet
  scene.expectAlike("a pyramid through the sheet");
  const auto behind = scene.addPyramid({ -0.5, 3.0, -1.5 }, 1.0);
  scene.expectAlike("and one behind");
  front->GetProperty()->SetOpacity(0.5);
  scene.expectAlike("a translucent one");
}

TEST(SoftwareBackend, DrawsPartsOfWindows)
{
  Sheet scene;
  scene.mapper->SetPointSize(2.0);
  scene.window->SetSize(420, 260);
  scene.renderer->SetViewport(0.1, 0.2, 0.55, 0.9);
  vtkNew<vtkRenderer> right;
  right->AddActor(scene.actor);
  right->SetViewport(0.6, 0.0, 1.0, 0.7);
  right->SetBackground(0.2, 0.0, 0.0);
  right->GetActiveCamera()->DeepCopy(scene.renderer->GetActiveCamera());
  right->GetActiveCamera()->Azimuth(50.0);
  scene.window->AddRenderer(right);
  scene.expectAlike("two viewports");
  scene.window->SetSize(300, 400);
  scene.expectAlike("resized");
}

/// The border is inside of the cloud, and of squares that have their centre beside it.
TEST(SoftwareBackend, DrawsWhatReachesIntoTheViewAsOpenGLDoes)
{
  Sheet scene;
  scene.window->SetSize(420, 260);
  scene.lookFrom({ 0.2871, -1.4633, 1.6127 }, { 0.0, 0.0, 0.0 }); // no two points at one depth
  scene.renderer->SetViewport(0.1, 0.2, 0.55, 0.9);
  vtkNew<vtkRenderer> right;
  right->AddActor(scene.actor);
  right->SetViewport(0.6, 0.0, 1.0, 0.7);
  right->GetActiveCamera()->DeepCopy(scene.renderer->GetActiveCamera());
  right->GetActiveCamera()->Azimuth(50.0);
  scene.window->AddRenderer(right);
  for (const bool parallel : { false, true })
  {
    for (const auto& renderer : { scene.renderer.Get(), right.Get() })
    {
      renderer->GetActiveCamera()->SetParallelProjection(parallel ? 1 : 0);
      renderer->GetActiveCamera()->SetParallelScale(0.4);
      // The near plane cuts the sheet: what is before it stays hidden.
      renderer->GetActiveCamera()->SetClippingRange(2.0, 50.0);
    }
    for (const double size : { 2.0, 20.0, 60.0, 150.0 })
    {
      scene.mapper->SetPointSize(size);
      scene.expectAlike((std::to_string(size) + " px").c_str());
    }
  }
}

TEST(SoftwareBackend, DrawsIntoMultisampledTargets)
{
  Sheet scene;
  scene.mapper->SetPointSize(3.0);
  scene.window->SetMultiSamples(4);
  const Picture multi = scene.with(vtkPointFrontMapper::SOFTWARE);
  Sheet single;
  single.mapper->SetPointSize(3.0);
  // Each pixel is whole: samples of one pixel do not differ.
  EXPECT_EQ(differing(multi, single.with(vtkPointFrontMapper::SOFTWARE), 1), 0);
}

TEST(SoftwareBackend, BothEyesAreDrawn)
{
  Sheet scene;
  scene.mapper->SetPointSize(2.0);
  scene.window->SetStereoTypeToAnaglyph();
  scene.window->StereoRenderOn();
  scene.expectAlike("anaglyph", 0.02);
}

TEST(SoftwareBackend, APosterOfTilesIsThatOfOpenGL)
{
  Sheet scene;
  scene.mapper->SetPointSize(2.0);
  const auto poster = [&](int backend)
  {
    scene.with(backend);
    return scene.poster(3, 2);
  };
  const Picture gl = poster(vtkPointFrontMapper::OPENGL);
  const Picture software = poster(vtkPointFrontMapper::SOFTWARE);
  EXPECT_EQ(software.width, 900);
  EXPECT_GT(gl.lit(), 20000);
  EXPECT_LE(differing(gl, software, Sheet::twoColumns), 0.01 * gl.lit());
}

/// Red and green say which point it is.
using Places = std::set<std::array<int, 2>>;

TEST(SoftwareBackend, SelectsThePointsThatItShows)
{
  Sheet scene;
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(scene.reader->GetFileName());
  reader->SetOverviewPoints(1000000);
  reader->Update();
  vtkPointData* all = reader->GetOutput()->GetPointData();
  auto* ids = vtkIdTypeArray::SafeDownCast(all->GetGlobalIds());
  ASSERT_NE(ids, nullptr);
  for (const double sizePx : { 1.0, 4.0 })
  {
    scene.mapper->SetPointSize(sizePx);
    const Picture picture = scene.with(vtkPointFrontMapper::SOFTWARE);
    Places shown;
    for (int y = 60; y <= 140; ++y)
    {
      for (int x = 100; x <= 180; ++x)
      {
        const auto colour = picture.at(x, y);
        shown.insert({ colour[0], colour[1] });
      }
    }
    shown.erase({ 0, 0 }); // nothing
    vtkNew<vtkHardwareSelector> selector;
    selector->SetRenderer(scene.renderer);
    selector->SetArea(100, 60, 180, 140);
    selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_POINTS);
    const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
    ASSERT_EQ(selection->GetNumberOfNodes(), 1u);
    vtkInformation* found = selection->GetNode(0)->GetProperties();
    EXPECT_EQ(found->Get(vtkSelectionNode::PROP()), scene.actor.GetPointer());
    auto* list = vtkIdTypeArray::SafeDownCast(selection->GetNode(0)->GetSelectionList());
    Places selected;
    for (vtkIdType i = 0; i < list->GetNumberOfValues(); ++i)
    {
      const vtkIdType index = ids->LookupValue(list->GetValue(i));
      ASSERT_GE(index, 0);
      const double* colour = all->GetArray("rgb")->GetTuple3(index);
      selected.insert({ static_cast<int>(colour[0]), static_cast<int>(colour[1]) });
    }
    EXPECT_EQ(list->GetNumberOfValues(), static_cast<vtkIdType>(selected.size()));
    EXPECT_EQ(selected, shown);
    EXPECT_GT(selected.size(), 3000u);
  }
}

TEST(SoftwareBackend, PassesOfOthersWorkOnIt)
{
  Sheet scene;
  scene.mapper->SetPointSize(3.0);
  scene.addPyramid({ 0.5, 0.0, 0.3 }, 2.0);
  const Picture plain = scene.with(vtkPointFrontMapper::SOFTWARE);
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkEDLShading> edl;
  edl->SetDelegatePass(steps);
  scene.renderer->SetPass(edl);
  scene.expectAlike("EDL", 0.03);
  EXPECT_GT(differing(plain, scene.with(vtkPointFrontMapper::SOFTWARE), 3), 1000);
  scene.renderer->SetPass(nullptr);

  vtkNew<vtkSSAOPass> ssao;
  ssao->SetRadius(0.3);
  ssao->SetDelegatePass(steps);
  scene.renderer->SetPass(ssao);
  const Picture occluded = scene.with(vtkPointFrontMapper::SOFTWARE);
  EXPECT_NEAR(occluded.lit(), plain.lit(), 0.05 * plain.lit());
  EXPECT_GT(differing(plain, occluded, 3), 200) << "the sheet hides and is hidden";
  scene.renderer->SetPass(nullptr);

  vtkNew<vtkOpenGLFXAAPass> fxaa;
  fxaa->SetDelegatePass(steps);
  scene.renderer->SetPass(fxaa);
  scene.expectAlike("FXAA", 0.03);
  edl->ReleaseGraphicsResources(scene.window);
  ssao->ReleaseGraphicsResources(scene.window);
  fxaa->ReleaseGraphicsResources(scene.window);
}
