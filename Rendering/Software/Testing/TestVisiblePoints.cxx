#include "KeptPoints.h"
#include "PlanOfPoints.h"
#include "SoftwareComposition.h"

#include "pointfront/Threads/ThreadCrew.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

constexpr int panWidth = 320;
constexpr int panHeight = 200;
constexpr double distance = 3.0;
constexpr double angle = 0.35;

/// A pixel's size at the surface.
double pixel()
{
  return 2.0 * distance * std::tan(0.5 * angle) / panHeight;
}

/// A surface seen from above, that fills the picture; the camera pans over it.
class PanOverSurface : public PlanOfPoints
{
public:
  PanOverSurface()
  {
    style->technique = Technique::Splats;
    style->size = { SplatSize::Mode::Spacing, 1.0, 0 };
    const std::vector<TestPoint> points = wavySurface(150000, 5);
    all = static_cast<std::uint32_t>(points.size());
    add(points, 0.014);
    pan(0.0);
  }

  void pan(double pixels)
  {
    const glm::dvec3 at(pixels * pixel(), 0.0, 0.0);
    plan.camera = FrameCamera::perspective(at + glm::dvec3(0.0, 0.0, distance), at,
      { 0.0, 1.0, 0.0 }, angle, 0.01, 100.0, panWidth, panHeight);
  }
  void draw(double share, bool keeps, SoftwareRasteriser& with)
  {
    plan.batches[0].items[0].last = static_cast<std::uint32_t>(share * all);
    plan.keepsVisible = keeps;
    target.reset(panWidth, panHeight);
    statistics = with.draw(plan, target);
  }
  /// The share of the first columns of pixels in which something was drawn.
  static double coverage(const SoftwareTarget& picture, int columns)
  {
    int covered = 0;
    for (int y = 0; y < panHeight; ++y)
    {
      for (int x = 0; x < columns; ++x)
      {
        covered += std::isfinite(picture.depth[static_cast<std::size_t>(y * panWidth + x)]);
      }
    }
    return static_cast<double>(covered) / (panHeight * columns);
  }

  std::uint32_t all = 0;
  SoftwareTarget target;
  RasterStatistics statistics;
};

} // namespace

/// SMOOTH-7
TEST(VisiblePoints, APanOfTenPixelsKeepsTheCoverage)
{
  PanOverSurface scene;
  SoftwareRasteriser rasteriser;
  scene.draw(1.0, true, rasteriser);
  const double before = PanOverSurface::coverage(scene.target, panWidth);
  EXPECT_GT(before, 0.99);
  EXPECT_EQ(scene.statistics.keptVisible, 0u); // nothing was seen before

  scene.pan(10.0);
  SoftwareRasteriser fresh;
  scene.draw(0.05, true, fresh);
  EXPECT_LT(PanOverSurface::coverage(scene.target, panWidth - 10), 0.6);
  scene.draw(0.05, true, rasteriser);
  EXPECT_GE(PanOverSurface::coverage(scene.target, panWidth - 10), 0.99 * before);
  EXPECT_GT(scene.statistics.keptVisible, 0u);
  EXPECT_LE(scene.statistics.keptVisible, std::uint64_t(panWidth) * panHeight);
}

TEST(VisiblePoints, AreKeptFromFrameToFrame)
{
  PanOverSurface scene;
  SoftwareRasteriser rasteriser;
  scene.draw(1.0, true, rasteriser);
  for (int frame = 1; frame <= 20; ++frame)
  {
    scene.pan(frame);
    scene.draw(0.05, true, rasteriser);
  }
  EXPECT_GE(PanOverSurface::coverage(scene.target, panWidth - 20), 0.97);
}

/// Who is hidden for a frame, by another point of its pixel, is there in the next one: what was
/// captured lives as long as the motion.
TEST(VisiblePoints, LastAsLongAsTheMotion)
{
  PanOverSurface scene;
  SoftwareRasteriser rasteriser;
  scene.draw(1.0, true, rasteriser);
  const double before = PanOverSurface::coverage(scene.target, panWidth);
  std::uint64_t first = 0;
  for (int frame = 1; frame <= 60; ++frame)
  {
    scene.pan(0.06 * frame);
    scene.draw(0.05, true, rasteriser);
    first = frame == 1 ? scene.statistics.keptVisible : first;
    ASSERT_GE(scene.statistics.keptVisible, first) << frame;
  }
  EXPECT_GE(PanOverSurface::coverage(scene.target, panWidth - 4), 0.99 * before);
  scene.pan(0.06 * 61);
  scene.draw(1.0, false, rasteriser); // the motion ends
  scene.draw(0.05, true, rasteriser);
  EXPECT_EQ(scene.statistics.keptVisible, 0u);
}

/// A lens shows the surface in a style of its own, and keeps what was visible in it: its picture is
/// as large as the lens.
TEST(VisiblePoints, InsideOfALensTheyLastAsLong)
{
  PanOverSurface scene;
  auto inside = std::make_shared<ResolvedStyle>(*scene.style);
  inside->lens = 0;
  FrameLens lens;
  lens.shape = LensShape::Rectangle;
  lens.centrePx = { 160.0f, 100.0f };
  lens.halfSizePx = { 60.0f, 50.0f };
  scene.plan.shading.lenses = { lens };
  scene.plan.batches.push_back(scene.plan.batches[0]);
  scene.plan.batches[1].style = inside;
  SoftwareRasteriser rasteriser;
  SoftwareComposition composition;
  const auto draw = [&](double share)
  {
    for (DrawBatch& batch : scene.plan.batches)
    {
      batch.items[0].last = static_cast<std::uint32_t>(share * scene.all);
    }
    scene.target.reset(panWidth, panHeight);
    scene.statistics = composition.draw(rasteriser, scene.plan, scene.target);
    composition.finish(scene.plan.camera, scene.plan.shading, scene.target);
    int covered = 0;
    for (int y = 52; y < 148; ++y)
    {
      for (int x = 102; x < 218; ++x)
      {
        covered += std::isfinite(scene.target.depth[static_cast<std::size_t>(y * panWidth + x)]);
      }
    }
    return covered / (96.0 * 116.0);
  };
  scene.plan.keepsVisible = true;
  const double before = draw(1.0);
  EXPECT_GT(before, 0.99);
  for (int frame = 1; frame <= 20; ++frame)
  {
    scene.pan(0.06 * frame);
    EXPECT_GT(draw(0.05), 0.97 * before) << frame;
  }
  // A lens that moves away shows what the plan has, and what was visible there outside of it.
  const std::uint64_t kept = scene.statistics.keptVisible;
  scene.plan.batches.pop_back();
  scene.pan(2.0);
  draw(0.05);
  EXPECT_LT(scene.statistics.keptVisible, kept) << "of the inside nothing is kept any more";
  scene.plan.keepsVisible = false;
  EXPECT_LT(draw(0.05), 0.6);
}

/// Points that the camera turned away from are there when it comes back, and those that a plan drew
/// in between when it no longer does.
TEST(VisiblePoints, ComeBack)
{
  PanOverSurface scene;
  SoftwareRasteriser rasteriser;
  scene.draw(1.0, true, rasteriser);
  const double before = PanOverSurface::coverage(scene.target, panWidth);
  for (const double pixels : { 60.0, 120.0, 60.0, 0.5 })
  {
    scene.pan(pixels);
    scene.draw(pixels == 120.0 ? 0.4 : 0.05, true, rasteriser);
  }
  EXPECT_GE(PanOverSurface::coverage(scene.target, panWidth), 0.98 * before);
}

/// A plan of a frame in which others have the whole budget says nothing of what was visible.
TEST(VisiblePoints, OutliveAnEmptyPlan)
{
  PanOverSurface scene;
  SoftwareRasteriser rasteriser;
  scene.draw(1.0, true, rasteriser);
  const double before = PanOverSurface::coverage(scene.target, panWidth);
  scene.pan(5.0);
  FramePlan nothing = scene.plan;
  nothing.batches.clear();
  nothing.keepsVisible = true;
  scene.target.reset(panWidth, panHeight);
  rasteriser.draw(nothing, scene.target);
  EXPECT_EQ(PanOverSurface::coverage(scene.target, panWidth), 0.0);
  scene.pan(10.0);
  scene.draw(0.05, true, rasteriser);
  EXPECT_GE(PanOverSurface::coverage(scene.target, panWidth - 10), 0.99 * before);
}

TEST(VisiblePoints, AreNoMoreThanPixels)
{
  PanOverSurface scene;
  SoftwareRasteriser rasteriser;
  scene.draw(1.0, true, rasteriser);
  const double before = PanOverSurface::coverage(scene.target, panWidth);
  constexpr std::uint64_t pixels = std::uint64_t(panWidth) * panHeight;
  std::uint64_t most = 0;
  for (int frame = 0; frame <= 40; ++frame)
  {
    scene.pan(1.3 * (frame % 10));
    scene.draw(frame % 2 ? 0.05 : 1.0, true, rasteriser);
    most = std::max(most, scene.statistics.keptVisible);
    ASSERT_LE(scene.statistics.keptVisible, pixels) << frame;
    EXPECT_GE(PanOverSurface::coverage(scene.target, panWidth), 0.98 * before) << frame;
  }
  EXPECT_GT(most, pixels / 2);
}

/// Beyond a number of points those go that were not seen for the longest time.
TEST(KeptPoints, GoWhenTheyAreTooMany)
{
  PlanOfPoints scene;
  const PlanItem& drawn = scene.add(wavySurface(100, 3));
  const auto points = [&](std::uint32_t first, std::uint32_t last)
  {
    std::vector<VisiblePoint> visible;
    for (std::uint32_t point = first; point < last; ++point)
    {
      visible.push_back({ point, point, drawn.node.get() });
    }
    return visible;
  };
  KeptNodes nodes;
  nodes[0].add(points(20, 60), PlanItem(), 1);
  nodes[0].add(points(0, 40), PlanItem(), 2); // 20 of them are there
  nodes[1].add(points(0, 20), PlanItem(), 3);
  EXPECT_EQ(nodes[0].indices().size(), 60u);
  EXPECT_EQ(nodes[0].columns()->positions[30], drawn.node->positions[30]);
  nodes[0].sawPoint(50, 3);
  bound(nodes, 80);
  EXPECT_EQ(nodes[0].indices().size(), 60u);
  bound(nodes, 48); // 42 stay: 21 of frame 3, 20 of frame 2, one of frame 1
  EXPECT_EQ(nodes[1].indices().size(), 20u);
  std::vector<std::uint32_t> expected(21);
  std::iota(expected.begin(), expected.end(), 0u);
  expected.push_back(50);
  EXPECT_EQ(nodes[0].indices(), expected);
  EXPECT_EQ(nodes[0].columns()->positions.back(), drawn.node->positions[50]);
  nodes[0].setPlanned(10);
  EXPECT_EQ(nodes[0].item().first, 10u);
  EXPECT_EQ(nodes[0].item().last, 22u);
  bound(nodes, 8); // 7 of frame 3
  EXPECT_EQ(nodes.count(0) + nodes.count(1), 2u);
  EXPECT_EQ(nodes[0].indices().size() + nodes[1].indices().size(), 7u);
}

TEST(VisiblePoints, ACompletePictureShowsWhatItsPlanSays)
{
  PanOverSurface scene;
  SoftwareRasteriser rasteriser;
  scene.draw(1.0, true, rasteriser);
  scene.pan(10.0);
  scene.draw(0.05, true, rasteriser);
  scene.draw(0.3, true, rasteriser); // at rest, while more is loaded
  EXPECT_GT(scene.statistics.keptVisible, 0u);
  EXPECT_GT(scene.statistics.reused, 0u); // it goes on from the last picture
  scene.draw(0.3, false, rasteriser);
  EXPECT_EQ(scene.statistics.keptVisible, 0u);
  const SoftwareTarget shown = scene.target;
  SoftwareRasteriser fresh;
  scene.draw(0.3, false, fresh);
  EXPECT_EQ(shown.rgba, scene.target.rgba);
  EXPECT_EQ(shown.depth, scene.target.depth);
}

TEST(VisiblePoints, AreTheSameForAnyNumberOfThreads)
{
  PictureValues<std::uint32_t> first;
  for (const unsigned threads : { 1u, 2u, 7u })
  {
    PanOverSurface scene;
    ThreadCrew crew(threads);
    SoftwareRasteriser rasteriser(&crew);
    for (int frame = 0; frame < 4; ++frame)
    {
      scene.pan(3.3 * frame);
      scene.draw(frame == 0 ? 1.0 : 0.1, true, rasteriser);
    }
    first = first.empty() ? scene.target.rgba : first;
    EXPECT_EQ(scene.target.rgba, first) << threads;
  }
}

TEST(VisiblePoints, FollowStylesAndClipping)
{
  PanOverSurface scene;
  SoftwareRasteriser rasteriser;
  scene.draw(1.0, true, rasteriser);
  scene.pan(10.0);
  scene.plan.clippingPlanes = { { 0.0, 1.0, 0.0, 0.0 } };
  scene.draw(0.05, true, rasteriser);
  EXPECT_GT(scene.statistics.keptVisible, 0u);
  for (int x = 0; x < panWidth; ++x)
  {
    EXPECT_FALSE(std::isfinite(scene.target.depth[static_cast<std::size_t>(x)])); // lowest row
  }
  scene.plan.clippingPlanes.clear();
  scene.pan(0.0);
  scene.draw(1.0, true, rasteriser);
  scene.pan(10.0);
  auto other = std::make_shared<ResolvedStyle>(*scene.style);
  other->technique = Technique::Spheres;
  scene.plan.batches[0].style = other;
  scene.draw(0.05, true, rasteriser);
  EXPECT_EQ(scene.statistics.keptVisible, 0u); // another style is another picture
}

TEST(VisiblePoints, OfNodesThatAreGoneStay)
{
  PanOverSurface scene;
  scene.add(wavySurface(2000, 9), 0.01);
  SoftwareRasteriser rasteriser;
  scene.draw(1.0, true, rasteriser);
  const double before = PanOverSurface::coverage(scene.target, panWidth);
  scene.pan(10.0);
  scene.plan.batches[0].items.erase(scene.plan.batches[0].items.begin());
  scene.plan.keepsVisible = true;
  scene.target.reset(panWidth, panHeight);
  rasteriser.draw(scene.plan, scene.target);
  EXPECT_GE(PanOverSurface::coverage(scene.target, panWidth - 10), 0.99 * before);
  SoftwareTarget picked; // who is in a pixel is said of what the plan draws only
  picked.keepPoints = true;
  picked.reset(panWidth, panHeight);
  EXPECT_EQ(rasteriser.draw(scene.plan, picked).keptVisible, 0u);
}

/// Each of several stores in one window keeps what was visible of it, though there is no memory for
/// the keys of all.
TEST(VisiblePoints, OfSeveralStoresAreKept)
{
  // One has to do without its keys.
  const int stores = 1 + SoftwareRasteriser::keptPictures(std::int64_t(panWidth) * panHeight);
  PanOverSurface scene;
  SoftwareRasteriser together;
  SoftwareTarget window;
  SoftwareRasteriser alone;
  for (int frame = 0; frame < 4; ++frame)
  {
    scene.pan(5.0 * frame);
    scene.draw(frame == 0 ? 1.0 : 0.05, true, alone);
    const std::uint64_t kept = scene.statistics.keptVisible;
    EXPECT_EQ(kept > 0, frame > 0);
    window.reset(panWidth, panHeight);
    for (std::uint16_t store = 0; store < stores; ++store)
    {
      EXPECT_EQ(together.draw(scene.plan, window, store).keptVisible, kept) << frame << store;
    }
    EXPECT_EQ(window.rgba, scene.target.rgba); // they are all the same
  }
}

/// Stores that show in a part of the window each go on from their own last pictures.
TEST(VisiblePoints, StoresBesideEachOtherDrawNothingTwice)
{
  PanOverSurface scene;
  const double shift = 0.25 * panWidth * pixel();
  SoftwareRasteriser together;
  for (const double share : { 0.2, 1.0 })
  {
    SoftwareTarget window;
    window.reset(panWidth, panHeight);
    for (const int side : { -1, 1 })
    {
      FramePlan plan = scene.plan;
      plan.batches[0].items[0].last = static_cast<std::uint32_t>(share * scene.all);
      plan.grid.offset.x = 4.0 * side * shift;
      const RasterStatistics drawn =
        together.draw(plan, window, static_cast<std::uint16_t>(side + 1));
      EXPECT_EQ(drawn.reused, share < 1.0 ? 0u : static_cast<std::uint64_t>(0.2 * scene.all));
    }
  }
}
