#include "pointfront/Front/MotionMargin.h"

#include "FrontScene.h"

#include <gtest/gtest.h>

#include <deque>
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
  MotionMargin margin(tree);
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
      const auto& more = margin.requests(view, limits.targetErrorPx, residency, 8.0, 1000);
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

TEST(MotionMargin, AsksForNothingAtRestAndOnlyForWhatIsAbsent)
{
  MotionMargin margin(strip());
  ScriptedResidency residency;
  EXPECT_TRUE(margin.requests(lookingDown(0.0), 4.0, residency, 8.0, 1000).empty());
  EXPECT_TRUE(margin.requests(lookingDown(0.0), 4.0, residency, 8.0, 1000).empty());
  const auto& ahead = margin.requests(lookingDown(50.0), 4.0, residency, 8.0, 1000);
  ASSERT_GT(ahead.size(), 10u);
  for (std::size_t r = 0; r < ahead.size(); ++r)
  {
    EXPECT_TRUE(ahead[r].optional);
    EXPECT_TRUE(r == 0 || ahead[r - 1].priority >= ahead[r].priority);
  }
  residency.otherwise = ResidencySnapshot::State::Resident;
  EXPECT_TRUE(margin.requests(lookingDown(100.0), 4.0, residency, 8.0, 1000).empty());
}

TEST(MotionMargin, HandsOutTheMostUrgentWhenTheyAreTooMany)
{
  MotionMargin all(strip());
  MotionMargin few(strip());
  ScriptedResidency residency;
  all.requests(lookingDown(0.0), 4.0, residency, 8.0, 1000);
  few.requests(lookingDown(0.0), 4.0, residency, 8.0, 5);
  const auto& a = all.requests(lookingDown(50.0), 4.0, residency, 8.0, 1000);
  const auto& b = few.requests(lookingDown(50.0), 4.0, residency, 8.0, 5);
  ASSERT_EQ(b.size(), 5u);
  for (std::size_t r = 0; r < b.size(); ++r)
  {
    EXPECT_EQ(a[r].node, b[r].node);
  }
}

TEST(MotionMargin, AFlightFindsMostOfWhatItNeedsInMemory)
{
  const std::uint64_t without = nodesLate(false);
  const std::uint64_t with = nodesLate(true);
  EXPECT_GT(without, 100u);
  EXPECT_LT(5 * with, without);
}

} // namespace pointfront
