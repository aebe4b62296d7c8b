// A view at rest in a window while its store is being loaded (SMOOTH-5): reader, mapper and actor
// as programs use them. The disk gives a few nodes a frame, so no frame depends on the machine.

#include "SlowView.h"
#include "Splats.h"

#include "pointfront/Generate/TerrainSource.h"
#include "pointfront/Tiles/StoredCloudFormats.h"

#include <vtkHardwareSelector.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <utility>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

/// Files that name a store, which they open as one on a slow disk.
class SlowFiles final : public StoredCloudFormat
{
public:
  std::string name() const override { return "slow (test)"; }
  bool accepts(const std::string& path) const override
  {
    return std::filesystem::path(path).extension() == ".slow";
  }
  Result<std::shared_ptr<const StoredCloud>> open(const std::string& path) const override
  {
    std::string name;
    std::getline(std::ifstream(path), name);
    last = std::make_shared<SlowStore>(openedStore(name));
    last->grant(SlowStore::allNodes); // until somebody holds it
    return std::shared_ptr<const StoredCloud>(last);
  }
  mutable std::shared_ptr<SlowStore> last; ///< that was opened
};

std::string slowFile(const std::string& store)
{
  std::ofstream(store + ".slow") << store << "\n";
  return store + ".slow";
}

struct SlowWindow : Splats
{
  static constexpr int mostFrames = 200;
  static constexpr int nodesAFrame = 4;

  SlowWindow(const std::string& store, const char* json)
    : Splats(slowFile(store))
  {
    const auto files = std::make_shared<SlowFiles>();
    StoredCloudFormats::ofProcess().add(files);
    reader->SetOverviewPoints(1); // more would be in memory
    reader->Update();
    disk = files->last;
    disk->hold();
    renderer->ResetCamera();
    EXPECT_TRUE(style->LoadJSON(json));
    mapper->SetTargetError(0.5);
    mapper->CompleteOff();
    mapper->SetGrowthTime(0.0);
  }
  ~SlowWindow() { disk->grant(SlowStore::allNodes); } // no read waits for ever
  SlowWindow(const SlowWindow&) = delete;
  SlowWindow& operator=(const SlowWindow&) = delete;

  /// Draws until all is there. `selects`: frames after each of which a selection is made.
  void load(int selects)
  {
    window->Start(); // there is a context before the first frame
    do
    {
      disk->grant(frames == 0 ? 1 : nodesAFrame);
      drawn += primitivesOf(*this);
      ++frames;
      gained += mapper->GetLastPointsDrawn() > points;
      points = mapper->GetLastPointsDrawn();
      frames <= selects ? select() : void();
      waitForNews();
    } while (!mapper->GetLastComplete() && frames < mostFrames);
  }

  std::shared_ptr<SlowStore> disk;
  double drawn = 0.0; ///< points and triangles, of all frames together, selections left out
  int frames = 0;
  int gained = 0; ///< frames that had more points than the one before
  vtkIdType points = 0; ///< those of the last frame
  int fewestFound = 1 << 30; ///< pixels in which a selection found a point

private:
  void select()
  {
    vtkNew<vtkHardwareSelector> selector;
    const auto width = static_cast<unsigned>(window->GetSize()[0]);
    const auto height = static_cast<unsigned>(window->GetSize()[1]);
    selector->SetRenderer(renderer);
    selector->SetArea(0, 0, width - 1, height - 1);
    selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_POINTS);
    EXPECT_TRUE(selector->CaptureBuffers());
    int found = 0;
    for (unsigned pixel = 0; pixel < width * height; ++pixel)
    {
      const unsigned place[2] = { pixel % width, pixel / width };
      found += selector->GetPixelInformation(place).Valid ? 1 : 0;
    }
    fewestFound = std::min(fewestFound, found);
  }
  void waitForNews()
  {
    for (int waits = 0; waits < 2000 && !mapper->GetLastComplete() && !mapper->NeedsRender();
         ++waits)
    {
      std::this_thread::sleep_for(std::chrono::microseconds(500));
      if (waits % 16 == 15 && disk->isUsedUp()) // the arrivals were of no use for the picture
      {
        disk->grant(nodesAFrame);
      }
    }
  }
};

constexpr double once = 1.1; ///< times the points of the complete picture

/// 100,000 points of a town. `replaces`: children take their parents' places.
std::string townIn(Structure structure, bool replaces)
{
  BuildOptions options = nodesOf(500);
  options.refinement = replaces ? Refinement::Replace : Refinement::Add;
  options.structure = structure;
  const std::string name = std::string("window-") +
    (structure == Structure::KdTree ? "kdtree" : "octree") + (replaces ? "-means" : "");
  return builtStore(name, std::make_unique<TerrainSource>(100000, 11), options);
}

/// `selects`: as SlowWindow::load's.
void expectDrawnOnce(Structure structure, bool replaces, const char* technique, int selects = 0)
{
  const std::string what = std::string(technique) + (replaces ? ", means" : "") +
    (structure == Structure::KdTree ? ", kd-tree" : "");
  const std::string store = townIn(structure, replaces);
  const char* const json = techniques.at(technique).c_str();
  SlowWindow scene(store, json);
  scene.load(selects);
  EXPECT_TRUE(scene.mapper->GetLastComplete()) << what;
  EXPECT_GE(scene.gained, 3) << what;
  EXPECT_LE(scene.drawn, once * static_cast<double>(scene.points))
    << what << ", " << scene.frames << " frames, " << scene.gained << " with more points";
  if (selects > 0)
  {
    EXPECT_GT(scene.fewestFound, 1000) << what;
  }
  testing::Test::RecordProperty(
    technique, std::to_string(scene.drawn / static_cast<double>(scene.points)));
  const Picture last = scene.read();
  Splats whole(store);
  whole.renderer->ResetCamera();
  ASSERT_TRUE(whole.style->LoadJSON(json));
  whole.mapper->SetTargetError(0.5);
  EXPECT_EQ(differing(whole.draw(), last), 0) << what;
}

TEST(RefiningWindow, DrawsNothingTwice)
{
  expectDrawnOnce(Structure::Octree, false, "splats");
}

/// The coarse nodes that stand in for finer ones are no nodes of the complete view.
TEST(RefiningWindow, OfATreeOfMeansDrawsNothingTwice)
{
  expectDrawnOnce(Structure::Octree, true, "splats");
  expectDrawnOnce(Structure::Octree, true, "discs");
  expectDrawnOnce(Structure::KdTree, true, "splats");
}

/// A selection has no stand-ins, and in a tree of means nodes and sizes of its own.
TEST(RefiningWindow, GoesOnAfterSelections)
{
  expectDrawnOnce(Structure::Octree, false, "splats", 8);
  expectDrawnOnce(Structure::Octree, true, "splats", 8);
}

} // namespace
