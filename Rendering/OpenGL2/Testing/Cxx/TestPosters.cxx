// A picture made of tiles is the picture of one large window.

#include "Scene.h"

#include "vtkPointFrontStyle.h"

#include <string>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

constexpr int pillarsSide = 150;

/// Ground of class 2 in two colours, and above it pillars of class 5; 20 mm between the points.
std::string pillarsStore(const std::string& name)
{
  return storeOf(name, std::size_t(pillarsSide) * pillarsSide,
    [](std::size_t i)
    {
      const auto column = static_cast<int>(i % pillarsSide);
      const auto row = static_cast<int>(i / pillarsSide);
      const bool pillar = column % 30 < 12 && row % 25 < 9;
      Sample sample;
      sample.position = { (2 * column - pillarsSide + 1) * 10, (2 * row - pillarsSide + 1) * 10,
        pillar ? 700 : 3 * column % 40 };
      sample.rgb[0] = static_cast<std::uint8_t>(100 + row);
      sample.rgb[1] = static_cast<std::uint8_t>(60 + column);
      sample.classification = pillar ? 5 : 2;
      return sample;
    });
}

struct Pillars : Scene
{
  vtkNew<vtkPointFrontStyle> style;

  explicit Pillars(const std::string& store)
    : Scene(store)
  {
    lookFrom({ 0.7, -0.4, 4.0 }, { 0.1, 0.0, 0.0 });
    mapper->SetStyle(style);
  }
  Picture poster(int backend, int width, int height, int scale)
  {
    mapper->SetBackend(backend);
    window->SetSize(width / scale, height / scale);
    return Scene::poster(scale, scale);
  }
};

struct Look
{
  const char* what;
  std::string tile; ///< the style of a poster of 3 x 3 tiles
  std::string whole; ///< the same with widths in pixels of the poster
  bool parallel = false;
};

std::string splatsOf(const std::string& size, const std::string& further = "")
{
  return R"({"default": {"technique": "splats", "size": {)" + size + "}}" + further + "}";
}

std::string eyeDomeOf(int radius)
{
  return R"(, "shading": {"mode": "edl", "radius_px": )" + std::to_string(radius) + "}";
}

} // namespace

TEST(Posters, AreThePictureOfOneWindow)
{
  Pillars scene(pillarsStore("poster"));
  const std::string splats = R"({"default": {"technique": "splats"}, )";
  const std::string open = R"({"default": {"technique": "points", "size": {"mode": "fixed", )"
                           R"("px": 3}}, "shading": {"fill_holes": true}})";
  const std::string closing = R"("mode": "spacing", "factor": )";
  const std::string large = splatsOf(closing + "4");
  const std::string largest = splatsOf(closing + "12"); // an eighth of the poster's height
  const std::string fixed = splatsOf(R"("mode": "fixed", "px": 80)");
  const auto filledAndDark = [](int radius)
  {
    return R"({"default": {"size": {"mode": "fixed", "px": 3}}, "shading": {"mode": "edl", )"
           R"("fill_holes": true, "radius_px": )" +
      std::to_string(radius) + "}}";
  };
  const Look looks[] = {
    { "eye-dome lighting", splatsOf(closing + "1", eyeDomeOf(2)),
      splatsOf(closing + "1", eyeDomeOf(6)) },
    { "eye-dome lighting, parallel", splatsOf(closing + "1", eyeDomeOf(2)),
      splatsOf(closing + "1", eyeDomeOf(6)), true },
    { "holes and light", filledAndDark(3), filledAndDark(9) },
    { "halo", splats + R"("highlight": [{"class": 5, "color": "#ff0000", "halo_px": 3}]})",
      splats + R"("highlight": [{"class": 5, "color": "#ff0000", "halo_px": 9}]})" },
    { "holes", open, open },
    { "large discs", large, large },
    { "largest discs", largest, largest },
    { "discs of 80 pixels", fixed, fixed },
  };
  for (const Look& look : looks)
  {
    scene.renderer->GetActiveCamera()->SetParallelProjection(look.parallel ? 1 : 0);
    scene.renderer->GetActiveCamera()->SetParallelScale(1.2);
    for (const int backend : { vtkPointFrontMapper::SOFTWARE, vtkPointFrontMapper::OPENGL })
    {
      ASSERT_TRUE(scene.style->LoadJSON(look.tile)) << look.what;
      const Picture poster = scene.poster(backend, 330, 270, 3);
      ASSERT_TRUE(scene.style->LoadJSON(look.whole)) << look.what;
      const Picture whole = scene.poster(backend, 330, 270, 1);
      ASSERT_EQ(poster.width, whole.width);
      EXPECT_GT(whole.lit(), 60000) << look.what;
      // In floats a tile's pixels have smaller numbers: a few rims of splats fall otherwise, and
      // light around them. Without margins of tiles 4,900 to 13,000 pixels differ.
      EXPECT_LE(differing(poster, whole, 2), 250) << look.what << ", back end " << backend;
    }
  }
}

/// Squares whose centre is in the tile beside.
TEST(Posters, OfLargeSquaresHaveNoSeams)
{
  Pillars scene(pillarsStore("poster_squares"));
  scene.mapper->SetStyle(nullptr);
  for (const bool parallel : { false, true })
  {
    scene.renderer->GetActiveCamera()->SetParallelProjection(parallel ? 1 : 0);
    scene.renderer->GetActiveCamera()->SetParallelScale(1.2);
    for (const float size : { 2.0f, 7.0f, 20.0f })
    {
      scene.actor->GetProperty()->SetPointSize(size);
      for (const int backend : { vtkPointFrontMapper::SOFTWARE, vtkPointFrontMapper::OPENGL })
      {
        const Picture poster = scene.poster(backend, 330, 270, 3);
        const Picture whole = scene.poster(backend, 330, 270, 1);
        EXPECT_GT(whole.lit(), 50000) << size;
        // Rounding of tiles moves a few squares by a pixel.
        EXPECT_LE(differing(poster, whole, 2), 250) << size << " px, back end " << backend;
      }
    }
  }
}

/// Halos grow as posters do: what one costs grows with its width, not with the square of it.
/// Of what lies beside a tile only what reaches into it is loaded, and takes a part of the budget.
TEST(Posters, OfLargeSplatsNeedFewPointsBesideTheTile)
{
  Pillars scene(planeStore("poster-points", 500, 4));
  scene.lookFrom({ 0.0, 0.0, 2.4 }, { 0.0, 0.0, 0.0 });
  const auto pointsOf = [&](const std::string& json)
  {
    EXPECT_TRUE(scene.style->LoadJSON(json));
    scene.poster(vtkPointFrontMapper::SOFTWARE, 600, 400, 4);
    return scene.mapper->GetLastPointsDrawn(); // points of the last tile
  };
  const vtkIdType small = pointsOf(R"({"default": {"size": {"mode": "fixed", "px": 1}}, )"
                                   R"("shading": {"mode": "edl"}})");
  const vtkIdType large =
    pointsOf(R"({"default": {"technique": "splats"}, "shading": {"mode": "edl"}})");
  EXPECT_GT(small, 0);
  // With all that lies within an eighth of the poster it is 28 % more.
  EXPECT_LE(static_cast<double>(large), 1.1 * static_cast<double>(small));
}

TEST(Posters, HaveWideHalosInBothBackEnds)
{
  Pillars scene(pillarsStore("poster_halo"));
  ASSERT_TRUE(scene.style->LoadJSON(splatsOf(R"("mode": "fixed", "px": 3)",
    R"(, "classes": {"5": {"where": "x in [-0.3, 0.2]"}}, "highlight": )"
    R"([{"class": 5, "color": "#ff0000", "halo_px": 16}])")));
  const Picture software = scene.poster(vtkPointFrontMapper::SOFTWARE, 480, 320, 8);
  const Picture gl = scene.poster(vtkPointFrontMapper::OPENGL, 480, 320, 8);
  EXPECT_GT(gl.lit(), 60000);
  EXPECT_LE(differing(software, gl, 2), 0.005 * gl.width * gl.height);
}
