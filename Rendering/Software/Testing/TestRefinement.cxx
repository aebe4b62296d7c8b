// A view at rest while its store is being loaded (SMOOTH-5): each frame draws what is new, nothing
// is drawn twice, and the complete picture has the bits of one that was drawn at one go.

#include "SlowView.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
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
constexpr double mostMeansGrowing = 3.2; ///< likewise: all points of a node grow
#if defined(__SANITIZE_THREAD__)
// As many nodes and frames, with a sixth of the points: coarse nodes leave more holes.
constexpr double leastCovered = 0.9;
constexpr std::uint64_t townPoints = 50000;
constexpr std::uint32_t townNodePoints = 400;
#else
/// Share of the complete picture's pixels in each frame; splats that close the surface.
constexpr double leastCovered = 0.98;
constexpr std::uint64_t townPoints = 300000;
constexpr std::uint32_t townNodePoints = 2000;
#endif

std::shared_ptr<const PointStore> refiningTown()
{
  static const std::string path = builtStore("refinement-" + std::to_string(getpid()),
    std::make_unique<TerrainSource>(townPoints, 11), nodesOf(townNodePoints));
  return openedStore(path);
}

std::shared_ptr<const PointStore> refiningMeans()
{
  BuildOptions options = nodesOf(townNodePoints);
  options.refinement = Refinement::Replace;
  static const std::string path = builtStore(
    "means-" + std::to_string(getpid()), std::make_unique<TerrainSource>(townPoints, 11), options);
  return openedStore(path);
}

/// Clouds whose points lie among each other.
std::vector<std::shared_ptr<const PointStore>> refiningTowns()
{
  std::vector<std::shared_ptr<const PointStore>> stores;
  for (const unsigned seed : { 11u, 12u, 13u })
  {
    const std::string name = "refinement-" + std::to_string(getpid()) + "-" + std::to_string(seed);
    static std::map<unsigned, std::string> paths;
    std::string& path = paths[seed];
    path = path.empty() ? builtStore(name, std::make_unique<TerrainSource>(100000, seed)) : path;
    stores.push_back(openedStore(path));
  }
  return stores;
}

struct RefiningStyle
{
  std::string name;
  Technique technique;
  SplatSize::Mode size;
  double value;
};
const RefiningStyle closingDiscs{ "closing_discs", Technique::Splats, SplatSize::Mode::Spacing,
  1.0 };
const RefiningStyle refiningStyles[] = {
  { "squares", Technique::Points, SplatSize::Mode::Pixels, 2.0 },
#if !defined(__SANITIZE_THREAD__) // the same threads whatever they draw: two ways to draw there
  { "spheres_in_metres", Technique::Spheres, SplatSize::Mode::World, 0.4 },
  closingDiscs,
  { "closing_spheres", Technique::Spheres, SplatSize::Mode::Spacing, 1.0 },
  { "discs_in_pixels", Technique::Splats, SplatSize::Mode::Pixels, 3.0 },
#endif
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
  std::vector<PictureValues<float>> depths; ///< depths of each frame

  double drawnPerPoint() const { return double(drawn) / double(points); }
  double blendedPerPoint() const { return double(blended) / double(points); }
  /// The worst frame's share of the pixels that the complete picture covers.
  double leastCovered(const SoftwareTarget& complete) const
  {
    double least = 1.0;
    for (const PictureValues<float>& depth : depths)
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

SeenFrames refine(SlowView& view)
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
  const SlowView& view, const SeenFrames& seen, const RefiningStyle& style, bool means = false)
{
  const double covered = seen.leastCovered(view.target);
  EXPECT_GE(covered, coverageOf(style));
  testing::Test::RecordProperty("frames", seen.frames);
  testing::Test::RecordProperty("drawn_per_point", std::to_string(seen.drawnPerPoint()));
  testing::Test::RecordProperty("blended_per_point", std::to_string(seen.blendedPerPoint()));
  testing::Test::RecordProperty("least_covered", std::to_string(covered));
  SlowView atOnce(means ? refiningMeans() : refiningTown(), refiningSheet(style));
  atOnce.frameRequest = view.frameRequest;
  atOnce.frame(true);
  EXPECT_EQ(view.target.rgba, atOnce.target.rgba);
  EXPECT_EQ(view.target.depth, atOnce.target.depth);
}

} // namespace

TEST_P(RefiningView, DrawsNothingTwice)
{
  const std::shared_ptr<const PointStore> store = refiningTown();
  ASSERT_TRUE(store);
  SlowView(store, refiningSheet(GetParam())).frame(true); // the table's rows are there then
  SlowView view(store, refiningSheet(GetParam()));
  const SeenFrames seen = refine(view);
  ASSERT_TRUE(view.isComplete());
  EXPECT_GE(seen.gained, 3); // it was seen to load; a slow machine draws few frames meanwhile
  EXPECT_LE(seen.drawnPerPoint(), mostDrawnAgain) << seen.frames << " frames";
  EXPECT_LE(seen.blendedPerPoint(), mostBlendedAgain) << seen.frames << " frames";
  expectCoveredAndAsAtOneGo(view, seen, GetParam());
}

/// A detail that is one for the whole view (SMOOTH-3) knows its complete view, too.
TEST_P(RefiningView, OfViewSpecificDetailDrawsNothingTwice)
{
  const std::shared_ptr<const PointStore> store = refiningTown();
  ASSERT_TRUE(store);
  SlowView(store, refiningSheet(GetParam())).frame(true); // the table's rows are there then
  SlowView view(store, refiningSheet(GetParam()));
  view.frameRequest.method = DetailMethod::ViewSpecific;
  view.frameRequest.overviewPoints = townPoints / 20;
  const SeenFrames seen = refine(view);
  ASSERT_TRUE(view.isComplete());
  EXPECT_GE(seen.gained, 3);
  EXPECT_LE(seen.drawnPerPoint(), mostDrawnAgain) << seen.frames << " frames";
  EXPECT_LE(seen.blendedPerPoint(), mostBlendedAgain) << seen.frames << " frames";
  expectCoveredAndAsAtOneGo(view, seen, GetParam());
}

/// Where children replace their parents, the coarse ones of these are the stand-ins.
TEST_P(RefiningView, OfATreeOfMeansDrawsNothingTwice)
{
  if (GetParam().size != SplatSize::Mode::Spacing)
  {
    return; // only what closes the surface goes on there
  }
  const std::shared_ptr<const PointStore> store = refiningMeans();
  ASSERT_TRUE(store);
  SlowView(store, refiningSheet(GetParam())).frame(true); // the table's rows are there then
  for (const double growthStep : { 0.0, 0.05 })
  {
    SlowView view(store, refiningSheet(GetParam()));
    view.growthStep = growthStep;
    const SeenFrames seen = refine(view);
    ASSERT_TRUE(view.isComplete());
    EXPECT_GE(seen.gained, 3);
    EXPECT_LE(seen.drawnPerPoint(), growthStep > 0.0 ? mostMeansGrowing : mostDrawnAgain)
      << seen.frames << " frames";
    EXPECT_LE(seen.blendedPerPoint(), growthStep > 0.0 ? mostMeansGrowing + 1.0 : mostBlendedAgain);
    expectCoveredAndAsAtOneGo(view, seen, GetParam(), true);
  }
}

/// Means in nodes of 400 points.
std::shared_ptr<const PointStore> fewMeans()
{
  BuildOptions options = nodesOf(400);
  options.refinement = Refinement::Replace;
  static const std::string path = builtStore(
    "few-means-" + std::to_string(getpid()), std::make_unique<TerrainSource>(40000, 11), options);
  return openedStore(path);
}

#if !defined(__SANITIZE_THREAD__) // sixteen views on one set of threads
/// Close to the ground a coarse node reaches into the view and its children lie beside it: nothing
/// takes its place, so that a picture with it could not go on.
TEST(RefiningMeans, NodesWithoutAChildInTheViewAreNoPartOfIt)
{
  const std::shared_ptr<const PointStore> store = fewMeans();
  ASSERT_TRUE(store);
  const StyleSheet sheet = refiningSheet(closingDiscs);
  const Bounds box = store->description().bounds;
  const glm::dvec3 size = box.high - box.low;
  for (int place = 0; place < 16; ++place)
  {
    const glm::dvec3 share((place % 4 + 0.5) / 4.0, (place / 4 + 0.5) / 4.0, 0.5);
    SlowView view(store, sheet);
    view.frameRequest.targetErrorPx = 1.0;
    view.lookAt(box.low + share * size, 0.1 * std::max(size.x, size.y));
    const SeenFrames seen = refine(view);
    ASSERT_TRUE(view.isComplete());
    const auto most = static_cast<std::uint64_t>(mostDrawnAgain * double(seen.points)) + 200;
    EXPECT_LE(seen.drawn, most) << place << ": " << seen.points << " points";
  }
}

#endif

/// A tree of means whose nodes are small has a root of a few dozen points, each for a thousand.
TEST(RefiningMeans, ARootOfAFewPointsClosesTheSurface)
{
  const std::shared_ptr<const PointStore> store = fewMeans();
  ASSERT_TRUE(store);
  const StyleSheet sheet = refiningSheet(closingDiscs);
  SlowView complete(store, sheet);
  complete.frame(true);
  SlowView view(store, sheet);
  view.nodesAFrame = 1;
  const RasterStatistics first = view.frame();
  EXPECT_EQ(first.points, 0u);
  EXPECT_GT(first.standIns, 0u);
  EXPECT_LT(first.standIns, 64u);
  SeenFrames seen;
  seen.depths.push_back(view.target.depth);
  EXPECT_GE(seen.leastCovered(complete.target), 0.7)
    << "none is larger than an eighth of the height";
}

/// As windows show it: what arrives grows (SMOOTH-6). What grows is drawn each time; what has grown
/// is not.
TEST_P(RefiningView, DrawsWhatGrowsAndNothingElse)
{
  const std::shared_ptr<const PointStore> store = refiningTown();
  ASSERT_TRUE(store);
  SlowView(store, refiningSheet(GetParam())).frame(true); // the table's rows are there then
  SlowView view(store, refiningSheet(GetParam()));
  view.growthStep = 0.05;
  const SeenFrames seen = refine(view);
  ASSERT_TRUE(view.isComplete());
  EXPECT_LE(seen.drawnPerPoint(), mostDrawnGrowing) << seen.frames << " frames";
  expectCoveredAndAsAtOneGo(view, seen, GetParam());
}

namespace
{

/// Several clouds of one view that are being loaded side by side: `together`, into one picture as
/// the tool draws them, or each into its own, as the actors of a window are drawn.
struct RefiningClouds
{
  RefiningClouds(const RefiningStyle& style, bool drawnTogether)
    : together(drawnTogether)
  {
    for (const std::shared_ptr<const PointStore>& store : refiningTowns())
    {
      views.push_back(std::make_unique<SlowView>(store, refiningSheet(style)));
      views.back()->composited = true;
      views.back()->camera = views.front()->camera;
    }
  }
  void frame(bool complete)
  {
    if (together)
    {
      picture.keepDecided = true;
      picture.reset(SlowView::width, SlowView::height);
    }
    points = 0;
    for (std::size_t number = 0; number < views.size(); ++number)
    {
      SlowView& view = *views[number];
      RasterStatistics one;
      if (together)
      {
        view.planNext(complete);
        one = rasteriser.draw(view.plan, picture, static_cast<std::uint16_t>(number));
      }
      else
      {
        one = view.frame(complete);
      }
      points += one.points;
      drawn += one.points + one.standIns + one.keptVisible - one.reused;
      blended += one.blended;
    }
  }
  bool isComplete() const
  {
    return std::all_of(
      views.begin(), views.end(), [](const auto& view) { return view->isComplete(); });
  }
  void expectAlike(const RefiningClouds& other) const
  {
    EXPECT_EQ(picture.rgba, other.picture.rgba);
    EXPECT_EQ(picture.depth, other.picture.depth);
    EXPECT_EQ(picture.decided, other.picture.decided);
    for (std::size_t number = 0; number < views.size(); ++number)
    {
      EXPECT_EQ(views[number]->target.rgba, other.views[number]->target.rgba) << number;
      EXPECT_EQ(views[number]->target.depth, other.views[number]->target.depth) << number;
      EXPECT_EQ(views[number]->target.decided, other.views[number]->target.decided) << number;
    }
  }

  bool together;
  std::vector<std::unique_ptr<SlowView>> views;
  SoftwareRasteriser rasteriser;
  SoftwareTarget picture;
  std::uint64_t points = 0; ///< the last frame has
  std::uint64_t drawn = 0; ///< in all frames together
  std::uint64_t blended = 0; ///< likewise, through the second pass
};

} // namespace

TEST_P(RefiningView, OfSeveralCloudsDrawsNothingTwice)
{
  for (const bool together : { false, true })
  {
    RefiningClouds atOnce(GetParam(), together);
    atOnce.frame(true); // the tables' rows are there then
    RefiningClouds clouds(GetParam(), together);
    int frames = 0, gained = 0;
    do
    {
      const std::uint64_t before = clouds.points;
      for (const auto& view : clouds.views)
      {
        view->isComplete() ? void() : view->waitForNews();
      }
      clouds.frame(false);
      gained += frames > 0 && clouds.points > before;
    } while (!clouds.isComplete() && ++frames < mostRefiningFrames);
    ASSERT_TRUE(clouds.isComplete()) << together;
    EXPECT_GE(gained, 3) << together;
    const auto points = static_cast<double>(clouds.points);
    RecordProperty(
      together ? "one_picture" : "a_picture_each", std::to_string(double(clouds.drawn) / points));
    EXPECT_LE(double(clouds.drawn) / points, mostDrawnAgain) << together << ", " << frames;
    EXPECT_LE(double(clouds.blended) / points, mostBlendedAgain) << together << ", " << frames;
    clouds.expectAlike(atOnce);
  }
}

INSTANTIATE_TEST_SUITE_P(Techniques, RefiningView, testing::ValuesIn(refiningStyles),
  [](const testing::TestParamInfo<RefiningStyle>& one) { return one.param.name; });
