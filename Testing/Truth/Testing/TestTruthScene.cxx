#include "SolidTexture.h"
#include "TruthScene.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <map>
#include <set>

namespace pointfront::truth
{
namespace
{
bool same(const TriangleMesh& one, const TriangleMesh& other)
{
  return one.vertices == other.vertices && one.triangles == other.triangles &&
    one.materials == other.materials && one.vertexNormals == other.vertexNormals;
}

TEST(TruthScene, IsTheSameEveryTime)
{
  EXPECT_TRUE(same(makeTown().mesh, makeTown().mesh));
  EXPECT_TRUE(same(makeKnot().mesh, makeKnot().mesh));
  EXPECT_FALSE(makeScene("village"));
  EXPECT_EQ(makeScene("knot")->view("above"), nullptr);
}

TEST(TruthScene, TheTownHasWhatATownHas)
{
  const TruthScene town = makeTown();
  std::map<Material, double> area;
  for (std::size_t t = 0; t < town.mesh.size(); ++t)
  {
    ASSERT_GT(town.mesh.area(t), 0.0) << t;
    area[town.mesh.materials[t]] += town.mesh.area(t);
  }
  EXPECT_NEAR(area[Material::Ground], 40000.0, 200.0); // sloped: a little more
  EXPECT_GT(area[Material::Ground], 40000.0);
  EXPECT_GT(area[Material::Wall], 3000.0);
  EXPECT_GT(area[Material::Roof], 3000.0);
  EXPECT_GT(area[Material::Leaf], 1000.0);
  EXPECT_GT(area[Material::Trunk], 50.0);
  EXPECT_GT(area[Material::Metal], 100.0);
  for (const char* view : { "far", "mid", "close", "graze" })
  {
    EXPECT_NE(town.view(view), nullptr) << view;
  }
}

TEST(TruthScene, TheGroundLooksUpAndTheKnotOutwards)
{
  const TruthScene town = makeTown();
  for (std::size_t t = 0; t < town.mesh.size(); ++t)
  {
    if (town.mesh.materials[t] == Material::Ground || town.mesh.materials[t] == Material::Roof)
    {
      ASSERT_GT(town.mesh.faceNormal(t).z, 0.0) << t;
    }
  }
  // The volume inside a closed surface is positive when the surface looks outwards.
  const TruthScene knot = makeKnot();
  double sixVolumes = 0.0;
  for (std::size_t t = 0; t < knot.mesh.size(); ++t)
  {
    sixVolumes +=
      glm::dot(knot.mesh.corner(t, 0), glm::cross(knot.mesh.corner(t, 1), knot.mesh.corner(t, 2)));
  }
  EXPECT_GT(sixVolumes, 0.0);
  const glm::dvec3 size = knot.mesh.bounds().size();
  EXPECT_NEAR(std::max({ size.x, size.y, size.z }), 10.0, 1e-9);
}

TEST(TruthScene, TheKnotIsClosed)
{
  // Every edge belongs to two triangles, which go along it in opposite directions.
  const TruthScene knot = makeKnot();
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& corners : knot.mesh.triangles)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      ASSERT_TRUE(edges.insert({ corners[i], corners[(i + 1) % 3] }).second);
    }
  }
  for (const auto& [from, to] : edges)
  {
    ASSERT_EQ(edges.count({ to, from }), 1u);
  }
}

TEST(SolidTexture, HasOneColourAtAPlaceAndDetailAround)
{
  const glm::dvec3 up(0, 0, 1);
  std::set<std::array<std::uint8_t, 3>> colours;
  for (int i = 0; i < 400; ++i)
  {
    const glm::dvec3 place(0.05 * i, 3.0, 1.0);
    colours.insert(toBytes(surfaceColour(Material::Marble, place, up, 0)));
    EXPECT_EQ(surfaceColour(Material::Marble, place, up, 0),
      surfaceColour(Material::Marble, place, up, 77));
  }
  EXPECT_GT(colours.size(), 200u);
  const glm::dvec3 lit = surfaceColour(Material::Metal, {}, up, 0);
  const glm::dvec3 dark = surfaceColour(Material::Metal, {}, -up, 0);
  EXPECT_DOUBLE_EQ(dark.x, 75.0); // half of 150: the sky alone
  EXPECT_GT(lit.x, 1.7 * dark.x);
  EXPECT_EQ(toBytes({ -3.0, 254.5, 300.0 }), (std::array<std::uint8_t, 3>{ 0, 255, 255 }));
}
} // namespace
} // namespace pointfront::truth
