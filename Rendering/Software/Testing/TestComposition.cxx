// Lenses, translucent classes and highlights: pictures whose every pixel is known beforehand.

#include "PlanOfPoints.h"
#include "SoftwareComposition.h"

#include "pointfront/Threads/ThreadCrew.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

constexpr int size = 64;
using Bytes = std::array<int, 4>;
constexpr Bytes nothing{ 0, 0, 0, 0 };

/// Sheets that face the eye, each of one style; nearer than 1 are in front.
class Sheets
{
public:
  Sheets()
  {
    scene.plan.camera = FrameCamera::perspective(
      { 0.0, 0.0, 0.0 }, { 0.0, 0.0, -1.0 }, { 0.0, 1.0, 0.0 }, 0.9, 0.01, 100.0, size, size);
    scene.plan.batches.clear();
  }

  /// Points on a square of half a side `reach` times the picture's at a depth.
  std::shared_ptr<ResolvedStyle> add(double depth, Rgba8 colour, double reach = 1.5)
  {
    PlanOfPoints one;
    one.next = scene.next;
    std::vector<TestPoint> points;
    constexpr int side = 200;
    for (int i = 0; i < side * side; ++i)
    {
      const double half = reach * depth * std::tan(0.45);
      points.push_back({ { half * (2.0 * (i % side) / (side - 1.0) - 1.0),
                           half * (2.0 * (i / side) / (side - 1.0) - 1.0), -depth },
        {}, {} });
    }
    return put(one, points, colour);
  }
  std::shared_ptr<ResolvedStyle> addPoint(const glm::dvec3& at, Rgba8 colour)
  {
    PlanOfPoints one;
    one.next = scene.next;
    return put(one, { { at, {}, {} } }, colour);
  }

  SoftwareTarget draw(
    ThreadCrew* crew = nullptr, const PixelRectangle* place = nullptr, bool points = false) const
  {
    SoftwareRasteriser rasteriser(crew);
    SoftwareComposition composition;
    SoftwareTarget target;
    target.keepPoints = points;
    target.reset(place ? *place : PixelRectangle{ 0, 0, size, size });
    composition.draw(rasteriser, scene.plan, target);
    composition.finish(scene.plan.camera, scene.plan.shading, target);
    return target;
  }

  PlanOfPoints scene;

private:
  std::shared_ptr<ResolvedStyle> put(
    PlanOfPoints& one, const std::vector<TestPoint>& points, Rgba8 colour)
  {
    one.add(points, 0.1);
    scene.next = one.next;
    one.style->colouring = {};
    one.style->flat = colour;
    one.style->size = { SplatSize::Mode::Pixels, 1.0, 0 };
    scene.plan.batches.push_back(one.plan.batches[0]);
    return one.style;
  }
};

Bytes at(const SoftwareTarget& target, int x, int y)
{
  const std::size_t pixel =
    static_cast<std::size_t>(y - target.bottom) * static_cast<std::size_t>(target.width) +
    static_cast<std::size_t>(x - target.left);
  Bytes bytes;
  for (int c = 0; c < 4; ++c)
  {
    bytes[static_cast<std::size_t>(c)] = static_cast<int>(target.rgba[pixel] >> (8 * c) & 255u);
  }
  return bytes;
}

float depthAt(const SoftwareTarget& target, int x, int y)
{
  return target.depth[static_cast<std::size_t>(y) * size + static_cast<std::size_t>(x)];
}

constexpr Rgba8 red{ 200, 0, 0, 255 };
constexpr Rgba8 green{ 0, 200, 0, 255 };
constexpr Rgba8 blue{ 0, 0, 200, 255 };

} // namespace

TEST(Composition, WhatIsTranslucentLiesOverWhatIsBehindIt)
{
  Sheets sheets;
  sheets.add(2.0, blue);
  const auto front = sheets.add(1.0, red);
  front->group = 7;
  front->opacity = 0.25;
  const SoftwareTarget picture = sheets.draw(nullptr, nullptr, true);
  EXPECT_EQ(at(picture, 30, 20), (Bytes{ 50, 0, 150, 255 }));
  EXPECT_FLOAT_EQ(depthAt(picture, 30, 20), 2.0f) << "of what is opaque";
  EXPECT_EQ(picture.points[20 * size + 30].node, 1u) << "of what is nearest";
}

TEST(Composition, BehindWhatIsOpaqueItIsNotSeen)
{
  Sheets sheets;
  sheets.add(1.0, blue);
  const auto behind = sheets.add(2.0, red);
  behind->group = 7;
  behind->opacity = 0.25;
  EXPECT_EQ(at(sheets.draw(), 30, 20), (Bytes{ 0, 0, 200, 255 }));
}

TEST(Composition, OverNothingItIsAsOpaqueAsItIs)
{
  Sheets sheets;
  const auto front = sheets.add(1.0, red);
  front->group = 7;
  front->opacity = 0.4;
  const SoftwareTarget picture = sheets.draw();
  EXPECT_EQ(at(picture, 30, 20), (Bytes{ 200, 0, 0, 102 }));
  EXPECT_FLOAT_EQ(depthAt(picture, 30, 20), 1.0f);
}

// Groups blend far to near, whatever their numbers; a group shows its nearest points alone.
TEST(Composition, GroupsBlendByDepthAndAreOneSurfaceEach)
{
  for (const bool swapped : { false, true })
  {
    Sheets sheets;
    sheets.add(4.0, blue);
    const auto middle = sheets.add(2.0, green);
    const auto front = sheets.add(1.0, red);
    const auto own = sheets.add(3.0, red);
    front->group = own->group = swapped ? 9 : 3;
    middle->group = 5;
    front->opacity = own->opacity = middle->opacity = 0.5;
    // 0.5 red over 0.5 green over blue.
    EXPECT_EQ(at(sheets.draw(), 30, 20), (Bytes{ 100, 50, 50, 255 }));
  }
}

TEST(Composition, ACircleShowsWhatLiesInItAndNothingElse)
{
  Sheets sheets;
  sheets.add(1.0, red);
  sheets.add(2.0, blue)->lens = 0;
  FrameLens lens;
  lens.centrePx = { 40.0f, 20.0f };
  lens.halfSizePx = glm::vec2(12.0f);
  sheets.scene.plan.shading.lenses = { lens };
  const SoftwareTarget picture = sheets.draw();
  int inside = 0;
  for (int y = 0; y < size; ++y)
  {
    for (int x = 0; x < size; ++x)
    {
      const bool covered = std::hypot(x + 0.5 - 40.0, y + 0.5 - 20.0) <= 12.0;
      inside += covered ? 1 : 0;
      EXPECT_EQ(at(picture, x, y), (covered ? Bytes{ 0, 0, 200, 255 } : Bytes{ 200, 0, 0, 255 }))
        << x << ", " << y;
      EXPECT_FLOAT_EQ(depthAt(picture, x, y), covered ? 2.0f : 1.0f);
    }
  }
  EXPECT_NEAR(inside, 3.1416 * 144.0, 12.0);
}

TEST(Composition, WhereNothingIsShownInALensThereIsNothing)
{
  Sheets sheets;
  sheets.add(1.0, red);
  FrameLens lens;
  lens.shape = LensShape::Rectangle;
  lens.centrePx = { 32.0f, 32.0f };
  lens.halfSizePx = { 10.0f, 5.0f };
  sheets.scene.plan.shading.lenses = { lens };
  const SoftwareTarget picture = sheets.draw();
  EXPECT_EQ(at(picture, 32, 32), nothing);
  EXPECT_EQ(depthAt(picture, 32, 32), std::numeric_limits<float>::infinity());
  EXPECT_EQ(at(picture, 41, 36), nothing);
  EXPECT_EQ(at(picture, 42, 36), (Bytes{ 200, 0, 0, 255 }));
  EXPECT_EQ(at(picture, 41, 37), (Bytes{ 200, 0, 0, 255 }));
}

TEST(Composition, AMaskIsStretchedOverTheViewport)
{
  Sheets sheets;
  sheets.add(1.0, red);
  sheets.add(2.0, green)->lens = 0;
  FrameLens lens;
  lens.shape = LensShape::Mask;
  lens.mask = std::make_shared<LensMask>(LensMask{ 2, 2, { 0, 1, 0, 0 } }); // the lower right
  sheets.scene.plan.shading.lenses = { lens };
  const SoftwareTarget picture = sheets.draw();
  for (int y = 0; y < size; ++y)
  {
    for (int x = 0; x < size; ++x)
    {
      const bool covered = x >= size / 2 && y < size / 2;
      EXPECT_EQ(at(picture, x, y), (covered ? Bytes{ 0, 200, 0, 255 } : Bytes{ 200, 0, 0, 255 }));
    }
  }
}

// A point at depth 2 with a disc of 0.2: 0.1 of the depth.
TEST(Composition, ALensAroundAClassIsWhatItsDiscsCover)
{
  Sheets sheets;
  sheets.add(1.0, red);
  sheets.add(4.0, blue)->lens = 0;
  const auto mask = sheets.addPoint({ 0.0, 0.0, -2.0 }, red);
  mask->lens = 0;
  mask->lensMask = true;
  mask->size = { SplatSize::Mode::World, 0.4, 0 };
  FrameLens lens;
  lens.shape = LensShape::AroundClass;
  sheets.scene.plan.shading.lenses = { lens };
  const SoftwareTarget picture = sheets.draw();
  const double radius = 0.1 * 0.5 * size / std::tan(0.45);
  for (int y = 0; y < size; ++y)
  {
    for (int x = 0; x < size; ++x)
    {
      const double far = std::hypot(x + 0.5 - 32.0, y + 0.5 - 32.0);
      if (std::abs(far - radius) > 0.1)
      {
        EXPECT_EQ(
          at(picture, x, y), (far < radius ? Bytes{ 0, 0, 200, 255 } : Bytes{ 200, 0, 0, 255 }))
          << x << ", " << y;
      }
    }
  }
}

TEST(Composition, LensesHaveTranslucentClassesOfTheirOwnAndLaterOnesLieOnTop)
{
  Sheets sheets;
  sheets.add(1.0, red);
  sheets.add(4.0, blue)->lens = 0;
  const auto glass = sheets.add(2.0, green);
  glass->lens = 0;
  glass->group = 3;
  glass->opacity = 0.5;
  sheets.add(3.0, green)->lens = 1;
  FrameLens lens;
  lens.centrePx = { 32.0f, 32.0f };
  lens.halfSizePx = glm::vec2(20.0f);
  FrameLens small = lens;
  small.halfSizePx = glm::vec2(8.0f);
  sheets.scene.plan.shading.lenses = { lens, small };
  const SoftwareTarget picture = sheets.draw();
  EXPECT_EQ(at(picture, 5, 5), (Bytes{ 200, 0, 0, 255 }));
  EXPECT_EQ(at(picture, 32, 46), (Bytes{ 0, 100, 100, 255 }));
  EXPECT_EQ(at(picture, 32, 32), (Bytes{ 0, 200, 0, 255 }));
}

/// SMOOTH-5 in parts that do not fill the viewport; and the same bits as at one go.
TEST(Composition, InsideOfALensNothingIsDrawnTwice)
{
  Sheets sheets;
  sheets.add(1.0, red);
  sheets.add(2.0, blue)->lens = 0;
  const auto glass = sheets.add(1.5, green);
  glass->lens = 0;
  glass->group = 3;
  glass->opacity = 0.5;
  FrameLens lens;
  lens.centrePx = { 30.0f, 33.0f };
  lens.halfSizePx = glm::vec2(20.0f);
  FramePlan& plan = sheets.scene.plan;
  plan.shading.lenses = { lens };
  plan.refining = true;
  SoftwareRasteriser rasteriser;
  SoftwareComposition composition;
  const std::uint32_t all = plan.batches[0].items[0].last;
  std::uint64_t drawn = 0;
  for (int frame = 1; frame <= 6; ++frame)
  {
    SCOPED_TRACE(frame);
    for (DrawBatch& batch : plan.batches)
    {
      batch.items[0].last = all * static_cast<std::uint32_t>(std::min(frame, 4)) / 4;
    }
    plan.refining = frame < 4;
    // A smaller lens goes on from nothing, for its part of the picture is another one.
    plan.shading.lenses[0].halfSizePx = glm::vec2(frame < 6 ? 20.0f : 10.0f);
    SoftwareTarget picture;
    picture.reset(size, size);
    drawn += composition.draw(rasteriser, plan, picture).drawn;
    composition.finish(plan.camera, plan.shading, picture);
    EXPECT_EQ(picture.rgba, sheets.draw().rgba);
    EXPECT_EQ(drawn, std::uint64_t(all) * (frame < 6 ? 3 : 5) * std::min(frame, 4) / 4);
  }
}

TEST(Composition, AHighlightTintsAndHasARimOnWhatIsBehind)
{
  Sheets sheets;
  sheets.add(4.0, blue);
  sheets.add(2.0, red, 0.25)->highlight = 1; // the middle quarter: pixels 24 to 39
  sheets.add(1.0, green, 0.05); // in front of its middle
  sheets.scene.plan.shading.highlights = { { { 1.0f, 1.0f, 1.0f }, 3.0f, 0.5f } };
  const SoftwareTarget picture = sheets.draw();
  EXPECT_EQ(at(picture, 28, 36), (Bytes{ 228, 128, 128, 255 })) << "half white";
  EXPECT_EQ(at(picture, 32, 32), (Bytes{ 0, 200, 0, 255 })) << "in front";
  EXPECT_EQ(at(picture, 22, 32), (Bytes{ 255, 255, 255, 255 })) << "rim";
  EXPECT_EQ(at(picture, 32, 42), (Bytes{ 255, 255, 255, 255 }));
  EXPECT_EQ(at(picture, 18, 32), (Bytes{ 0, 0, 200, 255 })) << "beyond it";
}

/// A pick in a halo finds what lies behind it.
TEST(Composition, APictureOfPointsHasNoHalo)
{
  Sheets sheets;
  sheets.add(2.0, red, 0.25)->highlight = 1;
  sheets.scene.plan.shading.highlights = { { { 1.0f, 1.0f, 1.0f }, 3.0f, 0.5f } };
  ASSERT_LT(depthAt(sheets.draw(), 22, 32), 3.0f) << "rim over nothing";
  const SoftwareTarget points = sheets.draw(nullptr, nullptr, true);
  EXPECT_GT(depthAt(points, 22, 32), 1e30f);
  EXPECT_EQ(points.points[32 * size + 22].store, PixelPoint::nothing);
  EXPECT_EQ(at(points, 32, 32), (Bytes{ 228, 128, 128, 255 })) << "its points are tinted";
}

TEST(Composition, IsTheSameForAnyThreadsAndInBands)
{
  Sheets sheets;
  sheets.add(4.0, blue);
  const auto glass = sheets.add(2.0, green, 0.6);
  glass->group = 2;
  glass->opacity = 0.3;
  glass->highlight = 1;
  sheets.add(3.0, red, 0.7)->lens = 0;
  FrameLens lens;
  lens.centrePx = { 20.0f, 40.0f };
  lens.halfSizePx = glm::vec2(17.0f);
  FrameShading& shading = sheets.scene.plan.shading;
  shading.lenses = { lens };
  shading.highlights = { { { 1.0f, 1.0f, 0.0f }, 2.0f, 0.2f } };
  shading.eyeDomeStrength = 0.4f;
  const SoftwareTarget whole = sheets.draw();
  ThreadCrew seven(7);
  EXPECT_EQ(sheets.draw(&seven).rgba, whole.rgba);
  const int reach = shading.reachPx();
  for (int bottom = 0; bottom < size; bottom += 10)
  {
    const int top = std::min(size, bottom + 10);
    const PixelRectangle band{ 0, std::max(0, bottom - reach), size, std::min(size, top + reach) };
    const SoftwareTarget part = sheets.draw(nullptr, &band);
    for (int y = bottom; y < top; ++y)
    {
      for (int x = 0; x < size; ++x)
      {
        EXPECT_EQ(at(part, x, y), at(whole, x, y)) << x << ", " << y;
      }
    }
  }
}

TEST(Composition, OneRasteriserGoesOnWithEachPart)
{
  Sheets sheets;
  sheets.add(4.0, blue);
  const auto glass = sheets.add(2.0, green, 0.6);
  glass->group = 2;
  glass->opacity = 0.3;
  SoftwareRasteriser rasteriser;
  SoftwareComposition composition;
  SoftwareTarget target;
  PictureValues<std::uint32_t> first;
  for (int frame = 0; frame < 3; ++frame)
  {
    target.reset(size, size);
    const RasterStatistics drawn = composition.draw(rasteriser, sheets.scene.plan, target);
    composition.finish(sheets.scene.plan.camera, sheets.scene.plan.shading, target);
    first = frame == 0 ? target.rgba : first;
    EXPECT_EQ(target.rgba, first);
    EXPECT_EQ(drawn.reused, frame == 0 ? 0u : 80000u) << "nothing is drawn twice at rest";
  }
  EXPECT_EQ(first, sheets.draw().rgba);
}

TEST(Composition, SplatsOfSeveralCloudsMeetAsThoseOfOne)
{
  PlanOfPoints one;
  one.look({ 0.0, -3.0, 1.5 }, { 0.0, 0.0, 0.0 }, 0.7, size, size);
  one.style->technique = Technique::Splats;
  one.add(wavySurface(300, 1), 0.1);
  one.add(wavySurface(300, 2), 0.1);
  SoftwareRasteriser rasteriser;
  SoftwareComposition composition;
  SoftwareTarget whole, meeting;
  const auto drawInto = [&](SoftwareTarget& target, std::vector<FramePlan> plans)
  {
    target.reset(size, size);
    for (const FramePlan& plan : plans)
    {
      composition.draw(rasteriser, plan, target);
    }
    composition.finish(one.plan.camera, one.plan.shading, target);
  };
  FramePlan first = one.plan, second = one.plan;
  first.batches[0].items.pop_back();
  second.batches[0].items.erase(second.batches[0].items.begin());
  drawInto(whole, { one.plan });
  for (const bool fronts : { true, false })
  {
    meeting.keepDecided = true;
    drawInto(meeting, fronts ? std::vector{ first, second } : std::vector{ second, first });
    EXPECT_EQ(meeting.rgba, whole.rgba);
    EXPECT_EQ(meeting.depth, whole.depth);
  }
  meeting.keepDecided = false;
  drawInto(meeting, { first, second });
  EXPECT_NE(meeting.rgba, whole.rgba) << "discs cut each other: nothing was tested above";
}
