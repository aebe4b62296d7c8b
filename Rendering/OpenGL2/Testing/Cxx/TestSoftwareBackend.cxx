// Pictures that threads of this process draw, in VTK's framebuffer: the same as OpenGL's, whatever
// is in the scene beside them.

#include "Scene.h"

#include "pointfront/Style/AttributeRanges.h"
#include "pointfront/Style/StyleSheet.h"
#include "vtkPointFrontStyle.h"

#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkEDLShading.h>
#include <vtkFloatArray.h>
#include <vtkHardwareSelector.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkLookupTable.h>
#include <vtkOpenGLFXAAPass.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkRenderStepsPass.h>
#include <vtkSelection.h>
#include <vtkSelectionNode.h>
#include <vtkSSAOPass.h>
#include <vtkWindowToImageFilter.h>

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

/// A wavy sheet of 200 * 200 points, 20 mm apart, whose colours say where they are.
std::string sheetStore()
{
  return storeOf("sheet", 200 * 200,
    [](std::size_t i)
    {
      const int column = static_cast<int>(i % 200);
      const int row = static_cast<int>(i / 200);
      Sample sample;
      const double height = 300.0 * std::sin(0.07 * column) * std::cos(0.05 * row);
      sample.position = { 20 * column - 1990, 20 * row - 1990, static_cast<int>(height) };
      sample.rgb = { static_cast<std::uint8_t>(55 + column), static_cast<std::uint8_t>(55 + row),
        static_cast<std::uint8_t>(150 + height / 3) };
      sample.classification = static_cast<std::uint8_t>(1 + column / 100);
      sample.time = 1e-3 * height;
      return sample;
    });
}

struct Sheet : Scene
{
  Sheet()
    : Scene(sheetStore())
  {
    lookFrom({ 3.0, -6.0, 4.0 }, { 0.0, 0.0, 0.0 });
  }
  Picture with(int backend)
  {
    mapper->SetBackend(backend);
    return draw();
  }
  /// Both back ends draw alike. llvmpipe puts points on steps of 1/256 px, which moves one in a
  /// hundred by a pixel; and where neighbours have the same depth but for rounding either may win:
  /// their colours differ by `twoColumns` at most.
  static constexpr int twoColumns = 12;
  void expectAlike(const char* what, double share = 0.01)
  {
    const Picture gl = with(vtkPointFrontMapper::OPENGL);
    const Picture software = with(vtkPointFrontMapper::SOFTWARE);
    EXPECT_GT(gl.lit(), 2000) << what;
    EXPECT_NEAR(gl.lit(), software.lit(), share * gl.lit()) << what;
    EXPECT_LE(differing(gl, software, twoColumns), share * gl.lit()) << what;
  }
  vtkSmartPointer<vtkActor> addPyramid(const glm::dvec3& centre, double height)
  {
    vtkNew<vtkPoints> points;
    for (const glm::dvec2& corner :
      { glm::dvec2(-0.8, -0.8), { 0.8, -0.8 }, { 0.8, 0.8 }, { -0.8, 0.8 } })
    {
      points->InsertNextPoint(centre.x + corner.x, centre.y + corner.y, centre.z - 0.5 * height);
    }
    points->InsertNextPoint(centre.x, centre.y, centre.z + 0.5 * height);
    vtkNew<vtkCellArray> sides;
    for (vtkIdType side = 0; side < 4; ++side)
    {
      sides->InsertNextCell({ side, (side + 1) % 4, 4 });
    }
    vtkNew<vtkPolyData> surface;
    surface->SetPoints(points);
    surface->SetPolys(sides);
    vtkNew<vtkPolyDataMapper> surfaceMapper;
    surfaceMapper->SetInputData(surface);
    auto pyramid = vtkSmartPointer<vtkActor>::New();
    pyramid->SetMapper(surfaceMapper);
    pyramid->GetProperty()->SetColor(0.2, 0.9, 0.3);
    renderer->AddActor(pyramid);
    return pyramid;
  }
  std::vector<float> depths()
  {
    vtkNew<vtkFloatArray> z;
    const int* size = window->GetSize();
    window->GetZbufferData(0, 0, size[0] - 1, size[1] - 1, z);
    return std::vector<float>(z->GetPointer(0), z->GetPointer(0) + z->GetNumberOfValues());
  }
};

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
    vtkNew<vtkWindowToImageFilter> filter;
    filter->SetInput(scene.window);
    filter->SetScale(3, 2);
    filter->ReadFrontBufferOff();
    filter->Update();
    vtkImageData* image = filter->GetOutput();
    Picture picture;
    picture.width = image->GetDimensions()[0];
    picture.height = image->GetDimensions()[1];
    const auto* bytes = static_cast<unsigned char*>(image->GetScalarPointer());
    picture.rgb.assign(bytes, bytes + 3 * std::size_t(picture.width) * picture.height);
    return picture;
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
  auto* ranks = vtkIdTypeArray::SafeDownCast(all->GetGlobalIds());
  ASSERT_NE(ranks, nullptr);
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
      const vtkIdType index = ranks->LookupValue(list->GetValue(i));
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

TEST(SoftwareBackend, WhatItDoesNotDrawOpenGLDoes)
{
  Sheet scene;
  int warnings = 0;
  vtkNew<vtkCallbackCommand> count;
  count->SetClientData(&warnings);
  count->SetCallback(
    [](vtkObject*, unsigned long, void* data, void*) { ++*static_cast<int*>(data); });
  scene.mapper->AddObserver(vtkCommand::WarningEvent, count);
  scene.actor->GetProperty()->SetOpacity(0.5);
  const Picture gl = scene.with(vtkPointFrontMapper::OPENGL);
  EXPECT_EQ(warnings, 0);
  EXPECT_EQ(differing(gl, scene.with(vtkPointFrontMapper::SOFTWARE)), 0);
  scene.draw();
  EXPECT_EQ(warnings, 1);
  scene.mapper->SetBackendToAutomatic();
  EXPECT_EQ(differing(gl, scene.draw()), 0) << "and silently where nobody asked for it";
  EXPECT_EQ(warnings, 1);
}

/// A sheet's words are in the kernel's terms here; docs/user/styles.md has those of users.
TEST(SoftwareBackend, DrawsByStyleSheets)
{
  Sheet scene;
  const Picture points = scene.with(vtkPointFrontMapper::SOFTWARE);
  auto sheet = std::make_shared<StyleSheet>();
  sheet->standard.technique = Technique::Splats;
  scene.mapper->SetStyleSheet(sheet);
  const Picture splats = scene.draw();
  EXPECT_GT(splats.lit(), points.lit()) << "a closed surface";
  // A class less: its points are not drawn, whichever layer they are in.
  auto half = std::make_shared<StyleSheet>(*sheet);
  half->classes[2].visible = false;
  scene.mapper->SetStyleSheet(half);
  const Picture left = scene.draw();
  EXPECT_LT(left.lit(), splats.lit() * 3 / 4);
  EXPECT_GT(left.lit(), splats.lit() / 4);
  scene.mapper->SetStyleSheet(nullptr);
  EXPECT_EQ(differing(points, scene.draw()), 0);
}

TEST(SoftwareBackend, FewOutliersDoNotEatTheColours)
{
  // Times of 0 to 1 and, of one point in 200, of 1000: colours are those of 2 % to 98 %.
  Scene scene(storeOf("outliers", 200 * 200,
    [](std::size_t i)
    {
      Sample sample;
      sample.position = { 20 * static_cast<int>(i % 200) - 1990,
        20 * static_cast<int>(i / 200) - 1990, 0 };
      sample.time = i % 200 == 77 ? 1000.0 : static_cast<double>(i % 200) / 200.0;
      return sample;
    }));
  scene.mapper->SetBackendToSoftware();
  const auto coloured = [&](std::optional<std::array<double, 2>> range)
  {
    auto sheet = std::make_shared<StyleSheet>();
    ColourMapChoice map;
    map.range = range;
    sheet->standard.colour = ColourSource::ofAttribute("gps_time", map);
    scene.mapper->SetStyleSheet(sheet);
    return scene.draw();
  };
  scene.draw(); // opens the store
  const AttributeRanges ranges({ scene.mapper->GetStore()->GetStore() });
  const auto sampled = ranges.of("gps_time");
  ASSERT_TRUE(sampled);
  EXPECT_NEAR((*sampled)[0], 0.02, 0.01);
  EXPECT_NEAR((*sampled)[1], 0.98, 0.01);
  const Picture automatic = coloured(std::nullopt);
  EXPECT_GT(automatic.lit(), 1000);
  EXPECT_EQ(differing(automatic, coloured(*sampled)), 0);
  EXPECT_GT(differing(automatic, coloured(std::array<double, 2>{ 0.0, 1000.0 })), 1000);
}

TEST(SoftwareBackend, AStyleMayChangeBetweenTwoFrames)
{
  Sheet scene;
  const Picture points = scene.with(vtkPointFrontMapper::SOFTWARE);
  vtkNew<vtkPointFrontStyle> style;
  scene.mapper->SetStyle(style);
  style->SetTechnique("splats");
  const Picture splats = scene.draw();
  EXPECT_GT(splats.lit(), points.lit());
  style->SetFilter("x > 1e12");
  EXPECT_EQ(scene.draw().lit(), 0);
  EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), 0) << "their nodes are not drawn at all";
  style->SetFilter("");
  EXPECT_EQ(differing(splats, scene.draw()), 0);
  scene.mapper->SetStyle(nullptr);
  EXPECT_EQ(differing(points, scene.draw()), 0);
}

TEST(SoftwareBackend, DrawsWhatOpenGLDoesNotAndSaysSo)
{
  Sheet scene;
  vtkNew<vtkPointFrontStyle> style;
  style->SetTechnique("splats");
  for (int lens = 0; lens < 5; ++lens)
  {
    style->AddCircleLens(100.0 + 20.0 * lens, 100.0, 8.0);
    style->SetLensStyle(lens, R"({"color": "#ff0000"})");
  }
  scene.mapper->SetStyle(style);
  const Picture splats = scene.with(vtkPointFrontMapper::SOFTWARE);
  int warnings = 0;
  vtkNew<vtkCallbackCommand> count;
  count->SetClientData(&warnings);
  count->SetCallback(
    [](vtkObject*, unsigned long, void* data, void*) { ++*static_cast<int*>(data); });
  scene.mapper->AddObserver(vtkCommand::WarningEvent, count);
  EXPECT_EQ(differing(splats, scene.with(vtkPointFrontMapper::OPENGL)), 0);
  scene.draw();
  EXPECT_EQ(warnings, 1);
}

TEST(SoftwareBackend, ASheetThatAsksForWhatIsNotThereIsAnError)
{
  Sheet scene;
  const Picture points = scene.with(vtkPointFrontMapper::SOFTWARE);
  auto sheet = std::make_shared<StyleSheet>();
  sheet->standard.colour = ColourSource::ofAttribute("no_such_thing");
  scene.mapper->SetStyleSheet(sheet);
  int errors = 0;
  vtkNew<vtkCallbackCommand> count;
  count->SetClientData(&errors);
  count->SetCallback(
    [](vtkObject*, unsigned long, void* data, void*) { ++*static_cast<int*>(data); });
  scene.mapper->AddObserver(vtkCommand::ErrorEvent, count);
  EXPECT_EQ(differing(points, scene.draw()), 0) << "as the properties say";
  scene.draw();
  EXPECT_EQ(errors, 1) << "once";
}

TEST(SoftwareBackend, TakesNoGpuMemoryAndNoGpuBudget)
{
  Sheet scene;
  const Picture gl = scene.with(vtkPointFrontMapper::OPENGL);
  EXPECT_GT(scene.mapper->GetLastGPUBytes(), 0);
  scene.mapper->SetGPUMemoryBudget(1000); // less than a slot
  const Picture software = scene.with(vtkPointFrontMapper::SOFTWARE);
  EXPECT_EQ(scene.mapper->GetLastGPUBytes(), 0);
  EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), 200 * 200);
  EXPECT_FALSE(scene.mapper->GetLastLimitedByGPUMemory());
  EXPECT_LE(differing(gl, software, Sheet::twoColumns), 0.01 * gl.lit());
}

TEST(SoftwareBackend, KeepsToTheTimeOfAFrame)
{
  Scene scene(planeStore("software_time", 1500, 2));
  scene.mapper->SetBackendToSoftware();
  scene.mapper->SetPointBudget(0);
  scene.mapper->SetTargetError(0.01);
  scene.draw();
  EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), 1500 * 1500);
  scene.mapper->CompleteOff();
  scene.window->SetDesiredUpdateRate(15.0);
  scene.mapper->SetTargetFrameTime(1.0); // what no machine draws 2.25 million points in
  for (int frame = 0; frame < 40; ++frame)
  {
    scene.window->Render();
  }
  EXPECT_LT(scene.mapper->GetLastPointsDrawn(), 1500 * 1500 / 2) << "its cost is learnt";
  EXPECT_GE(scene.mapper->GetLastPointsDrawn(), 50000);
}

TEST(SoftwareBackend, LeavesNoNamesBehind)
{
  Sheet scene;
  const auto names = [&]
  {
    scene.window->MakeCurrent();
    int live = 0;
    for (GLuint name = 1; name < 4096; ++name)
    {
      live += glIsTexture(name) == GL_TRUE || glIsVertexArray(name) == GL_TRUE ? 1 : 0;
    }
    return live;
  };
  scene.actor->VisibilityOff();
  scene.draw();
  const int before = names();
  scene.actor->VisibilityOn();
  const Picture picture = scene.with(vtkPointFrontMapper::SOFTWARE);
  EXPECT_GT(names(), before);
  scene.actor->ReleaseGraphicsResources(scene.window);
  EXPECT_EQ(names(), before);
  EXPECT_EQ(differing(picture, scene.draw()), 0);
  scene.actor->SetMapper(nullptr);
  scene.mapper = nullptr;
  EXPECT_EQ(names(), before);
}

} // namespace
