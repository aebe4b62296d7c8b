#include "pointfront/Front/ViewMargin.h"

#include "pointfront/Front/ScreenError.h"

#include "FrontScene.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace pointfront
{
namespace
{

using test::ScriptedResidency;

constexpr double angle = 0.8;

View lookingDown(double x, double height = 400.0)
{
  return View::perspective(
    { x, 0.0, height }, { x, 1.0, 0.0 }, { 0.0, 1.0, 0.0 }, angle, 0.1, 1e5, 800, 600);
}

std::shared_ptr<const HierarchyTable> strip()
{
  test::TreeShape shape;
  shape.levels = 5;
  shape.roots = 8; // in a row along x
  shape.childChance = 0.6;
  return test::randomTree(shape);
}

/// Flies along the strip; what is asked for arrives two frames later. Nodes drawn less than would
/// be with everything in memory, over all frames after the first ones.
std::uint64_t nodesLate(bool ahead)
{
  const auto tree = strip();
  RenderFront front(tree);
  RenderFront ideal(tree);
  ViewMargin margin(tree);
  ScriptedResidency residency;
  ScriptedResidency everything;
  everything.otherwise = ResidencySnapshot::State::Resident;
  FrontLimits limits;
  limits.targetErrorPx = limits.initialErrorPx = 4.0;
  std::deque<std::vector<LoadRequest>> underWay(2);
  std::uint64_t late = 0;
  for (int frame = 0; frame < 200; ++frame)
  {
    const View view = lookingDown(frame * 20.0);
    std::vector<LoadRequest> wanted = front.update(view, residency, limits).requests;
    const std::uint64_t drawn = front.update(view, residency, limits).draw.size();
    const std::uint64_t possible = ideal.update(view, everything, limits).draw.size();
    late += frame > 20 ? possible - std::min(drawn, possible) : 0;
    if (ahead)
    {
      const auto& more = margin.ahead(view, limits.targetErrorPx, residency, 8.0, 1000);
      wanted.insert(wanted.end(), more.begin(), more.end());
    }
    underWay.push_back(std::move(wanted));
    residency.load(underWay.front());
    underWay.pop_front();
  }
  return late;
}

} // namespace

TEST(ViewAhead, ALinearMoveGoesOn)
{
  const View ahead = viewAhead(lookingDown(10.0), lookingDown(13.0), 4.0);
  const View there = lookingDown(25.0);
  EXPECT_NEAR(glm::distance(ahead.position, there.position), 0.0, 1e-9);
  EXPECT_NEAR(glm::distance(ahead.direction, there.direction), 0.0, 1e-9);
  for (std::size_t p = 0; p < there.planes.size(); ++p)
  {
    EXPECT_NEAR(glm::distance(ahead.planes[p], there.planes[p]), 0.0, 1e-6) << p;
  }
  EXPECT_EQ(ahead.pixelsPerUnit, there.pixelsPerUnit);
}

TEST(ViewAhead, ATurnGoesOn)
{
  const auto turnedBy = [](double a)
  {
    return View::perspective({ 5, 6, 7 },
      glm::dvec3(5, 6, 7) + glm::dvec3(std::cos(a), std::sin(a), 0.0), { 0, 0, 1 }, angle, 0.1, 1e4,
      800, 600);
  };
  const View ahead = viewAhead(turnedBy(0.5), turnedBy(0.52), 5.0);
  const View there = turnedBy(0.62);
  EXPECT_GT(glm::dot(ahead.direction, there.direction), 0.9999);
  for (std::size_t p = 0; p < there.planes.size(); ++p)
  {
    const glm::dvec3 normal(ahead.planes[p]);
    EXPECT_NEAR(glm::length(normal), 1.0, 1e-12);
    EXPECT_GT(glm::dot(normal, glm::dvec3(there.planes[p])), 0.9999) << p;
  }
}

TEST(ViewAhead, AZoomGoesOnWithinBounds)
{
  View before = lookingDown(0.0);
  View now = before;
  now.pixelsPerUnit = 1.1 * before.pixelsPerUnit;
  EXPECT_NEAR(viewAhead(before, now, 2.0).pixelsPerUnit, 1.331 * before.pixelsPerUnit, 1e-6);
  EXPECT_NEAR(viewAhead(before, now, 100.0).pixelsPerUnit, 4.4 * before.pixelsPerUnit, 1e-6);
}

TEST(ViewAhead, OtherViewportsAndKindsTellNothing)
{
  const View now = lookingDown(3.0);
  View before = lookingDown(1.0);
  before.width = 400;
  EXPECT_EQ(viewAhead(before, now, 5.0), now);
  before = lookingDown(1.0);
  before.parallel = true;
  EXPECT_EQ(viewAhead(before, now, 5.0), now);
}

// A point in sight of the wide view lies at most that far outside of the viewport.
TEST(WidenedView, HasAShareOfTheViewportMoreOnAllSides)
{
  const glm::dmat4 offAxis = glm::frustum(-0.3, 0.7, -0.2, 0.4, 1.0, 1e5) *
    glm::lookAt(glm::dvec3(5, 6, 700), glm::dvec3(50, 60, 0), glm::dvec3(0, 1, 0));
  const glm::dmat4 parallel = glm::ortho(-30.0, 70.0, -20.0, 40.0, 1.0, 1e5) *
    glm::lookAt(glm::dvec3(5, 6, 700), glm::dvec3(50, 60, 0), glm::dvec3(0, 1, 0));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> clip(-2.0, 2.0);
  for (const glm::dmat4& matrix : { offAxis, parallel })
  {
    const View now = View::fromMatrix(matrix, 800, 600);
    const View wide = widened(now, 0.125);
    EXPECT_EQ(wide.pixelsPerUnit, now.pixelsPerUnit);
    int inTheMargin = 0;
    for (int n = 0; n < 2000; ++n)
    {
      const glm::dvec3 ndc(clip(random), clip(random), 0.3);
      const glm::dvec4 there = glm::inverse(matrix) * glm::dvec4(ndc, 1.0);
      const glm::dvec3 world = glm::dvec3(there) / there.w;
      const double farthest = std::max(std::abs(ndc.x), std::abs(ndc.y));
      if (std::abs(farthest - 1.25) > 1e-6)
      {
        EXPECT_EQ(sphereVisibility(wide, world, 0.0) == Visibility::Inside, farthest < 1.25)
          << ndc.x << " " << ndc.y;
      }
      inTheMargin += farthest > 1.0 && farthest < 1.25 ? 1 : 0;
    }
    EXPECT_GT(inTheMargin, 50);
  }
}

TEST(WidenedView, ByNothingIsTheSameView)
{
  const View now = lookingDown(3.0);
  const View same = widened(now, 0.0);
  for (std::size_t p = 0; p < now.planes.size(); ++p)
  {
    EXPECT_NEAR(glm::distance(same.planes[p], now.planes[p]), 0.0, 1e-9) << p;
  }
}

// All that views moved by a tenth of the picture show, and nothing that is there.
TEST(ViewMargin, AroundAViewAtRestItHasWhatASmallMotionShows)
{
  const auto tree = strip();
  ScriptedResidency residency;
  residency.otherwise = ResidencySnapshot::State::Resident;
  FrontLimits limits;
  limits.targetErrorPx = limits.initialErrorPx = 1.5;
  limits.movesPerFrame = 100000;
  constexpr double height = 3000.0; // the picture is 3,400 wide where the strip is highest
  const auto shown = [&](double x)
  {
    RenderFront front(tree);
    std::map<NodeIndex, std::uint32_t> points;
    for (const DrawItem& item : front.update(lookingDown(x, height), residency, limits).draw)
    {
      points[item.node] = item.pointCount;
    }
    return points;
  };
  const auto here = shown(2000.0);
  ScriptedResidency loaded;
  for (const auto& [node, points] : here)
  {
    loaded.set(node, ResidencySnapshot::State::Resident);
  }
  ViewMargin margin(tree);
  std::set<NodeIndex> around;
  for (const LoadRequest& r : margin.around(lookingDown(2000.0, height), 1.5, loaded, 0.125, 1000))
  {
    EXPECT_TRUE(r.optional);
    EXPECT_EQ(here.count(r.node), 0u);
    around.insert(r.node);
  }
  EXPECT_FALSE(margin.rowsComing());
  // Nearer nodes have larger errors, so a move also shows the first points of some finer ones.
  std::uint64_t newOnes = 0; // points
  std::uint64_t missing = 0;
  for (const double x : { 1750.0, 1900.0, 2100.0, 2250.0 })
  {
    for (const auto& [node, points] : shown(x))
    {
      newOnes += here.count(node) == 0 ? points : 0;
      missing += here.count(node) == 0 && around.count(node) == 0 ? points : 0;
    }
  }
  EXPECT_GT(newOnes, 2000u);
  EXPECT_LE(20 * missing, newOnes);
}

TEST(ViewMargin, AheadOfNoMotionIsNothingAndOfAMotionWhatIsAbsent)
{
  ViewMargin margin(strip());
  ScriptedResidency residency;
  EXPECT_TRUE(margin.ahead(lookingDown(0.0), 4.0, residency, 8.0, 1000).empty());
  EXPECT_TRUE(margin.ahead(lookingDown(0.0), 4.0, residency, 8.0, 1000).empty());
  const auto& ahead = margin.ahead(lookingDown(50.0), 4.0, residency, 8.0, 1000);
  ASSERT_GT(ahead.size(), 10u);
  for (std::size_t r = 0; r < ahead.size(); ++r)
  {
    EXPECT_TRUE(ahead[r].optional);
    EXPECT_TRUE(r == 0 || ahead[r - 1].priority >= ahead[r].priority);
  }
  residency.otherwise = ResidencySnapshot::State::Resident;
  EXPECT_TRUE(margin.ahead(lookingDown(100.0), 4.0, residency, 8.0, 1000).empty());
}

TEST(ViewMargin, HandsOutTheMostUrgentWhenTheyAreTooMany)
{
  ViewMargin all(strip());
  ViewMargin few(strip());
  ScriptedResidency residency;
  all.ahead(lookingDown(0.0), 4.0, residency, 8.0, 1000);
  few.ahead(lookingDown(0.0), 4.0, residency, 8.0, 5);
  const auto& a = all.ahead(lookingDown(50.0), 4.0, residency, 8.0, 1000);
  const auto& b = few.ahead(lookingDown(50.0), 4.0, residency, 8.0, 5);
  ASSERT_EQ(b.size(), 5u);
  for (std::size_t r = 0; r < b.size(); ++r)
  {
    EXPECT_EQ(a[r].node, b[r].node);
  }
}

TEST(ViewMargin, AFlightFindsMostOfWhatItNeedsInMemory)
{
  const std::uint64_t without = nodesLate(false);
  const std::uint64_t with = nodesLate(true);
  EXPECT_GT(without, 100u);
  EXPECT_LT(5 * with, without);
}

} // namespace pointfront
