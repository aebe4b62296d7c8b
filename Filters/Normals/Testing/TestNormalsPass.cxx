#include "NormalClouds.h"

#include "NormalsPass.h"
#include "PCLFit.h"
#include "SurfaceFit.h"

#include <Eigen/Eigenvalues>

#include <glm/common.hpp>

#include <string>
#include <vector>

namespace
{
using namespace pointfront;
using namespace pointfront::test;

/// A bumpy surface in the order of a scan, at `origin`.
Positions bumpy(std::size_t count, const glm::dvec3& origin, double step = 0.001)
{
  Random random(11);
  Positions positions;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double x = 20.0 * random.uniform();
    const double y = 20.0 * random.uniform();
    const glm::dvec3 p(x, y, std::sin(x) * std::cos(0.7 * y));
    positions.push_back(origin + glm::round(p / step) * step);
  }
  return positions;
}

TEST(NormalsPass, TheWholeBunnyAsOneNeighbourhood)
{
  NormalsOptions options = nearest(397);
  options.curvature = true;
  for (const double shift : { 0.0, 100.0 })
  {
    Positions positions = bunny();
    for (glm::dvec3& p : positions)
    {
      p += shift;
    }
    Result<PointSources> result = NormalsPass(options).apply(sourcesOf(positions), testResources());
    ASSERT_TRUE(result);
    const Attribute& stored = result->front()->description().schema[1];
    for (const PackedNormal& packed : attributeOf<PackedNormal>(*result, "normal"))
    {
      EXPECT_NEAR(std::abs(packed.x) / double(normalSteps), 0.035592, 1e-4);
      EXPECT_NEAR(std::abs(packed.y) / double(normalSteps), 0.369596, 1e-4);
      EXPECT_NEAR(packed.z / double(normalSteps), 0.928511, 1e-4); // up
    }
    ASSERT_EQ(stored.name, "curvature");
    for (const std::uint16_t steps : attributeOf<std::uint16_t>(*result, "curvature"))
    {
      EXPECT_NEAR(steps * stored.scale, 0.0693136, 1e-4);
    }
  }
}

TEST(NormalsPass, TowardsTheScannerWhereItIsKnown)
{
  PointSources sources = sourcesOf(bunny());
  dynamic_cast<CloudSource&>(*sources[0]).editDescription().scanners = { { 0, glm::dvec3(0.0) } };
  for (const PackedNormal& packed : normalsBy(NormalsPass(nearest(397)), std::move(sources)))
  {
    EXPECT_NEAR(packed.x / double(normalSteps), -0.035592, 1e-4);
    EXPECT_NEAR(packed.y / double(normalSteps), -0.369596, 1e-4);
    EXPECT_NEAR(packed.z / double(normalSteps), -0.928511, 1e-4);
  }
}

TEST(NormalsPass, MovingTheBunnyChangesNothing)
{
  Positions moved = bunny();
  for (glm::dvec3& p : moved)
  {
    p += glm::dvec3(123.0, -45.0, 98.0);
  }
  const auto here = normalsBy(NormalsPass(nearest(15)), sourcesOf(bunny()));
  const auto there = normalsBy(NormalsPass(nearest(15)), sourcesOf(moved));
  ASSERT_EQ(here.size(), 397u);
  for (std::size_t i = 0; i < here.size(); ++i)
  {
    const glm::dvec3 a = unpackNormal(here[i]);
    const glm::dvec3 b = unpackNormal(there[i]);
    EXPECT_NEAR(std::abs(glm::dot(a, b)), 1.0, 1e-6);
    EXPECT_LT(glm::length(a - b), 5e-4);
  }
}

TEST(NormalsPass, AsStoredInTheBunny)
{
  // Stored there: PCA of the ten nearest. textPositions() reads three numbers: drop the positions.
  std::ifstream file(std::string(POINTFRONT_SHARED_DATA) + "/normals/bun0.pcd");
  std::string line;
  while (std::getline(file, line) && line != "DATA ascii")
  {
  }
  Positions stored;
  for (glm::dvec3 p(0.0), n(0.0); std::getline(file, line);)
  {
    std::istringstream(line) >> p.x >> p.y >> p.z >> n.x >> n.y >> n.z;
    stored.push_back(n);
  }
  ASSERT_EQ(stored.size(), 397u);
  const auto ours = normalsBy(NormalsPass(nearest(10)), sourcesOf(bunny()));
  std::vector<double> degrees;
  for (std::size_t i = 0; i < ours.size(); ++i)
  {
    degrees.push_back(rmsDegrees(Positions{ unpackNormal(ours[i]) }, Positions{ stored[i] }));
  }
  std::nth_element(degrees.begin(), degrees.begin() + 198, degrees.end());
  EXPECT_LT(degrees[198], 0.01); // median
}

TEST(NormalsPass, ByPCLNeedsABuildWithPCL)
{
  NormalsOptions options = nearest(16);
  options.byPCL = true;
  const auto done =
    NormalsPass(options).apply(sourcesOf(bumpy(100, glm::dvec3(0.0))), testResources());
  ASSERT_EQ(bool(done), hasPCLFit());
  if (!done)
  {
    EXPECT_EQ(done.error().kind, Error::Kind::Unsupported);
    EXPECT_NE(done.error().what.find("POINTFRONT_PCL"), std::string::npos);
  }
}

TEST(NormalsPass, OnASphere)
{
  const Positions sphere = textPositions("unit_sphere_642.ply", "end_header", 642);
  const auto normals = normalsBy(NormalsPass(nearest(7)), sourcesOf(sphere));
  EXPECT_LT(rmsDegrees(normals, sphere), 1.0);
}

TEST(NormalsPass, OneTileOrSixtyFourAndAnyMemoryFarFromTheOriginToo)
{
  for (const glm::dvec3& origin : { glm::dvec3(0.0), glm::dvec3(1e7, 1e7, -1e7) })
  {
    const Positions positions = bumpy(20000, origin);
    NormalsOptions whole = nearest(16);
    whole.tilePoints = positions.size();
    NormalsOptions tiled = nearest(16);
    tiled.tilePoints = positions.size() / 64;
    const auto expected = normalsBy(NormalsPass(whole), sourcesOf(positions));
    EXPECT_TRUE(expected == normalsBy(NormalsPass(tiled), sourcesOf(positions)));
    NormalsOptions radius;
    radius.radius = 0.4;
    radius.tilePoints = whole.tilePoints;
    const auto within = normalsBy(NormalsPass(radius), sourcesOf(positions));
    radius.tilePoints = tiled.tilePoints;
    EXPECT_TRUE(within == normalsBy(NormalsPass(radius), sourcesOf(positions)));
    EXPECT_FALSE(within == expected);
  }
}

TEST(NormalsPass, FarFromTheOriginIsAsGoodAsNear)
{
  const auto near = normalsBy(NormalsPass(nearest(16)), sourcesOf(bumpy(5000, glm::dvec3(0.0))));
  const auto far =
    normalsBy(NormalsPass(nearest(16)), sourcesOf(bumpy(5000, glm::dvec3(1e7, -1e7, 1e7))));
  EXPECT_LT(rmsDegrees(near, far), 0.2); // ties on the millimetre grid fall differently
}

TEST(NormalsPass, WithoutAPlaneThereIsNoNormal)
{
  const auto without = [](const Positions& positions)
  {
    const NormalsPass pass(nearest(16));
    std::size_t zeros = 0;
    for (const PackedNormal& n : normalsBy(pass, sourcesOf(positions)))
    {
      zeros += n == PackedNormal(0) ? 1 : 0;
    }
    const std::vector<std::string> findings = pass.findings();
    EXPECT_EQ(findings.size(), zeros > 0 ? 1u : 0u);
    EXPECT_EQ(zeros == 1, !findings.empty() && findings[0].find("1 point has") == 0);
    EXPECT_TRUE(zeros < 2 || findings[0].find(std::to_string(zeros) + " points have") == 0)
      << findings[0];
    return zeros;
  };
  EXPECT_EQ(without({}), 0u);
  EXPECT_EQ(without({ { 1.0, 2.0, 3.0 } }), 1u);
  EXPECT_EQ(without({ { 1.0, 2.0, 3.0 }, { 4.0, 2.0, 3.0 } }), 2u);
  EXPECT_EQ(without(Positions(1000, { 1e7, 2.0, 3.0 })), 1000u); // coincident
  Positions pairs(2, { 1.0, 2.0, 3.0 });
  pairs.insert(pairs.end(), 3, { 4.0, 2.0, 3.0 });
  EXPECT_EQ(without(pairs), 5u);
  Positions line;
  for (int i = 0; i < 1000; ++i)
  {
    line.emplace_back(1e6 + 0.25 * i, 1e6 - 0.5 * i, 0.125 * i);
  }
  EXPECT_EQ(without(line), 1000u);
  line[500].z += 0.01;
  EXPECT_LT(without(line), 1000u);
  EXPECT_EQ(without({ { 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 } }), 0u);
}

TEST(SurfaceFit, UpTo64PointsTheOrderChangesNothing)
{
  Random random(13);
  for (const std::size_t count : { 3u, 16u, 64u })
  {
    const glm::dvec3 origin(4e5, 5.6e6, 120.0);
    std::vector<NearPoint> points;
    for (std::size_t i = 0; i < count; ++i)
    {
      const glm::dvec3 d(random.uniform(), random.uniform(), 0.1 * random.uniform());
      points.push_back({ origin + d, glm::dot(d, d), 1 });
    }
    const auto fit = fitSurface(origin, points);
    ASSERT_TRUE(fit);
    for (int turn = 0; turn < 20; ++turn)
    {
      std::rotate(points.begin(), points.begin() + 1, points.end());
      std::swap(points[0], points[random.next() % count]);
      const auto other = fitSurface(origin, points);
      ASSERT_TRUE(other);
      EXPECT_EQ(fit->normal, other->normal);
      EXPECT_EQ(fit->curvature, other->curvature);
      EXPECT_EQ(fit->centre, other->centre);
    }
  }
}

/// The plane of 16 points whose extents along three turned axes are 1, `middle` and `thin`; on
/// steps of 2^-21, which the rounding of offsets leaves as they are.
TEST(SurfaceFit, OfAnyShapeIsWhatASolverForAnyMatrixFinds)
{
  Random random(14);
  for (const double thin : { 0.0, 1e-5, 1e-3, 0.1, 0.9, 1.0 })
  {
    for (const double middle : { 1e-4, 1e-2, 0.3, 1.0 })
    {
      for (int turn = 0; thin <= middle && turn < 50; ++turn)
      {
        const glm::dvec3 up =
          glm::normalize(glm::dvec3(random.uniform(), random.uniform(), random.uniform()) - 0.5);
        const glm::dvec3 along = glm::normalize(glm::cross(up, glm::dvec3(0.3, 0.8, 0.5)));
        std::vector<NearPoint> points;
        Eigen::Matrix<double, 16, 3> rows;
        for (int i = 0; i < 16; ++i)
        {
          const glm::dvec3 exact = (random.uniform() - 0.5) * along +
            middle * (random.uniform() - 0.5) * glm::cross(up, along) +
            thin * (random.uniform() - 0.5) * up;
          const glm::dvec3 d = glm::round(exact * 2097152.0) / 2097152.0;
          points.push_back({ d, glm::dot(d, d), 1 });
          rows.row(i) << d.x, d.y, d.z;
        }
        const Eigen::Matrix<double, 16, 3> centred = rows.rowwise() - rows.colwise().mean();
        const Eigen::Matrix3d covariance = centred.transpose() * centred;
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
        const auto fit = fitSurface(glm::dvec3(0.0), points);
        ASSERT_TRUE(fit) << thin << " " << middle;
        const Eigen::Vector3d normal(fit->normal.x, fit->normal.y, fit->normal.z);
        const double across = (covariance * normal).dot(normal);
        // A root is known to the last bit of its polynomial over the gap to the next root, 1e-4.
        EXPECT_NEAR(across, solver.eigenvalues()[0], 1e-12) << thin << " " << middle;
        EXPECT_NEAR(fit->curvature, solver.eigenvalues()[0] / solver.eigenvalues().sum(), 1e-12);
        EXPECT_NEAR(normal.norm(), 1.0, 1e-12);
      }
    }
  }
}

TEST(NormalsPass, ADenseBlockAndDuplicates)
{
  Positions block;
  for (int i = 0; i < 20 * 20 * 20; ++i)
  {
    block.emplace_back(i % 20, i / 20 % 20, i / 400);
    block.push_back(block.back());
  }
  const auto normals = normalsBy(NormalsPass(nearest(32)), sourcesOf(block));
  for (std::size_t i = 0; i < normals.size(); i += 2)
  {
    EXPECT_EQ(normals[i], normals[i + 1]);
    EXPECT_NE(normals[i], PackedNormal(0));
  }
}

TEST(NormalsPass, OtherClassesGetNone)
{
  // A floor of class 2 below a wall of class 6: one would spoil the other's planes.
  Positions positions;
  std::vector<std::uint8_t> classes;
  for (int i = 0; i < 1600; ++i)
  {
    const bool floor = i % 2 == 0;
    const double u = 0.1 * (i / 2 % 28);
    const double v = 0.1 * (i / 56);
    positions.emplace_back(floor ? glm::dvec3(u, v, 0.0) : glm::dvec3(1.0, v, u));
    classes.push_back(floor ? 2 : 6);
  }
  NormalsOptions options = nearest(12);
  options.classes = { { 6 } };
  const auto normals = normalsBy(NormalsPass(options), sourcesOf(positions, classes));
  for (std::size_t i = 0; i < normals.size(); ++i)
  {
    EXPECT_EQ(normals[i], classes[i] == 6 ? PackedNormal(normalSteps, 0, 0) : PackedNormal(0));
  }
  const auto refused = NormalsPass(options).apply(sourcesOf(positions), testResources());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, Error::Kind::BadArgument);
}

TEST(NormalsPass, ApproximateIsCloseAndDoesNotDependOnThreads)
{
  const Positions positions = bumpy(20000, glm::dvec3(0.0));
  NormalsOptions options = nearest(16);
  const auto exact = normalsBy(NormalsPass(options), sourcesOf(positions));
  options.eps = 2.0;
  const NormalsPass approximate(options);
  const auto near = normalsBy(approximate, sourcesOf(positions));
  EXPECT_LT(rmsDegrees(near, exact), 5.0);
  EXPECT_GT(rmsDegrees(near, exact), 0.01); // it does something
  PassResources one = testResources();
  one.threads = 1;
  one.memoryBytes = 100 << 20;
  const Result<PointSources> alone = approximate.apply(sourcesOf(positions), one);
  ASSERT_TRUE(alone);
  EXPECT_TRUE(near == attributeOf<PackedNormal>(*alone, "normal"));
}
} // namespace
