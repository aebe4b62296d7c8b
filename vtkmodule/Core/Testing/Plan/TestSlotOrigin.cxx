#include "pointfront/Plan/SlotOrigin.h"

#include <gtest/gtest.h>

using namespace pointfront;

namespace
{

glm::vec3 cube(double halfSize)
{
  return glm::vec3(static_cast<float>(halfSize));
}

const QuantisationGrid far{ glm::dvec3(0.001), glm::dvec3(1e7, 1e7, 1e3) };

TEST(SlotOrigin, NearTheReferenceAPointIsExactToAFractionOfAStep)
{
  // A node of 1,000 km whose origin is 500 km away.
  const GridPosition origin(-500000000, -500000000, 0);
  const glm::dvec3 reference = far.offset + glm::dvec3(0.0003, 0.25, 1.0);
  const auto slot = SlotOrigin::of(far, cube(5e5), origin, reference);
  EXPECT_EQ(slot.shift, 0);
  const glm::u32vec3 position(500000001u, 500000250u, 1000u); // offset + (0.001, 0.25, 1)
  const glm::vec3 relative = slot.relative(position, glm::vec3(0.001f));
  EXPECT_NEAR(relative.x, 0.0007, 1e-9);
  EXPECT_NEAR(relative.y, 0.0, 1e-9);
  EXPECT_NEAR(relative.z, 0.0, 1e-9);
}

TEST(SlotOrigin, TwoNodesAgreeOnACommonPoint)
{
  // The jitter that ADR 0004 is about: a coarse and a fine node with a point at one place.
  for (int i = 0; i < 100; ++i)
  {
    const glm::dvec3 reference = far.offset + glm::dvec3(0.00001 * i, 3.0 + 0.00003 * i, 2.0);
    const auto coarse = SlotOrigin::of(far, cube(4e5), GridPosition(-400000000), reference);
    const auto fine = SlotOrigin::of(far, cube(1.0), GridPosition(0, 2000, 1000), reference);
    const glm::vec3 a =
      coarse.relative(glm::u32vec3(400000100u, 400003000u, 400002500u), glm::vec3(0.001f));
    const glm::vec3 b = fine.relative(glm::u32vec3(100u, 1000u, 1500u), glm::vec3(0.001f));
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(a[axis], b[axis], 1e-7);
    }
  }
}

TEST(SlotOrigin, AnExtentWithoutEndHasAnOrigin)
{
  const QuantisationGrid tiny{ glm::dvec3(1e-308), glm::dvec3(0.0) };
  const auto slot = SlotOrigin::of(tiny, glm::vec3(3e38f), GridPosition(0), glm::dvec3(0.0));
  EXPECT_EQ(slot.shift, 32);
}

TEST(SlotOrigin, AFarReferenceIsClampedAndTheRestIsInTheBase)
{
  const glm::dvec3 reference = far.offset + glm::dvec3(0.0, 0.0, 5e6); // 5e9 steps
  const auto slot = SlotOrigin::of(far, cube(10.0), GridPosition(0), reference);
  EXPECT_EQ(slot.steps.z, 1 << 30);
  const glm::vec3 relative = slot.relative(glm::u32vec3(1000u), glm::vec3(0.001f));
  EXPECT_NEAR(relative.z, 1.0 - 5e6, 1.0); // float at 5e6
  EXPECT_NEAR(relative.x, 1.0, 1e-6);
}

TEST(SlotOrigin, NodesBeyondThirtyBitsAreShifted)
{
  const auto slot = SlotOrigin::of(far, cube(2e6), GridPosition(0), far.offset);
  EXPECT_EQ(slot.shift, 2); // 4e9 steps
  const glm::vec3 relative = slot.relative(glm::u32vec3(4000000000u, 4u, 0u), glm::vec3(0.001f));
  EXPECT_NEAR(relative.x, 4e6, 1.0);
  EXPECT_NEAR(relative.y, 0.004, 1e-6);
}

TEST(SlotOrigin, TheSameAtTheOriginAndFarAway)
{
  const QuantisationGrid home{ glm::dvec3(0.001), glm::dvec3(0.0) };
  const glm::dvec3 eye(3.0625, -2.5, 1.125);
  for (int i = 0; i < 50; ++i)
  {
    const GridPosition origin(i * 1237 - 20000, i * 511, -i);
    const auto a = SlotOrigin::of(home, cube(3.0), origin, eye);
    const auto b = SlotOrigin::of(far, cube(3.0), origin, far.offset + eye);
    EXPECT_EQ(a.steps, b.steps);
    EXPECT_EQ(a.base, b.base);
  }
}

} // namespace
