// The same bits whatever draws them: instruction sets, threads, orders, in one go or by and by.

#include "PlanOfPoints.h"

#include "pointfront/Threads/ThreadCrew.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

struct NamedStyle
{
  const char* name;
  Technique technique;
  bool blended;
  bool normals;
  SplatAccuracy accuracy;
  SplatSize::Mode size;
};

const NamedStyle styles[] = {
  { "Points", Technique::Points, false, false, SplatAccuracy::Affine, SplatSize::Mode::Pixels },
  { "FlatDiscs", Technique::Points, false, false, SplatAccuracy::Affine,
    SplatSize::Mode::Spacing },
  { "Paraboloids", Technique::Splats, false, false, SplatAccuracy::Affine,
    SplatSize::Mode::Spacing },
  { "BlendedParaboloids", Technique::Splats, true, false, SplatAccuracy::Affine,
    SplatSize::Mode::Spacing },
  { "Ellipses", Technique::Splats, false, true, SplatAccuracy::Affine, SplatSize::Mode::Spacing },
  { "Spheres", Technique::Spheres, false, true, SplatAccuracy::Affine, SplatSize::Mode::Spacing },
  { "EwaAffine", Technique::Ewa, true, true, SplatAccuracy::Affine, SplatSize::Mode::Spacing },
  { "EwaExact", Technique::Ewa, true, true, SplatAccuracy::Exact, SplatSize::Mode::Spacing },
  { "EwaFull", Technique::Ewa, true, true, SplatAccuracy::Full, SplatSize::Mode::World },
};

void apply(const NamedStyle& named, ResolvedStyle& style)
{
  style.technique = named.technique;
  style.blended = named.blended;
  style.accuracy = named.accuracy;
  style.normalColumn = named.normals ? std::optional<std::uint32_t>(1) : std::nullopt;
  style.size = { named.size, 1.0, 0 };
  style.size.value = named.size == SplatSize::Mode::World ? 0.06 : 1.0;
}

PlanOfPoints surface(const NamedStyle& named, bool parallel = false)
{
  PlanOfPoints scene;
  apply(named, *scene.style);
  scene.plan.shading.lit = named.normals;
  for (unsigned node = 0; node < 6; ++node)
  {
    scene.add(wavySurface(700, node), 0.05);
  }
  if (parallel)
  {
    scene.plan.camera = FrameCamera::parallelView(
      { 1.0, -3.0, 2.0 }, { 0, 0, 0 }, { 0, 0, 1 }, 1.2, 0.1, 10.0, 200, 150);
  }
  else
  {
    scene.look({ 0.3, -1.6, 0.9 }, { 0, 0, 0 }, 0.9, 200, 150);
  }
  return scene;
}

void expectSame(const SoftwareTarget& a, const SoftwareTarget& b, const std::string& what)
{
  EXPECT_EQ(a.rgba, b.rgba) << what;
  EXPECT_EQ(a.depth, b.depth) << what;
  EXPECT_EQ(a.normals, b.normals) << what;
}

class SameBits : public testing::TestWithParam<NamedStyle>
{
};

} // namespace

TEST_P(SameBits, OnEachInstructionSet)
{
  for (const bool parallel : { false, true })
  {
    const PlanOfPoints scene = surface(GetParam(), parallel);
    SoftwareRasteriser portable;
    ASSERT_TRUE(portable.setInstructionSet("portable"));
    const SoftwareTarget reference = scene.draw(portable);
    EXPECT_GT(std::count_if(reference.depth.begin(), reference.depth.end(),
                [](float depth) { return depth < 1e30f; }),
      2000);
    for (const char* const name : { "AVX2", "AVX-512" })
    {
      SoftwareRasteriser rasteriser;
      if (rasteriser.setInstructionSet(name))
      {
        expectSame(scene.draw(rasteriser), reference, name);
      }
    }
  }
}

TEST_P(SameBits, WithAnyNumberOfThreads)
{
  const PlanOfPoints scene = surface(GetParam());
  ThreadCrew one(1);
  SoftwareRasteriser alone(&one);
  const SoftwareTarget reference = scene.draw(alone);
  for (const unsigned threads : { 2u, 7u })
  {
    ThreadCrew crew(threads);
    SoftwareRasteriser rasteriser(&crew);
    expectSame(scene.draw(rasteriser), reference, std::to_string(threads));
  }
}

TEST_P(SameBits, InAnyOrderOfNodes)
{
  PlanOfPoints scene = surface(GetParam());
  const SoftwareTarget reference = scene.draw();
  std::vector<PlanItem>& items = scene.plan.batches[0].items;
  std::reverse(items.begin(), items.end());
  expectSame(scene.draw(), reference, "reversed");
  std::rotate(items.begin(), items.begin() + 2, items.end());
  scene.plan.batches.push_back(scene.plan.batches[0]);
  scene.plan.batches[0].items.resize(3);
  scene.plan.batches[1].items.erase(
    scene.plan.batches[1].items.begin(), scene.plan.batches[1].items.begin() + 3);
  expectSame(scene.draw(), reference, "in two batches");
}

TEST_P(SameBits, ByAndByAndAtOneGo)
{
  PlanOfPoints scene = surface(GetParam());
  const SoftwareTarget reference = scene.draw();
  const std::vector<PlanItem> all = scene.plan.batches[0].items;
  SoftwareRasteriser rasteriser;
  // Nodes 1, 3, 5; then 4 and a part of 2; then everything.
  const std::vector<std::vector<std::size_t>> rounds = { { 5, 1, 3 }, { 4, 1, 3, 2, 5 },
    { 0, 1, 2, 3, 4, 5 } };
  std::uint64_t reused = 0;
  for (std::size_t round = 0; round < rounds.size(); ++round)
  {
    std::vector<PlanItem>& items = scene.plan.batches[0].items;
    items.clear();
    for (const std::size_t number : rounds[round])
    {
      items.push_back(all[number]);
      items.back().last = round == 1 && number == 2 ? 300u : items.back().last;
    }
    SoftwareTarget target;
    target.reset(scene.plan.camera.width, scene.plan.camera.height);
    reused += rasteriser.draw(scene.plan, target).reused;
    if (round + 1 == rounds.size())
    {
      expectSame(target, reference, "by and by");
    }
  }
  EXPECT_EQ(reused, 2100u + 3100u);
}

TEST_P(SameBits, InBands)
{
  const PlanOfPoints scene = surface(GetParam());
  const SoftwareTarget reference = scene.draw();
  SoftwareRasteriser rasteriser;
  SoftwareTarget band;
  for (int bottom = 0; bottom < 150; bottom += 37)
  {
    const int rows = std::min(37, 150 - bottom);
    band.reset(200, rows);
    rasteriser.draw(scene.plan, { bottom, bottom + rows }, band);
    const std::size_t first = static_cast<std::size_t>(bottom) * 200;
    EXPECT_TRUE(std::equal(band.rgba.begin(), band.rgba.end(), reference.rgba.begin() + first));
    EXPECT_TRUE(std::equal(band.depth.begin(), band.depth.end(), reference.depth.begin() + first));
  }
}

INSTANTIATE_TEST_SUITE_P(Techniques, SameBits, testing::ValuesIn(styles),
  [](const testing::TestParamInfo<NamedStyle>& one) { return one.param.name; });
