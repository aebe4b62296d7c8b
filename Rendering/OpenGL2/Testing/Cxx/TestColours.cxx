#include "Scene.h"

#include <vtkColorTransferFunction.h>
#include <vtkLookupTable.h>

#include <limits>

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

/// 20 * 20 points whose times grow by 0.01 from `first`, but for one.
std::string timesWithOneFarOff(double first, double farOff)
{
  return storeOf("far", 400,
    [=](std::size_t i)
    {
      Sample sample;
      sample.position = { static_cast<int>(i % 20) * 100 - 950,
        static_cast<int>(i / 20) * 100 - 950, 0 };
      sample.time = i == 5 ? farOff : first + 0.01 * static_cast<double>(i);
      return sample;
    });
}

/// Coloured by time, with a colour of its own below and above the table's range.
struct Times : Scene
{
  vtkNew<vtkLookupTable> table;

  explicit Times(const std::string& store)
    : Scene(store)
  {
    actor->GetProperty()->SetPointSize(3);
    table->SetBelowRangeColor(1.0, 1.0, 1.0, 1.0);
    table->UseBelowRangeColorOn();
    table->SetAboveRangeColor(0.5, 0.5, 0.5, 1.0);
    table->UseAboveRangeColorOn();
    colour(mapper);
  }
  void colour(vtkMapper* by)
  {
    by->SetScalarModeToUsePointFieldData();
    by->SelectColorArray("gps_time");
    by->SetLookupTable(table);
    by->UseLookupTableScalarRangeOn();
  }
  /// In both back ends, but for points on the border of two entries.
  void expectColoursOfVtk(const std::string& what)
  {
    const Picture ours = draw();
    mapper->SetBackendToSoftware();
    const Picture software = draw();
    mapper->SetBackendToOpenGL();
    auto plain = inMemory();
    colour(plain);
    actor->SetMapper(plain);
    const Picture theirs = draw();
    actor->SetMapper(mapper);
    EXPECT_EQ(ours.lit(), 400 * 9) << what;
    EXPECT_LE(differing(ours, theirs), 9) << what;
    EXPECT_LE(differing(ours, software), 9) << what;
  }
};

TEST(Colours, OneValueFarOffChangesNoOther)
{
  constexpr double infinite = std::numeric_limits<double>::infinity();
  constexpr double lowest = -3.4028234663852886e38;
  for (const double first : { 297700000.0, 1.0 })
  {
    for (const double farOff : { 0.0, -99999.0, -1e10, lowest, -1e300, -infinite, infinite, 1e300 })
    {
      Times scene(timesWithOneFarOff(first, farOff));
      const std::string what = (testing::Message() << first << " and " << farOff).GetString();
      // Away from the values, so that none lies on the border of two entries.
      scene.table->SetTableRange(first - 0.003, first + 4.001);
      scene.table->Build();
      scene.expectColoursOfVtk(what);
      scene.table->SetTableRange(first + 1.003, first + 2.001);
      scene.expectColoursOfVtk(what + ", a part of the range");
    }
  }
}

TEST(Colours, OneValueFarOffChangesNoLogarithm)
{
  Times scene(timesWithOneFarOff(0.5, -1e10));
  scene.table->SetScaleToLog10();
  scene.table->SetTableRange(0.4997, 4.003);
  scene.table->Build();
  scene.expectColoursOfVtk("-1e10");
}

TEST(Colours, ARangeThatIsDraggedUploadsPointsNowAndThen)
{
  Times scene(timesWithOneFarOff(297700000.0, 0.0));
  auto* gl = vtkOpenGLPointFrontMapper::SafeDownCast(scene.mapper);
  ASSERT_NE(gl, nullptr);
  scene.table->SetTableRange(297700000.0 + 0.503, 297700000.0 + 1.001);
  scene.table->Build();
  scene.draw();
  const auto first = gl->GetUploadedBytes();
  EXPECT_EQ(first, 400 * (12 + 4));
  for (int step = 1; step <= 20; ++step)
  {
    const double low = 297700000.0 + 0.503 + 0.05 * step;
    scene.table->SetTableRange(low, low + 0.498);
    scene.draw();
  }
  EXPECT_LE(gl->GetUploadedBytes() - first, 400 * 4);
  scene.expectColoursOfVtk("dragged");
}

} // namespace
