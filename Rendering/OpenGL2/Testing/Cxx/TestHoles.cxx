// Holes that are filled, by both back ends in VTK windows.

#include "Scene.h"
#include "Splats.h"

#include "pointfront/Style/StyleSheet.h"
#include "vtkPointFrontStyle.h"

#include <vtkHardwareSelector.h>
#include <vtkIdTypeArray.h>
#include <vtkLight.h>
#include <vtkSelection.h>
#include <vtkSelectionNode.h>
#include <vtkSmartPointer.h>

#include <set>
#include <string>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

constexpr int gapsSide = 60;

/// A wall of class 5 with gaps, red, half a metre above a green floor of class 2; 40 mm apart.
std::string gapsStore(const std::string& name)
{
  return storeOf(name, 2 * std::size_t(gapsSide) * gapsSide,
    [](std::size_t i)
    {
      const bool above = i >= std::size_t(gapsSide) * gapsSide;
      const auto column = static_cast<int>(i % gapsSide);
      const auto row = static_cast<int>(i / gapsSide % gapsSide);
      Sample sample;
      sample.position = { (2 * column - gapsSide + 1) * (above ? 10 : 20),
        (2 * row - gapsSide + 1) * (above ? 10 : 20), above ? 500 : 5 * (column % 3) };
      sample.rgb = above
        ? std::array<std::uint8_t, 3>{ static_cast<std::uint8_t>(255 - row), 40, 0 }
        : std::array<std::uint8_t, 3>{ 0, static_cast<std::uint8_t>(255 - column), 40 };
      sample.classification = above ? 5 : 2;
      return sample;
    });
}

struct Gaps : Scene
{
  vtkNew<vtkPointFrontStyle> style;

  explicit Gaps(const std::string& store)
    : Scene(store)
  {
    lookFrom({ 0.9, -0.6, 4.0 }, { 0.1, 0.0, 0.0 });
    mapper->SetStyle(style);
    EXPECT_TRUE(style->LoadJSON(json(2.0, "")));
  }
  static std::string json(double px, const std::string& further)
  {
    return R"({"default": {"size": {"mode": "fixed", "px": )" + std::to_string(px) +
      R"(}}, "shading": {"fill_holes": true})" + further + "}";
  }
  Picture with(int backend)
  {
    mapper->SetBackend(backend);
    return draw();
  }
};

} // namespace

TEST(Holes, AreFilledAlikeByBothBackEnds)
{
  Gaps scene(gapsStore("gaps"));
  const std::string lit = R"({"default": {"technique": "splats", "blended": true, "size": )"
                          R"({"mode": "fixed", "px": 3}}, "shading": {"fill_holes": true, )"
                          R"("mode": ["lit", "edl"]}})";
  const std::string lens = R"(, "lenses": [{"shape": "circle", "center_px": [150, 100], )"
                           R"("radius_px": 40, "inside": {"5": {"visible": false}}}])";
  const std::string glass = R"(, "classes": {"5": {"opacity": 0.5}})";
  for (const bool parallel : { false, true })
  {
    scene.renderer->GetActiveCamera()->SetParallelProjection(parallel ? 1 : 0);
    scene.renderer->GetActiveCamera()->SetParallelScale(0.9);
    for (const std::string& json : { Gaps::json(2.0, ""), Gaps::json(1.0, ""), lit,
           Gaps::json(2.0, lens), Gaps::json(2.0, glass) })
    {
      ASSERT_TRUE(scene.style->LoadJSON(json));
      const Picture software = scene.with(vtkPointFrontMapper::SOFTWARE);
      const Picture gl = scene.with(vtkPointFrontMapper::OPENGL);
      EXPECT_LE(differing(software, gl, 2), 0.005 * 300 * 200) << json << parallel;
      scene.style->SetFillHoles(false);
      const Picture open = scene.draw();
      EXPECT_GT(gl.lit(), 1.2 * open.lit()) << json;
      EXPECT_GT(differing(gl, open, 2), 2000) << json;
    }
  }
}

/// A pixel between points shows none of them: it selects nothing, least of all the first point.
TEST(Holes, SelectNothing)
{
  Gaps scene(gapsStore("gaps_selected"));
  for (const int backend : { vtkPointFrontMapper::SOFTWARE, vtkPointFrontMapper::OPENGL })
  {
    ASSERT_TRUE(scene.style->LoadJSON(Gaps::json(1.0, R"(, "show_classes": [5])")));
    const int filled = scene.with(backend).lit();
    scene.style->SetFillHoles(false);
    const int points = scene.draw().lit();
    ASSERT_GT(filled, 2 * points);
    const auto count = [&]
    {
      vtkNew<vtkHardwareSelector> selector;
      selector->SetRenderer(scene.renderer);
      selector->SetArea(0, 0, 299, 199);
      selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_POINTS);
      const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
      EXPECT_EQ(selection->GetNumberOfNodes(), 1u);
      auto* ids = vtkIdTypeArray::SafeDownCast(selection->GetNode(0)->GetSelectionList());
      std::set<vtkIdType> found;
      for (vtkIdType i = 0; ids && i < ids->GetNumberOfTuples(); ++i)
      {
        found.insert(ids->GetValue(i));
      }
      return found;
    };
    const std::set<vtkIdType> open = count();
    scene.style->SetFillHoles(true);
    scene.draw();
    EXPECT_EQ(count(), open) << "back end " << backend;
    EXPECT_GT(open.size(), 1000u);
  }
}

/// Light looks at pixels beside the cloud: nothing of an earlier, larger picture is there.
TEST(Holes, ShowNothingOfAnEarlierFrame)
{
  Gaps scene(gapsStore("gaps_earlier"));
  ASSERT_TRUE(scene.style->LoadJSON(
    R"({"default": {"size": {"mode": "fixed", "px": 3}}, "shading": {"mode": "edl", )"
    R"("strength": 1, "radius_px": 24, "fill_holes": true}})"));
  scene.lookFrom({ 0.0, 0.0, 1.2 }, { 0.0, 0.0, 0.0 });
  scene.with(vtkPointFrontMapper::OPENGL);
  scene.lookFrom({ 0.0, 0.0, 9.0 }, { 0.0, 0.0, 0.0 });
  const Picture after = scene.draw();
  scene.mapper->ReleaseGraphicsResources(scene.window);
  EXPECT_EQ(differing(after, scene.draw()), 0);
  EXPECT_LE(differing(after, scene.with(vtkPointFrontMapper::SOFTWARE), 2), 0.005 * 300 * 200);
}

/// A filled pixel has the light of the surface that it closes.
TEST(Holes, AreLitAsTheSurfaceAround)
{
  Splats scene(surfaceStore("gaps_lit", planeAt));
  scene.lookFrom({ 0.0, 0.0, 5.0 }, { 0.0, 0.0, 0.0 });
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPosition(4.0, 0.0, 2.0);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  scene.renderer->AutomaticLightCreationOff();
  scene.renderer->AddLight(light);
  const std::string json = R"({"default": {"color": "#ffffff", "size": {"mode": "fixed", "px": 1}},
    "shading": {"mode": "lit", "fill_holes": true}})";
  for (const int backend : { vtkPointFrontMapper::SOFTWARE, vtkPointFrontMapper::OPENGL })
  {
    scene.mapper->SetBackend(backend);
    ASSERT_TRUE(scene.style->LoadJSON(json));
    const Picture filled = scene.draw();
    scene.style->SetFillHoles(false);
    const Picture open = scene.draw();
    double sums[2] = {};
    int counts[2] = {};
    for (int y = 50; y < 150; ++y)
    {
      for (int x = 100; x < 200; ++x)
      {
        const std::size_t covered = open.at(x, y)[0] > 0 ? 1 : 0;
        sums[covered] += filled.at(x, y)[0];
        ++counts[covered];
      }
    }
    ASSERT_GT(counts[0], 500);
    ASSERT_GT(counts[1], 500);
    EXPECT_NEAR(sums[0] / counts[0], sums[1] / counts[1], 6.0) << "back end " << backend;
    EXPECT_LT(sums[1] / counts[1], 200.0); // at a slant
  }
}

/// A filled pixel stands out as the class that closes it does.
TEST(Holes, AreTintedAsTheClassAround)
{
  Gaps scene(gapsStore("gaps_tinted"));
  const std::string blue =
    R"(, "highlight": [{"class": 5, "color": "#0000ff", "halo_px": 0, "tint": 1}])";
  for (const int backend : { vtkPointFrontMapper::SOFTWARE, vtkPointFrontMapper::OPENGL })
  {
    ASSERT_TRUE(scene.style->LoadJSON(Gaps::json(2.0, blue)));
    const Picture filled = scene.with(backend);
    int tinted = 0;
    int red = 0;
    for (int y = 0; y < filled.height; ++y)
    {
      for (int x = 0; x < filled.width; ++x)
      {
        const auto colour = filled.at(x, y);
        tinted += colour[2] > 200 ? 1 : 0;
        red += colour[0] > 150 ? 1 : 0;
      }
    }
    EXPECT_GT(tinted, 5000) << "back end " << backend;
    EXPECT_EQ(red, 0) << "back end " << backend;
  }
}

TEST(Holes, AreGivenBackAndMadeAgain)
{
  Gaps scene(gapsStore("gaps_released"));
  const Picture before = scene.with(vtkPointFrontMapper::OPENGL);
  scene.mapper->ReleaseGraphicsResources(scene.window);
  EXPECT_EQ(differing(before, scene.draw()), 0);
  scene.window->SetSize(211, 133);
  const Picture odd = scene.draw();
  EXPECT_LE(differing(odd, scene.with(vtkPointFrontMapper::SOFTWARE), 2), 0.005 * 211 * 133);
}
