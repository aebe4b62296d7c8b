// Pictures of several parts that several processes draw: lenses, translucent classes, highlights.

#include "MeetingOfProcesses.h"
#include "PlanOfPoints.h"
#include "SoftwareComposition.h"

#include "pointfront/Threads/ThreadCrew.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <random>
#include <thread>
#include <vector>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

constexpr int sideOfParts = 96;

/// A cloud of several nodes in styles of several places, drawn at random.
class RandomParts
{
public:
  explicit RandomParts(unsigned seed)
    : random_(seed)
  {
    scene.look({ 0.0, -2.6, 1.7 }, { 0.0, 0.0, 0.0 }, 0.8, sideOfParts, sideOfParts);
    scene.plan.batches.clear();
    const bool blended = chance();
    put(0)->technique = blended ? Technique::Ewa : Technique::Splats;
    put(0)->technique = Technique::Points;
    const auto inside = put(0.1);
    inside->lens = 0;
    inside->technique = blended && chance() ? Technique::Ewa : Technique::Splats;
    const auto mask = put(0);
    mask->lens = 0;
    mask->lensMask = true;
    mask->size = { SplatSize::Mode::World, 0.3, 0 };
    mask->orientation = SplatOrientation::View;
    const auto glass = put(-0.2);
    glass->group = 3;
    glass->opacity = 0.4;
    if (chance())
    {
      const auto within = put(0.3);
      within->lens = 0;
      within->group = 5;
      within->opacity = 0.6;
    }
    FrameShading& shading = scene.plan.shading;
    FrameLens lens;
    lens.shape = LensShape::AroundClass;
    shading.lenses = { lens };
    if (chance())
    {
      put(-0.1)->highlight = 1;
      shading.highlights = { { { 1.0f, 1.0f, 0.0f }, 2.0f, 0.3f } };
    }
    shading.eyeDomeStrength = chance() ? 0.3f : 0.0f;
    shading.fillHoles = chance();
  }

  /// Each node to one of the processes; some may have none.
  std::vector<FramePlan> pieces(std::size_t count)
  {
    std::vector<FramePlan> all(count, scene.plan);
    std::uniform_int_distribution<std::size_t> any(0, count - 1);
    for (FramePlan& one : all)
    {
      one.batches.clear();
      one.composited = true;
    }
    for (const DrawBatch& batch : scene.plan.batches)
    {
      for (const PlanItem& item : batch.items)
      {
        std::vector<DrawBatch>& batches = all[any(random_)].batches;
        if (batches.empty() || batches.back().style != batch.style)
        {
          batches.push_back({ batch.layer, batch.style, {} });
        }
        batches.back().items.push_back(item);
      }
    }
    return all;
  }

  PlanOfPoints scene;

private:
  bool chance() { return random_() % 2 == 1; }

  std::shared_ptr<ResolvedStyle> put(double above)
  {
    PlanOfPoints one;
    one.next = scene.next;
    for (int node = 0; node < 3; ++node)
    {
      std::vector<TestPoint> points = wavySurface(150, static_cast<unsigned>(random_()));
      for (TestPoint& point : points)
      {
        point.position.z += above;
      }
      one.add(points, 0.08);
    }
    scene.next = one.next;
    one.style->technique = Technique::Splats;
    scene.plan.batches.push_back(one.plan.batches[0]);
    return one.style;
  }

  std::mt19937 random_;
};

/// As a window draws it.
SoftwareTarget pictureOf(const FramePlan& plan)
{
  ThreadCrew crew(2);
  SoftwareRasteriser rasteriser(&crew);
  SoftwareComposition composition;
  SoftwareTarget target;
  target.keepDecided = plan.composited;
  composition.drawShown(rasteriser, plan, target);
  composition.finish(plan.camera, plan.shading, target, plan.exchange);
  return target;
}

} // namespace

// Whichever process has the points of a lens, of its mask or of a translucent class, each has the
// picture that one process draws.
TEST(SharedParts, PicturesOfAnyNumberOfProcessesAreThoseOfOne)
{
  for (unsigned seed = 1; seed <= 24; ++seed)
  {
    SCOPED_TRACE(seed);
    RandomParts parts(seed);
    const SoftwareTarget whole = [&]
    {
      SoftwareTarget target;
      target.reset(sideOfParts, sideOfParts);
      SoftwareRasteriser rasteriser;
      SoftwareComposition composition;
      composition.draw(rasteriser, parts.scene.plan, target);
      composition.finish(parts.scene.plan.camera, parts.scene.plan.shading, target);
      return target;
    }();
    const std::size_t count = 2 + seed % 3;
    std::vector<FramePlan> pieces = parts.pieces(count);
    std::vector<SoftwareTarget> pictures(count);
    MeetingOfProcesses meeting(static_cast<int>(count));
    std::vector<std::thread> processes;
    for (std::size_t i = 0; i < count; ++i)
    {
      processes.emplace_back(
        [&, i]
        {
          ProcessOfMeeting here(meeting);
          pieces[i].exchange = &here;
          pictures[i] = pictureOf(pieces[i]);
        });
    }
    for (std::thread& process : processes)
    {
      process.join();
    }
    for (const SoftwareTarget& picture : pictures)
    {
      EXPECT_EQ(picture.rgba, whole.rgba);
      EXPECT_EQ(picture.depth, whole.depth);
    }
  }
}
