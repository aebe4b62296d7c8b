// Scenes that load node by node, and what their frames drew: for Testing/Whole/random_loading.py.
// usage: pointfrontLoadingScenes < SCENES
// A scene is a line: the file of its style, error in pixels, seconds from a frame to the next (0:
// nothing grows), position, focal point and view up, an angle in degrees (0: parallel rays), half
// of the height, and the stores. The answer is a line of `name=value`, or `refused: WHY`.

#include "LoadingClouds.h"
#include "StyleJSON.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <exception>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

constexpr int mostFrames = 5000;

struct LoadingScene
{
  StyleSheet sheet;
  double errorPx = 1.0;
  double growthStep = 0.0;
  FrameCamera camera;
  std::vector<std::shared_ptr<const PointStore>> stores;
};

/// Near and far planes as all points of the stores need them.
FrameCamera cameraOf(std::istream& words, const LoadingScene& scene)
{
  glm::dvec3 eye, at, up;
  double degrees = 0.0, halfHeight = 0.0;
  for (glm::dvec3* place : { &eye, &at, &up })
  {
    words >> place->x >> place->y >> place->z;
  }
  words >> degrees >> halfHeight;
  double farthest = 1.0;
  for (const auto& store : scene.stores)
  {
    const Bounds& box = store->description().bounds;
    farthest = std::max(
      farthest, glm::distance(eye, 0.5 * (box.low + box.high)) + glm::distance(box.low, box.high));
  }
  const double nearest = 1e-4 * farthest;
  return degrees > 0.0 ? FrameCamera::perspective(eye, at, up, glm::radians(degrees), nearest,
                           farthest, SlowView::width, SlowView::height)
                       : FrameCamera::parallelView(eye, at, up, halfHeight, nearest, farthest,
                           SlowView::width, SlowView::height);
}

std::unique_ptr<LoadingClouds> cloudsOf(const LoadingScene& scene)
{
  auto clouds = std::make_unique<LoadingClouds>(scene.stores, scene.sheet);
  clouds->setCamera(scene.camera);
  for (std::size_t number = 0; number < clouds->size(); ++number)
  {
    clouds->view(number).growthStep = scene.growthStep;
    clouds->view(number).frameRequest.targetErrorPx = scene.errorPx;
  }
  return clouds;
}

std::string answerTo(const LoadingScene& scene)
{
  for (const auto& store : scene.stores)
  {
    if (const auto layers = scene.sheet.resolveAll(store->description()); !layers)
    {
      return "refused: " + layers.error().what;
    }
  }
  const auto atOnce = cloudsOf(scene);
  const LoadingCounts once = atOnce->frame(true); // the tables' rows are there then
  const auto clouds = cloudsOf(scene);
  LoadingCounts all, last;
  int frames = 0;
  do
  {
    clouds->waitForNews();
    last = clouds->frame();
    all.drawn += last.drawn;
    all.blended += last.blended;
    all.onGl += last.onGl;
  } while (++frames < mostFrames && !clouds->isComplete());
  const SoftwareTarget& mine = clouds->software;
  std::size_t differs = 0;
  for (std::size_t pixel = 0; pixel < mine.rgba.size(); ++pixel)
  {
    differs += mine.rgba[pixel] != atOnce->software.rgba[pixel] ||
      mine.depth[pixel] != atOnce->software.depth[pixel];
  }
  const Picture picture = clouds->picture();
  std::ostringstream said;
  said << "frames=" << frames << " complete=" << clouds->isComplete() << " points=" << once.points
       << " drawn=" << all.drawn << " once=" << once.drawn << " blended=" << all.blended
       << " blended_once=" << once.blended << " gl=" << all.onGl << " gl_once=" << once.onGl
       << " differs=" << differs << " gl_differs=" << differing(atOnce->picture(), picture)
       << " lit=" << picture.lit() << " off=" << clouds->offSoftware();
  return said.str();
}

} // namespace

int main()
{
  std::map<std::string, std::shared_ptr<const PointStore>> opened;
  for (std::string line; std::getline(std::cin, line);)
  {
    std::istringstream words(line);
    LoadingScene scene;
    std::string style;
    words >> style >> scene.errorPx >> scene.growthStep;
    const auto begin = words.tellg();
    for (int number = 0; number < 11; ++number)
    {
      double skipped = 0.0;
      words >> skipped;
    }
    for (std::string path; words >> path;)
    {
      auto& store = opened[path];
      store = store ? store : openedStore(path);
      scene.stores.push_back(store);
    }
    words.clear();
    words.seekg(begin);
    std::ifstream file(style);
    const std::string json{ std::istreambuf_iterator<char>(file), {} };
    Result<StyleSheet> sheet = parseStyleSheet(json);
    if (!sheet || scene.stores.empty() || !scene.stores.front())
    {
      std::cout << "refused: " << (sheet ? "no store" : sheet.error().what) << std::endl;
      continue;
    }
    scene.sheet = *sheet;
    scene.camera = cameraOf(words, scene);
    std::cout << answerTo(scene) << std::endl;
  }
  return 0;
}
