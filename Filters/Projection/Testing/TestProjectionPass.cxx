#include "ProjectionPass.h"

#include "ProjectedSink.h"

#include "CloudInMemory.h"

#include "LASFormat.h"
#include "LASWriter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

using namespace pointfront;
using pointfront::test::CloudInMemory;

namespace
{
std::string wkt(const char* code)
{
  const ProjCoordinateSystems known;
  return known.parse(code)->wkt;
}

std::unique_ptr<CloudInMemory> cloud(
  const char* path, glm::dvec3 corner, const std::string& system, double extent = 1000.0)
{
  return std::make_unique<CloudInMemory>(
    path, std::vector<glm::dvec3>{ corner, corner + glm::dvec3(extent, extent, 10.0) }, system);
}

struct Outcome
{
  PointSources sources;
  std::vector<std::string> findings;
  std::string error;

  std::string all() const
  {
    std::string text;
    for (const std::string& finding : findings)
    {
      text += finding + "\n";
    }
    return text;
  }
};

Outcome passed(PointSources sources, ProjectionOptions options = {})
{
  Outcome outcome;
  const ProjectionPass pass(std::move(options));
  Result<PointSources> result = pass.apply(std::move(sources), {});
  outcome.findings = pass.findings();
  if (result)
  {
    outcome.sources = std::move(*result);
  }
  else
  {
    outcome.error = result.error().what;
  }
  return outcome;
}

PointBatch firstChunk(const PointSource& source)
{
  PointBatch batch;
  const Result<void> done = source.read(0, batch);
  EXPECT_TRUE(done.ok()) << (done ? "" : done.error().what);
  return batch;
}

std::unique_ptr<PointSource> shared(const std::string& file)
{
  auto source = LASFormat().open(POINTFRONT_SHARED_DATA "/" + file);
  EXPECT_TRUE(source.ok()) << (source ? "" : source.error().what);
  return source ? std::move(*source) : nullptr;
}

PointSources listOf(std::unique_ptr<PointSource> a, std::unique_ptr<PointSource> b = nullptr)
{
  PointSources sources;
  sources.push_back(std::move(a));
  if (b)
  {
    sources.push_back(std::move(b));
  }
  return sources;
}
} // namespace

TEST(ProjectionPass, OneSystemStaysAsItIs)
{
  const Outcome outcome = passed(listOf(cloud("a", { 5e5, 5e6, 0 }, wkt("EPSG:32632")),
    cloud("b", { 5e5, 5e6, 0 }, wkt("EPSG:32632"))));
  ASSERT_EQ(outcome.sources.size(), 2u) << outcome.error;
  EXPECT_EQ(outcome.all(), "");
  EXPECT_EQ(firstChunk(*outcome.sources[1]).positions[0], glm::dvec3(5e5, 5e6, 0));
  EXPECT_FALSE(outcome.sources[0]->description().grid);
}

TEST(ProjectionPass, InputsThatDifferAreTransformedToTheFirst)
{
  // The same place, 9 degrees east, 45 north (z), as UTM 32 and as degrees.
  auto metres = cloud("a", { 500000.0, 4982950.4, 7.0 }, wkt("EPSG:32632"));
  metres->describe().grid = QuantisationGrid{ glm::dvec3(0.01), { 500000.0, 4980000.005, 0.0 } };
  auto angles = cloud("b", { 9.0, 45.0, 7.0 }, wkt("EPSG:4326"), 0.01);
  angles->describe().grid = QuantisationGrid{ { 1e-7, 1e-7, 0.01 }, {} };
  const Outcome outcome = passed(listOf(std::move(metres), std::move(angles)));
  ASSERT_EQ(outcome.sources.size(), 2u) << outcome.error;
  const SourceDescription& second = outcome.sources[1]->description();
  EXPECT_EQ(second.crsWkt, wkt("EPSG:32632"));
  const glm::dvec3 p = firstChunk(*outcome.sources[1]).positions[0];
  EXPECT_NEAR(p.x, 500000.0, 1e-6);
  EXPECT_NEAR(p.y, 4982950.4, 0.1); // 4,982,950.400 from tables of the meridian arc
  EXPECT_EQ(p.z, 7.0);
  ASSERT_TRUE(second.grid);
  EXPECT_NEAR(second.grid->scale.x, 0.001, 1e-15);
  EXPECT_EQ(second.grid->offset.y, 4980000.005) << "points of the first lie on this grid too";
  EXPECT_NEAR(second.declaredBounds.low.x, 500000.0, 10.0);
}

TEST(ProjectionPass, ATargetMovesAllAndDropsWhatRecordsSaidOfTheOldSystem)
{
  auto source = cloud("a", { 636000.0, 849000.0, 400.0 }, wkt("EPSG:2994"));
  source->describe().metadata = { { "LASF_Projection", 34735, "", {} },
    { "LASF_Spec", 4, "", {} } };
  ProjectionOptions options;
  options.target = "EPSG:26910";
  const Outcome outcome = passed(listOf(std::move(source)), options);
  ASSERT_EQ(outcome.sources.size(), 1u) << outcome.error;
  const SourceDescription& description = outcome.sources[0]->description();
  ASSERT_EQ(description.metadata.size(), 1u);
  EXPECT_EQ(description.metadata[0].owner, "LASF_Spec");
  EXPECT_EQ(description.crsWkt, wkt("EPSG:26910"));
  EXPECT_NEAR(description.grid->scale.x, 0.001, 1e-15);
  EXPECT_NE(outcome.all().find("names no system of heights"), std::string::npos) << outcome.all();
}

TEST(ProjectionPass, HeightsThatAreNamedStayNamed)
{
  ProjectionOptions options;
  options.target = "EPSG:26911";
  const Outcome outcome =
    passed(listOf(cloud("a", { 740000.0, 4800000.0, 1200.0 }, wkt("EPSG:26910+5703"))), options);
  ASSERT_EQ(outcome.sources.size(), 1u) << outcome.error;
  const ProjCoordinateSystems known;
  const auto now = known.parse(outcome.sources[0]->description().crsWkt);
  ASSERT_TRUE(now.ok());
  EXPECT_TRUE(known.equivalent(*now, *known.parse("EPSG:26911+5703"), false)) << now->name;
  EXPECT_NEAR(firstChunk(*outcome.sources[0]).positions[0].z, 1200.0, 1e-9);
}

TEST(ProjectedSink, NamesTheChoiceThatItsCallerHas)
{
  const std::string path = testing::TempDir() + "unplaced.las";
  ProjectedSink sink(std::make_unique<LASWriter>(path), "EPSG:4326", "AssumedCRS");
  const Result<void> begun = sink.begin({});
  ASSERT_FALSE(begun);
  EXPECT_NE(begun.error().what.find("build the store with AssumedCRS"), std::string::npos)
    << begun.error().what;
}

TEST(ProjectionPass, AnInputWithoutASystemIsToldOfAndNeverMoved)
{
  const Outcome alone = passed(listOf(cloud("bare.las", { 5, 5, 5 }, "")));
  ASSERT_EQ(alone.sources.size(), 1u);
  EXPECT_NE(alone.all().find("--assume-crs"), std::string::npos) << alone.all();

  ProjectionOptions target;
  target.target = "EPSG:32632";
  const Outcome refused = passed(listOf(cloud("bare.las", { 5, 5, 5 }, "")), target);
  EXPECT_NE(refused.error.find("bare.las: names no coordinate"), std::string::npos)
    << refused.error;

  target.assumed = "EPSG:4326";
  const Outcome moved = passed(listOf(cloud("bare.las", { 9, 45, 5 }, "", 0.1)), target);
  ASSERT_EQ(moved.sources.size(), 1u) << moved.error;
  EXPECT_NEAR(firstChunk(*moved.sources[0]).positions[0].x, 500000.0, 1e-6);
}

TEST(ProjectionPass, DegreesAreRecognisedAndProjectedOnlyWhenAsked)
{
  const Outcome stated = passed(listOf(cloud("a", { 13.4, 52.5, 30.0 }, wkt("EPSG:4326"), 0.01)));
  EXPECT_NE(stated.all().find("--crs utm"), std::string::npos) << stated.all();
  ASSERT_EQ(stated.sources.size(), 1u);
  ASSERT_TRUE(stated.sources[0]->description().grid) << "a millimetre is no step for degrees";
  EXPECT_EQ(stated.sources[0]->description().grid->scale.x, 1e-9);
  EXPECT_EQ(firstChunk(*stated.sources[0]).positions[0].x, 13.4);

  auto silent = cloud("a.las", { 13.4, 52.5, 30.0 }, "", 0.01);
  silent->describe().grid = QuantisationGrid{ { 1e-7, 1e-7, 0.01 }, {} };
  const Outcome guessed = passed(listOf(std::move(silent)));
  EXPECT_NE(guessed.all().find("a.las: the coordinates look like"), std::string::npos)
    << guessed.all();

  ProjectionOptions options;
  options.target = "utm";
  const Outcome asked =
    passed(listOf(cloud("a", { 13.4, 52.5, 30.0 }, wkt("EPSG:4326"), 0.01)), options);
  ASSERT_EQ(asked.sources.size(), 1u) << asked.error;
  EXPECT_NE(asked.sources[0]->description().crsWkt.find("UTM zone 33N"), std::string::npos);
  EXPECT_NEAR(firstChunk(*asked.sources[0]).positions[0].x, 391000.0, 1000.0);
}

TEST(ProjectionPass, ATargetMayBeAFileAndAWrongOneIsNamed)
{
  const std::string path = testing::TempDir() + "target.wkt";
  std::ofstream(path) << wkt("EPSG:32633") << "\n";
  ProjectionOptions options;
  options.target = path;
  const Outcome outcome = passed(listOf(cloud("a", { 5e5, 5e6, 0 }, wkt("EPSG:32632"))), options);
  ASSERT_EQ(outcome.sources.size(), 1u) << outcome.error;
  std::ofstream(path) << "nothing of the kind";
  EXPECT_NE(passed(listOf(cloud("a", { 5e5, 5e6, 0 }, wkt("EPSG:32632"))), options)
              .error.find("target.wkt"),
    std::string::npos);
}

TEST(ProjectionPass, AnErrorOfProjNamesTheFile)
{
  ProjectionOptions options;
  options.target = "EPSG:32632";
  const Outcome outcome =
    passed(listOf(cloud("feet.las", { 5e5, 5e6, 0 }, wkt("EPSG:4326"))), options);
  EXPECT_NE(outcome.error.find("feet.las: "), std::string::npos) << outcome.error;
  EXPECT_NE(outcome.error.find("can be transformed"), std::string::npos) << outcome.error;
}

// libLAS cut one cloud and transformed it: autzen-dd.las to degrees, autzen-utm.las to UTM.
TEST(ProjectionPass, ARealFileInDegreesIsWhereItsCopyInMetresIs)
{
  ProjectionOptions options;
  options.target = "EPSG:32610"; // the same datum: the copy took NAD83 for WGS 84
  const Outcome outcome = passed(listOf(shared("las/real/autzen-dd.las")), options);
  ASSERT_EQ(outcome.sources.size(), 1u) << outcome.error;
  const std::unique_ptr<PointSource> expected = shared("las/real/autzen-utm.las");
  ASSERT_TRUE(expected);
  const PointBatch here = firstChunk(*outcome.sources[0]);
  const PointBatch there = firstChunk(*expected);
  ASSERT_EQ(here.size(), there.size());
  double farthest = 0.0;
  for (std::size_t i = 0; i < here.size(); ++i)
  {
    const glm::dvec3 d = here.positions[i] - there.positions[i];
    farthest = std::max(farthest, std::hypot(d.x, d.y));
  }
  EXPECT_LT(farthest, 0.02) << "both files are rounded to about a centimetre";
}

TEST(ProjectionPass, RealGeoKeysBecomeWkt)
{
  struct Case
  {
    const char* file;
    const char* words;
  };
  for (const Case& c : { Case{ "las/real/epsg_4326.las", "GEOGCS[\"WGS 84\"" },
         Case{ "las/real/mvk-thin.las", "NAD83 / Mississippi West" },
         Case{ "las/real/4_6_crop.las", "NAVD88 height (ftUS)" },
         Case{ "las/version_x_format/las1.1_pf0_10pts.las", "JGD2011" },
         Case{ "laz/lazperf_1815.laz", "NAVD88 height" } })
  {
    const Outcome outcome = passed(listOf(shared(c.file)));
    ASSERT_EQ(outcome.sources.size(), 1u) << outcome.error;
    const SourceDescription& description = outcome.sources[0]->description();
    EXPECT_NE(description.crsWkt.find(c.words), std::string::npos)
      << c.file << ": " << description.crsWkt << outcome.all();
    EXPECT_FALSE(description.metadata.empty()) << "the keys go on with the points";
  }
  const Outcome own = passed(listOf(shared("las/real/prec3.las")));
  EXPECT_EQ(own.sources.at(0)->description().crsWkt, "");
  EXPECT_NE(
    own.all().find("prec3.las: its coordinate reference system is not known"), std::string::npos)
    << own.all();
}

TEST(ProjectionPass, NoUtmZoneIsGuessedAcrossTheAntimeridian)
{
  ProjectionOptions options;
  options.target = "utm";
  auto fiji = std::make_unique<CloudInMemory>("fiji",
    std::vector<glm::dvec3>{ { 179.95, -17.0, 5.0 }, { -179.96, -17.01, 5.0 } }, wkt("EPSG:4326"));
  const Outcome outcome = passed(listOf(std::move(fiji)), options);
  EXPECT_NE(outcome.error.find("fiji: "), std::string::npos) << outcome.error;
  EXPECT_NE(outcome.error.find("antimeridian"), std::string::npos) << outcome.error;
  EXPECT_NE(outcome.error.find("name the zone"), std::string::npos) << outcome.error;
}
