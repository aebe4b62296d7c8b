#include "Scene.h"

#include "pointfront/Style/StyleSheet.h"

#include <vtkColorTransferFunction.h>
#include <vtkLookupTable.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

/// Four points at (+-0.5, +-0.5): classes 0, 1, 2, 3; times -5, 0.5, 1.5 and NaN.
std::string fourPoints(const std::string& name)
{
  return storeOf(name, 4,
    [](std::size_t i)
    {
      Sample sample;
      sample.position = { i % 2 == 0 ? -500 : 500, i < 2 ? -500 : 500, static_cast<int>(i) * 100 };
      sample.classification = static_cast<std::uint8_t>(i);
      sample.rgb = { static_cast<std::uint8_t>(10 + i), 20, 30 };
      const double times[] = { -5.0, 0.5, 1.5, std::numeric_limits<double>::quiet_NaN() };
      sample.time = times[i];
      return sample;
    });
}

struct FourPoints : Scene
{
  explicit FourPoints(const std::string& name)
    : Scene(fourPoints(name))
  {
    actor->GetProperty()->SetPointSize(5);
  }
  std::array<int, 3> colourOf(const Picture& picture, int i)
  {
    const auto p = project({ i % 2 == 0 ? -0.5 : 0.5, i < 2 ? -0.5 : 0.5, i * 0.1 });
    return picture.at(static_cast<int>(p[0]), static_cast<int>(p[1]));
  }
  void colourBy(const char* name, vtkScalarsToColors* table)
  {
    mapper->SetScalarModeToUsePointFieldData();
    mapper->SelectColorArray(name);
    mapper->SetLookupTable(table);
    mapper->UseLookupTableScalarRangeOn();
  }
};

using Rgb = std::array<int, 3>;

TEST(Colours, RgbIsDrawnAsItIs)
{
  FourPoints scene("rgb");
  const Picture picture = scene.draw();
  for (int i = 0; i < 4; ++i)
  {
    EXPECT_EQ(scene.colourOf(picture, i), (Rgb{ 10 + i, 20, 30 }));
  }
}

TEST(Colours, WithoutScalarsThePropertysColour)
{
  FourPoints scene("flat");
  scene.mapper->ScalarVisibilityOff();
  scene.actor->GetProperty()->SetColor(1.0, 0.2, 0.0);
  EXPECT_EQ(scene.colourOf(scene.draw(), 2), (Rgb{ 255, 51, 0 }));
}

TEST(Colours, TheTableHasRangeColoursAndOneForNan)
{
  FourPoints scene("table");
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(2);
  table->SetTableRange(0.0, 1.0);
  table->Build();
  table->SetTableValue(0, 1.0, 0.0, 0.0);
  table->SetTableValue(1, 0.0, 1.0, 0.0);
  table->SetBelowRangeColor(0.0, 0.0, 1.0, 1.0);
  table->UseBelowRangeColorOn();
  table->SetAboveRangeColor(1.0, 0.0, 1.0, 1.0);
  table->UseAboveRangeColorOn();
  table->SetNanColor(0.0, 1.0, 1.0, 1.0);
  scene.colourBy("gps_time", table);
  const Picture picture = scene.draw();
  EXPECT_EQ(scene.colourOf(picture, 0), (Rgb{ 0, 0, 255 }));
  EXPECT_EQ(scene.colourOf(picture, 1), (Rgb{ 0, 255, 0 }));
  EXPECT_EQ(scene.colourOf(picture, 2), (Rgb{ 255, 0, 255 }));
  EXPECT_EQ(scene.colourOf(picture, 3), (Rgb{ 0, 255, 255 }));
}

TEST(Colours, EditingTheTableChangesThePictureAndUploadsNoPoint)
{
  FourPoints scene("edit");
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(2);
  table->SetTableRange(0.0, 4.0);
  table->Build();
  table->SetTableValue(0, 1.0, 0.0, 0.0);
  scene.colourBy("gps_time", table);
  auto* gl = vtkOpenGLPointFrontMapper::SafeDownCast(scene.mapper);
  ASSERT_NE(gl, nullptr);
  EXPECT_EQ(scene.colourOf(scene.draw(), 1), (Rgb{ 255, 0, 0 }));
  const auto uploaded = gl->GetUploadedBytes();
  EXPECT_EQ(uploaded, 4 * (12 + 4));
  table->SetTableValue(0, 0.0, 0.0, 1.0);
  EXPECT_EQ(scene.colourOf(scene.draw(), 1), (Rgb{ 0, 0, 255 }));
  table->SetTableRange(-1.0, 1.0);
  table->SetTableValue(1, 0.0, 1.0, 0.0);
  EXPECT_EQ(scene.colourOf(scene.draw(), 1), (Rgb{ 0, 255, 0 }));
  EXPECT_EQ(gl->GetUploadedBytes(), uploaded);
}

TEST(Colours, ClassesOfAnIndexedTable)
{
  FourPoints scene("classes");
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(2);
  table->IndexedLookupOn();
  table->SetAnnotation(1.0, "ground");
  table->SetAnnotation(3.0, "building");
  table->SetTableValue(0, 0.6, 0.4, 0.2);
  table->SetTableValue(1, 1.0, 0.0, 0.0);
  table->SetNanColor(0.0, 0.0, 1.0, 1.0);
  scene.colourBy("classification", table);
  const Picture picture = scene.draw();
  EXPECT_EQ(scene.colourOf(picture, 0), (Rgb{ 0, 0, 255 }));
  EXPECT_EQ(scene.colourOf(picture, 1), (Rgb{ 153, 102, 51 }));
  EXPECT_EQ(scene.colourOf(picture, 2), (Rgb{ 0, 0, 255 }));
  EXPECT_EQ(scene.colourOf(picture, 3), (Rgb{ 255, 0, 0 }));
}

/// The map of classes for times and heights, most of which are no codes.
TEST(Colours, WhatIsNoCodeHasTheMissingColour)
{
  const std::vector<double> times{ -1.0, -0.5, 0.0, 1.0, 5.0, 5.001, 5.3, 5.999, 6.0, 9.5, 254.0,
    255.0, 255.6, 256.0, 1e5, 1e30, -1e30, std::numeric_limits<double>::quiet_NaN(),
    std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() };
  for (const bool farOff : { false, true })
  {
    Scene scene(storeOf("codes", 400,
      [&](std::size_t i)
      {
        Sample sample;
        const auto row = static_cast<int>(i / 20);
        sample.position = { static_cast<int>(i % 20) * 100 - 950, row * 100 - 950,
          row % 2 * 250 + row / 2 % 4 * 1000 - 1000 };
        const double time = times[i % 20];
        sample.time = !farOff && std::abs(time) > 1e3 ? 1e3 : time;
        return sample;
      }));
    scene.actor->GetProperty()->SetPointSize(3);
    for (const char* name : { "gps_time", "elevation" })
    {
      const bool isTime = name == std::string("gps_time");
      auto sheet = std::make_shared<StyleSheet>();
      ColourMapChoice map;
      map.kind = ColourMapChoice::Kind::Classification;
      sheet->standard.colour = ColourSource::ofAttribute(name, map);
      scene.mapper->SetStyleSheet(sheet);
      const Picture ours = scene.draw();
      scene.mapper->SetBackendToSoftware();
      const Picture software = scene.draw();
      scene.mapper->SetBackendToOpenGL();
      EXPECT_EQ(differing(ours, software), 0) << name << ' ' << farOff;
      int missing = 0;
      for (int y = 0; y < ours.height; ++y)
      {
        for (int x = 0; x < ours.width; ++x)
        {
          missing += ours.at(x, y) == Rgb{ 130, 130, 130 } ? 1 : 0;
        }
      }
      EXPECT_GT(missing, isTime ? 2000 : 1000) << name << ' ' << farOff;
      EXPECT_LT(missing, ours.lit() - 500) << name << ' ' << farOff;
    }
  }
}

TEST(Colours, ALogarithmicTableEqualsVtks)
{
  const auto store = storeOf("log", 400,
    [](std::size_t i)
    {
      Sample sample;
      sample.position = { static_cast<int>(i % 20) * 100 - 950,
        static_cast<int>(i / 20) * 100 - 950, 0 };
      sample.time = std::pow(10.0, static_cast<double>(i) / 100.0) - 1.5;
      return sample;
    });
  Scene scene(store);
  scene.actor->GetProperty()->SetPointSize(3);
  vtkNew<vtkLookupTable> table;
  table->SetScaleToLog10();
  table->SetTableRange(0.5, 5000.0);
  table->Build();
  const auto colour = [&](vtkMapper* mapper)
  {
    mapper->SetScalarModeToUsePointFieldData();
    mapper->SelectColorArray("gps_time");
    mapper->SetLookupTable(table);
    mapper->UseLookupTableScalarRangeOn();
  };
  colour(scene.mapper);
  const Picture ours = scene.draw();
  auto plain = scene.inMemory();
  colour(plain);
  scene.actor->SetMapper(plain);
  const Picture theirs = scene.draw();
  EXPECT_EQ(ours.lit(), theirs.lit());
  EXPECT_LE(differing(ours, theirs, 4), 9); // one value on the border of two entries
}

TEST(Colours, ElevationIsComputedAndNeedsNoColumn)
{
  FourPoints scene("elevation");
  vtkNew<vtkColorTransferFunction> table;
  table->AddRGBPoint(0.0, 0.0, 0.0, 0.0);
  table->AddRGBPoint(0.3, 0.9, 0.0, 0.0);
  scene.colourBy("elevation", table);
  const Picture picture = scene.draw();
  for (int i = 1; i < 3; ++i)
  {
    EXPECT_NEAR(scene.colourOf(picture, i)[0], 76.5 * i, 1.0);
  }
  auto* gl = vtkOpenGLPointFrontMapper::SafeDownCast(scene.mapper);
  EXPECT_EQ(gl->GetUploadedBytes(), 4 * 12); // positions and nothing else
  EXPECT_TRUE(scene.mapper->GetStore()->GetResidency().columns().empty());
}

TEST(Colours, AnotherAttributeReplacesTheFirst)
{
  FourPoints scene("switch");
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(4);
  table->SetTableRange(0.0, 3.0);
  table->Build();
  for (int i = 0; i < 4; ++i)
  {
    table->SetTableValue(i, 0.2 * (i + 1), 0.0, 0.0);
  }
  EXPECT_EQ(scene.colourOf(scene.draw(), 3), (Rgb{ 13, 20, 30 }));
  scene.colourBy("classification", table);
  EXPECT_EQ(scene.colourOf(scene.draw(), 3), (Rgb{ 204, 0, 0 }));
  EXPECT_TRUE(scene.mapper->GetLastComplete());
  scene.mapper->SelectColorArray("rgb");
  EXPECT_EQ(scene.colourOf(scene.draw(), 3), (Rgb{ 13, 20, 30 }));
}

TEST(Colours, LargeTimesKeepTheirFractions)
{
  // GPS times near 3e8 s: float32 would step by 32 s.
  const auto store = storeOf("times", 100,
    [](std::size_t i)
    {
      Sample sample;
      sample.position = { static_cast<int>(i) * 20 - 990, 0, 0 };
      sample.time = 3e8 + 0.01 * static_cast<double>(i);
      return sample;
    });
  Scene scene(store);
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(100);
  table->SetTableRange(3e8 - 0.005, 3e8 + 0.995);
  table->Build();
  for (int i = 0; i < 100; ++i)
  {
    table->SetTableValue(i, i / 255.0, 1.0, 0.0);
  }
  scene.mapper->SetScalarModeToUsePointFieldData();
  scene.mapper->SelectColorArray("gps_time");
  scene.mapper->SetLookupTable(table);
  scene.mapper->UseLookupTableScalarRangeOn();
  scene.actor->GetProperty()->SetPointSize(1);
  scene.window->SetSize(1200, 100);
  scene.renderer->GetActiveCamera()->SetViewAngle(2.0);
  const Picture picture = scene.draw();
  int seen = 0;
  for (int i = 1; i < 99; ++i)
  {
    const auto p = scene.project({ 0.001 * (i * 20 - 990), 0.0, 0.0 });
    for (int dy = -1; dy <= 1; ++dy)
    {
      const auto c = picture.at(static_cast<int>(p[0]), static_cast<int>(p[1]) + dy);
      if (c[1] == 255)
      {
        EXPECT_EQ(c[0], i);
        ++seen;
      }
    }
  }
  EXPECT_GE(seen, 90);
}

} // namespace
