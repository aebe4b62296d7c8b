// A view at rest while its store is being loaded (SMOOTH-5): each frame draws what is new, nothing
// is drawn twice, and the complete picture has the bits of one that was drawn at one go.

#include "LoadingView.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <unistd.h>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

constexpr int mostRefiningFrames = 5000;
constexpr double mostDrawnAgain = 1.1; ///< times the points of the complete picture
/// Once as it comes, by what is nearest at that time, and once more when all is there.
constexpr double mostBlendedAgain = 2.15;
constexpr double mostDrawnGrowing = 2.5; ///< likewise: what grows has another size in each frame
/// Share of the complete picture's pixels in each frame; splats that close the surface.
constexpr double leastCovered = 0.98;

std::shared_ptr<const PointStore> refiningTown()
{
  static const std::string path = builtStore(
    "refinement-" + std::to_string(getpid()), std::make_unique<TerrainSource>(300000, 11));
  return openedStore(path);
}

struct RefiningStyle
{
  std::string name;
  Technique technique;
  SplatSize::Mode size;
  double value;
};
const RefiningStyle refiningStyles[] = {
  { "squares", Technique::Points, SplatSize::Mode::Pixels, 2.0 },
  { "discs_in_pixels", Technique::Splats, SplatSize::Mode::Pixels, 3.0 },
  { "spheres_in_metres", Technique::Spheres, SplatSize::Mode::World, 0.4 },
  { "closing_discs", Technique::Splats, SplatSize::Mode::Spacing, 1.0 },
  { "closing_spheres", Technique::Spheres, SplatSize::Mode::Spacing, 1.0 },
  { "closing_ewa", Technique::Ewa, SplatSize::Mode::Spacing, 1.0 },
};

class RefiningView : public testing::TestWithParam<RefiningStyle>
{
};

StyleSheet refiningSheet(const RefiningStyle& style)
{
  StyleSheet sheet;
  sheet.standard.technique = style.technique;
  sheet.standard.size = StyleSize{ style.size, style.value, "" };
  sheet.standard.colour = ColourSource::ofAttribute("rgb");
  return sheet;
}

/// The frames of a view until it was complete.
struct SeenFrames
{
  std::uint64_t points = 0; ///< points of the complete picture
  std::uint64_t drawn = 0; ///< in all frames together
  std::uint64_t blended = 0; ///< likewise, through the second pass
  int frames = 0;
  int gained = 0; ///< frames after the first with more points than the one before
  std::vector<std::vector<float>> depths; ///< depths of each frame

  double drawnPerPoint() const { return double(drawn) / double(points); }
  double blendedPerPoint() const { return double(blended) / double(points); }
  /// The worst frame's share of the pixels that the complete picture covers.
  double leastCovered(const SoftwareTarget& complete) const
  {
    double least = 1.0;
    for (const std::vector<float>& depth : depths)
    {
      double covered = 0.0, all = 0.0;
      for (std::size_t pixel = 0; pixel < depth.size(); ++pixel)
      {
        const bool counts = std::isfinite(complete.depth[pixel]);
        all += counts ? 1.0 : 0.0;
        covered += counts && std::isfinite(depth[pixel]) ? 1.0 : 0.0;
      }
      least = std::min(least, covered / all);
    }
    return least;
  }
};

SeenFrames refine(LoadingView& view)
{
  SeenFrames seen;
  do
  {
    view.waitForNews();
    const RasterStatistics one = view.frame();
    seen.drawn += one.points + one.standIns + one.keptVisible - one.reused;
    seen.gained += seen.frames > 0 && one.points > seen.points;
    seen.blended += one.blended;
    seen.points = one.points;
    seen.depths.push_back(view.target.depth);
  } while (!view.isComplete() && ++seen.frames < mostRefiningFrames);
  return seen;
}

/// Splats of a given size leave holes until all are there.
double coverageOf(const RefiningStyle& style)
{
  return style.size == SplatSize::Mode::Spacing ? leastCovered : 0.0;
}

/// In each frame, and at the end; what was seen goes into the report.
void expectCoveredAndAsAtOneGo(
  const LoadingView& view, const SeenFrames& seen, const RefiningStyle& style)
{
  const double covered = seen.leastCovered(view.target);
  EXPECT_GE(covered, coverageOf(style));
  testing::Test::RecordProperty("frames", seen.frames);
  testing::Test::RecordProperty("drawn_per_point", std::to_string(seen.drawnPerPoint()));
  testing::Test::RecordProperty("blended_per_point", std::to_string(seen.blendedPerPoint()));
  testing::Test::RecordProperty("least_covered", std::to_string(covered));
  LoadingView atOnce(refiningTown(), refiningSheet(style));
  atOnce.frame(true);
  EXPECT_EQ(view.target.rgba, atOnce.target.rgba);
  EXPECT_EQ(view.target.depth, atOnce.target.depth);
}

} // namespace

TEST_P(RefiningView, DrawsNothingTwice)
{
  const std::shared_ptr<const PointStore> store = refiningTown();
  ASSERT_TRUE(store);
  LoadingView(store, refiningSheet(GetParam())).frame(true); // the table's rows are there then
  LoadingView view(store, refiningSheet(GetParam()));
  const SeenFrames seen = refine(view);
  ASSERT_TRUE(view.isComplete());
  EXPECT_GE(seen.gained, 3); // it was seen to load; a slow machine draws few frames meanwhile
  EXPECT_LE(seen.drawnPerPoint(), mostDrawnAgain) << seen.frames << " frames";
  EXPECT_LE(seen.blendedPerPoint(), mostBlendedAgain) << seen.frames << " frames";
  expectCoveredAndAsAtOneGo(view, seen, GetParam());
}

/// As windows show it: what arrives grows (SMOOTH-6). What grows is drawn each time; what has grown
/// is not.
TEST_P(RefiningView, DrawsWhatGrowsAndNothingElse)
{
  const std::shared_ptr<const PointStore> store = refiningTown();
  ASSERT_TRUE(store);
  LoadingView(store, refiningSheet(GetParam())).frame(true); // the table's rows are there then
  LoadingView view(store, refiningSheet(GetParam()));
  view.growthStep = 0.05;
  const SeenFrames seen = refine(view);
  ASSERT_TRUE(view.isComplete());
  EXPECT_LE(seen.drawnPerPoint(), mostDrawnGrowing) << seen.frames << " frames";
  expectCoveredAndAsAtOneGo(view, seen, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Techniques, RefiningView, testing::ValuesIn(refiningStyles),
  [](const testing::TestParamInfo<RefiningStyle>& one) { return one.param.name; });
