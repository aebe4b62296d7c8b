#include "PoissonOrder.h"
#include "RandomStream.h"
#include "TruthCase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pointfront::truth
{
namespace
{
double smallestDistance(const std::vector<glm::dvec3>& places, std::size_t count)
{
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      smallest = std::min(smallest, glm::length(places[i] - places[j]));
    }
  }
  return smallest;
}

TEST(PoissonOrder, EachPrefixKeepsItsDistanceAndNothingIsLeftOut)
{
  RandomStream random(3);
  std::vector<glm::dvec3> candidates;
  for (int i = 0; i < 6000; ++i)
  {
    candidates.emplace_back(random.uniform(), random.uniform(), 0.0);
  }
  const double radius = 0.713 / 32.0; // about 1000 points
  const std::vector<double> radii(candidates.size(), radius);
  const std::vector<std::uint32_t> order = poissonOrder(candidates, radii, 9);
  ASSERT_GT(order.size(), 900u);
  EXPECT_LT(order.size(), 1150u);
  std::vector<glm::dvec3> picked;
  for (std::uint32_t index : order)
  {
    picked.push_back(candidates[index]);
  }
  EXPECT_GE(smallestDistance(picked, picked.size()), radius);
  for (std::size_t count : { 16u, 64u, 250u })
  { // as evenly spread as all of them: the distance of the best pattern is 1.07 / sqrt(count)
    EXPECT_GT(smallestDistance(picked, count) * std::sqrt(double(count)), 0.45) << count;
  }
  for (const glm::dvec3& candidate : candidates)
  {
    const bool covered = std::any_of(picked.begin(), picked.end(),
      [&](const glm::dvec3& p) { return glm::length(p - candidate) < radius; });
    ASSERT_TRUE(covered);
  }
  EXPECT_EQ(order, poissonOrder(candidates, radii, 9));
  EXPECT_NE(order, poissonOrder(candidates, radii, 10));
  EXPECT_TRUE(poissonOrder({}, {}, 1).empty());
}

double areaOf(const TriangleMesh& mesh)
{
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.size(); ++t)
  {
    area += mesh.area(t);
  }
  return area;
}

TEST(BlueNoise, HasOnePointForEachSquareOfTheSpacing)
{
  const TruthCase knot(makeKnot(), { "far", 1.0, 160, 120 }); // all of it is in view
  const TruthPoints points = knot.blueNoise(1);
  const double h = knot.grade().spacing;
  EXPECT_NEAR(double(points.size()) * h * h / areaOf(knot.scene().mesh), 1.0, 0.03);
  ASSERT_GT(points.size(), 2000u);
  EXPECT_GE(smallestDistance(points.positions, 2000), 0.713 * h * (1.0 - 1e-9));
  for (std::size_t i = 0; i < points.size(); i += 37)
  {
    EXPECT_NEAR(glm::length(points.normals[i]), 1.0f, 1e-5f);
    // On the surface: a ray along the normal from just above it meets it at once.
    const glm::dvec3 normal(points.normals[i]);
    const Hit hit = knot.rays().cast(points.positions[i] + 0.02 * normal, -normal);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit.distance, 0.02, 1e-3);
  }
  const TruthPoints again = knot.blueNoise(1);
  EXPECT_EQ(points.positions, again.positions);
  EXPECT_EQ(points.colours, again.colours);
}

TEST(BlueNoise, AGradedViewHasItsSpacingOnTheScreenNearAndFar)
{
  const TruthCase town(makeTown(), { "close", 4.0, 160, 120 });
  const TruthPoints points = town.blueNoise(1);
  const SpacingGrade& grade = town.grade();
  ASSERT_TRUE(grade.graded);
  std::size_t levels[24] = {};
  std::vector<double> depths;
  for (const glm::dvec3& place : points.positions)
  {
    ASSERT_TRUE(town.region().contains(place));
    depths.push_back(town.pixels().project(place).z);
    ++levels[std::size_t(grade.level(depths.back()) + 12)];
    const double px = grade.at(depths.back()) * town.pixels().focalPx() / depths.back();
    ASSERT_GT(px, 4.0 / 1.42);
    ASSERT_LT(px, 4.0 * 1.42);
  }
  EXPECT_GT(std::count_if(
              std::begin(levels), std::end(levels), [](std::size_t count) { return count > 20; }),
    3);
  std::size_t tooNear = 0;
  for (std::size_t i = 0; i < points.size(); i += 7) // each with all before it
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      const double least = 0.713 * std::min(grade.at(depths[i]), grade.at(depths[j]));
      tooNear += glm::length(points.positions[i] - points.positions[j]) < 0.999 * least ? 1 : 0;
    }
  }
  EXPECT_EQ(tooNear, 0u);
}

TEST(Scanner, HasLinesTwiceAsFarApartAsPointsAndTheNoiseItSays)
{
  // Level ground below the five flights over a town.
  MeshBuilder builder;
  builder.quad({ -50, -50, 0 }, { 50, -50, 0 }, { 50, 50, 0 }, { -50, 50, 0 }, Material::Metal);
  TruthScene flat{ "town", builder.take(), {} };
  TruthCamera camera;
  camera.position = { 0, 0, 100 };
  camera.viewUp = { 0, 1, 0 };
  flat.views.push_back({ "above", camera, false });
  const TruthCase ground(std::move(flat), { "above", 1.0, 160, 120 });
  const double h = ground.grade().spacing;
  const TruthPoints points = ground.scan(5);
  ASSERT_GT(points.size(), 5000u);
  // The nadir flight at 1.22 h x h and four at 2.44 h x h make about one and a third a square.
  std::size_t inside = 0;
  std::size_t outliers = 0;
  double squares = 0.0;
  for (const glm::dvec3& place : points.positions)
  {
    inside += std::abs(place.x) < 30.0 && std::abs(place.y) < 30.0 ? 1 : 0;
    const bool outlier = std::abs(place.z) > 0.5 * h;
    outliers += outlier ? 1 : 0;
    squares += outlier ? 0.0 : place.z * place.z;
  }
  const double perSquare = double(inside) * h * h / 3600.0;
  const double nadir = 1.0 / (1.22 * 1.22);
  const double oblique = 4.0 / (2.44 * 2.44) / std::sqrt(1.49); // beams of slope 0.7 spread
  EXPECT_NEAR(perSquare, nadir + oblique, 0.05);
  // Noise along oblique beams is a little less in height: 0.1 h is the most.
  const double deviation = std::sqrt(squares / double(points.size()));
  EXPECT_GT(deviation, 0.08 * h);
  EXPECT_LT(deviation, 0.103 * h);
  // 1 % are off by h: 62 % of these by more than half of it.
  EXPECT_NEAR(double(outliers) / double(points.size()), 0.006, 0.002);
  EXPECT_EQ(points.positions, ground.scan(5).positions);
}

TEST(Scanner, SeesAnObjectFromAllSidesAndColoursItAsTheTextureIs)
{
  const TruthCase knot(makeKnot(), { "far", 1.0, 160, 120 });
  const TruthPoints points = knot.scan(5);
  const double h = knot.grade().spacing;
  const double perSquare = double(points.size()) * h * h / areaOf(knot.scene().mesh);
  EXPECT_GT(perSquare, 0.7);
  EXPECT_LT(perSquare, 2.0);
  int sides[6] = {};
  for (const glm::vec3& normal : points.normals)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      sides[2 * axis] += normal[axis] > 0.9f ? 1 : 0;
      sides[2 * axis + 1] += normal[axis] < -0.9f ? 1 : 0;
    }
  }
  for (int count : sides)
  {
    EXPECT_GT(count, 50);
  }
}
} // namespace
} // namespace pointfront::truth
