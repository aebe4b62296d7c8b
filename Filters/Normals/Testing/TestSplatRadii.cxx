#include "NormalClouds.h"
#include "SplatPatterns.h"

#include "NormalsPass.h"
#include "SplatCodes.h"

#include "pointfront/Build/StoreBuilder.h"
#include "pointfront/Store/PointStore.h"

namespace
{
using namespace pointfront;
using namespace pointfront::test;

struct Radii
{
  std::vector<std::uint8_t> codes;
  double base = 0.0;
  float operator[](std::size_t i) const { return decodeSplatRadius(codes[i], base); }
};

NormalsOptions radiiOnly()
{
  NormalsOptions options;
  options.normals = false;
  return options;
}

Radii radiiBy(const NormalsOptions& options, PointSources sources,
  const PassResources& resources = testResources())
{
  Result<PointSources> result = NormalsPass(options).apply(std::move(sources), resources);
  EXPECT_TRUE(result) << (result ? "" : result.error().what);
  return { attributeOf<std::uint8_t>(*result, splatRadiusAttribute),
    result->front()->description().splatRadiusBase };
}

Positions scaled(Positions positions, double scale, const glm::dvec3& origin)
{
  for (glm::dvec3& p : positions)
  {
    p = p * scale + origin;
  }
  return positions;
}

TEST(SplatRadii, DiscsCloseAPlane)
{
  SplatPatterns patterns(1);
  for (const Positions& plane : { patterns.blueNoise(4000), patterns.scanLines(4000, 2.0) })
  {
    const Radii radii = radiiBy(radiiOnly(), sourcesOf(plane));
    ASSERT_EQ(radii.codes.size(), plane.size());
    EXPECT_EQ(std::exp2(std::round(std::log2(radii.base))), radii.base);
    const double holes = holesOf(plane, [&](std::size_t i) { return visibleShare * radii[i]; });
    EXPECT_LT(holes, 0.001);
    const double h = 1.0 / std::sqrt(static_cast<double>(plane.size()));
    double sum = 0.0;
    for (std::size_t i = 0; i < plane.size(); ++i)
    {
      EXPECT_GT(radii[i], 0.0f);
      sum += radii[i];
    }
    EXPECT_NEAR(sum / static_cast<double>(plane.size()), 1.02 * h, 0.12 * h);
  }
}

TEST(SplatRadii, ComeWithNormalsAndChangeThemNot)
{
  SplatPatterns patterns(2);
  const Positions plane = patterns.scanLines(3000, 2.0);
  NormalsOptions with;
  with.curvature = true;
  NormalsOptions without = with;
  without.splatRadius = false;
  const auto both = NormalsPass(with).apply(sourcesOf(plane), testResources());
  const auto plain = NormalsPass(without).apply(sourcesOf(plane), testResources());
  ASSERT_TRUE(both && plain);
  EXPECT_FALSE(plain->front()->description().schema.find(splatRadiusAttribute));
  EXPECT_EQ(plain->front()->description().splatRadiusBase, 0.0);
  EXPECT_EQ(
    attributeOf<PackedNormal>(*both, "normal"), attributeOf<PackedNormal>(*plain, "normal"));
  EXPECT_EQ(attributeOf<std::uint16_t>(*both, "curvature"),
    attributeOf<std::uint16_t>(*plain, "curvature"));
  const Radii alone = radiiBy(radiiOnly(), sourcesOf(plane));
  EXPECT_EQ(attributeOf<std::uint8_t>(*both, splatRadiusAttribute), alone.codes);
}

TEST(SplatRadii, DoNotDependOnFewNeighboursOfNormals)
{
  SplatPatterns patterns(7);
  Positions points = patterns.scanLines(3000, 2.0);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i].z = 0.002 * static_cast<double>(i * 7919 % 13);
  }
  for (int i = 0; i < 3000; ++i)
  {
    points.emplace_back(2.0 + 0.01 * (i % 60), 0.01 * (i / 60), i % 3 == 0 ? 0.005 : 0.0);
    if (i % 5 == 0)
    {
      points.push_back(points.back()); // twice
    }
  }
  const Radii alone = radiiBy(radiiOnly(), sourcesOf(points));
  for (const std::uint32_t neighbours : { 3u, 8u, 15u })
  {
    NormalsOptions with;
    with.neighbours = neighbours;
    with.curvature = true;
    NormalsOptions without = with;
    without.splatRadius = false;
    const auto both = NormalsPass(with).apply(sourcesOf(points), testResources());
    const auto plain = NormalsPass(without).apply(sourcesOf(points), testResources());
    ASSERT_TRUE(both && plain);
    EXPECT_EQ(attributeOf<std::uint8_t>(*both, splatRadiusAttribute), alone.codes) << neighbours;
    EXPECT_EQ(both->front()->description().splatRadiusBase, alone.base) << neighbours;
    EXPECT_EQ(
      attributeOf<PackedNormal>(*both, "normal"), attributeOf<PackedNormal>(*plain, "normal"))
      << neighbours;
    EXPECT_EQ(attributeOf<std::uint16_t>(*both, "curvature"),
      attributeOf<std::uint16_t>(*plain, "curvature"))
      << neighbours;
  }
}

// Regular lattices are full of neighbours at the same distance.
TEST(SplatRadii, DependNeitherOnTilesNorOnThreads)
{
  SplatPatterns patterns(3);
  Positions points = patterns.scanLines(6000, 2.0);
  for (int i = 0; i < 6000; ++i)
  {
    points.emplace_back(2.0 + 0.01 * (i % 80), 0.01 * (i / 80), 0.0);
  }
  const Radii whole = radiiBy(radiiOnly(), sourcesOf(points));
  for (const unsigned threads : { 1u, 7u })
  {
    for (const std::uint64_t tilePoints : { 300u, 2000u })
    {
      NormalsOptions options = radiiOnly();
      options.tilePoints = tilePoints;
      PassResources resources = testResources();
      resources.threads = threads;
      const Radii cut = radiiBy(options, sourcesOf(points), resources);
      EXPECT_EQ(cut.base, whole.base);
      EXPECT_EQ(cut.codes, whole.codes) << threads << " threads, tiles of " << tilePoints;
    }
  }
}

TEST(SplatRadii, TenThousandKilometresAwayAreTheSame)
{
  SplatPatterns patterns(4);
  Positions plane = patterns.scanLines(2000, 2.0);
  for (glm::dvec3& p : plane)
  {
    p = glm::round(p * 1024.0) / 1024.0; // exact there, too
  }
  const Radii here = radiiBy(radiiOnly(), sourcesOf(plane));
  const Radii there =
    radiiBy(radiiOnly(), sourcesOf(scaled(plane, 1.0, { 16777216.0, -16777216.0, 4096.0 })));
  EXPECT_EQ(here.codes, there.codes);
  const Radii large = radiiBy(radiiOnly(), sourcesOf(scaled(plane, 1048576.0, glm::dvec3(0.0))));
  EXPECT_EQ(large.base, 1048576.0 * here.base);
  EXPECT_EQ(large.codes, here.codes);
}

TEST(SplatRadii, Extremes)
{
  EXPECT_EQ(radiiBy(radiiOnly(), sourcesOf({})).base, 0.0);
  const Radii one = radiiBy(radiiOnly(), sourcesOf({ glm::dvec3(1.0) }));
  EXPECT_EQ(one.codes, std::vector<std::uint8_t>{ 0 });
  EXPECT_EQ(one.base, 0.0);
  const Radii equal = radiiBy(radiiOnly(), sourcesOf(Positions(100, glm::dvec3(1.0))));
  EXPECT_EQ(equal.codes, std::vector<std::uint8_t>(100, 0));
  Positions line;
  for (int i = 0; i < 50; ++i)
  {
    line.emplace_back(2.0 * i, 0.0, 0.0);
    line.emplace_back(2.0 * i, 0.0, 0.0); // each twice
  }
  const Radii wire = radiiBy(radiiOnly(), sourcesOf(line));
  for (std::size_t i = 10; i < 90; ++i)
  {
    EXPECT_GE(wire[i], 1.25f * 1.0f);
    EXPECT_LE(wire[i], 1.25f * 1.05f);
  }
  const double nan = std::nan("");
  const Radii broken = radiiBy(
    radiiOnly(), sourcesOf({ glm::dvec3(0.0), glm::dvec3(nan), glm::dvec3(2.0, 0.0, 0.0) }));
  EXPECT_EQ(broken.codes[1], 0);
  EXPECT_GE(broken[0], 1.25f);
  EXPECT_GE(broken[2], 1.25f);
}

// A radius is too fine or too coarse for a byte only if it is far from the usual one.
TEST(SplatRadii, TheBaseIsThatOfMost)
{
  SplatCodes codes;
  for (int i = 0; i < 1000; ++i)
  {
    codes.count(waitingRadius(0.3));
  }
  EXPECT_EQ(codes.base(), 0.25);
  codes.count(waitingRadius(1e-9));
  codes.count(waitingRadius(1e9));
  const double base = codes.base();
  EXPECT_EQ(base, 0.25);
  EXPECT_EQ(splatCode(waitingRadius(1e-9), base), 1);
  EXPECT_EQ(splatCode(waitingRadius(1e9), base), 255);
  EXPECT_EQ(splatCode(0, base), 0);
  for (double radius = 0.002; radius < 50.0; radius *= 1.01)
  {
    EXPECT_EQ(splatCode(waitingRadius(radius), base), encodeSplatRadius(radius, base)) << radius;
  }
}

TEST(SplatRadii, StoresKeepThem)
{
  SplatPatterns patterns(5);
  const Positions plane = patterns.scanLines(4000, 2.0);
  const Radii expected = radiiBy(radiiOnly(), sourcesOf(plane));
  for (const Refinement refinement : { Refinement::Add, Refinement::Replace })
  {
    const auto folder = freshFolder("splat-radii");
    BuildOptions options;
    options.outputPath = (folder / "plane.pfront").string();
    options.precision = 1e-6;
    options.nodePoints = 300;
    options.refinement = refinement;
    Result<PointSources> sources =
      NormalsPass(radiiOnly()).apply(sourcesOf(plane), testResources());
    ASSERT_TRUE(sources);
    const auto report = buildStore(*sources, options);
    ASSERT_TRUE(report) << report.error().what;
    const auto store = PointStore::open(options.outputPath);
    ASSERT_TRUE(store);
    EXPECT_EQ((*store)->description().splatRadiusBase, expected.base);
    const auto column = (*store)->description().schema.find(splatRadiusAttribute);
    ASSERT_TRUE(column);
    std::vector<std::uint8_t> found;
    for (NodeIndex i = 0; i < (*store)->hierarchy()->nodeCount(); ++i)
    {
      const auto node = (*store)->read(i, { static_cast<std::uint32_t>(*column) });
      const bool representatives =
        refinement == Refinement::Replace && !(*store)->hierarchy()->node(i).leaf();
      for (const std::byte code : node->columns[0])
      {
        if (representatives)
        {
          EXPECT_EQ(code, std::byte(0)) << "nobody measured around a representative";
          continue;
        }
        found.push_back(static_cast<std::uint8_t>(code));
      }
    }
    std::vector<std::uint8_t> all = expected.codes;
    std::sort(all.begin(), all.end());
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, all);
    std::filesystem::remove_all(folder);
  }
}

} // namespace
