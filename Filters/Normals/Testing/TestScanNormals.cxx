#include "NormalClouds.h"

#include "NormalsPass.h"
#include "ScanNormals.h"
#include "ScanNormalsPass.h"

#include "pointfront/Generate/TerrainSource.h"

namespace
{
using namespace pointfront;
using namespace pointfront::test;

/// `lines` lines of `points` points on a plane of slope (0.5, 0.25), 0.5 m apart; there and back,
/// or always forth.
Positions slope(int lines, int points, bool zigzag)
{
  Positions positions;
  for (int l = 0; l < lines; ++l)
  {
    for (int i = 0; i < points; ++i)
    {
      const double x = 0.5 * (zigzag && l % 2 == 1 ? points - 1 - i : i);
      const double y = 0.5 * l + 0.001 * i;
      positions.emplace_back(4e5 + x, 5.6e6 + y, 100.0 + 0.5 * x + 0.25 * y);
    }
  }
  return positions;
}

TEST(ScanNormals, LinesAreFoundByJumpsAndByTurns)
{
  for (const bool zigzag : { false, true })
  {
    const std::vector<std::size_t> begins = scanLines(slope(7, 100, zigzag));
    ASSERT_EQ(begins.size(), 8u) << "zigzag " << zigzag;
    for (std::size_t l = 0; l < begins.size(); ++l)
    {
      EXPECT_NEAR(double(begins[l]), 100.0 * double(l), 1.0);
    }
  }
  EXPECT_EQ(scanLines({}), std::vector<std::size_t>{ 0 });
  EXPECT_EQ(scanLines(Positions(5, glm::dvec3(1.0))).back(), 5u);
}

TEST(ScanNormals, OfAPlaneAreExact)
{
  const glm::dvec3 expected = glm::normalize(glm::dvec3(-0.5, -0.25, 1.0));
  for (const bool zigzag : { false, true })
  {
    std::vector<PackedNormal> normals;
    scanNormals(slope(20, 100, zigzag), normals);
    ASSERT_EQ(normals.size(), 2000u);
    for (const PackedNormal& n : normals)
    {
      EXPECT_GT(glm::dot(unpackNormal(n), expected), 1.0 - 1e-7);
    }
  }
}

TEST(ScanNormals, WithoutATriangleThereIsNone)
{
  for (const Positions& positions :
    { Positions{}, Positions(3, glm::dvec3(7.0)), slope(1, 50, false) })
  {
    const ScanNormalsPass pass(std::nullopt);
    for (const PackedNormal& n : normalsBy(pass, sourcesOf(positions)))
    {
      EXPECT_EQ(n, PackedNormal(0));
    }
    EXPECT_EQ(pass.findings().size(), positions.empty() ? 0u : 1u);
  }
}

TEST(ScanNormals, PointsWithoutOneAreCountedOnceHoweverOftenTheyAreRead)
{
  const ScanNormalsPass pass(std::nullopt);
  for (int build = 0; build < 2; ++build)
  {
    const auto sources = pass.apply(sourcesOf(Positions(2500, glm::dvec3(7.0))), {});
    ASSERT_TRUE(sources) << sources.error().what;
    for (int reading = 0; reading < 3; ++reading)
    {
      EXPECT_EQ(attributeOf<PackedNormal>(*sources, "normal").size(), 2500u);
    }
    ASSERT_EQ(pass.findings().size(), 1u);
    EXPECT_EQ(pass.findings()[0].find("2500 points have no normal"), 0u) << pass.findings()[0];
  }
}

TEST(ScanNormals, OnGeneratedGroundTheyAreCoarserThanPCA)
{
  // Up to 2 cm of noise, and neighbours that are 0 to 60 cm apart.
  const TerrainSource terrain(65536, 3);
  PointBatch batch;
  ASSERT_TRUE(terrain.read(0, batch));
  const auto objectClass = batch.columns[*terrain.description().schema.find("classification")];
  std::vector<std::uint8_t> classes(batch.size());
  std::memcpy(classes.data(), objectClass.data(), classes.size());
  const std::vector<std::uint8_t> ground{ 2 };
  const auto scan =
    normalsBy(ScanNormalsPass(std::optional(ground)), sourcesOf(batch.positions, classes));
  NormalsOptions options;
  options.neighbours = 32;
  options.classes = ground;
  const auto pca = normalsBy(NormalsPass(options), sourcesOf(batch.positions, classes));
  std::vector<PackedNormal> a;
  std::vector<PackedNormal> b;
  for (std::size_t i = 0; i < classes.size(); ++i)
  {
    if (classes[i] != 2)
    {
      EXPECT_EQ(scan[i], PackedNormal(0));
    }
    else if (scan[i] != PackedNormal(0) && pca[i] != PackedNormal(0))
    {
      a.push_back(scan[i]);
      b.push_back(pca[i]);
    }
  }
  EXPECT_GT(static_cast<double>(a.size()),
    0.95 * static_cast<double>(std::count(classes.begin(), classes.end(), 2)));
  EXPECT_LT(rmsDegrees(a, b), 25.0);
  EXPECT_GT(rmsDegrees(a, b), 1.0);
}

TEST(ScanNormals, TowardsTheScanner)
{
  PointSources sources = sourcesOf(slope(20, 100, true));
  auto& description = dynamic_cast<CloudSource&>(*sources[0]).editDescription();
  description.scanners = { { 0, glm::dvec3(4e5, 5.6e6, 0.0) } };
  for (const PackedNormal& n : normalsBy(ScanNormalsPass(std::nullopt), std::move(sources)))
  {
    EXPECT_LT(n.z, 0); // from below
  }
}
} // namespace
