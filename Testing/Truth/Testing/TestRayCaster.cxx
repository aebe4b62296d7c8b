#include "RandomStream.h"
#include "RayCaster.h"
#include "TruthScene.h"

#include <gtest/gtest.h>

namespace pointfront::truth
{
namespace
{
Hit bruteForce(const TriangleMesh& mesh, const glm::dvec3& origin, const glm::dvec3& direction)
{
  Hit hit;
  for (std::uint32_t t = 0; t < mesh.size(); ++t)
  {
    intersect(mesh, t, origin, direction, 0.0, hit);
  }
  return hit;
}

void expectSame(const Hit& one, const Hit& other, int ray)
{
  EXPECT_EQ(one.triangle, other.triangle) << "ray " << ray;
  EXPECT_EQ(one.distance, other.distance) << "ray " << ray;
  EXPECT_EQ(one.b, other.b) << "ray " << ray;
  EXPECT_EQ(one.c, other.c) << "ray " << ray;
}

TEST(RayCaster, MeetsWhatAllTrianglesOneByOneMeet)
{
  for (const TruthScene& scene : { makeTown(), makeKnot() })
  {
    const RayCaster rays(scene.mesh);
    const Bounds box = scene.mesh.bounds();
    RandomStream random(5);
    int met = 0;
    for (int ray = 0; ray < 60; ++ray)
    {
      const glm::dvec3 share(random.uniform(), random.uniform(), random.uniform());
      const glm::dvec3 target = box.low + share * box.size();
      const glm::dvec3 origin = ray % 2 == 0
        ? box.centre() + 1.5 * glm::length(box.size()) * random.direction()
        : box.low + glm::dvec3(random.uniform(), random.uniform(), random.uniform()) * box.size();
      const Hit hit = rays.cast(origin, target - origin);
      expectSame(hit, bruteForce(scene.mesh, origin, target - origin), ray);
      met += hit ? 1 : 0;
    }
    EXPECT_GT(met, 12) << scene.name;
    EXPECT_LT(met, 60) << scene.name;
  }
}

TEST(RayCaster, MeetsFlatBoxesAlongTheAxesAndAlongTheirSides)
{
  MeshBuilder builder;
  for (int i = 0; i < 8; ++i)
  { // tiles of one plane, so that every box is flat
    builder.quad({ i, 0, 0 }, { i + 1, 0, 0 }, { i + 1, 1, 0 }, { i, 1, 0 }, Material::Ground);
  }
  const TriangleMesh mesh = builder.take();
  const RayCaster rays(mesh);
  int ray = 0;
  for (double x : { 0.0, 0.5, 1.0, 3.0, 7.25, 8.0 }) // on vertices and edges too
  {
    for (double y : { 0.0, 0.25, 1.0 })
    {
      const Hit hit = rays.cast({ x, y, 5.0 }, { 0, 0, -1 });
      EXPECT_TRUE(hit) << x << ' ' << y;
      EXPECT_EQ(hit.distance, 5.0);
      expectSame(hit, bruteForce(mesh, { x, y, 5.0 }, { 0, 0, -1 }), ++ray);
    }
  }
  EXPECT_FALSE(rays.cast({ -1, 0.5, 0 }, { 1, 0, 0 })); // in the plane
  EXPECT_FALSE(rays.cast({ 8.001, 0.5, 5 }, { 0, 0, -1 }));
  EXPECT_FALSE(rays.cast({ 0.5, 0.5, 5 }, { 0, 0, 1 }));
  EXPECT_FALSE(rays.cast({ 0.5, 0.5, 5 }, { 0, 0, -1 }, 5.5));
}

TEST(RayCaster, OneTriangleSaysWhereItIsMet)
{
  MeshBuilder builder;
  builder.triangle({ 0, 0, 1 }, { 4, 0, 1 }, { 0, 2, 1 }, Material::Wall);
  const TriangleMesh mesh = builder.take();
  const Hit hit = RayCaster(mesh).cast({ 1, 0.5, 0 }, { 0, 0, 0.5 });
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit.distance, 2.0); // in units of half a metre
  EXPECT_EQ(hit.b, 0.25);
  EXPECT_EQ(hit.c, 0.25);
}
} // namespace
} // namespace pointfront::truth
