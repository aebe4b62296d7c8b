#include "pointfront/Neighbourhood/SplatCell.h"

#include "SplatPatterns.h"

#include "pointfront/Neighbourhood/KdIndex.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>

namespace pointfront
{
namespace
{
using Points = std::vector<glm::dvec3>;
constexpr double margin = 1.25; ///< times the farthest vertex is the stored radius

std::vector<double> radiiOf(const Points& points)
{
  PositionSet set;
  set.positions = points;
  set.counts.assign(points.size(), 1);
  const KdIndex index(set, 3);
  NeighbourList list(16);
  NearOffsets near;
  std::vector<double> radii;
  for (const glm::dvec3& p : points)
  {
    list.begin(set);
    index.search(p, list);
    near.begin();
    for (const NeighbourList::Entry& entry : list.entries())
    {
      near.add(points[entry.index] - p);
    }
    radii.push_back(splatRadius(near, neighbourPlane(near)));
  }
  return radii;
}

double radiusAmong(const Points& neighbours)
{
  NearOffsets near;
  near.begin();
  for (const glm::dvec3& offset : neighbours)
  {
    near.add(offset);
  }
  return splatRadius(near, neighbourPlane(near));
}

/// A square lattice around the origin, `step` apart.
Points lattice(double step)
{
  Points points;
  for (int y = -2; y <= 2; ++y)
  {
    for (int x = -2; x <= 2; ++x)
    {
      points.emplace_back(x * step, y * step, 0.0);
    }
  }
  return points;
}

double quantileOf(std::vector<double> values, double share)
{
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// The farthest place of a fine grid that is nearer to the point than to all others.
double farthestOfCell(const Points& points, std::size_t point, double extent)
{
  double farthest = 0.0;
  constexpr int steps = 120;
  for (int j = -steps; j <= steps; ++j)
  {
    for (int i = -steps; i <= steps; ++i)
    {
      const glm::dvec3 place(
        points[point].x + i * extent / steps, points[point].y + j * extent / steps, 0.0);
      const double own = glm::length(place - points[point]);
      const bool mine = own > farthest &&
        std::none_of(points.begin(), points.end(),
          [&](const glm::dvec3& other) { return glm::length(place - other) < own; });
      farthest = mine ? own : farthest;
    }
  }
  return farthest;
}
} // namespace

TEST(SplatCell, IsTheVoronoiCellsOnAPlane)
{
  test::SplatPatterns patterns(3);
  const Points points = patterns.blueNoise(400);
  const std::vector<double> radii = radiiOf(points);
  int checked = 0;
  for (std::size_t i = 0; i < points.size() && checked < 25; ++i)
  {
    const glm::dvec3& p = points[i];
    if (p.x > 0.25 && p.x < 0.75 && p.y > 0.25 && p.y < 0.75)
    {
      const double ideal = farthestOfCell(points, i, 0.1);
      EXPECT_NEAR(radii[i], margin * ideal, 0.02 * ideal + 0.1 / 120.0) << "point " << i;
      ++checked;
    }
  }
  EXPECT_EQ(checked, 25);
}

TEST(SplatCell, DiscsCloseAPlane)
{
  test::SplatPatterns patterns(4);
  for (const Points& points : { patterns.blueNoise(5000), patterns.scanLines(5000, 1.0),
         patterns.scanLines(5000, 2.0), patterns.scanLines(5000, 4.0) })
  {
    const std::vector<double> radii = radiiOf(points);
    const double holes =
      test::holesOf(points, [&](std::size_t i) { return test::visibleShare * radii[i]; });
    EXPECT_LT(holes, 0.001);
    // And not larger than that needs: the middle of a cell of 1 : 4 is 1.03 h from its corners.
    const double h = 1.0 / std::sqrt(static_cast<double>(points.size()));
    EXPECT_LT(quantileOf(radii, 0.5), 1.4 * h);
    EXPECT_GT(quantileOf(radii, 0.5), 0.8 * h);
  }
}

TEST(SplatCell, ScalesAndTurnsWithThePoints)
{
  const Points points = lattice(1.0);
  const double radius = radiusAmong(points);
  EXPECT_NEAR(radius, margin * std::sqrt(0.5), 1e-6);
  for (const double scale : { 1e-9, 1e-3, 1e3, 1e9 })
  {
    EXPECT_NEAR(radiusAmong(lattice(scale)), scale * radius, 1e-6 * scale);
  }
  Points turned;
  for (const glm::dvec3& p : points)
  {
    turned.emplace_back(0.6 * p.x + 0.48 * p.y, -0.8 * p.x + 0.36 * p.y, 0.8 * p.y);
  }
  EXPECT_NEAR(radiusAmong(turned), radius, 1e-6);
}

TEST(SplatCell, IsTheSameInAnyOrder)
{
  std::mt19937_64 random(5);
  const auto check = [&](Points points)
  {
    const double radius = radiusAmong(points);
    for (int round = 0; round < 50; ++round)
    {
      std::shuffle(points.begin(), points.end(), random);
      ASSERT_EQ(radiusAmong(points), radius);
      NearOffsets near;
      near.assign(points.data(), points.size());
      ASSERT_EQ(splatRadius(near, neighbourPlane(near)), radius);
    }
  };
  check(lattice(0.1)); // many at the same distance
  test::SplatPatterns patterns(11);
  for (std::size_t count = 0; count <= 16; ++count)
  {
    Points points;
    for (std::size_t i = 0; i < count; ++i)
    {
      points.emplace_back(patterns.uniform() - 0.5, patterns.uniform() - 0.5, 0.0);
    }
    check(points);
    points.emplace_back(0.0);
    check(points);
  }
}

// A wire is not inflated to the distance of what is beside it.
TEST(SplatCell, ALineIsHalfItsStepWide)
{
  Points line;
  for (int i = -7; i <= 7; ++i)
  {
    line.emplace_back(0.5 * i, 0.0, 0.3 * i);
  }
  const double step = std::sqrt(0.34);
  EXPECT_NEAR(radiusAmong(line), margin * 0.5 * step, 1e-9);
  EXPECT_GT(test::visibleShare * radiusAmong(line), 0.5 * step); // closed
}

// Leaves of a tree are not drawn as large as their cells in a plane that is none.
TEST(SplatCell, FoliageIsSmallerThanItsScale)
{
  test::SplatPatterns patterns(6);
  Points points;
  for (int i = 0; i < 4000; ++i)
  {
    points.emplace_back(patterns.uniform(), patterns.uniform(), patterns.uniform());
  }
  const double step = std::cbrt(1.0 / 4000.0);
  EXPECT_LT(quantileOf(radiiOf(points), 0.99), 1.25 * step);
}

TEST(SplatCell, TheRimOfASurfaceIsNotInflated)
{
  test::SplatPatterns patterns(7);
  const Points points = patterns.blueNoise(3000);
  const std::vector<double> radii = radiiOf(points);
  EXPECT_LT(*std::max_element(radii.begin(), radii.end()), 3.0 * quantileOf(radii, 0.5));
}

// Seven neighbours on a wire, eight in the tree beside it: no plane through both.
TEST(SplatCell, AWireBesideATreeIsAWire)
{
  Points points;
  for (int i = 1; i <= 7; ++i)
  {
    points.emplace_back(0.9 * i, 1.2 * i, 0.4 * i);
  }
  test::SplatPatterns patterns(9);
  for (int i = 0; i < 8; ++i)
  {
    points.emplace_back(25.0 + 4.0 * patterns.uniform(), -16.0 + 4.0 * patterns.uniform(),
      -20.0 * patterns.uniform());
  }
  EXPECT_LE(radiusAmong(points), margin * std::sqrt(0.81 + 1.44 + 0.16) + 1e-9); // a step
}

// A bird over a field is no surface that reaches down to it.
TEST(SplatCell, AStrayIsAsLargeAsWhatIsBesideIt)
{
  test::SplatPatterns patterns(8);
  Points points = patterns.blueNoise(3000);
  const double usual = quantileOf(radiiOf(points), 0.5);
  const glm::dvec3 middle = points[1500];
  for (const double height : { 8.0, 20.0, 100.0 })
  {
    for (const glm::dvec3& way : { glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(0.6, 0.0, 0.8) })
    {
      Points with = points;
      with.push_back(middle + height * usual * way);
      const double alone = radiiOf(with).back();
      EXPECT_GT(alone, 0.3 * usual) << height;
      EXPECT_LT(alone, 3.0 * usual) << height; // seen at a slant they lie in a strip
      with.push_back(with.back() + 0.3 * usual * way); // a pair
      EXPECT_LT(radiiOf(with).back(), 3.0 * usual) << height;
    }
  }
}

TEST(SplatCell, Extremes)
{
  EXPECT_EQ(radiusAmong({}), 0.0);
  EXPECT_EQ(radiusAmong({ glm::dvec3(0.0), glm::dvec3(0.0) }), 0.0); // all at its place
  EXPECT_NEAR(radiusAmong({ { 2.0, 0.0, 0.0 } }), margin, 1e-12); // two points touch
  EXPECT_NEAR(radiusAmong({ { 2.0, 0.0, 0.0 }, { 2.0, 0.0, 0.0 } }), margin, 1e-12);
  for (const double size : { 1e-150, 1e-30, 1e12, 1e100 })
  {
    const double radius = radiusAmong(lattice(size));
    EXPECT_TRUE(std::isfinite(radius) && radius > 0.5 * size && radius < 1.5 * size) << size;
  }
  const Points corner{ { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 1.0, 1.0, 0.0 } }; // open
  EXPECT_GT(radiusAmong(corner), 0.0);
  EXPECT_LT(radiusAmong(corner), 2.0);
}

} // namespace pointfront
