// Lenses, translucent classes and highlights in VTK windows, by both back ends.

#include "ErrorObserver.h"
#include "pointfront/Style/StyleSheet.h"
#include "Scene.h"
#include "vtkPointFrontLensWidget.h"
#include "vtkPointFrontStyle.h"

#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkHardwareSelector.h>
#include <vtkIdTypeArray.h>
#include <vtkPoints.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkSelection.h>
#include <vtkSelectionNode.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

using Colour = std::array<int, 3>;
constexpr Colour black{ 0, 0, 0 };
constexpr Colour green{ 0, 200, 0 };
constexpr Colour red{ 200, 0, 0 };
constexpr int side = 120;
const std::array<int, 2> backends = { vtkPointFrontMapper::SOFTWARE, vtkPointFrontMapper::OPENGL };

/// Class 5, green, half a metre above class 2, red; both 2.4 m wide, `across` points a side.
std::string meadowStore(
  const std::string& name, int across = side, Layering layering = Layering::None)
{
  return storeOf(
    name, 2 * static_cast<std::size_t>(across) * across,
    [across](std::size_t i)
    {
      const bool above = i >= static_cast<std::size_t>(across) * across;
      const auto column = static_cast<int>(i % across);
      const auto row = static_cast<int>(i / across % across);
      const int half = 1200 / across; // half of the distance between points, millimetres
      Sample sample;
      sample.position = { (2 * column - across + 1) * half, (2 * row - across + 1) * half,
        above ? 500 : 0 };
      sample.rgb =
        above ? std::array<std::uint8_t, 3>{ 0, 200, 0 } : std::array<std::uint8_t, 3>{ 200, 0, 0 };
      sample.classification = above ? 5 : 2;
      return sample;
    },
    glm::dvec3(0.0), layering);
}

/// Seen from 5 m above: 200 pixels show 2.68 m of the ground, 2.41 m of what is above it.
struct Meadow : Scene
{
  vtkNew<vtkPointFrontStyle> style;

  explicit Meadow(const std::string& store)
    : Scene(store)
  {
    window->SetSize(200, 200);
    lookFrom({ 0.0, 0.0, 5.0 }, { 0.0, 0.0, 0.0 });
    mapper->SetStyle(style);
    style->SetTechnique("splats");
  }
  Picture with(int backend)
  {
    mapper->SetBackend(backend);
    return draw();
  }
};

void expectNear(const Colour& a, const Colour& b, const char* what)
{
  for (std::size_t c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(a[c], b[c], 1) << what;
  }
}

} // namespace

TEST(Lenses, ACircleOpensTheCanopy)
{
  Meadow scene(meadowStore("canopy"));
  const int lens = scene.style->AddCircleLens(60.0, 100.0, 30.0);
  scene.style->SetLensStyle(lens, R"({"visible": false})", 5);
  for (const int backend : backends)
  {
    const Picture picture = scene.with(backend);
    for (int y = 20; y < 180; ++y)
    {
      for (int x = 20; x < 180; ++x)
      {
        const double far = std::hypot(x + 0.5 - 60.0, y + 0.5 - 100.0);
        if (std::abs(far - 30.0) > 0.01)
        {
          EXPECT_EQ(picture.at(x, y), far < 30.0 ? red : green) << backend << x << y;
        }
      }
    }
    EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), 2 * side * side) << "each counts once";
  }
}

TEST(Lenses, AreAlikeInBothBackEnds)
{
  const std::map<std::string, std::string> styles = {
    { "circle", R"({"lenses": [{"shape": "circle", "center_px": [90, 80], "radius_px": 50,
      "inside": {"default": {"technique": "ewa", "color": "elevation"}}}]})" },
    { "rectangle", R"({"lenses": [{"shape": "rectangle", "center_px": [90, 80], "size_px": [80, 31],
      "inside": {"5": {"opacity": 0.3}}}], "shading": {"mode": "edl"}})" },
    { "mask", R"({"lenses": [{"shape": "mask", "mask": ["#..", ".##"],
      "inside": {"5": {"visible": false}, "2": {"technique": "spheres"}}}]})" },
    { "around", R"({"lenses": [{"around_class": 2, "radius": 0.05,
      "inside": {"5": {"visible": false}}}], "classes": {"2": {"where": "x < 0"}}})" },
    { "two", R"({"lenses": [
      {"shape": "circle", "center_px": [90, 80], "radius_px": 50,
       "inside": {"5": {"color": "#4080ff"}}},
      {"shape": "circle", "center_px": [110, 90], "radius_px": 30,
       "inside": {"5": {"visible": false}}}]})" },
    { "translucent", R"({"classes": {"5": {"opacity": 0.4}}, "shading": {"mode": "edl"}})" },
    { "both",
      R"({"classes": {"5": {"opacity": 0.4}, "2": {"opacity": 0.7, "technique": "ewa"}}})" },
    { "highlight", R"({"classes": {"5": {"where": "x in [-0.5, 0.4]"}},
      "highlight": [{"class": 5, "color": "#ffcc00", "halo_px": 4, "tint": 0.3}]})" },
    { "wide halos", R"({"classes": {"5": {"where": "x in [-0.5, 0.4]"}, "2": {"where": "y < 0"}},
      "highlight": [{"class": 5, "color": "#ffcc00", "halo_px": 15.5, "tint": 0.3},
        {"class": 2, "color": "#00ffcc", "halo_px": 7}]})" },
    { "looks", R"({"default": {"technique": "splats", "edl": {"strength": 0.1}},
      "classes": {"5": {"technique": "spheres", "size": {"mode": "fixed", "px": 9}, "edl": false},
        "2": {"light": {"ambient": 0.1}, "edl": {"radius_px": 3}}}})" },
    { "looks of holes, glass and a lens", R"({"default": {"size": {"mode": "fixed", "px": 1},
      "light": {"ambient": 0.6}}, "classes": {"5": {"edl": {"radius_px": 2}, "opacity": 0.5}},
      "lenses": [{"shape": "circle", "center_px": [90, 80], "radius_px": 50,
        "inside": {"2": {"light": false, "edl": true}, "5": {"opacity": 1}}}],
      "shading": {"fill_holes": true}})" },
  };
  Meadow scene(meadowStore("alike"));
  scene.lookFrom({ 1.5, -3.0, 4.0 }, { 0.0, 0.0, 0.2 });
  for (const auto& [name, json] : styles)
  {
    ASSERT_TRUE(scene.style->LoadJSON(json)) << name;
    const Picture software = scene.with(vtkPointFrontMapper::SOFTWARE);
    const Picture gl = scene.with(vtkPointFrontMapper::OPENGL);
    EXPECT_GT(gl.lit(), 4000) << name;
    EXPECT_LE(differing(software, gl, 2), 0.005 * gl.width * gl.height) << name;
  }
}

TEST(Lenses, WhatIsTranslucentLiesOverWhatIsBehindItAndOverTheBackground)
{
  Meadow scene(meadowStore("glass"));
  scene.style->SetOpacity(0.25, 5);
  for (const int backend : backends)
  {
    scene.style->SetVisibility(true, 2);
    expectNear(scene.with(backend).at(100, 100), { 150, 50, 0 }, "over red");
    scene.style->SetVisibility(false, 2);
    expectNear(scene.with(backend).at(100, 100), { 0, 50, 0 }, "over black");
    scene.renderer->SetBackground(0.0, 0.0, 1.0);
    expectNear(scene.with(backend).at(100, 100), { 0, 50, 191 }, "over blue");
    scene.renderer->SetBackground(0.0, 0.0, 0.0);
  }
}

TEST(Lenses, OtherActorsAreInFrontAndBehind)
{
  Meadow scene(meadowStore("others"));
  const int lens = scene.style->AddCircleLens(100.0, 100.0, 40.0);
  scene.style->SetLensStyle(lens, R"({"visible": false})", 5);
  vtkNew<vtkPoints> corners; // between the two classes
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(4);
  for (const auto& [x, y] : { std::pair(-0.2, -0.2), { 0.2, -0.2 }, { 0.2, 0.2 }, { -0.2, 0.2 } })
  {
    cells->InsertCellPoint(corners->InsertNextPoint(x, y, 0.25));
  }
  vtkNew<vtkPolyData> quad;
  quad->SetPoints(corners);
  quad->SetPolys(cells);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(quad);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.0, 0.0, 1.0);
  actor->GetProperty()->LightingOff();
  scene.renderer->AddActor(actor);
  for (const int backend : backends)
  {
    const Picture picture = scene.with(backend);
    EXPECT_EQ(picture.at(100, 100), (Colour{ 0, 0, 255 })) << "seen through the lens";
    EXPECT_EQ(picture.at(130, 100), red) << "beside it, in the lens";
    EXPECT_EQ(picture.at(160, 100), green);
  }
}

TEST(Lenses, SelectionsGetWhatIsSeen)
{
  Meadow scene(meadowStore("selected_in_lens"));
  const int lens = scene.style->AddCircleLens(60.0, 100.0, 30.0);
  scene.style->SetLensStyle(lens, R"({"visible": false})", 5);
  vtkNew<vtkPointFrontReader> reader;
  reader->SetFileName(scene.reader->GetFileName());
  reader->SetOverviewPoints(4 * side * side);
  reader->Update();
  vtkPolyData* const all = reader->GetOutput();
  for (const int backend : backends)
  {
    scene.with(backend);
    const auto heightsIn = [&](unsigned int x, unsigned int y)
    {
      vtkNew<vtkHardwareSelector> selector;
      selector->SetRenderer(scene.renderer);
      selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_POINTS);
      selector->SetArea(x, y, x + 6, y + 6);
      const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
      std::set<double> heights;
      for (unsigned int n = 0; n < selection->GetNumberOfNodes(); ++n)
      {
        auto* const ids = vtkIdTypeArray::SafeDownCast(selection->GetNode(n)->GetSelectionList());
        for (vtkIdType i = 0; i < ids->GetNumberOfTuples(); ++i)
        {
          heights.insert(all->GetPoint(ids->GetValue(i))[2]);
        }
      }
      return heights;
    };
    EXPECT_EQ(heightsIn(58, 98), std::set<double>{ 0.0 }) << "in the lens, " << backend;
    EXPECT_EQ(heightsIn(150, 98), std::set<double>{ 0.5 }) << "outside, " << backend;
  }
}

TEST(Lenses, MovingOneUploadsNothing)
{
  Meadow scene(meadowStore("moving"));
  const int lens = scene.style->AddCircleLens(60.0, 100.0, 30.0);
  scene.style->SetLensStyle(lens, R"({"visible": false})", 5);
  scene.with(vtkPointFrontMapper::OPENGL);
  auto* const mapper = vtkOpenGLPointFrontMapper::SafeDownCast(scene.mapper);
  const auto uploaded = mapper->GetUploadedBytes();
  scene.style->SetLensCenter(lens, 140.0, 100.0);
  const Picture picture = scene.draw();
  EXPECT_EQ(picture.at(60, 100), green);
  EXPECT_EQ(picture.at(140, 100), red);
  EXPECT_EQ(mapper->GetUploadedBytes(), uploaded);
}

/// Its outside goes on; its inside is another picture.
TEST(Lenses, MovingOneDrawsItsInsideAlone)
{
  Meadow scene(meadowStore("moved", 480));
  const int lens = scene.style->AddCircleLens(60.0, 100.0, 30.0);
  scene.style->SetLensStyle(lens, R"({"visible": false})", 5);
  scene.mapper->SetBackendToOpenGL();
  scene.window->Start(); // there is a context before the first frame
  const int all = primitivesOf(scene);
  EXPECT_LT(primitivesOf(scene), 20) << "nothing moved";
  int most = 0;
  for (int move = 1; move <= 40; ++move)
  {
    scene.style->SetLensCenter(lens, 60.0 + 2.0 * move, 100.0);
    most = std::max(most, primitivesOf(scene));
  }
  RecordProperty("all", all);
  RecordProperty("most", most);
  EXPECT_GT(most, 1000);
  EXPECT_LT(most, all / 2) << "the nodes that reach a lens of 60 of 200 pixels";
  const Picture last = scene.read();
  scene.actor->ReleaseGraphicsResources(scene.window);
  EXPECT_EQ(differing(last, scene.draw()), 0);
}

TEST(Lenses, MoreThanOpenGLHasAreDrawnBySoftwareWithAWarning)
{
  Meadow scene(meadowStore("many_lenses"));
  for (int i = 0; i < 5; ++i)
  {
    const int lens = scene.style->AddCircleLens(20.0 + 40.0 * i, 100.0, 10.0);
    scene.style->SetLensStyle(lens, R"({"visible": false})", 5);
  }
  vtkNew<ErrorObserver> told;
  scene.mapper->AddObserver(vtkCommand::WarningEvent, told);
  const Picture picture = scene.with(vtkPointFrontMapper::OPENGL);
  EXPECT_EQ(picture.at(180, 100), red);
  EXPECT_NE(told->GetWarningMessage().find("at most 4 lenses"), std::string::npos);
}

TEST(Lenses, TheWidgetFollowsTheMouse)
{
  Meadow scene(meadowStore("widget"));
  const int lens = scene.style->AddCircleLens(-100.0, -100.0, 30.0);
  scene.style->SetLensStyle(lens, R"({"visible": false})", 5);
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetInteractorStyle(nullptr);
  interactor->SetRenderWindow(scene.window);
  interactor->Initialize();
  vtkNew<vtkPointFrontLensWidget> widget;
  widget->SetInteractor(interactor);
  widget->SetStyle(scene.style);
  widget->SetLens(lens);
  widget->On();
  interactor->SetEventInformation(70, 90);
  interactor->InvokeEvent(vtkCommand::MouseMoveEvent);
  EXPECT_EQ(scene.style->GetLensCenterX(lens), 70.0);
  EXPECT_EQ(scene.style->GetLensCenterY(lens), 90.0);
  EXPECT_EQ(scene.read().at(70, 90), red) << "the widget renders";
  interactor->SetEventInformation(70, 90, 1); // Ctrl
  interactor->InvokeEvent(vtkCommand::MouseWheelForwardEvent);
  EXPECT_NEAR(scene.style->GetLensRadius(lens), 34.5, 1e-4);
  widget->Off();
  interactor->SetEventInformation(10, 10);
  interactor->InvokeEvent(vtkCommand::MouseMoveEvent);
  EXPECT_EQ(scene.style->GetLensCenterX(lens), 70.0) << "off";
}

// A poster is one picture: its lens lies where it lies in the window, not once in every tile.
TEST(Lenses, APosterOfTilesHasTheLensOnce)
{
  Meadow scene(meadowStore("poster_lens"));
  for (const char* const place : { R"("shape": "circle", "center_px": [60, 100], "radius_px": 30)",
         R"("shape": "mask", "mask": ["..#...", "...#.."])" })
  {
    scene.style->LoadJSON(std::string(R"({"default": {"technique": "splats"}, "lenses": [{)") +
      place + R"(, "inside": {"5": {"visible": false}}}]})");
    const FrameLens lens = scene.style->GetStyleSheet().lenses[0].place;
    for (const int backend : backends)
    {
      scene.with(backend);
      const Picture poster = scene.poster(3, 2);
      int wrong = 0;
      for (int y = 30; y < 370; ++y)
      {
        for (int x = 125; x < 475; ++x) // a wider picture shows the same meadow
        {
          const bool inside = poster.at(x, y)[0] > 100;
          wrong += inside != lens.covers(x / 3, y / 2, 200, 200) ? 1 : 0;
        }
      }
      EXPECT_LE(wrong, 600) << place << backend << ": pixels of the rim at most";
    }
  }
}

// A class with a tree of its own is read and drawn where its lens is, and nowhere else.
TEST(Lenses, WhatOnlyALensShowsIsLoadedForTheLens)
{
  constexpr int across = 400;
  Meadow all(meadowStore("all_layers", across, Layering::ObjectClass));
  all.style->LoadJSON(R"({"default": {"technique": "splats"}})");
  Meadow scene(meadowStore("lens_layers", across, Layering::ObjectClass));
  const auto lensAt = [&](int x, int y)
  {
    scene.style->LoadJSON(R"({"default": {"technique": "splats"}, "classes": {"5": {"visible": )"
                          R"(false}}, "lenses": [{"shape": "circle", "center_px": [)" +
      std::to_string(x) + ", " + std::to_string(y) +
      R"(], "radius_px": 25, "inside": {"5": {"visible": true}}}]})");
  };
  for (const int backend : backends)
  {
    const Picture above = all.with(backend);
    lensAt(-100, -100);
    scene.with(backend);
    EXPECT_EQ(scene.mapper->GetLastPointsDrawn(), across * across) << "the ground alone";
    for (const auto& [x, y] : { std::pair(40, 50), std::pair(100, 100), std::pair(170, 120) })
    {
      lensAt(x, y);
      const Picture picture = scene.with(backend);
      EXPECT_LT(scene.mapper->GetLastPointsDrawn(), 1.4 * across * across) << x;
      EXPECT_GT(scene.mapper->GetLastPointsDrawn(), 1.02 * across * across) << x;
      for (int row = -24; row <= 24; ++row)
      {
        for (int column = -24; column <= 24; ++column)
        {
          if (column * column + row * row < 23 * 23 && x + column < 200)
          {
            EXPECT_EQ(picture.at(x + column, y + row), above.at(x + column, y + row))
              << backend << ", " << x + column << ", " << y + row;
          }
        }
      }
    }
  }
}

TEST(Lenses, ResourcesAreReleasedAndMadeAgain)
{
  Meadow scene(meadowStore("released_lens"));
  const int lens = scene.style->AddCircleLens(100.0, 100.0, 30.0);
  scene.style->SetLensStyle(lens, R"({"visible": false})", 5);
  const Picture before = scene.with(vtkPointFrontMapper::OPENGL);
  scene.mapper->ReleaseGraphicsResources(scene.window);
  EXPECT_EQ(differing(before, scene.draw()), 0);
  scene.style->RemoveAllLenses();
  EXPECT_EQ(scene.draw().at(100, 100), green);
  scene.style->AddCircleLens(100.0, 100.0, 30.0);
  scene.style->SetLensStyle(0, R"({"visible": false})");
  EXPECT_EQ(scene.draw().at(100, 100), black) << "nothing is shown in it";
}
