// usage: pointfrontFlickerBenchmark STORE [FRAMES]
//
// What of a moving picture is due to its levels of detail, frame by frame, everything in memory.
//   zoom   to a quarter of the distance; pan: 4 pixels a frame
//   sweep  the camera stands still while the error falls to a quarter; splats stay as large as at
//          the beginning, so that nothing changes but the detail
//   step   the error falls to a quarter in one frame, as where motion ends or nodes arrive
// Three ways to go from level to level: nodes that pop up whole, when half of their points are
// wanted; prefixes whose points pop up one by one; prefixes that grow. Of each pair of frames the
// mean difference (grey levels), less that of the pictures with all points in the same pair: the
// mean over the path and the largest; the root of the mean square, less that of all points; and the
// share of pixels that change by more than 24 levels where those with all points do not.
// Time is the frame's number / 30 s.

#include "SoftwareRasteriser.h"

#include "pointfront/Plan/FramePlanner.h"
#include "pointfront/Residency/LoadScheduler.h"
#include "pointfront/Store/PointStore.h"
#include "pointfront/Style/QualityPreset.h"
#include "pointfront/Style/StyleSheet.h"
#include "pointfront/Threads/ThreadCrew.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace
{

using namespace pointfront;

constexpr int width = 800;
constexpr int height = 600;
constexpr double angle = 0.6;
constexpr double framesASecond = 30.0;
constexpr double growthSeconds = 0.25;
constexpr double allPointsPx = 0.05;
constexpr int jump = 24; // grey levels

enum class Path
{
  Zoom,
  Pan,
  Sweep,
  Step
};
const std::array<const char*, 4> pathNames{ "zoom", "pan", "sweep", "step" };

enum class Way
{
  AllPoints,
  Nodes,
  Prefixes,
  Growing
};
const std::array<const char*, 4> wayNames{ "all points", "nodes pop up", "points pop up",
  "points grow" };

[[noreturn]] void fail(const std::string& why)
{
  std::fprintf(stderr, "%s\n", why.c_str());
  std::exit(1);
}

struct DrawnWay
{
  const char* name;
  const char* quality;
  double errorPx;
};
const DrawnWay techniques[] = { { "paraboloids or ellipses, opaque, 4 px", "draft", 4.0 },
  { "the same, 2 px (draft)", "draft", 2.0 }, { "blended, 4 px", "balanced", 4.0 },
  { "blended, 2 px", "balanced", 2.0 }, { "blended, 1 px (balanced)", "balanced", 1.0 } };

/// One way through a path.
class Flight
{
public:
  Flight(const std::shared_ptr<const PointStore>& store, const DrawnWay& technique, Way way)
    : store_(store)
    , way_(way)
    , share_(store, store->hierarchy()->nodeCount(), LoadScheduler::ofProcess(),
        store->description().pointCount)
    , front_(std::make_shared<HierarchyPiece>(store->hierarchy(), 0, 1), share_,
        store->description().schema, std::make_shared<WindowDemand>())
  {
    StyleSheet sheet;
    qualityPresetOf(technique.quality)->applyTo(sheet.standard);
    const auto layers = sheet.resolveAll(store->description());
    if (!layers)
    {
      fail(layers.error().what);
    }
    for (const LayerStyling& layer : *layers)
    {
      drawn_.styles.push_back(layer.styles.front());
      wanted_.columns.layers.push_back(layer.columns());
    }
    errorPx_ = technique.errorPx;
    wanted_.complete = true;
  }

  /// The grey picture of the next frame; `seconds` of drawing are added.
  std::vector<float> frame(const FrameCamera& camera, int number, double times, bool fixedSizes)
  {
    wanted_.targetErrorPx = way_ == Way::AllPoints ? allPointsPx : times * errorPx_;
    wanted_.view = View::fromMatrix(camera.storeToClip(), camera.width, camera.height);
    front_.update(wanted_);
    PlanRequest request = drawn_;
    request.camera = camera;
    request.growth = way_ == Way::Growing ? &growth_ : nullptr;
    request.moment = { number / framesASecond, growthSeconds, true };
    FramePlan plan = planFrame(front_, store_->description(), std::move(request));
    if (way_ == Way::Nodes)
    {
      popUp(plan);
    }
    if (fixedSizes)
    {
      fixSizes(plan, static_cast<float>(4.0 * errorPx_));
    }
    points += plan.pointCount();
    SoftwareTarget target;
    target.reset(width, height);
    milliseconds += rasteriser_.draw(plan, target).milliseconds;
    std::vector<float> grey(target.rgba.size());
    for (std::size_t i = 0; i < grey.size(); ++i)
    {
      const std::uint32_t c = target.rgba[i];
      grey[i] = 0.299f * static_cast<float>(c & 255u) + 0.587f * static_cast<float>(c >> 8 & 255u) +
        0.114f * static_cast<float>(c >> 16 & 255u);
    }
    return grey;
  }

  std::uint64_t points = 0;
  double milliseconds = 0.0;

private:
  static void popUp(FramePlan& plan)
  {
    for (DrawBatch& batch : plan.batches)
    {
      for (PlanItem& item : batch.items)
      {
        const auto all = static_cast<std::uint32_t>(item.node->size());
        item.last = 2 * item.last >= all || item.node->parent == noNode ? all : 0;
      }
      batch.items.erase(std::remove_if(batch.items.begin(), batch.items.end(),
                          [](const PlanItem& item) { return item.last == 0; }),
        batch.items.end());
    }
  }

  static void fixSizes(FramePlan& plan, float spacingPx)
  {
    plan.spacingPx = spacingPx;
    for (DrawBatch& batch : plan.batches)
    {
      for (PlanItem& item : batch.items)
      {
        item.closingRadius = 0.0f;
        item.sparsestRadius = 0.0f;
        item.unfinished = true;
        item.refined = true;
      }
    }
  }

  std::shared_ptr<const PointStore> store_;
  Way way_;
  double errorPx_ = 1.0;
  ResidencyShare share_;
  ViewFront front_;
  FrameRequest wanted_;
  PlanRequest drawn_; // without what differs from frame to frame
  DetailGrowth growth_;
  SoftwareRasteriser rasteriser_;
};

struct Flicker
{
  double sum = 0.0;
  double largest = 0.0;
  double jumps = 0.0;
  double squares = 0.0;
};

/// Adds two frames that follow each other: how much more changes than with all points.
void add(Flicker& flicker, const std::vector<float>& before, const std::vector<float>& now,
  const std::vector<float>& allBefore, const std::vector<float>& all)
{
  double difference = 0.0, squares = 0.0;
  std::size_t jumps = 0;
  for (std::size_t i = 0; i < now.size(); ++i)
  {
    const float mine = std::abs(now[i] - before[i]), other = std::abs(all[i] - allBefore[i]);
    difference += double(mine) - other;
    jumps += mine > jump && other <= jump;
    squares += double(mine) * mine - double(other) * other;
  }
  difference /= static_cast<double>(now.size());
  flicker.sum += difference;
  flicker.squares += squares / static_cast<double>(now.size());
  flicker.largest = std::max(flicker.largest, difference);
  flicker.jumps += 100.0 * static_cast<double>(jumps) / static_cast<double>(now.size());
}

FrameCamera cameraAt(const Bounds& box, Path path, int frame, int frames)
{
  const glm::dvec3 size = box.high - box.low;
  glm::dvec3 at = 0.5 * (box.low + box.high);
  const double across = std::min(size.x, size.y);
  double away = 0.5 * across / std::tan(0.5 * angle);
  if (path == Path::Zoom)
  {
    away *= std::pow(0.25, double(frame) / frames);
  }
  else
  {
    away *= 0.5;
    const double pixel = 2.0 * away * std::tan(0.5 * angle) / height;
    at.x += path == Path::Pan ? 4.0 * (frame - frames / 2) * pixel : 0.0;
  }
  return FrameCamera::perspective(at + glm::dvec3(0.0, -0.3 * away, away), at, { 0, 1, 0 }, angle,
    1e-3 * away, 10.0 * away, width, height);
}

void measure(
  const std::shared_ptr<const PointStore>& store, const DrawnWay& technique, Path path, int frames)
{
  std::vector<std::unique_ptr<Flight>> flights;
  for (const Way way : { Way::AllPoints, Way::Nodes, Way::Prefixes, Way::Growing })
  {
    flights.push_back(std::make_unique<Flight>(store, technique, way));
  }
  std::array<Flicker, 4> flicker;
  std::array<std::vector<float>, 4> before;
  for (int frame = 0; frame < frames; ++frame)
  {
    const FrameCamera camera = cameraAt(store->description().bounds, path, frame, frames);
    const double times = path == Path::Sweep     ? std::pow(0.25, double(frame) / frames) * 4.0
      : path == Path::Step && frame < frames / 4 ? 4.0
                                                 : 1.0;
    std::array<std::vector<float>, 4> now;
    for (std::size_t way = 0; way < 4; ++way)
    {
      now[way] = flights[way]->frame(camera, frame, times, path == Path::Sweep);
      if (frame > 0 && way > 0)
      {
        add(flicker[way], before[way], now[way], before[0], now[0]);
      }
    }
    before = std::move(now);
  }
  const char* const pathName = pathNames[static_cast<std::size_t>(path)];
  std::printf("| %s, %s |", technique.name, pathName);
  for (std::size_t way = 1; way < 4; ++way)
  {
    std::printf(" %.2f; %.2f |", flicker[way].sum / (frames - 1), flicker[way].largest);
    std::fprintf(stderr,
      "%s, %s, %s: root of squares %.2f, jumps %.2f %% of pixels, %.0f thousand points, "
      "%.1f ms a frame\n",
      technique.name, pathName, wayNames[way],
      std::sqrt(std::max(0.0, flicker[way].squares / (frames - 1))),
      flicker[way].jumps / (frames - 1), 1e-3 * static_cast<double>(flights[way]->points) / frames,
      flights[way]->milliseconds / frames);
  }
  std::printf("\n");
  std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv)
{
  if (argc != 2 && argc != 3)
  {
    fail("usage: pointfrontFlickerBenchmark STORE [FRAMES]");
  }
  const Result<std::shared_ptr<const PointStore>> store = PointStore::open(argv[1]);
  if (!store)
  {
    fail(store.error().what);
  }
  const int frames = argc > 2 ? std::max(2, std::atoi(argv[2])) : 60;
  std::printf("| technique, path | %s | %s | %s |\n| --- | --- | --- | --- |\n", wayNames[1],
    wayNames[2], wayNames[3]);
  for (const DrawnWay& technique : techniques)
  {
    for (const Path path : { Path::Zoom, Path::Pan, Path::Sweep, Path::Step })
    {
      measure(*store, technique, path, frames);
    }
  }
  return 0;
}
