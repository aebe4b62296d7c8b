#include "TestBuildClouds.h"

#include "GroundSurface.h"
#include "HeightAboveGroundPass.h"
#include "LocalHeightPass.h"

#include "pointfront/Generate/TerrainModel.h"
#include "pointfront/Generate/TerrainSource.h"
#include "pointfront/Points/AttributePass.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace pointfront;
using pointfront::test::CloudSource;
using pointfront::test::Random;

struct Scene
{
  std::vector<glm::dvec3> positions;
  std::vector<std::uint8_t> classes;
  std::vector<double> heights; ///< above the ground, as made
};

constexpr double eastSlope = 0.3;
constexpr double northSlope = -0.1;

/// A slope of class 2, on it boxes 6 m high (class 6) without ground below them, and one lamp on a
/// pole 9 m above the ground of class 1.
Scene boxesOnASlope(const glm::dvec3& origin, std::size_t count = 40000)
{
  Random random(9);
  Scene scene;
  const auto add = [&](double x, double y, double height, std::uint8_t objectClass)
  {
    const glm::dvec3 p(x, y, eastSlope * x + northSlope * y + height);
    scene.positions.push_back(origin + p);
    scene.classes.push_back(objectClass);
    scene.heights.push_back(height);
  };
  for (std::size_t i = 0; i < count; ++i)
  {
    const double x = 100.0 * random.uniform();
    const double y = 100.0 * random.uniform();
    const bool box = std::fmod(x, 25.0) > 10.0 && std::fmod(y, 25.0) > 10.0;
    add(x, y, box ? 6.0 : 0.0, box ? 6 : 2);
  }
  add(5.0, 5.0, 9.0, 1);
  return scene;
}

PointSources sourcesOf(const Scene& scene, bool classified)
{
  AttributeSchema schema;
  if (classified)
  {
    schema.add({ "classification", ScalarType::UInt8, 1 });
  }
  auto source = std::make_unique<CloudSource>("cloud", schema, std::nullopt, 1000);
  for (std::size_t i = 0; i < scene.positions.size(); ++i)
  {
    source->addPosition(scene.positions[i]);
    if (classified)
    {
      source->addValue(0, scene.classes[i]);
    }
  }
  PointSources sources;
  sources.push_back(std::move(source));
  return sources;
}

PassResources testResources()
{
  PassResources resources;
  resources.threads = 2;
  resources.temporaryFolder = testing::TempDir();
  return resources;
}

std::vector<float> valuesOf(const Result<PointSources>& sources, const std::string& name)
{
  std::vector<float> values;
  EXPECT_TRUE(sources) << (sources ? "" : sources.error().what);
  for (std::size_t s = 0; sources && s < sources->size(); ++s)
  {
    const PointSource& source = *(*sources)[s];
    const auto column = source.description().schema.find(name);
    EXPECT_TRUE(column);
    PointBatch batch;
    for (std::uint64_t chunk = 0; column && chunk < source.chunkCount(); ++chunk)
    {
      EXPECT_TRUE(source.read(chunk, batch));
      const auto* first = reinterpret_cast<const float*>(batch.columns[*column].data());
      values.insert(values.end(), first, first + batch.size());
    }
  }
  return values;
}

std::vector<float> aboveGround(
  const Scene& scene, bool classified, const GroundOptions& options = {})
{
  return valuesOf(
    HeightAboveGroundPass(options).apply(sourcesOf(scene, classified), testResources()),
    "height_above_ground");
}

std::vector<float> localHeights(
  const Scene& scene, double radius, std::uint64_t tilePoints = 1u << 17, bool classified = true)
{
  return valuesOf(
    LocalHeightPass(radius, tilePoints).apply(sourcesOf(scene, classified), testResources()),
    "local_height");
}

double largestError(const std::vector<float>& values, const std::vector<double>& expected)
{
  double largest = values.size() == expected.size() ? 0.0 : 1e300;
  for (std::size_t i = 0; i < std::min(values.size(), expected.size()); ++i)
  {
    largest = std::max(largest, std::abs(values[i] - expected[i]));
  }
  return largest;
}

TEST(HeightAboveGround, OfBoxesOnASlopeIsTheirHeight)
{
  for (const glm::dvec3& origin : { glm::dvec3(0.0), glm::dvec3(4e5, 5.6e6, 1000.0) })
  {
    const Scene scene = boxesOnASlope(origin);
    EXPECT_LT(largestError(aboveGround(scene, true), scene.heights), 1e-3);
  }
}

TEST(HeightAboveGround, WithoutClassesFromTheLowestPoints)
{
  const Scene scene = boxesOnASlope(glm::dvec3(0.0));
  GroundOptions options;
  options.cell = 20.0; // wider than a box
  const HeightAboveGroundPass pass(options);
  const Result<PointSources> result = pass.apply(sourcesOf(scene, false), testResources());
  const std::vector<float> values = valuesOf(result, "height_above_ground");
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    sum += std::abs(values[i] - scene.heights[i]);
  }
  EXPECT_LT(sum / double(values.size()), 0.5);
  EXPECT_LT(largestError(values, scene.heights), 6.0);
  ASSERT_EQ(pass.findings().size(), 1u);
  EXPECT_NE(pass.findings()[0].find("25 cells"), std::string::npos) << pass.findings()[0];
  EXPECT_GT(pass.heldBytes(testResources()), 0u);
}

TEST(HeightAboveGround, OneTileOrSixtyFourIsTheSame)
{
  const Scene scene = boxesOnASlope(glm::dvec3(1e7, -1e7, 0.0), 20000);
  GroundOptions whole;
  whole.tilePoints = scene.positions.size();
  GroundOptions tiled;
  tiled.tilePoints = scene.positions.size() / 64;
  EXPECT_TRUE(aboveGround(scene, true, whole) == aboveGround(scene, true, tiled));
}

TEST(HeightAboveGround, OnGeneratedTerrainAsTheGeneratorMadeIt)
{
  PointSources sources;
  sources.push_back(std::make_unique<TerrainSource>(131072, 5));
  const Result<PointSources> result =
    HeightAboveGroundPass({}).apply(std::move(sources), testResources());
  const std::vector<float> values = valuesOf(result, "height_above_ground");
  const TerrainModel model(5);
  const glm::dvec3 origin = result->front()->description().grid->offset;
  PointBatch batch;
  double sum = 0.0;
  std::size_t at = 0;
  for (std::uint64_t chunk = 0; chunk < result->front()->chunkCount(); ++chunk)
  {
    ASSERT_TRUE(result->front()->read(chunk, batch));
    for (const glm::dvec3& p : batch.positions)
    {
      const double truth = p.z - model.groundHeight(p.x - origin.x, p.y - origin.y);
      sum += (values[at] - truth) * (values[at] - truth);
      ++at;
    }
  }
  EXPECT_LT(std::sqrt(sum / double(at)), 0.1); // metres; the scanner's noise is 0.012
}

TEST(HeightAboveGround, OneGroundPointOrNone)
{
  Scene scene = boxesOnASlope(glm::dvec3(0.0), 0);
  EXPECT_EQ(aboveGround(scene, true), std::vector<float>{ 0.0f }); // its own lowest point
  scene.positions.push_back({ 100.0, 0.0, 1.0 });
  scene.classes.push_back(2);
  const double lamp = scene.positions[0].z;
  EXPECT_EQ(aboveGround(scene, true), (std::vector<float>{ float(lamp - 1.0), 0.0f }));
  EXPECT_TRUE(aboveGround(Scene(), true).empty());
  EXPECT_TRUE(aboveGround(Scene(), false).empty());
}

TEST(GroundSurface, IsNoSteeperThanFortyFiveDegrees)
{
  // A step of 10 m beside the place: not extended upwards for ever.
  std::vector<NearPoint> near;
  for (int i = 0; i < 12; ++i)
  {
    const glm::dvec3 p(1.0 + 0.1 * (i / 4), 0.1 * (i % 4), i < 6 ? 0.0 : 10.0);
    near.push_back({ p, p.x * p.x + p.y * p.y, 1 });
  }
  const double height = groundHeight(glm::dvec3(0.0), near);
  EXPECT_GT(height, -2.0);
  EXPECT_LT(height, 10.0);
}

TEST(LocalHeight, IsZeroOnASlopeAndStandsOutWhereSomethingStandsOut)
{
  Random random(4);
  Scene scene;
  for (int i = 0; i < 50000; ++i)
  {
    const double x = 50.0 * random.uniform();
    const double y = 50.0 * random.uniform();
    const bool chimney = std::abs(x - 25.0) < 0.5 && std::abs(y - 25.0) < 0.5;
    scene.positions.emplace_back(
      7e5 + x, 5e6 + y, eastSlope * x + northSlope * y + (chimney ? 3.0 : 0.0));
    scene.classes.push_back(6);
    const bool inside = std::min(x, y) > 6.0 && std::max(x, y) < 44.0;
    scene.heights.push_back(chimney ? 1.0 : inside ? 0.0 : -1.0);
  }
  const std::vector<float> values = localHeights(scene, 4.0);
  double squares = 0.0;
  std::size_t inside = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    if (scene.heights[i] > 0.0)
    {
      EXPECT_NEAR(values[i], 3.0 - 3.0 / 50.0, 0.25); // a fiftieth of the disc is chimney
    }
    else if (scene.heights[i] == 0.0)
    {
      squares += values[i] * values[i];
      ++inside;
    }
  }
  EXPECT_LT(std::sqrt(squares / double(inside)), 0.04);
}

TEST(LocalHeight, ComparesPointsOfOneClassOnly)
{
  Random random(4);
  Scene scene;
  for (int i = 0; i < 20000; ++i)
  {
    const bool roof = i % 2 == 0;
    scene.positions.emplace_back(
      30.0 * random.uniform(), 30.0 * random.uniform(), roof ? 8.0 : 2.0);
    scene.classes.push_back(roof ? 6 : 2);
    scene.heights.push_back(0.0);
  }
  EXPECT_LT(largestError(localHeights(scene, 5.0), scene.heights), 1e-6);
  for (const float height : localHeights(scene, 5.0, 1u << 17, false))
  {
    EXPECT_NEAR(std::abs(height), 3.0, 0.7); // all are of one class
  }
}

TEST(LocalHeight, OneTileOrSixtyFourIsTheSame)
{
  for (const glm::dvec3& origin : { glm::dvec3(0.0), glm::dvec3(1e7, -1e7, 0.0) })
  {
    const Scene scene = boxesOnASlope(origin, 20000);
    EXPECT_TRUE(localHeights(scene, 5.0, 1u << 20) == localHeights(scene, 5.0, 312));
  }
}

TEST(LocalHeight, ManyPointsAtOnePlaceTakeNoLongerThanOthers)
{
  Scene scene;
  for (int i = 0; i < 200000; ++i)
  {
    scene.positions.emplace_back(1.0, 1.0, i % 2);
    scene.classes.push_back(1);
    scene.heights.push_back(i % 2 - 0.5);
  }
  EXPECT_LT(largestError(localHeights(scene, 5.0), scene.heights), 1e-6);
}

TEST(LocalHeight, ARadiusFarTooWideIsRefused)
{
  const Scene scene = boxesOnASlope(glm::dvec3(0.0), 400000);
  const auto refused = LocalHeightPass(90.0, 2000).apply(sourcesOf(scene, true), testResources());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, Error::Kind::BadArgument);
}
} // namespace
