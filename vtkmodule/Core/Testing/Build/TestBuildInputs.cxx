#include "TestBuildClouds.h"

#include "pointfront/Ingest/CommonSchema.h"
#include "pointfront/Ingest/GridChoice.h"
#include "pointfront/Ingest/ReferenceSystem.h"
#include "pointfront/Points/GpsTimes.h"
#include "pointfront/Store/PointStore.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>

namespace pointfront
{
namespace
{
using namespace pointfront::test;
using Sources = std::vector<std::unique_ptr<PointSource>>;

std::unique_ptr<CloudSource> gridSource(const std::string& path, double scale, double offset)
{
  auto source = std::make_unique<CloudSource>(
    path, AttributeSchema{}, QuantisationGrid{ glm::dvec3(scale), glm::dvec3(offset) });
  source->editDescription().pointCount = 1; // warnings are of points
  return source;
}

TEST(GridChoice, KeepsASharedGridAndOneApartByWholeSteps)
{
  Sources sources;
  sources.push_back(gridSource("a", 0.01, 100.0));
  sources.push_back(gridSource("b", 0.01, -3500.37));
  sources.push_back(gridSource("c", 0.05, 100.05));
  const auto choice = chooseGrid(sources, std::nullopt);
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->grid, (QuantisationGrid{ glm::dvec3(0.01), glm::dvec3(100.0) }));
  EXPECT_TRUE(choice->warnings.empty());
}

TEST(GridChoice, TakesTheFinestAndNamesWhatIsRounded)
{
  Sources sources;
  sources.push_back(gridSource("coarse", 0.01, 0.0));
  sources.push_back(gridSource("fine", 0.001, 0.0));
  sources.push_back(gridSource("between", 0.001, 0.0005));
  const auto choice = chooseGrid(sources, std::nullopt);
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->grid.scale, glm::dvec3(0.001));
  ASSERT_EQ(choice->warnings.size(), 1u);
  EXPECT_NE(choice->warnings[0].find("'between'"), std::string::npos);
  EXPECT_NE(choice->warnings[0].find("0.0005"), std::string::npos);
}

TEST(GridChoice, HearsNoSourceWithoutPoints)
{
  Sources sources;
  sources.push_back(gridSource("empty", 0.001, 7.0005));
  sources.push_back(gridSource("coarse", 0.01, 0.0));
  for (const auto& source : sources)
  {
    static_cast<CloudSource&>(*source).editDescription().declaredBounds = // unlike those of points
      Bounds{ glm::dvec3(-5.0), glm::dvec3(source == sources[0] ? 1e9 : 5.0) };
  }
  static_cast<CloudSource&>(*sources[0]).editDescription().pointCount = 0;
  const auto choice = chooseGrid(sources, std::nullopt);
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->grid, (QuantisationGrid{ glm::dvec3(0.01), glm::dvec3(0.0) }));
  EXPECT_EQ(choice->high.x, 500);
  EXPECT_TRUE(choice->warnings.empty());
  sources.pop_back();
  const auto alone = chooseGrid(sources, std::nullopt);
  ASSERT_TRUE(alone);
  EXPECT_EQ(alone->grid.scale, glm::dvec3(0.001)) << "nobody else has a say";
}

TEST(GridChoice, TakesThePrecisionAskedFor)
{
  Sources sources;
  sources.push_back(gridSource("a", 0.001, 7.0));
  const auto choice = chooseGrid(sources, 0.25);
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->grid, (QuantisationGrid{ glm::dvec3(0.25), glm::dvec3(7.0) }));
  EXPECT_EQ(choice->warnings.size(), 1u);
  EXPECT_FALSE(chooseGrid(sources, 0.0));
  EXPECT_FALSE(chooseGrid(sources, std::nan("")));
}

TEST(GridChoice, GivesFloatingPointAMillionthOfItsExtent)
{
  auto cloud = std::make_unique<CloudSource>("scan", AttributeSchema{}, std::nullopt);
  cloud->editDescription().declaredBounds = Bounds{ glm::dvec3(-60.0), glm::dvec3(60.0) };
  Sources sources;
  sources.push_back(std::move(cloud));
  const auto choice = chooseGrid(sources, std::nullopt);
  ASSERT_TRUE(choice);
  EXPECT_DOUBLE_EQ(choice->grid.scale.x, 1e-4);
  EXPECT_EQ(choice->warnings.size(), 1u);
}

std::unique_ptr<CloudSource> floatingSource(const std::vector<glm::dvec3>& points)
{
  auto cloud = std::make_unique<CloudSource>("scan", AttributeSchema{}, std::nullopt);
  for (const glm::dvec3& point : points)
  {
    cloud->addPosition(point);
  }
  return cloud;
}

TEST(GridChoice, GivesTheHeightsOverDegreesAStepOfTheirOwn)
{
  Sources sources;
  sources.push_back(
    floatingSource({ { 7.0, 50.0, 0.0 }, { 7.02, 50.01, 450.0 }, { 7.01, 50.0, 99.0 } }));
  const auto choice = chooseGrid(sources, std::nullopt);
  ASSERT_TRUE(choice);
  EXPECT_DOUBLE_EQ(choice->grid.scale.x, 1e-8);
  EXPECT_DOUBLE_EQ(choice->grid.scale.y, 1e-8);
  EXPECT_DOUBLE_EQ(choice->grid.scale.z, 1e-4);
}

TEST(GridChoice, RefusesToLetPointsCollapseForOneFarAway)
{
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 1000; ++i)
  {
    points.emplace_back(0.001 * i, 0.001 * (i % 7), 0.0);
  }
  points.emplace_back(1e6, 0.0, 0.0); // a thousandth can still be told from the next
  Sources far;
  far.push_back(floatingSource(points));
  const auto held = chooseGrid(far, std::nullopt);
  ASSERT_FALSE(held);
  EXPECT_NE(held.error().what.find("0.001 fits"), std::string::npos) << held.error().what;
  EXPECT_TRUE(chooseGrid(far, 0.001));
  points.back().x = 1e4;
  Sources near;
  near.push_back(floatingSource(points));
  const auto choice = chooseGrid(near, std::nullopt);
  ASSERT_TRUE(choice) << choice.error().what;
  EXPECT_DOUBLE_EQ(choice->grid.scale.x, 1e-5);
}

TEST(GridChoice, RefusesWhatNoCoordinatesAreOn)
{
  Sources sources;
  sources.push_back(gridSource("a", 0.001, 1e300));
  EXPECT_FALSE(chooseGrid(sources, std::nullopt));
  EXPECT_FALSE(chooseGrid(sources, 1e300));
}

std::unique_ptr<CloudSource> schemaSource(
  const std::string& path, const std::vector<Attribute>& attributes)
{
  AttributeSchema schema;
  for (const Attribute& attribute : attributes)
  {
    schema.add(attribute);
  }
  auto source = std::make_unique<CloudSource>(path, schema, millimetres());
  source->editDescription().pointCount = 1; // warnings are of points
  return source;
}

TEST(CommonSchema, UnitesColumnsAndNamesThoseMissing)
{
  Sources sources;
  sources.push_back(schemaSource("a", { { "intensity", ScalarType::UInt16, 1 } }));
  sources.push_back(
    schemaSource("b", { { "x", ScalarType::Int8, 1 }, { "intensity", ScalarType::UInt8, 1 } }));
  const auto common = commonSchema(sources, std::nullopt);
  ASSERT_TRUE(common);
  ASSERT_EQ(common->schema.size(), 2u);
  EXPECT_EQ(common->schema[0].type, ScalarType::UInt16);
  EXPECT_FALSE(common->mappings[0][1].column);
  EXPECT_EQ(common->mappings[1][0].column, 1u);
  EXPECT_TRUE(common->mappings[1][0].converted);
  ASSERT_EQ(common->warnings.size(), 1u); // widening loses nothing, but a column is missing
  EXPECT_NE(common->warnings[0].find("'a' lacks x"), std::string::npos);
}

TEST(CommonSchema, TakesNoColumnOfASourceWithoutPoints)
{
  Sources sources;
  sources.push_back(schemaSource(
    "empty", { { "rgb", ScalarType::UInt16, 3 }, { "intensity", ScalarType::Float64, 2 } }));
  sources.push_back(schemaSource("full", { { "intensity", ScalarType::UInt16, 1 } }));
  static_cast<CloudSource&>(*sources[0]).editDescription().pointCount = 0;
  const auto common = commonSchema(sources, std::nullopt);
  ASSERT_TRUE(common) << common.error().what;
  ASSERT_EQ(common->schema.size(), 1u) << "all points would be black";
  EXPECT_EQ(common->schema[0], sources[1]->description().schema[0]);
  EXPECT_TRUE(common->warnings.empty());
  EXPECT_FALSE(commonSchema(sources, std::nullopt, SchemaOf::AllSources)) << "two shapes";
  const auto named = commonSchema(sources, std::vector<std::string>{ "intensity" });
  ASSERT_TRUE(named) << named.error().what;
  EXPECT_EQ(named->schema[0], sources[1]->description().schema[0]);
  const auto nobodys = commonSchema(sources, std::vector<std::string>{ "rgb" });
  ASSERT_FALSE(nobodys) << "a column of zeros that no point has";
  EXPECT_NE(nobodys.error().what.find("without points have an attribute 'rgb'"), std::string::npos);
  sources.pop_back();
  EXPECT_EQ(commonSchema(sources, std::nullopt)->schema.size(), 2u);
}

TEST(CommonSchema, TakesOnlyWhatIsWanted)
{
  Sources sources;
  sources.push_back(schemaSource(
    "a", { { "intensity", ScalarType::UInt16, 1 }, { "gps_time", ScalarType::Float64, 1 } }));
  const auto common = commonSchema(sources, std::vector<std::string>{ "GPS_time" });
  ASSERT_TRUE(common);
  ASSERT_EQ(common->schema.size(), 1u);
  EXPECT_EQ(common->schema[0].name, "gps_time");
  EXPECT_EQ(commonSchema(sources, std::vector<std::string>{})->schema.size(), 0u);
  const auto unknown = commonSchema(sources, std::vector<std::string>{ "colour" });
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().what.find("intensity, gps_time"), std::string::npos);
}

TEST(CommonSchema, RefusesColumnsOfDifferentShape)
{
  Sources sources;
  sources.push_back(schemaSource("a", { { "normal", ScalarType::Float32, 3 } }));
  sources.push_back(schemaSource("b", { { "normal", ScalarType::Float32, 2 } }));
  EXPECT_FALSE(commonSchema(sources, std::nullopt));
}

TEST(CommonSchema, ConvertsValuesToTheCommonTypeAndScale)
{
  const Attribute signedByte{ "v", ScalarType::Int8, 1 };
  const Attribute wide{ "v", ScalarType::Int32, 1 };
  const std::int8_t bytes[] = { -128, 7 };
  std::int32_t words[2];
  convertColumn(signedByte, reinterpret_cast<const std::byte*>(bytes), wide,
    reinterpret_cast<std::byte*>(words), 2);
  EXPECT_EQ(words[0], -128);
  EXPECT_EQ(words[1], 7);
  const Attribute scaled{ "v", ScalarType::Int8, 1, 0.5, 10.0 };
  const Attribute world{ "v", ScalarType::Float64, 1 };
  double values[2];
  convertColumn(scaled, reinterpret_cast<const std::byte*>(bytes), world,
    reinterpret_cast<std::byte*>(values), 2);
  EXPECT_EQ(values[0], -54.0);
  EXPECT_EQ(values[1], 13.5);
}

TEST(ReferenceSystem, RefusesTwoSystemsAndNamesBothFiles)
{
  Sources sources;
  for (const char* path : { "first", "silent", "second" })
  {
    auto source = schemaSource(path, {});
    source->editDescription().crsWkt = path == std::string("silent") ? "" : path;
    sources.push_back(std::move(source));
  }
  const auto refused = commonReferenceSystem(sources);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("'first' and 'second'"), std::string::npos);
  sources.pop_back();
  const auto common = commonReferenceSystem(sources);
  ASSERT_TRUE(common);
  EXPECT_EQ(common->wkt, "first");
  EXPECT_EQ(common->warnings.size(), 1u);
}

/// A source with GPS times whose header has these bits in its global encoding.
std::unique_ptr<CloudSource> timed(const std::string& path, std::uint8_t bits)
{
  auto source = schemaSource(path, { { "gps_time", ScalarType::Float64 } });
  source->editDescription().metadata.push_back(
    { lasKeptOwner, lasKeptEncodingRecord, "", { static_cast<std::byte>(bits), std::byte{ 0 } } });
  return source;
}

/// The system of all these sources; those whose path begins with "no points" give none.
Result<ReferenceSystem> timedSystem(const Sources& sources)
{
  Result<ReferenceSystem> system = commonReferenceSystem(sources);
  if (system)
  {
    system->keepTimes(sources,
      [&](std::size_t s) { return sources[s]->description().path.rfind("no points", 0) != 0; });
  }
  return system;
}

GpsTimes timesIn(const ReferenceSystem& system)
{
  AttributeSchema schema;
  schema.add({ "gps_time", ScalarType::Float64 });
  return gpsTimesOf(schema, system.metadata);
}

TEST(ReferenceSystem, SaysWhatGpsTimesAllSourcesHave)
{
  Sources sources;
  sources.push_back(schemaSource("no time", {}));
  sources.push_back(timed("standard", 17));
  auto common = timedSystem(sources);
  ASSERT_TRUE(common);
  EXPECT_EQ(timesIn(*common), GpsTimes::Standard) << "though the first source has none";
  EXPECT_TRUE(common->warnings.empty());
  sources.push_back(timed("week", 0));
  common = timedSystem(sources);
  ASSERT_TRUE(common);
  EXPECT_EQ(timesIn(*common), GpsTimes::Mixed);
  ASSERT_EQ(common->warnings.size(), 1u);
  EXPECT_NE(common->warnings[0].find("'week' are seconds of a week, and those of 'standard'"),
    std::string::npos)
    << common->warnings[0];
  // Such a store as an input: still mixed, and told before.
  auto again = schemaSource("mixed", { { "gps_time", ScalarType::Float64 } });
  again->editDescription().metadata = common->metadata;
  Sources one;
  one.push_back(std::move(again));
  const auto stored = timedSystem(one);
  ASSERT_TRUE(stored);
  EXPECT_EQ(timesIn(*stored), GpsTimes::Mixed);
  EXPECT_TRUE(stored->warnings.empty());
}

TEST(ReferenceSystem, SourcesWithoutPointsHaveNoSayInGpsTimes)
{
  Sources sources;
  auto week = timed("no points, week", 0);
  week->editDescription().crsWkt = "a system";
  sources.push_back(std::move(week));
  auto mixed = timed("no points, both", 0);
  mixed->editDescription().metadata.push_back({ lasKeptOwner, lasMixedTimesRecord, "", {} });
  sources.push_back(std::move(mixed));
  sources.push_back(timed("standard", 1));
  const auto common = timedSystem(sources);
  ASSERT_TRUE(common);
  EXPECT_EQ(timesIn(*common), GpsTimes::Standard) << "though the records are those of the first";
  EXPECT_EQ(common->warnings.size(), 2u) << "two name no system";
}

/// A file with one colour for all its points.
std::unique_ptr<CloudSource> coloured(
  const std::string& path, double x, std::array<std::uint16_t, 3> rgb)
{
  AttributeSchema schema;
  schema.add({ "rgb", ScalarType::UInt16, 3 });
  auto cloud = std::make_unique<CloudSource>(path, schema, millimetres(), 100);
  for (int i = 0; i < 500; ++i)
  {
    cloud->addPosition({ x, i * 0.01, 0.0 });
    cloud->addValue(0, rgb);
  }
  return cloud;
}

/// The different colours of a store, as numbers of the stored width.
std::set<std::array<unsigned, 3>> coloursOf(const PointStore& store)
{
  std::set<std::array<unsigned, 3>> colours;
  const bool wide = store.description().schema[0].type == ScalarType::UInt16;
  for (NodeIndex n = 0; n < store.hierarchy()->nodeCount(); ++n)
  {
    const auto node = store.read(n, { 0 });
    EXPECT_TRUE(node);
    for (std::size_t i = 0; i < node->size(); ++i)
    {
      std::array<unsigned, 3> colour{};
      for (std::size_t k = 0; k < 3; ++k)
      {
        std::uint16_t value = 0;
        std::memcpy(
          &value, node->columns[0].data() + (wide ? 6 : 3) * i + (wide ? 2 : 1) * k, wide ? 2 : 1);
        colour[k] = value;
      }
      colours.insert(colour);
    }
  }
  return colours;
}

TEST(BuildColours, AreEightBitsIfAllFitAndAreWidenedFileByFile)
{
  const auto folder = freshFolder("colours");
  BuildOptions options;
  options.outputPath = (folder / "cloud.pfront").string();
  options.overwrite = true;
  options.nodePoints = 64;
  for (const std::uint64_t memory : { std::uint64_t(1) << 30, std::uint64_t(40) << 10 })
  {
    options.memoryBytes = memory;
    Sources sources;
    sources.push_back(coloured("dark", 0.0, { 0, 10, 255 }));
    sources.push_back(coloured("black", 1.0, { 0, 0, 0 }));
    ASSERT_TRUE(buildStore(sources, options));
    const auto narrow = PointStore::open(options.outputPath);
    ASSERT_TRUE(narrow);
    EXPECT_EQ((*narrow)->description().schema[0].type, ScalarType::UInt8);
    EXPECT_EQ(
      coloursOf(**narrow), (std::set<std::array<unsigned, 3>>{ { 0, 0, 0 }, { 0, 10, 255 } }));

    sources.push_back(coloured("wide", 2.0, { 3, 256, 65535 }));
    ASSERT_TRUE(buildStore(sources, options));
    const auto wide = PointStore::open(options.outputPath);
    ASSERT_TRUE(wide);
    EXPECT_EQ((*wide)->description().schema[0].type, ScalarType::UInt16);
    EXPECT_EQ(coloursOf(**wide),
      (std::set<std::array<unsigned, 3>>{ { 0, 0, 0 }, { 0, 2570, 65535 }, { 3, 256, 65535 } }));
  }
  std::filesystem::remove_all(folder);
}

TEST(BuildColours, AreAsDeepAsTheUserSays)
{
  const auto folder = freshFolder("depth");
  BuildOptions options;
  options.outputPath = (folder / "cloud.pfront").string();
  options.overwrite = true;
  Sources sources;
  sources.push_back(coloured("dark", 0.0, { 0, 10, 255 }));
  options.colourDepth = ColourDepth::Sixteen;
  ASSERT_TRUE(buildStore(sources, options));
  const auto dark = PointStore::open(options.outputPath);
  ASSERT_TRUE(dark);
  EXPECT_EQ((*dark)->description().schema[0].type, ScalarType::UInt16);
  EXPECT_EQ(coloursOf(**dark), (std::set<std::array<unsigned, 3>>{ { 0, 10, 255 } }));

  sources.push_back(coloured("wide", 2.0, { 3, 256, 65535 }));
  ASSERT_TRUE(buildStore(sources, options));
  const auto both = PointStore::open(options.outputPath);
  ASSERT_TRUE(both);
  EXPECT_EQ(
    coloursOf(**both), (std::set<std::array<unsigned, 3>>{ { 0, 10, 255 }, { 3, 256, 65535 } }));

  options.colourDepth = ColourDepth::Eight;
  const auto refused = buildStore(sources, options);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("'wide' has a colour of 65535"), std::string::npos);
  sources.pop_back();
  auto painted = coloured("painted", 2.0, { 3, 256, 65535 });
  painted->editDescription().colourImage = "ortho.tif";
  sources.push_back(std::move(painted));
  const auto blamed = buildStore(sources, options);
  ASSERT_FALSE(blamed);
  EXPECT_NE(blamed.error().what.find("'ortho.tif' has a colour of 65535"), std::string::npos);
  sources.pop_back();
  EXPECT_TRUE(buildStore(sources, options));
  std::filesystem::remove_all(folder);
}

} // namespace
} // namespace pointfront
