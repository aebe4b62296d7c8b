// A view at rest on OpenGL while its store is being loaded (SMOOTH-5), node by node: each frame
// draws what is new, nothing is drawn twice, no frame has holes, and the complete picture is the
// one that is drawn at one go. The plans are those of SlowView, without a mapper.

#include "LoadingClouds.h"
#include "StyleJSON.h"

#include "pointfront/Generate/TerrainSource.h"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <unistd.h>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

constexpr int mostFrames = 5000;
constexpr double mostDrawnAgain = 1.1; ///< times the points of the complete picture
/// Share of the complete picture's pixels that each frame covers.
constexpr double leastCovered = 0.96;
/// The same where the first frame has a root of 27 means alone, which are at most an eighth of the
/// height large; ellipses are shorter.
constexpr double leastOfMeansCovered = 0.55;
/// Share of the pixels that the back ends draw otherwise, in any frame.
constexpr double mostOff = 0.005;

struct RefiningSplats
{
  std::string name;
  std::string json;
  double most; ///< points drawn over all frames, times those of the complete picture at one go
  bool asSoftware = true; ///< each frame; else the last one
};
/// A blended point is drawn once, goes through the second pass as it comes, and once more when all
/// is there.
constexpr double mostBlendedAgain = (mostDrawnAgain + 2.15) / 2.0;

const RefiningSplats refiningSplats[] = {
  { "discs", R"({"default": {"technique": "splats"}})", mostDrawnAgain },
  { "ellipses", R"({"default": {"technique": "splats", "orientation": [0.1, 0.2, 1]}})",
    mostDrawnAgain },
  { "spheres", R"({"default": {"technique": "spheres"}, "shading": {"mode": "lit"}})",
    mostDrawnAgain },
  { "blended", R"({"default": {"technique": "splats", "blended": true}})", mostBlendedAgain,
    false },
  { "ewa", R"({"default": {"technique": "ewa", "orientation": [0.1, 0.2, 1]}})", mostBlendedAgain,
    false },
  { "composed", R"({"default": {"technique": "splats"}, "classes": {"5": {"opacity": 0.4},
      "6": {"technique": "ewa"}}, "shading": {"mode": "edl", "fill_holes": true},
      "lenses": [{"shape": "circle", "center_px": [240, 160], "radius_px": 90, "inside":
        {"default": {"technique": "spheres", "color": "classification"}}}],
      "highlight": [{"class": 6, "color": "#ffcc00"}]})",
    mostBlendedAgain, false },
  { "around", R"({"default": {"technique": "splats", "color": "#40a040"}, "lenses": [
      {"around_class": 5, "radius": 3, "inside": {"default": {"color": "#ff00ff"}}}]})",
    mostDrawnAgain },
};

/// A store in which children take their parents' places.
std::shared_ptr<const PointStore> meansOfTown(Structure structure)
{
  static std::map<Structure, std::string> paths;
  const bool kdTree = structure == Structure::KdTree;
  std::string& path = paths[structure];
  if (path.empty())
  {
    BuildOptions options = nodesOf(400);
    options.refinement = Refinement::Replace;
    options.structure = structure;
    const std::string name = kdTree ? "refining-kd-means-" : "refining-means-";
    path = builtStore(
      name + std::to_string(getpid()), std::make_unique<TerrainSource>(40000, 11), options);
  }
  return openedStore(path);
}

std::shared_ptr<const PointStore> townOf(std::size_t points, unsigned seed = 11)
{
  static std::map<unsigned, std::string> paths;
  const std::string name = "refining-" + std::to_string(getpid()) + "-" + std::to_string(seed);
  std::string& path = paths[seed];
  path = path.empty()
    ? builtStore(name, std::make_unique<TerrainSource>(points, seed), nodesOf(2000))
    : path;
  return openedStore(path);
}

/// Share of the pixels of the complete picture that another one covers.
double coveredOf(const Picture& complete, const Picture& other)
{
  double covered = 0.0, all = 0.0;
  for (std::size_t i = 0; i < complete.rgb.size(); i += 3)
  {
    const auto isLit = [&](const Picture& one)
    { return one.rgb[i] + one.rgb[i + 1] + one.rgb[i + 2] > 0; };
    all += isLit(complete) ? 1.0 : 0.0;
    covered += isLit(complete) && isLit(other) ? 1.0 : 0.0;
  }
  return covered / all;
}

/// Pixels in which red and blue are more than green.
std::ptrdiff_t magentaOf(const Picture& picture)
{
  std::ptrdiff_t count = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
  {
    count += picture.rgb[i] > picture.rgb[i + 1] && picture.rgb[i + 2] > picture.rgb[i + 1];
  }
  return count;
}

/// The frames of a view until it was complete.
struct SeenFrames
{
  double drawn = 0.0;
  double off = 0.0; ///< offSoftware() of the worst frame
  int frames = 0;
  int gained = 0; ///< frames after the first with more points than the one before
  std::vector<Picture> pictures;
};

SeenFrames refine(LoadingClouds& scene, bool compares)
{
  SeenFrames seen;
  std::int64_t before = 0;
  do
  {
    scene.waitForNews();
    for (std::size_t number = 0; number < scene.size(); ++number)
    {
      // The root comes alone, however slow the machine is.
      scene.view(number).nodesAFrame = seen.frames == 0 ? 1 : SlowView::usualNodesAFrame;
    }
    seen.drawn += scene.frame().onGl;
    seen.gained += seen.frames > 0 && scene.pointsOnGl > before;
    before = scene.pointsOnGl;
    seen.pictures.push_back(scene.picture());
    seen.off = compares ? std::max(seen.off, scene.offSoftware()) : 0.0;
  } while (!scene.isComplete() && ++seen.frames < mostFrames);
  EXPECT_TRUE(scene.isComplete());
  return seen;
}

using Stores = std::vector<std::shared_ptr<const PointStore>>;

/// Refines a view of each style, whose frames are `growthStep` seconds apart.
void expectRefined(
  const Stores& stores, const RefiningSplats& style, double growthStep, double most)
{
  const Result<StyleSheet> sheet = parseStyleSheet(style.json);
  ASSERT_TRUE(sheet.ok()) << sheet.error().what;
  LoadingClouds atOnce(stores, *sheet);
  const double once = atOnce.frame(true).onGl; // the table's rows are there then
  const Picture complete = atOnce.picture();
  EXPECT_GT(complete.lit(), 40000) << style.name;

  LoadingClouds scene(stores, *sheet);
  for (std::size_t number = 0; number < scene.size(); ++number)
  {
    scene.view(number).growthStep = growthStep;
  }
  // The software back end makes one picture of several clouds, in whose stand-ins all take part.
  const SeenFrames seen = refine(scene, style.asSoftware && stores.size() == 1);
  EXPECT_GE(seen.gained, 3) << style.name;
  EXPECT_LE(seen.drawn / once, most) << style.name << ", " << seen.frames << " frames";
  EXPECT_EQ(scene.pointsOnGl, atOnce.pointsOnGl) << style.name;
  EXPECT_EQ(differing(complete, seen.pictures.back()), 0) << style.name;
  EXPECT_LE(seen.off, mostOff) << style.name;
  double least = 1.0;
  for (const Picture& picture : seen.pictures)
  {
    least = std::min(least, coveredOf(complete, picture));
  }
  const bool means = stores.front()->hierarchy()->refinement() == Refinement::Replace;
  EXPECT_GE(least, means ? leastOfMeansCovered : leastCovered) << style.name;
  const std::string name = style.name + (growthStep > 0.0 ? "_growing" : "") +
    (stores.size() > 1 ? "_of_several" : "") + (means ? "_of_means" : "");
  testing::Test::RecordProperty(name + "_off", std::to_string(seen.off));
  testing::Test::RecordProperty(name + "_drawn", std::to_string(seen.drawn / once));
  testing::Test::RecordProperty(name + "_covered", std::to_string(least));
  testing::Test::RecordProperty(name + "_frames", std::to_string(seen.frames));
}

} // namespace

TEST(Refining, DrawsNothingTwice)
{
  for (const RefiningSplats& style : refiningSplats)
  {
    expectRefined({ townOf(100000) }, style, 0.0, style.most);
  }
}

/// As windows show it: what arrives grows (SMOOTH-6), in five frames. What grows is drawn each
/// time; what has grown is not.
TEST(Refining, DrawsWhatHasGrownOnce)
{
  for (const RefiningSplats& style : refiningSplats)
  {
    expectRefined({ townOf(100000) }, style, 0.05, 2.5);
  }
}

/// The coarse nodes that stand in for finer ones are no nodes of the complete view.
TEST(Refining, OfATreeOfMeansDrawsNothingTwice)
{
  for (const RefiningSplats& style : refiningSplats)
  {
    expectRefined({ meansOfTown(Structure::Octree) }, style, 0.0, style.most);
  }
}

/// A node may come after all nodes below it, which cover it: it hides nothing.
TEST(Refining, OfAKdTreeOfMeansDrawsNothingTwice)
{
  for (const RefiningSplats& style : refiningSplats)
  {
    if (style.name == "discs" || style.name == "spheres")
    {
      expectRefined({ meansOfTown(Structure::KdTree) }, style, 0.0, style.most);
    }
  }
}

/// The coarse nodes of a tree of means stand in for the points that make its mask, too.
TEST(Refining, ALensAroundAClassIsThereInEachFrame)
{
  const Result<StyleSheet> sheet = parseStyleSheet(refiningSplats[6].json);
  ASSERT_TRUE(sheet.ok()) << sheet.error().what;
  LoadingClouds scene({ meansOfTown(Structure::Octree) }, *sheet);
  const SeenFrames seen = refine(scene, false);
  const auto complete = double(magentaOf(seen.pictures.back()));
  EXPECT_GT(complete, 1000.0);
  double least = 1.0, most = 1.0;
  for (const Picture& picture : seen.pictures)
  {
    least = std::min(least, double(magentaOf(picture)) / complete);
    most = std::max(most, double(magentaOf(picture)) / complete);
  }
  EXPECT_GE(least, 0.15) << "the root's 27 means are a fifth of it";
  EXPECT_LE(most, 1.25);
  testing::Test::RecordProperty("least_of_the_lens", std::to_string(least));
  testing::Test::RecordProperty("most_of_the_lens", std::to_string(most));
}

/// All points of a node grow at a time.
TEST(Refining, OfATreeOfMeansDrawsWhatHasGrownOnce)
{
  expectRefined({ meansOfTown(Structure::Octree) }, refiningSplats[0], 0.05, 3.2);
}

/// Three clouds whose surfaces close, an actor each.
TEST(Refining, OfSeveralCloudsDrawsNothingTwice)
{
  for (const RefiningSplats& style : refiningSplats)
  {
    if (style.name == "discs" || style.name == "blended")
    {
      expectRefined(
        { townOf(100000), townOf(40000, 13), townOf(40000, 14) }, style, 0.0, style.most);
    }
  }
}
