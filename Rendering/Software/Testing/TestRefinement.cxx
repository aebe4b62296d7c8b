// A view at rest while its store is being loaded (SMOOTH-5): each frame draws what is new, nothing
// is drawn twice, and the complete picture has the bits of one that was drawn at one go.

#include "LoadingView.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>

#include <unistd.h>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

constexpr int mostRefiningFrames = 5000;
constexpr double mostDrawnAgain = 1.1; ///< times the points of the complete picture

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

} // namespace

TEST_P(RefiningView, DrawsNothingTwice)
{
  const std::shared_ptr<const PointStore> store = refiningTown();
  ASSERT_TRUE(store);
  LoadingView view(store, refiningSheet(GetParam()));
  std::uint64_t drawn = 0;
  int frames = 0, gained = 0;
  std::uint64_t before = 0;
  do
  {
    view.waitForNews();
    const RasterStatistics one = view.frame();
    drawn += one.points + one.keptVisible - one.reused;
    gained += frames > 0 && one.points > before;
    before = one.points;
  } while (!view.isComplete() && ++frames < mostRefiningFrames);
  ASSERT_TRUE(view.isComplete());
  EXPECT_GE(gained, 3); // it was seen to load; a slow machine draws few frames meanwhile
  EXPECT_LE(static_cast<double>(drawn), mostDrawnAgain * static_cast<double>(before))
    << frames << " frames";
  RecordProperty("frames", frames);
  RecordProperty("drawn_per_point", std::to_string(double(drawn) / double(before)));

  LoadingView atOnce(store, refiningSheet(GetParam()));
  atOnce.frame(true);
  EXPECT_EQ(view.target.rgba, atOnce.target.rgba);
  EXPECT_EQ(view.target.depth, atOnce.target.depth);
}

INSTANTIATE_TEST_SUITE_P(Techniques, RefiningView, testing::ValuesIn(refiningStyles),
  [](const testing::TestParamInfo<RefiningStyle>& one) { return one.param.name; });
