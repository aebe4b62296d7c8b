// Detail that grows while the view turns: time is a value, so each run gives the same pictures.

#include "SlowView.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>

#include <unistd.h>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

constexpr int turningFrames = 40;
constexpr double degreesAFrame = 1.0 / 3.0;
/// Mean difference of the channels, grey levels.
constexpr double mostOfGrowth = 0.1;

/// A view from within a landscape, which turns: nodes come in from the side in every frame.
struct TurningView : SlowView
{
  TurningView(const std::shared_ptr<const PointStore>& store, const StyleSheet& sheet)
    : SlowView(store, sheet)
  {
    const Bounds box = store->description().bounds;
    middle = 0.5 * (box.low + box.high);
    across = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
    moving = true;
    frameRequest.targetErrorPx = 3.0;
  }
  void turn(int number)
  {
    const double angle = number * degreesAFrame * 3.14159265358979 / 180.0;
    const glm::dvec3 arm(std::sin(angle), -std::cos(angle), 0.5);
    camera = FrameCamera::perspective(middle + 0.2 * across * arm, middle, { 0, 0, 1 }, 0.8,
      1e-3 * across, 10.0 * across, width, height);
    frame(true);
  }

  glm::dvec3 middle;
  double across;
};

double meanColourDifference(const SoftwareTarget& a, const SoftwareTarget& b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i)
  {
    for (int shift = 0; shift < 24; shift += 8)
    {
      sum += std::abs(int(a.rgba[i] >> shift & 255u) - int(b.rgba[i] >> shift & 255u));
    }
  }
  return sum / static_cast<double>(3 * a.rgba.size());
}

} // namespace

/// A turn brings nodes into view whose parents were seen. While they grew, splats of all coarser
/// nodes were large, across the whole picture: it was 0.23 grey levels from that of a view at rest.
TEST(GrowingMotion, ATurnIsNearToTheViewAtRest)
{
  const std::string path = builtStore("turning-" + std::to_string(getpid()),
    std::make_unique<TerrainSource>(300000, 11), nodesOf(2000));
  for (const bool blended : { false, true })
  {
    StyleSheet sheet;
    sheet.standard.technique = Technique::Splats;
    sheet.standard.blended = blended;
    sheet.standard.colour = ColourSource::ofAttribute("rgb");
    const auto store = openedStore(path);
    TurningView growing(store, sheet), still(store, sheet);
    growing.growthStep = 1.0 / 70.0;
    for (int number = 0; number < turningFrames; ++number)
    {
      growing.turn(number);
    }
    still.turn(turningFrames - 1);
    EXPECT_GT(growing.plan.pointCount(), 20000u);
    const double off = meanColourDifference(growing.target, still.target);
    EXPECT_LT(off, mostOfGrowth) << blended;
  }
}
