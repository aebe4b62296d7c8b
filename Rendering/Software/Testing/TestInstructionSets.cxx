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

const NamedStyle namedStyles[] = {
  { "Points", Technique::Points, false, false, SplatAccuracy::Affine, SplatSize::Mode::Pixels },
  { "FlatDiscs", Technique::Points, false, false, SplatAccuracy::Affine, SplatSize::Mode::Spacing },
  { "Paraboloids", Technique::Splats, false, false, SplatAccuracy::Affine,
    SplatSize::Mode::Spacing },
  { "BlendedParaboloids", Technique::Splats, true, false, SplatAccuracy::Affine,
    SplatSize::Mode::Spacing },
  { "Ellipses", Technique::Splats, false, true, SplatAccuracy::Affine, SplatSize::Mode::Spacing },
  { "Spheres", Technique::Spheres, false, true, SplatAccuracy::Affine, SplatSize::Mode::Spacing },
  { "EwaAffine", Technique::Ewa, true, true, SplatAccuracy::Affine, SplatSize::Mode::Spacing },
  { "EwaExact", Technique::Ewa, true, true, SplatAccuracy::Exact, SplatSize::Mode::Spacing },
  { "FacingSilhouettes", Technique::Silhouettes, false, false, SplatAccuracy::Affine,
    SplatSize::Mode::Spacing },
  { "Silhouettes", Technique::Silhouettes, false, true, SplatAccuracy::Affine,
    SplatSize::Mode::Spacing },
  { "ExactSilhouettes", Technique::Silhouettes, false, true, SplatAccuracy::Full,
    SplatSize::Mode::Spacing },
  { "FacingSolids", Technique::Solid, false, false, SplatAccuracy::Affine,
    SplatSize::Mode::Spacing },
  { "Solids", Technique::Solid, false, true, SplatAccuracy::Affine, SplatSize::Mode::Spacing },
  { "EwaFull", Technique::Ewa, true, true, SplatAccuracy::Full, SplatSize::Mode::World },
};

void apply(const NamedStyle& named, ResolvedStyle& style)
{
  style.technique = named.technique;
  style.blended = named.blended;
  style.accuracy = named.accuracy;
  style.normalColumn = named.normals ? std::optional<std::uint32_t>(1) : std::nullopt;
  if (named.technique == Technique::Solid)
  {
    style.heightColumn = 4;
    style.wall = { Rgba8{ 250, 240, 230, 255 }, Rgba8{ 10, 60, 110, 255 } };
  }
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

/// The part's pixels are those that the whole has there.
void expectPart(const SoftwareTarget& part, const SoftwareTarget& whole, const std::string& what)
{
  int different = 0;
  for (int y = 0; y < part.height; ++y)
  {
    for (int x = 0; x < part.width; ++x)
    {
      const auto mine = static_cast<std::size_t>(y * part.width + x);
      const auto other = static_cast<std::size_t>((part.bottom + y) * whole.width + part.left + x);
      different += part.rgba[mine] != whole.rgba[other] || part.depth[mine] != whole.depth[other];
      for (std::size_t c = 0; !part.normals.empty() && c < 3; ++c)
      {
        different += part.normals[3 * mine + c] != whole.normals[3 * other + c];
      }
    }
  }
  EXPECT_EQ(different, 0) << what;
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

TEST_P(SameBits, InParts)
{
  const PlanOfPoints scene = surface(GetParam());
  const SoftwareTarget reference = scene.draw();
  SoftwareRasteriser rasteriser;
  SoftwareTarget part;
  for (int bottom = 0; bottom < 150; bottom += 37)
  {
    for (int left = 0; left < 200; left += 61)
    {
      part.reset({ left, bottom, std::min(left + 61, 200), std::min(bottom + 37, 150) });
      rasteriser.draw(scene.plan, part);
      expectPart(part, reference, "part");
    }
  }
}

/// A store that fills a part of the window only: as drawn in all of it.
TEST_P(SameBits, WhereItShows)
{
  struct Look
  {
    const char* name;
    glm::dvec3 from;
    glm::dvec3 at;
    double angle;
    bool whole;
  };
  const Look looks[] = {
    { "far", { 20.0, -40.0, 30.0 }, { 3.0, 1.0, 0.0 }, 0.3, false },
    { "at the left edge", { 0.0, -9.0, 7.0 }, { 2.6, 0.0, 0.0 }, 0.5, false },
    { "at the upper right corner", { 0.0, -9.0, 7.0 }, { -3.0, -3.0, 0.0 }, 0.5, false },
    { "wide", { 0.5, -3.0, 2.0 }, { 3.5, 1.0, 0.0 }, 2.4, false },
    { "beside the view", { 0.0, -9.0, 7.0 }, { 30.0, 0.0, 0.0 }, 0.5, false },
    { "behind the eye", { 0.0, -9.0, 7.0 }, { 0.0, -40.0, 7.0 }, 0.5, false },
    { "near", { 0.2, -0.3, 0.4 }, { 0.0, 0.1, 0.0 }, 1.2, true },
  };
  for (const Look& look : looks)
  {
    for (const bool parallel : { false, true })
    {
      PlanOfPoints scene = surface(GetParam());
      scene.plan.shading.fillHoles = true;
      scene.plan.shading.eyeDomeStrength = 0.4f;
      scene.plan.camera = parallel
        ? FrameCamera::parallelView(look.from, look.at, { 0.0, 0.0, 1.0 }, 5.0, 0.01, 1e4, 331, 217)
        : FrameCamera::perspective(
            look.from, look.at, { 0.0, 0.0, 1.0 }, look.angle, 0.01, 1e4, 331, 217);
      SoftwareTarget shown;
      SoftwareRasteriser().drawShown(scene.plan, shown);
      const bool whole = shown.width == 331 && shown.height == 217;
      EXPECT_EQ(whole, look.whole && !parallel) << look.name;
      shade(scene.plan.camera, scene.plan.shading, shown);
      // The same beside a node that nobody sees but that might be anywhere.
      const glm::dvec3 ahead = 2.0e4 * glm::normalize(look.at - look.from);
      scene.add({ { look.from - ahead - 1.0e4 }, { look.from + ahead + 1.0e4 } });
      SoftwareTarget all = scene.draw();
      shade(scene.plan.camera, scene.plan.shading, all);
      expectPart(shown, all, look.name);
      const auto drawn = [](const SoftwareTarget& target)
      {
        return std::count_if(
          target.rgba.begin(), target.rgba.end(), [](std::uint32_t c) { return c != 0; });
      };
      EXPECT_EQ(drawn(shown), drawn(all)) << look.name; // nothing is outside
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Techniques, SameBits, testing::ValuesIn(namedStyles),
  [](const testing::TestParamInfo<NamedStyle>& one) { return one.param.name; });
