// Holes that are filled in a part of a viewport.

#include "HoleFiller.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>

using namespace pointfront;

namespace
{

constexpr int holesWidth = 96;
constexpr int holesHeight = 80;

/// A slope with every third pixel missing, and nothing around it.
SoftwareTarget slopeWithHoles(const PixelRectangle& place)
{
  SoftwareTarget target;
  target.reset(place);
  for (int y = place.bottom; y < place.top; ++y)
  {
    for (int x = place.left; x < place.right; ++x)
    {
      const bool slope = x >= 30 && x < 70 && y >= 26 && y < 60;
      if (slope && (x + 2 * y) % 3 != 0)
      {
        const std::size_t pixel =
          static_cast<std::size_t>(y - place.bottom) * static_cast<std::size_t>(place.width()) +
          static_cast<std::size_t>(x - place.left);
        target.depth[pixel] = 5.0f + 0.001f * static_cast<float>(x);
        target.rgba[pixel] = 0xff000000u + static_cast<std::uint32_t>(3 * x + 256 * y);
      }
    }
  }
  return target;
}

} // namespace

/// Blocks count from the viewport's corner: the same colours wherever the picture is cut.
TEST(HoleFiller, FillsAPartOfAViewportAsTheWhole)
{
  const FrameCamera camera = FrameCamera::perspective(
    { 0, 0, 5 }, { 0, 0, 0 }, { 0, 1, 0 }, 0.6, 0.1, 100.0, holesWidth, holesHeight);
  SoftwareTarget whole = slopeWithHoles({ 0, 0, holesWidth, holesHeight });
  fillHoles(camera, whole);
  int filled = 0;
  for (int shift = 0; shift < 9; ++shift)
  {
    // More than a block around the slope.
    const PixelRectangle place{ 3 + shift, 9 - shift, 87 + shift, 79 - shift };
    SoftwareTarget part = slopeWithHoles(place);
    fillHoles(camera, part);
    for (int y = place.bottom; y < place.top; ++y)
    {
      for (int x = place.left; x < place.right; ++x)
      {
        const std::size_t own =
          static_cast<std::size_t>(y - place.bottom) * static_cast<std::size_t>(place.width()) +
          static_cast<std::size_t>(x - place.left);
        const std::size_t other =
          static_cast<std::size_t>(y) * holesWidth + static_cast<std::size_t>(x);
        ASSERT_EQ(part.rgba[own], whole.rgba[other]) << x << ", " << y << ", cut by " << shift;
        filled +=
          (x + 2 * y) % 3 == 0 && part.depth[own] < std::numeric_limits<float>::infinity() ? 1 : 0;
      }
    }
  }
  EXPECT_GT(filled, 9 * 400);
}

/// A mean is of one pixel at least, however large the splat beside the eye.
TEST(HoleFiller, TakesDepthsBehindTheEye)
{
  const FrameCamera camera = FrameCamera::perspective(
    { 0, 0, 5 }, { 0, 0, 0 }, { 0, 1, 0 }, 0.6, 0.1, 100.0, holesWidth, holesHeight);
  SoftwareTarget target = slopeWithHoles({ 0, 0, holesWidth, holesHeight });
  const SoftwareTarget before = target;
  for (float& depth : target.depth)
  {
    depth = depth < 100.0f ? -0.01f * depth : depth;
  }
  fillHoles(camera, target);
  for (std::size_t pixel = 0; pixel < before.rgba.size(); ++pixel)
  {
    EXPECT_TRUE(before.rgba[pixel] == 0 || target.rgba[pixel] == before.rgba[pixel]) << pixel;
  }
}
