#include "pointfront/Query/BoxRegion.h"
#include "pointfront/Query/ConvexRegion.h"
#include "pointfront/Query/LineCorridor.h"
#include "pointfront/Query/MissedRegion.h"
#include "pointfront/Query/Orientation.h"
#include "pointfront/Query/PolygonPrism.h"
#include "pointfront/Query/SphereRegion.h"

#include "TestBuildClouds.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace pointfront
{
namespace
{
using test::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::shared_ptr<const PolygonPrism> prismOf(const std::vector<PlanarLine>& rings)
{
  return PolygonPrism::make({ PlanarPolygon{ rings } }).value();
}

bool holds(const Region& region, double x, double y, double z = 0.0)
{
  return region.contains({ x, y, z });
}

template <typename T>
bool refused(const Result<T>& region)
{
  return !region && region.error().kind == Error::Kind::BadArgument;
}

/// One of each kind around 637000, 5850000, with corners that are no round numbers.
std::vector<std::shared_ptr<const Region>> someRegions(Random& random)
{
  const auto place = [&random]
  { return glm::dvec2(637000.0 + 100.0 * random.uniform(), 5850000.0 + 100.0 * random.uniform()); };
  const double size = 60.0 * random.uniform();
  const glm::dvec3 centre(place(), 50.0 * random.uniform());
  const glm::dvec3 normal(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5);
  PlanarLine ring{ place(), place(), place(), place(), place() };
  return { BoxRegion::make({ centre, centre + size }).value(),
    SphereRegion::make(centre, size).value(),
    ConvexRegion::make(
      { glm::dvec4(normal, -(normal.x * centre.x + normal.y * centre.y + normal.z * centre.z)) })
      .value(),
    PolygonPrism::make(
      { PlanarPolygon{ { ring, { place(), place(), place() } } } }, { 10.0, 10.0 + size })
      .value(),
    LineCorridor::make({ { place(), place(), place() } }, 0.5 * size, { 5.0, 45.0 }).value() };
}

} // namespace

TEST(Orientation, IsTheSignOfTheExactDeterminant)
{
  // Whole numbers, so that 128 bits have the exact answer; nearly collinear, where doubles fail.
  Random random(3);
  int quickIsWrong = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const auto far = [&random] { return static_cast<std::int64_t>(random.next() >> 11); };
    const std::int64_t ax = far(), ay = far(), dx = far() >> 27, dy = far() >> 27;
    const auto wobble = static_cast<std::int64_t>(random.next() % 3) - 1;
    const std::int64_t bx = ax + dx, by = ay + dy, px = ax + 3 * dx, py = ay + 3 * dy + wobble;
    const __int128 exact =
      static_cast<__int128>(bx - ax) * (py - ay) - static_cast<__int128>(by - ay) * (px - ax);
    const glm::dvec2 a(ax, ay), b(bx, by), p(px, py);
    if (std::max(std::max(a.x, b.x), std::max(p.x, p.y)) > 0x1p53 || b.y > 0x1p53)
    {
      continue; // these are not whole numbers in double
    }
    ASSERT_EQ(orientation(a, b, p), exact > 0 ? 1 : exact < 0 ? -1 : 0);
    const double quick = a.x * b.y - a.y * b.x + b.x * p.y - b.y * p.x + p.x * a.y - p.y * a.x;
    quickIsWrong += (quick > 0 ? 1 : quick < 0 ? -1 : 0) != (exact > 0 ? 1 : exact < 0 ? -1 : 0);
  }
  EXPECT_GT(quickIsWrong, 1000) << "the cases are hard ones";
}

TEST(Region, WhatABoxIsToldHoldsOfEachOfItsPoints)
{
  Random random(11);
  int outside = 0;
  int inside = 0;
  for (int i = 0; i < 400; ++i)
  {
    const auto regions = someRegions(random);
    for (int b = 0; b < 20; ++b)
    {
      const glm::dvec3 low(637000.0 + 100.0 * random.uniform(),
        5850000.0 + 100.0 * random.uniform(), 50.0 * random.uniform());
      const double size = b % 4 == 0 ? 0.0 : 30.0 * random.uniform() * random.uniform();
      const Bounds box{ low, low + size };
      for (const std::shared_ptr<const Region>& region : regions)
      {
        const Overlap overlap = region->overlap(box);
        outside += overlap == Overlap::Outside;
        inside += overlap == Overlap::Inside;
        std::vector<glm::dvec3> points{ box.low, box.high };
        for (int p = 0; p < 30; ++p)
        {
          const auto at = [&](double from) { return from + size * random.uniform(); };
          points.push_back(glm::min(box.high, glm::dvec3(at(low.x), at(low.y), at(low.z))));
        }
        std::vector<std::uint8_t> keep(points.size(), 1);
        region->keepInside(box, points.data(), points.size(), keep.data());
        for (std::size_t p = 0; p < points.size(); ++p)
        {
          const bool contained = region->contains(points[p]);
          ASSERT_EQ(keep[p] != 0, contained);
          ASSERT_FALSE(overlap == Overlap::Outside && contained);
          ASSERT_FALSE(overlap == Overlap::Inside && !contained);
          ASSERT_TRUE(!contained || region->bounds().contains(points[p]));
        }
      }
    }
  }
  EXPECT_GT(outside, 1000);
  EXPECT_GT(inside, 300);
}

TEST(Region, WhatWasLeftOutBeforeStaysOut)
{
  const auto box = BoxRegion::make({ glm::dvec3(0.0), glm::dvec3(1.0) }).value();
  const auto sphere = SphereRegion::make(glm::dvec3(0.0), 1.0).value();
  const glm::dvec3 point(0.5, 0.0, 0.0);
  const std::vector<std::shared_ptr<const Region>> regions{ box, sphere,
    prismOf({ { { 0, -1 }, { 1, 0 }, { 0, 1 } } }) };
  for (const std::shared_ptr<const Region>& region : regions)
  {
    ASSERT_TRUE(region->contains(point));
    std::uint8_t keep = 0;
    region->keepInside(region->bounds(), &point, 1, &keep);
    EXPECT_EQ(keep, 0);
  }
}

TEST(BoxRegion, HasItsSurfaceAndNothingWhenItIsEmpty)
{
  const auto box = BoxRegion::make({ { 0, 0, 0 }, { 1, 2, infinity } }).value();
  EXPECT_TRUE(holds(*box, 1, 2, 1e300));
  EXPECT_FALSE(holds(*box, std::nextafter(1.0, 2.0), 2, 0));
  const auto none = BoxRegion::make({ { 5, 0, 0 }, { 3, 10, 10 } }).value();
  EXPECT_EQ(none->overlap({ glm::dvec3(0.0), glm::dvec3(10.0) }), Overlap::Outside);
  EXPECT_EQ(BoxRegion::make(Bounds()).value()->overlap({ glm::dvec3(0.0), glm::dvec3(1.0) }),
    Overlap::Outside);
  EXPECT_TRUE(refused(BoxRegion::make({ { nan, 0, 0 }, { 1, 1, 1 } })));
  EXPECT_TRUE(refused(BoxRegion::make({ { 0, 0, 0 }, { 1, 1, nan } })));
}

TEST(SphereRegion, OfRadiusZeroIsItsCentre)
{
  const auto sphere = SphereRegion::make({ 1, 2, 3 }, 0.0).value();
  EXPECT_TRUE(holds(*sphere, 1, 2, 3));
  EXPECT_FALSE(holds(*sphere, 1, 2, std::nextafter(3.0, 4.0)));
  EXPECT_TRUE(refused(SphereRegion::make({ 1, 2, 3 }, -1.0)));
  EXPECT_TRUE(refused(SphereRegion::make({ 1, 2, 3 }, nan)));
  EXPECT_TRUE(refused(SphereRegion::make({ 1, infinity, 3 }, 1.0)));
}

TEST(ConvexRegion, TakesWholePlanesOnly)
{
  const auto half = ConvexRegion::make({ { 0, 0, 2, -10 } }).value();
  EXPECT_TRUE(holds(*half, 1e9, 0, 5));
  EXPECT_FALSE(holds(*half, 0, 0, 4.9));
  EXPECT_TRUE(holds(*ConvexRegion::make({}).value(), 1, 2, 3));
  EXPECT_TRUE(refused(ConvexRegion::make({ { 0, 0, 0, 1 } })));
  EXPECT_TRUE(refused(ConvexRegion::make({ { 0, nan, 1, 1 } })));
  EXPECT_TRUE(refused(ConvexRegion::make({ { 0, 0, 1, infinity } })));
}

TEST(PolygonPrism, HolesAreOutAndTheirEdgesAreIn)
{
  const auto prism = prismOf({ { { 0, 0 }, { 10, 0 }, { 10, 10 }, { 0, 10 }, { 0, 0 } },
    { { 2, 2 }, { 4, 2 }, { 4, 4 }, { 2, 4 } } });
  EXPECT_TRUE(holds(*prism, 1, 1));
  EXPECT_FALSE(holds(*prism, 3, 3));
  EXPECT_TRUE(holds(*prism, 2, 3)); // on the hole's edge
  EXPECT_TRUE(holds(*prism, 4, 4));
  EXPECT_TRUE(holds(*prism, 10, 10)); // corners and edges of the outer ring
  EXPECT_TRUE(holds(*prism, 0, 5));
  EXPECT_TRUE(holds(*prism, 5, 10));
  EXPECT_FALSE(holds(*prism, 10.001, 5));
  EXPECT_EQ(prism->overlap({ { 2.5, 2.5, 0 }, { 3.5, 3.5, 0 } }), Overlap::Outside);
  EXPECT_EQ(prism->overlap({ { 5, 5, 0 }, { 6, 6, 0 } }), Overlap::Inside);
  EXPECT_EQ(prism->overlap({ { 1, 1, 0 }, { 5, 5, 0 } }), Overlap::Crossing); // around the hole
}

TEST(PolygonPrism, MayTouchAndCrossItself)
{
  // Two squares that share a corner, as one ring; and a bow tie.
  const auto touching =
    prismOf({ { { 0, 0 }, { 2, 0 }, { 2, 2 }, { 4, 2 }, { 4, 4 }, { 2, 4 }, { 2, 2 }, { 0, 2 } } });
  EXPECT_TRUE(holds(*touching, 1, 1));
  EXPECT_TRUE(holds(*touching, 3, 3));
  EXPECT_TRUE(holds(*touching, 2, 2));
  EXPECT_FALSE(holds(*touching, 3, 1));
  EXPECT_FALSE(holds(*touching, 1, 3));
  const auto bow = prismOf({ { { 0, 0 }, { 4, 4 }, { 4, 0 }, { 0, 4 } } });
  EXPECT_TRUE(holds(*bow, 0.5, 2));
  EXPECT_TRUE(holds(*bow, 3.5, 2));
  EXPECT_TRUE(holds(*bow, 2, 2));
  EXPECT_FALSE(holds(*bow, 2, 3));
}

TEST(PolygonPrism, OverlappingPolygonsAreOneArea)
{
  const PlanarPolygon one{ { { { 0, 0 }, { 4, 0 }, { 4, 4 }, { 0, 4 } } } };
  const PlanarPolygon other{ { { { 2, 0 }, { 6, 0 }, { 6, 4 }, { 2, 4 } } } };
  const auto prism = PolygonPrism::make({ one, other }, { 1.0, 2.0 }).value();
  EXPECT_TRUE(holds(*prism, 3, 1, 1));
  EXPECT_TRUE(holds(*prism, 5, 1, 2));
  EXPECT_FALSE(holds(*prism, 5, 1, 2.1));
  EXPECT_FALSE(holds(*prism, 5, 1, 0.9));
}

TEST(PolygonPrism, NoPointIsLostBetweenNeighbours)
{
  // Two triangles that share an edge which doubles do not meet: each point is in one of them.
  const glm::dvec2 a(637000.1, 5850000.7), b(637093.3, 5850041.9);
  const auto left = prismOf({ { a, b, { 637000.0, 5850100.0 } } });
  const auto right = prismOf({ { b, a, { 637093.0, 5850000.0 } } });
  Random random(5);
  for (int i = 0; i < 20000; ++i)
  {
    const glm::dvec2 p = a + random.uniform() * (b - a);
    ASSERT_TRUE(holds(*left, p.x, p.y) || holds(*right, p.x, p.y));
  }
}

TEST(PolygonPrism, DegenerateRings)
{
  const auto line = prismOf({ { { 0, 0 }, { 5, 5 }, { 10, 10 } } }); // no area
  EXPECT_TRUE(holds(*line, 3, 3));
  EXPECT_FALSE(holds(*line, 3, 3.1));
  const auto point = prismOf({ { { 1, 1 }, { 1, 1 }, { 1, 1 }, { 1, 1 } } });
  EXPECT_TRUE(holds(*point, 1, 1));
  EXPECT_FALSE(holds(*point, 1, 1.5));
  const auto none = PolygonPrism::make({}).value();
  EXPECT_FALSE(holds(*none, 0, 0));
  EXPECT_EQ(none->overlap({ glm::dvec3(-1e9), glm::dvec3(1e9) }), Overlap::Outside);
  const auto empty = PolygonPrism::make({ PlanarPolygon() }).value();
  EXPECT_FALSE(holds(*empty, 0, 0));
  const PlanarPolygon square{ { { { 0, 0 }, { 1, 0 }, { 1, 1 } } } };
  EXPECT_FALSE(holds(*PolygonPrism::make({ square }, { 2.0, 1.0 }).value(), 0.5, 0.5, 1.5));
  EXPECT_TRUE(refused(PolygonPrism::make({ PlanarPolygon{ { { { 0, 0 }, { 1, 0 } } } } })));
  EXPECT_TRUE(
    refused(PolygonPrism::make({ PlanarPolygon{ { { { 0, 0 }, { 1, 0 }, { 0, 0 } } } } })));
  EXPECT_TRUE(
    refused(PolygonPrism::make({ PlanarPolygon{ { { { 0, 0 }, { 1, nan }, { 1, 1 } } } } })));
  EXPECT_TRUE(
    refused(PolygonPrism::make({ PlanarPolygon{ { { { 0, 0 }, { 1, 0 }, { infinity, 1 } } } } })));
  EXPECT_TRUE(refused(PolygonPrism::make({ square }, { nan, 1.0 })));
}

/// The eight corners of a box around `centre` with edges of 2 * half along three orthonormal axes,
/// and its planes.
struct TurnedBox
{
  std::vector<glm::dvec3> corners;
  std::vector<glm::dvec4> planes;

  TurnedBox(Random& random, const glm::dvec3& centre, const glm::dvec3& half)
  {
    const auto some = [&random]
    { return glm::dvec3(random.uniform(), random.uniform(), random.uniform()) - 0.5; };
    glm::dmat3 axes(glm::normalize(some()), some(), glm::dvec3());
    axes[1] = glm::normalize(glm::cross(axes[0], axes[1]));
    axes[2] = glm::cross(axes[0], axes[1]);
    for (int i = 0; i < 8; ++i)
    {
      const glm::dvec3 sign(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0);
      corners.push_back(centre + axes * (sign * half));
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      for (const double sign : { 1.0, -1.0 })
      {
        const glm::dvec3 inward = sign * axes[axis];
        planes.emplace_back(inward, half[axis] - glm::dot(inward, centre));
      }
    }
  }
};

TEST(ConvexRegion, BoundsAreThoseOfItsCorners)
{
  Random random(17);
  for (int round = 0; round < 200; ++round)
  {
    const glm::dvec3 half(1.0 + 90.0 * random.uniform(), 5.0, 20.0 * random.uniform() + 0.01);
    const TurnedBox turned(random, { 637000.0, 5850000.0, 50.0 }, half);
    Bounds expected;
    for (const glm::dvec3& corner : turned.corners)
    {
      expected.add(corner);
    }
    const Bounds bounds = ConvexRegion::make(turned.planes).value()->bounds();
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_LE(bounds.low[axis], expected.low[axis]);
      EXPECT_GE(bounds.high[axis], expected.high[axis]);
      EXPECT_NEAR(bounds.low[axis], expected.low[axis], 1e-3);
      EXPECT_NEAR(bounds.high[axis], expected.high[axis], 1e-3);
    }
  }
  const Bounds wedge =
    ConvexRegion::make({ { 1, 0, 0, -5 }, { -1, 0, 0, 7 }, { 0, 2, 0, 0 }, { 0, 0, 1, 0 } })
      .value()
      ->bounds();
  EXPECT_NEAR(wedge.low.x, 5.0, 1e-6);
  EXPECT_NEAR(wedge.high.x, 7.0, 1e-6);
  EXPECT_NEAR(wedge.low.y, 0.0, 1e-6);
  EXPECT_EQ(wedge.high.y, infinity);
  // A column on its edge, without ends; and half of space that no axis is square to.
  const Bounds column =
    ConvexRegion::make({ { 1, 1, 0, -1 }, { 1, -1, 0, 1 }, { -1, 1, 0, 3 }, { -1, -1, 0, 5 } })
      .value()
      ->bounds();
  EXPECT_NEAR(column.low.x, 0.0, 1e-6);
  EXPECT_NEAR(column.high.x, 4.0, 1e-6);
  EXPECT_NEAR(column.low.y, -1.0, 1e-6);
  EXPECT_NEAR(column.high.y, 3.0, 1e-6);
  EXPECT_EQ(column.high.z, infinity);
  const Bounds half = ConvexRegion::make({ { 1, 2, 3, 0 } }).value()->bounds();
  EXPECT_TRUE(half.low == glm::dvec3(-infinity) && half.high == glm::dvec3(infinity));
  EXPECT_NEAR(ConvexRegion::make({ { 0, -2, 0, 6 } }).value()->bounds().high.y, 3.0, 1e-6);
}

TEST(MissedRegion, IsToldOfEachShapeThatLiesBesideTheCloud)
{
  StoreDescription store;
  store.bounds = { glm::dvec3(0.0), glm::dvec3(100.0, 100.0, 10.0) };
  const double s = std::sqrt(0.5);
  // A square column on its edge, whose nearest edge is `gap` beside the cloud's middle: no plane of
  // it has the whole cloud on its outer side.
  const auto diamond = [s](double gap)
  {
    const double x = 100.0 + gap + 10.0;
    return ConvexRegion::make(
      { { s, s, 0, -s * (x + 50.0) + 10.0 * s }, { s, -s, 0, -s * (x - 50.0) + 10.0 * s },
        { -s, -s, 0, s * (x + 50.0) + 10.0 * s }, { -s, s, 0, s * (x - 50.0) + 10.0 * s },
        { 0, 0, 1, 0 }, { 0, 0, -1, 10 } })
      .value();
  };
  const auto square = [](double x) {
    return prismOf({ { { x, 0 }, { x + 10, 0 }, { x + 10, 10 }, { x, 10 } } });
  };
  const auto told = [&store](const std::shared_ptr<const Region>& region)
  {
    PointQuery query;
    query.regions.push_back(region);
    return missedRegion(store, query);
  };
  EXPECT_EQ(told(BoxRegion::make({ glm::dvec3(101.0), glm::dvec3(102.0) }).value()).value_or(""),
    "the region lies beside the cloud, so there are no points: the cloud has coordinates from "
    "(0, 0, 0) to (100, 100, 10)");
  EXPECT_TRUE(told(SphereRegion::make({ -5.0, 50.0, 5.0 }, 4.0).value()));
  EXPECT_TRUE(told(square(101)));
  EXPECT_TRUE(told(LineCorridor::make({ { { 0, 120 }, { 100, 120 } } }, 19.0).value()));
  EXPECT_EQ(diamond(1.0)->overlap(store.bounds), Overlap::Crossing);
  EXPECT_TRUE(told(diamond(1.0)));
  EXPECT_FALSE(told(diamond(-1.0)));
  EXPECT_FALSE(told(square(99)));
  EXPECT_FALSE(told(LineCorridor::make({ { { 0, 120 }, { 100, 120 } } }, 21.0).value()));
  EXPECT_FALSE(missedRegion(store, {}));
  EXPECT_FALSE(missedRegion({}, {}));
}

TEST(LineCorridor, HasRoundEndsAndTakesASinglePlace)
{
  const auto corridor = LineCorridor::make({ { { 0, 0 }, { 10, 0 } } }, 2.0).value();
  EXPECT_TRUE(holds(*corridor, 5, 2, 1e6));
  EXPECT_TRUE(holds(*corridor, -2, 0));
  EXPECT_FALSE(holds(*corridor, -1.9, 1));
  const auto disc = LineCorridor::make({ { { 3, 3 } } }, 1.0, { 0.0, 1.0 }).value();
  EXPECT_TRUE(holds(*disc, 3, 4, 1));
  EXPECT_FALSE(holds(*disc, 3, 4, 1.1));
  EXPECT_FALSE(holds(*disc, 4, 4));
  EXPECT_TRUE(refused(LineCorridor::make({ PlanarLine() }, 1.0)));
  EXPECT_TRUE(refused(LineCorridor::make({ { { 0, nan } } }, 1.0)));
  EXPECT_TRUE(refused(LineCorridor::make({ { { 0, 0 } } }, -1.0)));
  EXPECT_TRUE(refused(LineCorridor::make({ { { 0, 0 } } }, infinity)));
}

} // namespace pointfront
