// Points that are not of their size yet (PlanItem::growth), in the software back end.

#include "PlanOfPoints.h"

#include "pointfront/Threads/ThreadCrew.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

constexpr int growthWidth = 200;
constexpr int growthHeight = 150;
constexpr std::uint32_t half = 400; // points of a node

struct GrowingStyle
{
  std::string name;
  Technique technique;
  bool blended;
  bool normals;
  SplatSize size = { SplatSize::Mode::Spacing, 1.0, 0 };
};
const GrowingStyle styles[] = {
  { "paraboloids", Technique::Splats, false, false },
  { "ellipses", Technique::Splats, false, true },
  { "blended_paraboloids", Technique::Splats, true, false },
  { "spheres", Technique::Spheres, false, false },
  { "ewa", Technique::Ewa, true, true },
  { "squares", Technique::Points, false, false, { SplatSize::Mode::Pixels, 5.0, 0 } },
};

/// Two nodes of a surface, one behind the other's points in the order of drawing.
PlanOfPoints surface(const GrowingStyle& style)
{
  PlanOfPoints scene;
  scene.style->technique = style.technique;
  scene.style->blended = style.blended;
  scene.style->size = style.size;
  scene.style->colouring.column = 0;
  if (style.normals)
  {
    scene.style->normalColumn = 1;
  }
  scene.add(wavySurface(2 * half, 3), 0.05);
  scene.add(wavySurface(2 * half, 4), 0.05);
  scene.look({ 0.3, -1.6, 0.9 }, { 0, 0, 0 }, 0.9, growthWidth, growthHeight);
  return scene;
}

int covered(const SoftwareTarget& target)
{
  return static_cast<int>(std::count_if(
    target.depth.begin(), target.depth.end(), [](float depth) { return std::isfinite(depth); }));
}

void expectSame(const SoftwareTarget& a, const SoftwareTarget& b)
{
  EXPECT_EQ(a.rgba, b.rgba);
  EXPECT_EQ(a.depth, b.depth);
}

double meanDifference(const SoftwareTarget& a, const SoftwareTarget& b)
{
  double sum = 0.0;
  const auto* x = reinterpret_cast<const std::uint8_t*>(a.rgba.data());
  const auto* y = reinterpret_cast<const std::uint8_t*>(b.rgba.data());
  for (std::size_t i = 0; i < 4 * a.rgba.size(); ++i)
  {
    sum += std::abs(int(x[i]) - int(y[i]));
  }
  return sum / static_cast<double>(4 * a.rgba.size());
}

class Growth : public testing::TestWithParam<GrowingStyle>
{
};

} // namespace

/// From a prefix of half of the points to all of them: the last step is all, each covers more than
/// the one before, none changes much.
TEST_P(Growth, LeadsFromAPrefixToAll)
{
  PlanOfPoints scene = surface(GetParam());
  PlanItem& item = scene.plan.batches[0].items[1];
  item.last = half;
  const SoftwareTarget prefix = scene.draw();
  item.last = 2 * half;
  const SoftwareTarget all = scene.draw();
  const double jump = meanDifference(prefix, all);
  ASSERT_GT(jump, 1.0);

  constexpr int steps = 12;
  constexpr float falling = 100.0f; // points that sizes fall over
  SoftwareTarget before = prefix;
  double largest = 0.0;
  int least = covered(prefix);
  for (int step = 0; step <= steps; ++step)
  {
    const float end = half + falling + static_cast<float>(half * step) / steps;
    item.growth = { end / falling, 1.0f / falling };
    const SoftwareTarget now = scene.draw();
    EXPECT_GE(covered(now), least) << step;
    largest = std::max(largest, meanDifference(now, before));
    least = covered(now);
    before = now;
  }
  expectSame(before, all);
  EXPECT_LT(largest, 0.35 * jump);
}

/// A picture that grew ends as one that was drawn at one go, bit for bit; so does one that begins
/// to grow on top of a finished one.
TEST_P(Growth, EndsAsOneThatNeverGrew)
{
  PlanOfPoints scene = surface(GetParam());
  const SoftwareTarget reference = scene.draw();
  std::vector<PlanItem>& items = scene.plan.batches[0].items;
  SoftwareRasteriser rasteriser;
  std::uint64_t reused = 0;
  for (const float first : { 0.25f, 0.5f, 1.75f, 1.0f })
  {
    items[1].growth = { first, first == 1.0f ? 0.0f : 0.001f };
    SoftwareTarget target;
    target.reset(growthWidth, growthHeight);
    reused = rasteriser.draw(scene.plan, target).reused;
    if (first == 1.0f)
    {
      expectSame(target, reference);
    }
  }
  EXPECT_EQ(reused, 0u);
  items[0].growth = { 0.5f, 0.0f };
  SoftwareTarget shrunk;
  shrunk.reset(growthWidth, growthHeight);
  rasteriser.draw(scene.plan, shrunk);
  EXPECT_NE(shrunk.rgba, reference.rgba);
  items[0].growth = {};
  shrunk.reset(growthWidth, growthHeight);
  rasteriser.draw(scene.plan, shrunk);
  expectSame(shrunk, reference);
}

TEST_P(Growth, IsTheSameForAnyThreadsAndInstructions)
{
  PlanOfPoints scene = surface(GetParam());
  scene.plan.batches[0].items[0].growth = { 1.5f, 0.002f };
  scene.plan.batches[0].items[1].growth = { 0.6f, 0.0f };
  ThreadCrew one(1);
  SoftwareRasteriser alone(&one);
  ASSERT_TRUE(alone.setInstructionSet("portable"));
  const SoftwareTarget reference = scene.draw(alone);
  for (const char* const name : { "portable", "AVX2", "AVX-512" })
  {
    ThreadCrew crew(7);
    SoftwareRasteriser rasteriser(&crew);
    if (rasteriser.setInstructionSet(name))
    {
      expectSame(scene.draw(rasteriser), reference);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Techniques, Growth, testing::ValuesIn(styles),
  [](const testing::TestParamInfo<GrowingStyle>& one) { return one.param.name; });
