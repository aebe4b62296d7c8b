#include "ProjCoordinateSystems.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <thread>

using namespace pointfront;

namespace
{
CoordinateSystem named(const ProjCoordinateSystems& known, const std::string& definition)
{
  Result<CoordinateSystem> system = known.parse(definition);
  EXPECT_TRUE(system.ok()) << (system ? "" : system.error().what);
  return system ? *system : CoordinateSystem();
}

glm::dvec3 moved(
  const ProjCoordinateSystems& known, const std::string& from, const std::string& to, glm::dvec3 p)
{
  auto transform = known.transform(named(known, from), named(known, to), {});
  EXPECT_TRUE(transform.ok()) << (transform ? "" : transform.error().what);
  const Result<void> done = transform ? (*transform)->apply(&p, 1) : Result<void>();
  EXPECT_TRUE(done.ok()) << (done ? "" : done.error().what);
  return p;
}

constexpr double degrees(int whole, double minutes, double seconds = 0.0)
{
  return whole + minutes / 60.0 + seconds / 3600.0;
}

GeoKeys keys(std::vector<std::uint16_t> entries)
{
  std::vector<std::uint16_t> words{ 1, 1, 0, static_cast<std::uint16_t>(entries.size() / 2) };
  for (std::size_t i = 0; i < entries.size(); i += 2)
  {
    words.insert(words.end(), { entries[i], 0, 1, entries[i + 1] });
  }
  return GeoKeys::parse(words, "");
}
} // namespace

// The worked examples of IOGP publication 373-7-2 (EPSG Guidance Note 7, part 2), section 3: made
// by others, with other programs.
TEST(ProjCoordinateSystems, WorkedExamplesOfTheEpsgGuidanceNote)
{
  const ProjCoordinateSystems known;
  struct Example
  {
    const char* geographic;
    const char* projected;
    double longitude;
    double latitude;
    double easting;
    double northing;
  };
  const Example examples[] = {
    { "EPSG:4277", "EPSG:27700", 0.5, 50.5, 577274.99, 69740.50 }, // TM, metres
    { "EPSG:4267", "EPSG:32040", -96.0, 28.5, 2963503.91, 254759.80 }, // LCC, feet
    { "EPSG:4242", "EPSG:24200", -degrees(76, 56, 37.26), degrees(17, 55, 55.80), 255966.58,
      142493.51 }, // LCC, metres
    { "EPSG:4326", "EPSG:32661", 44.0, 73.0, 3320416.75, 632668.43 }, // north before east
  };
  for (const Example& e : examples)
  {
    const glm::dvec3 p = moved(known, e.geographic, e.projected, { e.longitude, e.latitude, 12.5 });
    EXPECT_NEAR(p.x, e.easting, 0.01) << e.projected;
    EXPECT_NEAR(p.y, e.northing, 0.01) << e.projected;
    EXPECT_EQ(p.z, 12.5) << "heights stay where no system of heights is named";
    const glm::dvec3 back = moved(known, e.projected, e.geographic, p);
    EXPECT_NEAR(back.x, e.longitude, 1e-9) << e.projected;
    EXPECT_NEAR(back.y, e.latitude, 1e-9) << e.projected;
  }
}

TEST(ProjCoordinateSystems, CoordinatesOfTenMillionKeepAMicrometre)
{
  const ProjCoordinateSystems known;
  constexpr double radius = 6378137.0; // EPSG:3857 is exactly this sphere
  const glm::dvec3 p = moved(known, "EPSG:4326", "EPSG:3857", { 120.0, 60.0, 0.0 });
  EXPECT_NEAR(p.x, radius * 2.0 * M_PI / 3.0, 1e-6);
  EXPECT_NEAR(p.y, radius * std::log(std::tan(M_PI / 4.0 + M_PI / 6.0)), 1e-6);

  std::mt19937 random(20100); // NOLINT: a fixed seed
  std::uniform_real_distribution<double> easting(200000.0, 800000.0);
  std::uniform_real_distribution<double> northing(1000.0, 9999999.0);
  std::vector<glm::dvec3> points(10000);
  for (glm::dvec3& q : points)
  {
    q = { easting(random), northing(random), 100.0 };
  }
  std::vector<glm::dvec3> there = points; // the southern hemisphere, to degrees and back
  const auto utm = named(known, "EPSG:32733");
  const auto globe = named(known, "EPSG:4326");
  ASSERT_TRUE((*known.transform(utm, globe, {}))->apply(there.data(), there.size()).ok());
  ASSERT_TRUE((*known.transform(globe, utm, {}))->apply(there.data(), there.size()).ok());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    ASSERT_NEAR(there[i].x, points[i].x, 1e-6);
    ASSERT_NEAR(there[i].y, points[i].y, 1e-6);
  }
}

TEST(ProjCoordinateSystems, HeightsAreConvertedWhereBothSidesNameThem)
{
  const ProjCoordinateSystems known;
  const glm::dvec3 p =
    moved(known, "EPSG:26910+5703", "EPSG:26911+6360", { 740000.0, 4800000.0, 1200.0 });
  EXPECT_NEAR(p.z, 3937.0, 1e-6); // metres to US survey feet
  const CoordinateSystem tall = named(known, "EPSG:26910+5703");
  EXPECT_TRUE(tall.vertical);
  EXPECT_EQ(tall.heightUnit, 1.0);
  const CoordinateSystem feet = named(known, "EPSG:2994");
  EXPECT_FALSE(feet.vertical);
  EXPECT_FALSE(feet.geographic);
  EXPECT_DOUBLE_EQ(feet.unitLength, 0.3048);
  EXPECT_TRUE(named(known, "EPSG:4326").geographic);
  EXPECT_TRUE(named(known, "EPSG:4979").vertical);
  EXPECT_TRUE(named(known, "EPSG:4978").geocentric);
  const auto both = known.compound(named(known, "EPSG:32610"), tall);
  ASSERT_TRUE(both.ok()) << both.error().what;
  EXPECT_TRUE(both->vertical);
  EXPECT_TRUE(known.equivalent(*both, named(known, "EPSG:32610+5703"), false));
}

TEST(ProjCoordinateSystems, TheSameSystemInOtherWordsIsTheSame)
{
  const ProjCoordinateSystems known;
  const CoordinateSystem code = named(known, "EPSG:2994");
  const CoordinateSystem words = named(known, code.wkt);
  EXPECT_EQ(code.wkt.substr(0, 7), "PROJCS[") << "WKT 1, as LAS asks for";
  EXPECT_TRUE(known.equivalent(code, words, false));
  EXPECT_FALSE(known.equivalent(code, named(known, "EPSG:2992"), false)); // feet against feet too
  const CoordinateSystem tall = named(known, "EPSG:2994+5703");
  EXPECT_FALSE(known.equivalent(code, tall, false));
  EXPECT_TRUE(known.equivalent(code, tall, true));
}

TEST(ProjCoordinateSystems, GeoKeysNameACodeOrSayThatTheyDoNot)
{
  const ProjCoordinateSystems known;
  std::vector<std::string> warnings;
  const auto utm = known.fromGeoKeys(keys({ 1024, 1, 3072, 26910, 3076, 9001 }), warnings);
  ASSERT_TRUE(utm.ok()) << utm.error().what;
  EXPECT_EQ(utm->name, "NAD83 / UTM zone 10N (EPSG:26910)");
  const auto globe = known.fromGeoKeys(keys({ 1024, 2, 2048, 4326 }), warnings);
  ASSERT_TRUE(globe.ok()) << globe.error().what;
  EXPECT_TRUE(globe->geographic);
  EXPECT_TRUE(warnings.empty());

  const auto own = known.fromGeoKeys(keys({ 1024, 1, 3072, 32767, 2048, 4269 }), warnings);
  ASSERT_FALSE(own.ok());
  EXPECT_EQ(own.error().kind, Error::Kind::Unsupported);
  EXPECT_NE(own.error().what.find("of their own"), std::string::npos) << own.error().what;
  EXPECT_FALSE(known.fromGeoKeys(keys({ 1025, 2, 3076, 9001 }), warnings).ok());
  const auto never = known.fromGeoKeys(keys({ 1024, 1, 3072, 1999 }), warnings);
  ASSERT_FALSE(never.ok());
  EXPECT_NE(never.error().what.find("EPSG:1999"), std::string::npos) << never.error().what;
}

TEST(ProjCoordinateSystems, KeysWithAnotherUnitMeanTheSystemInThatUnit)
{
  const ProjCoordinateSystems known;
  std::vector<std::string> warnings;
  // NAD83 / Mississippi West is defined in metres; the keys say US survey feet.
  const auto feet = known.fromGeoKeys(keys({ 1024, 1, 3072, 26995, 3076, 9003 }), warnings);
  ASSERT_TRUE(feet.ok()) << feet.error().what;
  EXPECT_EQ(warnings.size(), 1u);
  EXPECT_DOUBLE_EQ(feet->unitLength, 1200.0 / 3937.0);
  const auto metres = named(known, "EPSG:26995");
  glm::dvec3 p{ 700000.0, 400000.0, 0.0 };
  const auto transform = known.transform(metres, *feet, {});
  ASSERT_TRUE(transform.ok()) << transform.error().what;
  ASSERT_TRUE((*transform)->apply(&p, 1).ok());
  EXPECT_NEAR(p.x, 700000.0 * 3937.0 / 1200.0, 1e-4);
  EXPECT_NEAR(p.y, 400000.0 * 3937.0 / 1200.0, 1e-4);
}

TEST(ProjCoordinateSystems, KeysOfHeightsMakeACompoundSystem)
{
  const ProjCoordinateSystems known;
  std::vector<std::string> warnings;
  const auto feet =
    known.fromGeoKeys(keys({ 1024, 1, 3072, 2903, 3076, 9003, 4096, 5103, 4099, 9003 }), warnings);
  ASSERT_TRUE(feet.ok()) << feet.error().what;
  EXPECT_TRUE(feet->vertical);
  EXPECT_DOUBLE_EQ(feet->heightUnit, 1200.0 / 3937.0);
  EXPECT_TRUE(warnings.empty());
  const auto odd = known.fromGeoKeys(keys({ 1024, 1, 3072, 26910, 4096, 5030 }), warnings);
  ASSERT_TRUE(odd.ok()) << odd.error().what;
  EXPECT_FALSE(odd->vertical);
  EXPECT_EQ(warnings.size(), 1u);
}

TEST(ProjCoordinateSystems, UtmZones)
{
  const ProjCoordinateSystems known;
  const auto zone = [&](const char* system, double x, double y) -> std::string
  {
    const auto found = known.utmZone(named(known, system), { x, y, 0.0 });
    return found ? found->name : found.error().what;
  };
  EXPECT_EQ(zone("EPSG:4326", 13.4, 52.5), "WGS 84 / UTM zone 33N");
  EXPECT_EQ(zone("EPSG:4326", -70.6, -33.4), "WGS 84 / UTM zone 19S");
  EXPECT_EQ(zone("EPSG:4326", 179.9, 1.0), "WGS 84 / UTM zone 60N");
  EXPECT_EQ(zone("EPSG:4326", -180.0, 1.0), "WGS 84 / UTM zone 1N");
  EXPECT_EQ(zone("EPSG:4326", 5.3, 60.4), "WGS 84 / UTM zone 32N"); // Bergen
  EXPECT_EQ(zone("EPSG:4326", 15.6, 78.2), "WGS 84 / UTM zone 33N"); // Longyearbyen
  EXPECT_EQ(zone("EPSG:2994", 636000.0, 849000.0), "NAD83(HARN) / UTM zone 10N");
  EXPECT_NE(zone("EPSG:4326", 0.0, 89.0).find("outside"), std::string::npos);
  const auto ten = known.utmZone(named(known, "EPSG:4269"), { -123.0, 44.0, 0.0 });
  ASSERT_TRUE(ten.ok());
  EXPECT_TRUE(known.equivalent(*ten, named(known, "EPSG:26910"), false));
}

TEST(ProjCoordinateSystems, WhatIsNoSystemIsRefusedWithTheReason)
{
  const ProjCoordinateSystems known;
  for (const char* definition :
    { "", "EPSG:999999", "nonsense", "PROJCS[\"x\"", "EPSG:5703", "+proj=utm +zone=32", "EPSG:1" })
  {
    const auto system = known.parse(definition);
    ASSERT_FALSE(system.ok()) << definition;
    EXPECT_FALSE(system.error().what.empty());
  }
}

TEST(ProjCoordinateSystems, PointsThatCannotBeTransformedBecomeInfinite)
{
  const ProjCoordinateSystems known;
  const auto transform = known.transform(named(known, "EPSG:32632"), named(known, "EPSG:4326"), {});
  ASSERT_TRUE(transform.ok());
  std::vector<glm::dvec3> points{ { 500000, 5000000, 1 }, { 1e30, 5e6, 1 }, { NAN, 1, 1 } };
  ASSERT_TRUE((*transform)->apply(points.data(), 3).ok());
  EXPECT_NEAR(points[0].x, 9.0, 1e-9);
  EXPECT_FALSE(std::isfinite(points[1].x + points[1].y));
  EXPECT_FALSE(std::isfinite(points[2].x + points[2].y));
  std::vector<glm::dvec3> none{ { 1e30, 1e30, 1 }, { -1e30, 1e30, 1 } };
  const Result<void> done = (*transform)->apply(none.data(), 2);
  ASSERT_FALSE(done.ok());
  EXPECT_NE(done.error().what.find("not one of 2 points"), std::string::npos) << done.error().what;
}

TEST(ProjCoordinateSystems, ManyThreadsShareOneTransformation)
{
  const ProjCoordinateSystems known;
  const auto transform = known.transform(named(known, "EPSG:4326"), named(known, "EPSG:32632"), {});
  ASSERT_TRUE(transform.ok());
  std::vector<glm::dvec3> expected(2000);
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    expected[i] = { 6.0 + 0.003 * static_cast<double>(i), 47.0, 0.0 };
  }
  const std::vector<glm::dvec3> start = expected;
  ASSERT_TRUE((*transform)->apply(expected.data(), expected.size()).ok());
  std::vector<std::thread> threads;
  std::vector<int> differences(4, 0);
  for (std::size_t t = 0; t < differences.size(); ++t)
  {
    threads.emplace_back(
      [&, t]
      {
        for (int round = 0; round < 10; ++round)
        {
          std::vector<glm::dvec3> own = start;
          const bool done = (*transform)->apply(own.data(), own.size()).ok();
          differences[t] += done && own == expected ? 0 : 1;
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(differences, std::vector<int>(4, 0));
}
