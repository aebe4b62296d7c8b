// Views and splats at the ends of what numbers can say, through OpenGL; the twins of
// TestRasterExtremes.cxx, and shapes whose picture is known.

#include "Scene.h"

#include "vtkPointFrontStyle.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <limits>
#include <string>
#include <vector>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

const std::vector<std::string> techniqueWords = { R"("technique": "splats")",
  R"("technique": "splats", "blended": true)", R"("technique": "splats", "orientation": "view")",
  R"("technique": "spheres")", R"("technique": "ewa")",
  R"("technique": "ewa", "accuracy": "exact")", R"("technique": "ewa", "accuracy": "full")" };

struct NormalPoint
{
  glm::dvec3 position;
  glm::vec3 normal{ 0.0f, 0.0f, 1.0f };
  std::array<std::uint8_t, 3> rgb{ 255, 255, 255 };
};

std::string storeOfPoints(const std::string& name, const std::vector<NormalPoint>& points,
  const glm::dvec3& offset = glm::dvec3(0.0), ScalarType normals = ScalarType::Float32)
{
  AttributeSchema schema;
  schema.add({ "rgb", ScalarType::UInt8, 3 });
  const bool floats = normals == ScalarType::Float32;
  schema.add({ "normal", normals, 3, floats ? 1.0 : 1.0 / 32767.0 });
  const QuantisationGrid grid = millimetres(offset);
  auto cloud = std::make_unique<CloudSource>(name, schema, grid);
  for (const NormalPoint& point : points)
  {
    const glm::vec3& n = point.normal;
    cloud->addPosition(point.position + offset);
    cloud->addValue(0, point.rgb);
    if (floats)
    {
      cloud->addValue(1, std::array<float, 3>{ n.x, n.y, n.z });
      continue;
    }
    const glm::vec3 steps = glm::round(32767.0f * n);
    cloud->addValue(1,
      std::array<std::int16_t, 3>{ static_cast<std::int16_t>(steps.x),
        static_cast<std::int16_t>(steps.y), static_cast<std::int16_t>(steps.z) });
  }
  return builtStore(name, std::move(cloud));
}

struct Extreme : Scene
{
  vtkNew<vtkPointFrontStyle> style;

  explicit Extreme(const std::string& store, const glm::dvec3& origin = glm::dvec3(0.0))
    : Scene(store, origin)
  {
    mapper->SetStyle(style);
  }
  /// A size in metres, or in pixels where `unit` says so.
  Picture with(const std::string& technique, double size, const char* unit = "metres")
  {
    const std::string json = "{\"default\": {" + technique +
      ", \"size\": {\"mode\": \"fixed\", \"" + unit + "\": " + std::to_string(size) + "}}}";
    EXPECT_TRUE(style->LoadJSON(json)) << json;
    return draw();
  }
};

std::vector<NormalPoint> plane(int side, double step)
{
  std::vector<NormalPoint> points;
  for (int i = 0; i < side * side; ++i)
  {
    points.push_back(
      { { (i % side - 0.5 * (side - 1)) * step, (i / side - 0.5 * (side - 1)) * step, 0.0 } });
  }
  return points;
}

/// Pixels without a splat among those around the middle, up to `half` pixels aside.
int unlitWithin(const Picture& picture, double half)
{
  int unlit = 0;
  for (int y = 0; y < picture.height; ++y)
  {
    for (int x = 0; x < picture.width; ++x)
    {
      const bool inside = std::abs(x + 0.5 - 0.5 * picture.width) < half &&
        std::abs(y + 0.5 - 0.5 * picture.height) < half;
      const std::array<int, 3> c = picture.at(x, y);
      unlit += inside && c[0] + c[1] + c[2] == 0;
    }
  }
  return unlit;
}

} // namespace

TEST(SplatExtremes, AnEyeOnASplatAndPointsBehind)
{
  Extreme scene(
    storeOfPoints("eye", { { { 0, 0, 0 }, { 0, -1, 0 } }, { { 0, -1, 0 } }, { { 0, -3, 0.1 } } }));
  scene.renderer->ResetCameraClippingRange();
  scene.lookFrom({ 0, 0, 0 }, { 0, 1, 0 });
  scene.renderer->GetActiveCamera()->SetViewUp(0, 0, 1);
  scene.renderer->GetActiveCamera()->SetClippingRange(1e-3, 10.0);
  for (const std::string& technique : techniqueWords)
  {
    // The eye is inside the first point's sphere and on its disc; the others are behind.
    EXPECT_EQ(scene.with(technique, 0.5).lit(), 0) << technique;
  }
}

/// At coordinates of ten thousand kilometres the picture is that of the origin.
TEST(SplatExtremes, CoordinatesOfTenThousandKilometres)
{
  std::vector<NormalPoint> points = plane(30, 0.1);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i].rgb = { static_cast<std::uint8_t>(37 * i), static_cast<std::uint8_t>(11 * i), 200 };
  }
  const glm::dvec3 far(10485760.0, -10485760.0, 2621440.0);
  Extreme near(storeOfPoints("near", points));
  Extreme moved(storeOfPoints("far", points, far), far);
  near.lookFrom({ 0.5, -3.0, 4.0 }, { 0.0, 0.0, 0.0 });
  moved.lookFrom(far + glm::dvec3(0.5, -3.0, 4.0), far);
  for (const std::string& technique : techniqueWords)
  {
    const Picture there = moved.with(technique, 0.2);
    EXPECT_GT(there.lit(), 4000) << technique;
    // Positions are the same bits; the view's matrix is not quite.
    EXPECT_LE(differing(near.with(technique, 0.2), there, 2), 300) << technique;
  }
}

/// A radius of nothing shows each point in its pixel; one of a million pixels fills the picture.
TEST(SplatExtremes, RadiiOfNothingAndOfAMillionPixels)
{
  Extreme scene(storeOfPoints("radii", { { { 0, 0, 0 } } }));
  for (const std::string& technique : techniqueWords)
  {
    const int lit = scene.with(technique, 1.0e-6).lit();
    EXPECT_GE(lit, 1) << technique;
    EXPECT_LE(lit, 9) << technique;
    if (technique.find("spheres") == std::string::npos) // the eye would be inside
    {
      // 10 m away, 37 pixels a metre: 2.7e4 m; bounded by what the technique states.
      EXPECT_GE(scene.with(technique, 5.4e4).lit(), 20000) << technique;
    }
  }
}

/// Near a surface perspective stretches splats aside of the line of sight beyond GL's largest
/// point.
TEST(SplatExtremes, ViewAnglesOfOneTo179Degrees)
{
  Extreme scene(storeOfPoints("angles", plane(60, 0.05)));
  for (const auto& [angle, away, width] :
    { std::array<double, 3>{ 1.0, 100.0, 300.0 }, { 170.0, 0.5, 300.0 }, { 150.0, 0.15, 990.0 },
      { 170.0, 0.15, 990.0 }, { 179.0, 0.15, 990.0 } })
  {
    scene.window->SetSize(static_cast<int>(width), static_cast<int>(width) * 2 / 3);
    for (const std::string& technique : techniqueWords)
    {
      scene.lookFrom({ 0.01, -0.003, away }, { 0.01, 0.0, 0.0 });
      scene.renderer->GetActiveCamera()->SetViewAngle(angle);
      scene.renderer->GetActiveCamera()->SetClippingRange(0.01, 1000.0);
      scene.mapper->SetBackendToOpenGL();
      const Picture gl = scene.with(technique, 0.1);
      scene.mapper->SetBackendToSoftware();
      EXPECT_GT(gl.lit(), 100) << technique << ", " << angle;
      EXPECT_LE(differing(gl, scene.draw(), 2), width * width / 300) << technique << ", " << angle;
    }
  }
}

TEST(SplatExtremes, PicturesOfOnePixelAndLargeOnes)
{
  Extreme scene(storeOfPoints("sizes", plane(40, 0.25)));
  for (const std::string& technique : techniqueWords)
  {
    scene.window->SetSize(1, 1);
    EXPECT_EQ(scene.with(technique, 0.5).lit(), 1) << technique;
  }
  scene.window->SetSize(3000, 2000);
  EXPECT_EQ(scene.with(techniqueWords[0], 0.6).lit(), 3000 * 2000);
  // The largest width and height that OpenGL must have; both at once take gigabytes a target.
  for (const glm::ivec2& size : { glm::ivec2(16384, 16), glm::ivec2(16, 16384) })
  {
    scene.window->SetSize(size.x, size.y);
    scene.renderer->GetActiveCamera()->SetViewAngle(size.x > size.y ? 0.03 : 30.0);
    for (const std::string& technique : techniqueWords)
    {
      const Picture picture = scene.with(technique, 0.6);
      EXPECT_EQ(picture.width, size.x);
      scene.mapper->SetBackendToSoftware();
      const Picture software = scene.draw();
      scene.mapper->SetBackendToOpenGL();
      EXPECT_GT(software.lit(), 16 * 5000) << technique << ", " << size.x;
      EXPECT_LE(differing(picture, software, 2), 16 * 16384 / 200) << technique << ", " << size.x;
    }
  }
}

TEST(SplatExtremes, NothingToDraw)
{
  Extreme scene(storeOfPoints("nothing", plane(10, 0.25)));
  for (const std::string& technique : techniqueWords)
  {
    EXPECT_EQ(scene.with(technique + R"(, "visible": false)", 0.5).lit(), 0) << technique;
    EXPECT_EQ(scene.with(technique + R"(, "where": "x > 1000")", 0.5).lit(), 0) << technique;
    EXPECT_TRUE(scene.mapper->GetLastComplete()) << technique;
    EXPECT_GT(scene.with(technique, 0.5).lit(), 0) << technique;
  }
}

/// From a millimetre to ten thousand kilometres: what is nearer by a tenth hides what is behind, up
/// to where 24 bits of depth tell that apart (60 m at 1 km).
TEST(SplatExtremes, DepthsOfTenOrdersOfMagnitude)
{
  for (const double away : { 0.1, 10.0, 1000.0 })
  {
    const double radius = 0.1 * away;
    Extreme scene(storeOfPoints("depths",
      { { { 0, 0, 0 }, { 0, 0, 1 }, { 255, 0, 0 } },
        { { 0, 0, -radius }, { 0, 0, 1 }, { 0, 255, 0 } } }));
    scene.lookFrom({ 0, 0, away }, { 0, 0, 0 });
    scene.renderer->GetActiveCamera()->SetClippingRange(1e-3, 1e7);
    for (const std::string& technique : techniqueWords)
    {
      const std::array<int, 3> colour = scene.with(technique, radius).at(150, 100);
      EXPECT_GT(colour[0], 250) << technique << ", " << away;
      EXPECT_LT(colour[1], 5) << technique << ", " << away;
    }
  }
}

TEST(SplatExtremes, NormalsThatAreNone)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  std::vector<NormalPoint> points;
  for (const glm::vec3& normal : { glm::vec3(0.0f), glm::vec3(nan), glm::vec3(infinity, 0, 0),
         glm::vec3(1e-20f), glm::vec3(1e20f, 0, 1), glm::vec3(1, 0, 0) })
  {
    points.push_back({ { 0.6 * static_cast<double>(points.size()) - 1.5, 0, 0 }, normal });
  }
  Extreme scene(storeOfPoints("normals", points));
  for (const std::string& technique : techniqueWords)
  {
    const Picture picture = scene.with(technique, 0.4);
    EXPECT_GT(picture.lit(), 300) << technique;
    scene.mapper->SetBackendToSoftware();
    EXPECT_LE(differing(picture, scene.draw(), 2), 60) << technique;
    scene.mapper->SetBackendToOpenGL();
  }
  // Light leaves the colour of a point without a normal.
  const Picture lit = scene.with("\"technique\": \"points\", \"light\": true", 9.0, "px");
  EXPECT_GT(lit.lit(), 6 * 70);
  scene.mapper->SetBackendToSoftware();
  const Picture software = scene.draw();
  EXPECT_EQ(software.lit(), lit.lit());
  EXPECT_LE(differing(lit, software, 2), 20);
}

/// Millimetres shown as metres, and far beyond that: discs keep their normals, whose numbers an
/// actor's matrix makes as large as the actor is small.
TEST(SplatExtremes, ActorsOfAnyScaleShowTheSamePicture)
{
  std::vector<NormalPoint> points = plane(60, 0.05);
  for (NormalPoint& point : points)
  {
    glm::dvec3& p = point.position;
    const double slope = 1.5 * std::cos(5.0 * p.x);
    p.z = 0.3 * std::sin(5.0 * p.x);
    point.normal = glm::normalize(glm::vec3(-slope, 0.0, 1.0));
    point.rgb = { static_cast<std::uint8_t>(120 + 60 * p.x),
      static_cast<std::uint8_t>(120 + 60 * p.y), 200 };
  }
  for (const ScalarType type : { ScalarType::Int16, ScalarType::Float32 })
  {
    const std::string name = "scales" + std::to_string(static_cast<int>(type));
    Extreme scene(storeOfPoints(name, points, glm::dvec3(0.0), type));
    for (const std::string& technique : { techniqueWords[0], techniqueWords[5] })
    {
      Picture first;
      for (const double scale : { 1.0, 0.05, 0.01, 0.001, 1.0e-6, 100.0, 1.0e6 })
      {
        SCOPED_TRACE(technique + ", times " + std::to_string(scale) + ", " + name);
        scene.actor->SetScale(scale);
        scene.lookFrom(scale * glm::dvec3(1.0, -3.0, 2.0), glm::dvec3(0.0));
        scene.renderer->GetActiveCamera()->SetClippingRange(0.5 * scale, 50.0 * scale);
        scene.mapper->SetBackendToSoftware();
        const std::string json = "{\"default\": {" + technique + ", \"light\": true}}";
        ASSERT_TRUE(scene.style->LoadJSON(json)) << json;
        const Picture software = scene.draw();
        scene.mapper->SetBackendToOpenGL();
        const Picture gl = scene.draw();
        first = scale == 1.0 ? software : first;
        EXPECT_GT(software.lit(), 10000);
        EXPECT_LE(differing(software, first, 2), 0.005 * 300 * 200);
        EXPECT_LE(differing(software, gl, 2), 0.005 * 300 * 200);
      }
    }
  }
}

/// Blended, their mean: sums are exact in floats up to a thousand overlaps (docs/adr/0028).
TEST(SplatExtremes, TenThousandSplatsOnOnePixel)
{
  for (const std::size_t count : { std::size_t(1000), std::size_t(10000) })
  {
    std::vector<NormalPoint> points(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      points[i].rgb = { 100, static_cast<std::uint8_t>(i % 2 == 0 ? 40 : 200), 7 };
      const std::size_t column = i % 6;
      const std::size_t row = i / 6 % 6;
      points[i].position = 1e-3 * glm::dvec3(glm::uvec3(column, row, 0));
    }
    Extreme scene(storeOfPoints("heap", points));
    scene.mapper->SetTargetError(0.01);
    for (const std::string& technique : techniqueWords)
    {
      const Picture picture = scene.with(technique, 0.5);
      const std::array<int, 3> colour = picture.at(150, 100);
      const bool blended = technique.find("ewa") != std::string::npos ||
        technique.find("blended") != std::string::npos;
      EXPECT_NEAR(colour[0], 100, 1) << technique;
      EXPECT_NEAR(colour[2], 7, 1) << technique;
      if (blended)
      {
        EXPECT_NEAR(colour[1], 120, count == 1000 ? 1 : 3) << technique;
      }
      else
      {
        EXPECT_TRUE(colour[1] == 40 || colour[1] == 200) << technique << ": " << colour[1];
      }
    }
  }
}

/// A surface of one colour has it wherever it is drawn.
TEST(SplatExtremes, AConstantColourStaysWhereSplatsAreBlended)
{
  std::vector<NormalPoint> points = plane(100, 0.03);
  for (NormalPoint& point : points)
  {
    point.rgb = { 201, 94, 33 };
    point.position.z = 0.05 * std::sin(7.0 * point.position.x);
  }
  Extreme scene(storeOfPoints("constant", points));
  scene.lookFrom({ 0.5, -3.0, 2.0 }, { 0.0, 0.0, 0.0 });
  for (const std::string& technique : techniqueWords)
  {
    const Picture picture = scene.with(technique + R"(, "light": false)", 0.1);
    EXPECT_GT(picture.lit(), 10000) << technique;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
    {
      const unsigned char* const c = &picture.rgb[i];
      const bool empty = c[0] + c[1] + c[2] == 0;
      ASSERT_TRUE(empty ||
        (std::abs(c[0] - 201) <= 1 && std::abs(c[1] - 94) <= 1 && std::abs(c[2] - 33) <= 1))
        << technique;
    }
  }
}

/// A disc, turned away and aside: the pixels whose ray meets it.
TEST(SplatExtremes, ADiscCoversWhatRaysMeet)
{
  constexpr double radius = 0.8;
  for (const glm::dvec3& facing : { glm::dvec3(0, 0, 1), glm::dvec3(1, 0.3, 1),
         glm::dvec3(-0.9, 0.9, 0.5), glm::dvec3(0.2, -1, 0.25) })
  {
    const glm::dvec3 normal = glm::normalize(facing);
    const glm::dvec3 centre(1.2, -0.7, 0.0);
    Extreme scene(storeOfPoints("disc", { { centre, glm::vec3(normal) } }));
    scene.lookFrom({ 0, 0, 5 }, { 0, 0, 0 });
    const Picture picture = scene.with(R"("technique": "ewa", "accuracy": "exact")", 2.0 * radius);
    const double pixel = 2.0 * std::tan(0.5 * 30.0 * 3.14159265358979 / 180.0) / 200.0;
    int both = 0, either = 0;
    for (int y = 0; y < 200; ++y)
    {
      for (int x = 0; x < 300; ++x)
      {
        const glm::dvec3 ray((x + 0.5 - 150.0) * pixel, (y + 0.5 - 100.0) * pixel, -1.0);
        const glm::dvec3 eye(0, 0, 5);
        const double t = glm::dot(centre - eye, normal) / glm::dot(ray, normal);
        const bool met = t > 0.0 && glm::length(eye + t * ray - centre) <= radius;
        const std::array<int, 3> c = picture.at(x, y);
        const bool drawn = c[0] + c[1] + c[2] > 0;
        both += met && drawn;
        either += met || drawn;
      }
    }
    EXPECT_GT(either, 300);
    EXPECT_GE(both, 0.98 * either) << normal.x << " " << normal.y << " " << normal.z;
  }
}

/// From a metre to ten kilometres, all of its points and levels that were thinned: points without
/// radii of their own, those that are drawn chosen by the front.
TEST(SplatExtremes, ASplattedPlaneHasNoHole)
{
  const std::string store = storeOfPoints("wide", plane(220, 0.05));
  for (const double error : { 0.01, 1.0, 2.0, 4.0 })
  {
    Extreme scene(store);
    scene.mapper->SetTargetError(error);
    for (const std::string& technique :
      { techniqueWords[0], techniqueWords[1], techniqueWords[2], techniqueWords[4] })
    {
      ASSERT_TRUE(scene.style->LoadJSON("{\"default\": {" + technique + "}}"));
      for (const double away : { 1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0, 3000.0, 10000.0 })
      {
        scene.lookFrom({ 0.0, 0.0, away }, { 0.0, 0.0, 0.0 });
        scene.renderer->GetActiveCamera()->SetClippingRange(0.5 * away, 2.0 * away);
        const Picture picture = scene.draw();
        // The points at the edge may be among those that are left out.
        const double edge = error < 1.0 ? 0.0 : 2.0 * error;
        const double half = 5.475 / (away * std::tan(0.2617993878)) * 100.0 - edge;
        const int holes = unlitWithin(picture, half);
        const double share = error < 1.0 ? 0.0 : 0.001;
        EXPECT_LE(holes, share * picture.lit() + (error < 1.0 ? 0.0 : 1.0))
          << technique << ", from " << away << ", error " << error;
        EXPECT_GT(picture.lit(), 0) << technique << ", from " << away;
      }
    }
  }
}
