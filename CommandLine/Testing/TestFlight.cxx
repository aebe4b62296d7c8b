#include "Flight.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace pointfront
{
namespace
{
Camera tenAway()
{
  Camera camera;
  camera.position = { 0.0, -10.0, 2.0 };
  camera.focalPoint = { 0.0, 0.0, 2.0 };
  camera.viewUp = { 0.0, 0.0, 1.0 };
  return camera;
}
} // namespace

TEST(Flight, HeldKeysCarryTheEyeAndOthersDoNot)
{
  Flight flight;
  EXPECT_FALSE(flight.hold("c", true));
  EXPECT_FALSE(flight.flying());
  EXPECT_TRUE(flight.hold("w", true));
  EXPECT_TRUE(flight.flying());
  Camera moved = flight.moved(tenAway(), 1.0);
  EXPECT_NEAR(moved.position.y, -5.0, 1e-9);
  EXPECT_NEAR(moved.focalPoint.y, 5.0, 1e-9);
  flight.hold("Shift_L", true);
  EXPECT_NEAR(flight.moved(tenAway(), 0.25).position.y, -5.0, 1e-9);
  flight.hold("s", true); // against each other
  EXPECT_EQ(flight.moved(tenAway(), 1.0).position, tenAway().position);
  flight.hold("W", false); // Shift is held: the key has another name now
  flight.hold("Shift_L", false);
  EXPECT_NEAR(flight.moved(tenAway(), 1.0).position.y, -15.0, 1e-9);
  flight.hold("s", false);
  EXPECT_FALSE(flight.flying());
}

TEST(Flight, GoesAsideAndUp)
{
  Flight flight;
  flight.hold("d", true);
  flight.hold("Prior", true);
  const Camera moved = flight.moved(tenAway(), 1.0);
  EXPECT_NEAR(glm::length(moved.position - glm::dvec3(5.0, -10.0, 7.0)), 0.0, 1e-9);
  flight.stop();
  EXPECT_EQ(flight.moved(tenAway(), 1.0).position, tenAway().position);
}

TEST(Flight, AParallelViewGrows)
{
  Flight flight;
  Camera camera = tenAway();
  camera.parallelScale = 8.0;
  flight.hold("w", true);
  const Camera moved = flight.moved(camera, 0.1);
  EXPECT_EQ(moved.position, camera.position);
  EXPECT_LT(*moved.parallelScale, 8.0);
}

} // namespace pointfront
