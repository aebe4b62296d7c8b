// usage: pointfrontMotionBenchmark STORE [FRAMES [POINTS]]
//
// What of a moving picture is left where a frame has time for few points (SMOOTH-7), everything in
// memory. The view is complete at first (1 px), then POINTS points of the front are drawn a frame.
//   pan    0.06 and 4 pixels a frame
//   orbit  a third of a degree a frame around the middle
//   zoom   to a quarter of the distance
// Two ways: the front's points alone, and with what was visible before. Against the picture of all
// points of the same frame:
//   coverage  of the pixels that it covers, those that are covered, in percent: mean and least
//   error     mean difference of the pixels, grey levels: mean over the frames, and of the last one
//   change    from frame to frame, less that of all points: the largest

#include "SoftwareRasteriser.h"

#include "pointfront/Plan/FramePlanner.h"
#include "pointfront/Residency/LoadScheduler.h"
#include "pointfront/Store/PointStore.h"
#include "pointfront/Style/StyleSheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace pointfront;

constexpr int width = 800;
constexpr int height = 600;
constexpr double angle = 0.6;
constexpr double orbitStep = 3.14159265358979 / 540.0;

[[noreturn]] void fail(const std::string& why)
{
  std::fprintf(stderr, "%s\n", why.c_str());
  std::exit(1);
}

struct MovingStyle
{
  const char* name;
  Technique technique;
  bool blended;
  StyleSize size;
};
const MovingStyle movingStyles[] = {
  { "squares of 2 px", Technique::Points, false, { SplatSize::Mode::Pixels, 2.0, "" } },
  { "splats", Technique::Splats, false, {} },
  { "splats, blended", Technique::Splats, true, {} },
};

enum class Path
{
  SlowPan,
  Pan,
  Orbit,
  Zoom
};
const std::array<const char*, 4> pathNames{ "pan, 0.06 px", "pan, 4 px", "orbit", "zoom" };

enum class Way
{
  AllPoints,
  FrontAlone,
  WithKept
};

struct Shown
{
  std::vector<float> grey;
  std::vector<char> covered;
  std::uint64_t kept = 0;
};

/// One way through a path.
class Flight
{
public:
  Flight(const std::shared_ptr<const PointStore>& store, const MovingStyle& style, Way way,
    std::uint64_t points)
    : store_(store)
    , way_(way)
    , points_(points)
    , share_(store, store->hierarchy()->nodeCount(), LoadScheduler::ofProcess(),
        store->description().pointCount)
    , front_(std::make_shared<HierarchyPiece>(store->hierarchy(), 0, 1), share_,
        store->description().schema, std::make_shared<WindowDemand>())
  {
    StyleSheet sheet;
    sheet.standard.technique = style.technique;
    sheet.standard.blended = style.blended;
    sheet.standard.size = style.size;
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
    wanted_.complete = true;
  }

  Shown frame(const FrameCamera& camera, bool moving)
  {
    const bool few = moving && way_ != Way::AllPoints;
    wanted_.pointBudget = few ? points_ : 0;
    wanted_.view = View::fromMatrix(camera.storeToClip(), camera.width, camera.height);
    front_.update(wanted_);
    PlanRequest request = drawn_;
    request.camera = camera;
    request.keepsVisible = moving && way_ == Way::WithKept;
    const FramePlan plan = planFrame(front_, store_->description(), std::move(request));
    SoftwareTarget target;
    target.reset(width, height);
    Shown shown;
    shown.kept = rasteriser_.draw(plan, target).keptVisible;
    for (std::size_t i = 0; i < target.rgba.size(); ++i)
    {
      const std::uint32_t c = target.rgba[i];
      shown.grey.push_back(0.299f * static_cast<float>(c & 255u) +
        0.587f * static_cast<float>(c >> 8 & 255u) + 0.114f * static_cast<float>(c >> 16 & 255u));
      shown.covered.push_back(std::isfinite(target.depth[i]) ? 1 : 0);
    }
    return shown;
  }

private:
  std::shared_ptr<const PointStore> store_;
  Way way_;
  std::uint64_t points_;
  ResidencyShare share_;
  ViewFront front_;
  FrameRequest wanted_;
  PlanRequest drawn_; // without what differs from frame to frame
  SoftwareRasteriser rasteriser_;
};

double difference(const Shown& a, const Shown& b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.grey.size(); ++i)
  {
    sum += std::abs(a.grey[i] - b.grey[i]);
  }
  return sum / static_cast<double>(a.grey.size());
}

double coverage(const Shown& shown, const Shown& all)
{
  std::size_t covered = 0, wanted = 0;
  for (std::size_t i = 0; i < all.covered.size(); ++i)
  {
    wanted += all.covered[i] ? 1 : 0;
    covered += all.covered[i] && shown.covered[i] ? 1 : 0;
  }
  return wanted > 0 ? 100.0 * static_cast<double>(covered) / static_cast<double>(wanted) : 100.0;
}

FrameCamera cameraAt(const Bounds& box, Path path, int frame, int frames)
{
  const glm::dvec3 size = box.high - box.low;
  glm::dvec3 at = 0.5 * (box.low + box.high);
  double away = 0.25 * std::min(size.x, size.y) / std::tan(0.5 * angle);
  const double pixel = 2.0 * away * std::tan(0.5 * angle) / height;
  const double turned = path == Path::Orbit ? orbitStep * frame : 0.0;
  away *= path == Path::Zoom ? std::pow(0.25, double(frame) / frames) : 1.0;
  at.x += path == Path::SlowPan ? 0.06 * frame * pixel : 0.0;
  at.x += path == Path::Pan ? 4.0 * (frame - frames / 2) * pixel : 0.0;
  const glm::dvec3 eye(0.6 * away * std::sin(turned), -0.6 * away * std::cos(turned), 0.8 * away);
  return FrameCamera::perspective(
    at + eye, at, { 0, 0, 1 }, angle, 1e-3 * away, 10.0 * away, width, height);
}

/// The measures of one way through a path.
struct Measured
{
  double coverage = 0.0;
  double leastCoverage = 100.0;
  double error = 0.0;
  double lastError = 0.0;
  double change = 0.0;
};

void measure(const std::shared_ptr<const PointStore>& store, const MovingStyle& style, Path path,
  int frames, std::uint64_t points)
{
  std::array<std::unique_ptr<Flight>, 3> flights;
  for (const Way way : { Way::AllPoints, Way::FrontAlone, Way::WithKept })
  {
    flights[static_cast<std::size_t>(way)] = std::make_unique<Flight>(store, style, way, points);
  }
  std::array<Measured, 3> results;
  std::array<Shown, 3> before;
  std::uint64_t firstKept = 0, lastKept = 0;
  for (int frame = 0; frame <= frames; ++frame)
  {
    const FrameCamera camera = cameraAt(store->description().bounds, path, frame, frames);
    std::array<Shown, 3> now;
    for (std::size_t way = 0; way < now.size(); ++way)
    {
      now[way] = flights[way]->frame(camera, frame > 0);
      Measured& result = results[way];
      if (frame > 0)
      {
        const double covered = coverage(now[way], now[0]);
        result.coverage += covered / frames;
        result.leastCoverage = std::min(result.leastCoverage, covered);
        result.lastError = difference(now[way], now[0]);
        result.error += result.lastError / frames;
        result.change = std::max(
          result.change, difference(now[way], before[way]) - difference(now[0], before[0]));
      }
    }
    lastKept = now[2].kept;
    firstKept = frame == 1 ? lastKept : firstKept;
    before = std::move(now);
  }
  std::printf("| %s, %s |", style.name, pathNames[static_cast<std::size_t>(path)]);
  for (const std::size_t way : { std::size_t(1), std::size_t(2) })
  {
    const Measured& r = results[way];
    std::printf(" %.1f, %.1f | %.1f, %.1f | %.1f |", r.coverage, r.leastCoverage, r.error,
      r.lastError, r.change);
  }
  std::printf(" %llu, %llu |\n", static_cast<unsigned long long>(firstKept),
    static_cast<unsigned long long>(lastKept));
  std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv)
{
  if (argc < 2 || argc > 4)
  {
    fail("usage: pointfrontMotionBenchmark STORE [FRAMES [POINTS]]");
  }
  const Result<std::shared_ptr<const PointStore>> store = PointStore::open(argv[1]);
  if (!store)
  {
    fail(store.error().what);
  }
  const int frames = argc > 2 ? std::max(2, std::atoi(argv[2])) : 200;
  const std::uint64_t points = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 30000;
  std::printf("| technique, path | front alone: coverage | error | change | with what was visible: "
              "coverage | error | change | points kept |\n"
              "| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const MovingStyle& style : movingStyles)
  {
    for (const Path path : { Path::SlowPan, Path::Pan, Path::Orbit, Path::Zoom })
    {
      measure(*store, style, path, frames, points);
    }
  }
  return 0;
}
