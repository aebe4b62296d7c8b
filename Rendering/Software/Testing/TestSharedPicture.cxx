// A picture that several processes draw, as threads play them.

#include "MeetingOfProcesses.h"
#include "SharedSums.h"
#include "SoftwareRasteriser.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <thread>
#include <vector>

namespace pointfront
{
namespace
{

void takeNearest(const std::vector<SoftwareTarget>& parts, std::size_t pixel, SoftwareTarget& whole)
{
  for (const SoftwareTarget& part : parts)
  {
    const bool nearer = part.decided[pixel] < whole.decided[pixel] ||
      (part.decided[pixel] == whole.decided[pixel] &&
        (part.depth[pixel] < whole.depth[pixel] ||
          (part.depth[pixel] == whole.depth[pixel] && part.rgba[pixel] < whole.rgba[pixel])));
    if (nearer)
    {
      whole.decided[pixel] = part.decided[pixel];
      whole.depth[pixel] = part.depth[pixel];
      whole.rgba[pixel] = part.rgba[pixel];
      whole.looks[pixel] = part.looks[pixel];
    }
  }
}

} // namespace

// The nearest of three processes' pictures, each with something behind it: the same on all, and
// so is the light that looks at the pixels around one.
TEST(SharedPicture, IsThatOfAllProcesses)
{
  constexpr int width = 40;
  constexpr int height = 30;
  std::mt19937 random(7);
  SoftwareTarget whole;
  whole.keepDecided = true;
  whole.reset(width, height);
  whole.looks.assign(whole.depth.size(), 0);
  std::vector<SoftwareTarget> parts(3, whole);
  for (std::size_t pixel = 0; pixel < whole.depth.size(); ++pixel)
  {
    float before = 1.0f;
    std::uniform_int_distribution<std::size_t> any(0, 3);
    const std::size_t first = any(random); // 3: none
    for (std::size_t next = 0; first < 3 && next < 3; ++next)
    {
      SoftwareTarget& part = parts[(first + next) % 3];
      before += 0.1f * static_cast<float>(random() % 50);
      part.decided[pixel] = before;
      part.depth[pixel] = before + 0.01f * static_cast<float>(random() % 9);
      part.rgba[pixel] = (random() & 0xffffffu) | 0xff000000u;
      part.looks[pixel] = static_cast<std::uint16_t>(random() % 3);
    }
    takeNearest(parts, pixel, whole);
  }
  FrameCamera camera;
  camera.width = width;
  camera.height = height;
  FrameShading shading;
  shading.eyeDomeStrength = 0.4f;
  shading.furtherLooks.resize(2); // the first of these without
  shading.furtherLooks[1].eyeDomeStrength = 0.01f;
  SoftwareTarget lit = whole;
  shade(camera, shading, lit);
  EXPECT_NE(lit.rgba, whole.rgba);
  test::MeetingOfProcesses meeting(3);
  std::vector<std::thread> processes;
  for (SoftwareTarget& part : parts)
  {
    processes.emplace_back(
      [&]
      {
        test::ProcessOfMeeting here(meeting);
        shade(camera, shading, part, &here);
      });
  }
  for (std::thread& process : processes)
  {
    process.join();
  }
  for (const SoftwareTarget& part : parts)
  {
    EXPECT_EQ(part.rgba, lit.rgba);
    EXPECT_EQ(part.depth, whole.depth);
    EXPECT_EQ(part.decided, whole.decided);
    EXPECT_EQ(part.looks, whole.looks);
  }
}

} // namespace pointfront
