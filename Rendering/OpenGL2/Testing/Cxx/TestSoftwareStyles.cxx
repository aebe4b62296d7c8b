// Styles, budgets and resources of the software back end in VTK's windows.

#include "Sheet.h"

#include "pointfront/Style/AttributeRanges.h"
#include "pointfront/Style/StyleSheet.h"
#include "vtkPointFrontStyle.h"

#include <vtkCommand.h>

#include <array>
#include <memory>
#include <optional>

using namespace pointfront;
using namespace pointfront::test;

TEST(SoftwareBackend, WhatItDoesNotDrawOpenGLDoes)
{
  Sheet scene;
  int warnings = 0;
  countEvents(scene.mapper, vtkCommand::WarningEvent, warnings);
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
    style->SetLensStyle(
      style->AddCircleLens(100.0 + 20.0 * lens, 100.0, 8.0), R"({"color": "#ff0000"})");
  }
  scene.mapper->SetStyle(style);
  const Picture splats = scene.with(vtkPointFrontMapper::SOFTWARE);
  int warnings = 0;
  countEvents(scene.mapper, vtkCommand::WarningEvent, warnings);
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
  countEvents(scene.mapper, vtkCommand::ErrorEvent, errors);
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
  scene.mapper->SetTargetFrameTime(1.0); // no machine draws 2.25 million points in that time
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
  scene.actor->VisibilityOff();
  scene.draw();
  const int before = liveNames(scene.window);
  scene.actor->VisibilityOn();
  const Picture picture = scene.with(vtkPointFrontMapper::SOFTWARE);
  EXPECT_GT(liveNames(scene.window), before);
  scene.actor->ReleaseGraphicsResources(scene.window);
  EXPECT_EQ(liveNames(scene.window), before);
  EXPECT_EQ(differing(picture, scene.draw()), 0);
  scene.actor->SetMapper(nullptr);
  scene.mapper = nullptr;
  EXPECT_EQ(liveNames(scene.window), before);
}
