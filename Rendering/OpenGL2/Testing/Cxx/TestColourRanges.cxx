#include "Scene.h"

#include "MapperStyle.h"

#include "pointfront/Style/StyleSheet.h"

#include <vtkLookupTable.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <utility>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

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
  int coloursDrawn()
  {
    const Picture picture = draw();
    std::set<std::array<int, 3>> colours;
    for (int y = 0; y < picture.height; ++y)
    {
      for (int x = 0; x < picture.width; ++x)
      {
        colours.insert(picture.at(x, y));
      }
    }
    return static_cast<int>(colours.size());
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

TEST(ColourRanges, OneValueFarOffChangesNoOther)
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

TEST(ColourRanges, OneValueFarOffChangesNoLogarithm)
{
  Times scene(timesWithOneFarOff(0.5, -1e10));
  scene.table->SetScaleToLog10();
  scene.table->SetTableRange(0.4997, 4.003);
  scene.table->Build();
  scene.expectColoursOfVtk("-1e10");
}

/// 20 * 20 points whose times are `first` at the beginning and `last` at the end; heights of
/// -20 to 18 mm.
std::string timesBetween(double first, double last, bool logarithmic)
{
  return storeOf("between", 400,
    [=](std::size_t i)
    {
      const auto row = static_cast<int>(i / 20);
      Sample sample;
      sample.position = { static_cast<int>(i % 20) * 100 - 950, row * 100 - 950, row * 2 - 20 };
      const double share = (static_cast<double>(i) + 0.3) / 400.0;
      sample.time = logarithmic
        ? std::pow(10.0, std::log10(first) * (1.0 - share) + std::log10(last) * share)
        : first * (1.0 - share) + last * share;
      return sample;
    });
}

/// Floats end at 3.4e38, and begin at 1e-38.
TEST(ColourRanges, RangesBeyondFloatsHaveTheColoursOfVtk)
{
  struct Case
  {
    double first, last;
    bool logarithmic;
  };
  for (const Case& one : { Case{ -1e300, 1e300, false }, Case{ -3e38, 3e38, false },
         Case{ 1e38, 1e40, false }, Case{ 1e200, 1.001e200, false }, Case{ -1e39, 0.0, false },
         Case{ -1e-40, 1e-40, false }, Case{ 1e-300, 3e-300, false }, Case{ 1e39, 1e45, true },
         Case{ 1e-60, 1e-50, true }, Case{ 1e-150, 1e200, true } })
  {
    Times scene(timesBetween(one.first, one.last, one.logarithmic));
    const std::string what = (testing::Message() << one.first << " to " << one.last).GetString();
    one.logarithmic ? scene.table->SetScaleToLog10() : scene.table->SetScaleToLinear();
    scene.table->SetTableRange(one.first, one.last);
    scene.table->Build();
    scene.expectColoursOfVtk(what);
    EXPECT_GE(scene.coloursDrawn(), 200) << what;
    const double low =
      one.first * (one.logarithmic ? 3.0 : 0.75) + (one.logarithmic ? 0.0 : one.last * 0.25);
    scene.table->SetTableRange(low, one.last);
    scene.expectColoursOfVtk(what + ", a part of the range");
  }
}

TEST(ColourRanges, TheWidestRangesHaveTheColoursOfSoftware)
{
  constexpr double most = std::numeric_limits<double>::max();
  for (const std::string name : { "gps_time", "elevation" })
  {
    for (const auto& [low, high] : { std::pair(-most, most), std::pair(-1e300, 1e300),
           std::pair(-0.9 * most, 0.8 * most), std::pair(0.0, 1e300), std::pair(-1.0, 1e38),
           std::pair(-1e300, 1.0), std::pair(-1.0, -1.0 + 1e-15), std::pair(0.0, 1e-300),
           std::pair(0.0, std::numeric_limits<double>::denorm_min()) })
    {
      Scene scene(timesBetween(-most, most, false));
      scene.actor->GetProperty()->SetPointSize(3);
      auto sheet = std::make_shared<StyleSheet>();
      ColourMapChoice map;
      map.range = std::array<double, 2>{ low, high };
      sheet->standard.colour = ColourSource::ofAttribute(name, map);
      scene.mapper->SetStyleSheet(sheet);
      const Picture ours = scene.draw();
      scene.mapper->SetBackendToSoftware();
      const Picture software = scene.draw();
      EXPECT_GT(ours.lit(), 3000);
      // Points on the border of two entries.
      EXPECT_LE(differing(ours, software, 4), 9) << name << ' ' << low << ' ' << high;
    }
  }
}

TEST(ColourRanges, ARangeThatIsDraggedUploadsPointsNowAndThen)
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

/// 400 points of the classes 0 to `last`.
std::string classesUpTo(int last)
{
  return storeOf("classes", 400,
    [=](std::size_t i)
    {
      Sample sample;
      sample.position = { static_cast<int>(i % 20) * 100 - 950,
        static_cast<int>(i / 20) * 100 - 950, 0 };
      sample.classification = static_cast<std::uint8_t>(i % static_cast<std::size_t>(last + 1));
      return sample;
    });
}

/// Time steps, and any other store: their classes are not those that the table was sampled for.
TEST(ColourRanges, TheNextStoreHasTheColoursOfItsOwnIntegers)
{
  vtkNew<vtkLookupTable> table;
  table->SetNanColor(1.0, 1.0, 0.0, 1.0);
  table->SetRange(0.0, 8.0);
  table->Build();
  const auto colour = [&](Scene& scene)
  {
    scene.actor->GetProperty()->SetPointSize(3);
    scene.mapper->SetScalarModeToUsePointFieldData();
    scene.mapper->SelectColorArray("classification");
    scene.mapper->SetLookupTable(table);
    scene.mapper->UseLookupTableScalarRangeOn();
  };
  for (const auto& [first, next] : { std::pair(2, 8), std::pair(8, 2) })
  {
    Scene fresh(classesUpTo(next));
    colour(fresh);
    for (const bool software : { false, true })
    {
      Scene scene(classesUpTo(first));
      colour(scene);
      for (Scene* one : { &scene, &fresh })
      {
        software ? one->mapper->SetBackendToSoftware() : one->mapper->SetBackendToOpenGL();
      }
      scene.draw();
      scene.mapper->SetInputConnection(fresh.reader->GetOutputPort());
      EXPECT_EQ(differing(scene.draw(), fresh.draw()), 0) << next << (software ? " software" : "");
    }
  }
}

/// Whole numbers are sampled one by one. Those that have no logarithm are below any range, as
/// numbers of other types are.
TEST(ColourRanges, WholeNumbersWithoutALogarithmAreBelowTheRange)
{
  vtkNew<vtkLookupTable> table;
  table->SetScaleToLog10();
  table->SetRange(1.0, 100.0);
  table->SetBelowRangeColor(1.0, 1.0, 1.0, 1.0);
  table->Build();
  PointColouring colouring;
  colouring.kind = PointColouring::Kind::Table;
  colouring.integers = { -3, 5 };
  for (const bool below : { false, true })
  {
    table->SetUseBelowRangeColor(below);
    table->Build();
    const ColourMap map = sampleColours(*table, colouring);
    double lowest[4];
    table->GetTableValue(0, lowest);
    const auto expected = static_cast<std::uint8_t>(std::lround(255.0 * (below ? 1.0 : lowest[1])));
    for (std::size_t entry = 0; entry < 4; ++entry)
    {
      EXPECT_EQ(map.entries[entry][1], expected) << entry << below;
    }
    EXPECT_EQ(map.below[1], expected);
  }
}

/// VTK's tables end the program if they are asked for colours then.
TEST(ColourRanges, ARangeThatIsNoneShowsNothing)
{
  vtkNew<vtkLookupTable> table;
  table->SetNanColor(1.0, 1.0, 0.0, 1.0);
  PointColouring colouring;
  colouring.kind = PointColouring::Kind::Table;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const double nan = std::nan("");
  for (const auto& [low, high] :
    { std::pair(nan, nan), std::pair(-infinite, infinite), std::pair(0.0, infinite) })
  {
    for (const bool integers : { false, true })
    {
      colouring.integers.reset();
      if (integers)
      {
        colouring.integers = { 0, 2 };
      }
      table->SetRange(low, high);
      const ColourMap map = sampleColours(*table, colouring);
      for (const Rgba8& colour : { map.entries.front(), map.below, map.above, map.missing })
      {
        EXPECT_EQ(colour, (Rgba8{ 255, 255, 0, 255 })) << low;
      }
    }
  }
}

} // namespace
