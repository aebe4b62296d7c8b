#include "TruthScene.h"

#include "RandomStream.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>

namespace pointfront::truth
{
namespace
{
constexpr double halfWidth = 100.0; // metres
constexpr int groundCells = 100; // along each axis
constexpr double plotWidth = 28.0;
constexpr int plots = 7; // along each axis

double groundHeight(double x, double y)
{
  return 0.05 * x + 0.02 * y + 0.8 * std::sin(0.045 * x) * std::cos(0.037 * y);
}

glm::dvec3 onGround(double x, double y, double above = 0.0)
{
  return { x, y, groundHeight(x, y) + above };
}

void addGround(MeshBuilder& mesh)
{
  const auto corner = [](int i, int j)
  {
    return onGround(-halfWidth + 2.0 * halfWidth * i / groundCells,
      -halfWidth + 2.0 * halfWidth * j / groundCells);
  };
  for (int j = 0; j < groundCells; ++j)
  {
    for (int i = 0; i < groundCells; ++i)
    {
      mesh.quad(
        corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1), Material::Ground);
    }
  }
}

/// Four walls, two gables and a roof that stands out by half a metre.
void addHouse(MeshBuilder& mesh, const glm::dvec2& centre, RandomStream& random)
{
  const double a = random.uniform(3.5, 6.0); // half of the width
  const double b = random.uniform(3.5, 6.5); // half of the length
  const double wall = random.uniform(3.0, 8.0);
  const double rise = random.uniform(1.5, 3.5);
  const double angle = random.uniform(-0.3, 0.3);
  const double floor = groundHeight(centre.x, centre.y) - 0.8;
  const auto at = [&](double x, double y, double z)
  {
    return glm::dvec3(centre.x + std::cos(angle) * x - std::sin(angle) * y,
      centre.y + std::sin(angle) * x + std::cos(angle) * y, floor + z);
  };
  const glm::dvec2 corners[4] = { { -a, -b }, { a, -b }, { a, b }, { -a, b } };
  for (int side = 0; side < 4; ++side)
  {
    const glm::dvec2& p = corners[side];
    const glm::dvec2& q = corners[(side + 1) % 4];
    mesh.quad(
      at(p.x, p.y, 0), at(q.x, q.y, 0), at(q.x, q.y, wall), at(p.x, p.y, wall), Material::Wall);
  }
  const double top = wall + rise;
  mesh.triangle(at(-a, -b, wall), at(a, -b, wall), at(0, -b, top), Material::Wall);
  mesh.triangle(at(a, b, wall), at(-a, b, wall), at(0, b, top), Material::Wall);
  const double out = 0.5;
  const double eaves = wall - rise * out / a;
  mesh.quad(at(-a - out, -b - out, eaves), at(0, -b - out, top), at(0, b + out, top),
    at(-a - out, b + out, eaves), Material::Roof);
  mesh.quad(at(a + out, -b - out, eaves), at(a + out, b + out, eaves), at(0, b + out, top),
    at(0, -b - out, top), Material::Roof);
}

/// In the unit ball, thinner towards the middle, as leaves are.
glm::dvec3 placeInCrown(RandomStream& random)
{
  for (;;)
  {
    const double x = random.uniform(-1.0, 1.0);
    const double y = random.uniform(-1.0, 1.0);
    const glm::dvec3 place(x, y, random.uniform(-1.0, 1.0));
    const double squared = glm::dot(place, place);
    if (squared <= 1.0 && squared >= 0.25 * random.uniform())
    {
      return place;
    }
  }
}

void addTree(MeshBuilder& mesh, const glm::dvec2& place, RandomStream& random)
{
  const double trunk = random.uniform(2.0, 4.0);
  const double radius = random.uniform(1.6, 3.0);
  const double halfHeight = radius * random.uniform(1.0, 2.0);
  const glm::dvec3 crown = onGround(place.x, place.y, trunk + halfHeight);
  mesh.tube(onGround(place.x, place.y, -0.3), crown, 0.18, 7, Material::Trunk);
  const int leaves = int(260.0 * radius * radius);
  for (int leaf = 0; leaf < leaves; ++leaf)
  {
    const glm::dvec3 centre = crown + placeInCrown(random) * glm::dvec3(radius, radius, halfHeight);
    const glm::dvec3 along = random.direction();
    const glm::dvec3 across = glm::normalize(glm::cross(along, random.direction()));
    const double size = random.uniform(0.12, 0.28);
    const glm::dvec3 back = centre - 0.5 * size * along;
    mesh.triangle(centre + size * along, back + 0.8 * size * across, back - 0.8 * size * across,
      Material::Leaf);
  }
}

void addPlots(MeshBuilder& mesh, RandomStream& random)
{
  const double first = -0.5 * plotWidth * (plots - 1);
  for (int j = 0; j < plots; ++j)
  {
    for (int i = 0; i < plots; ++i)
    {
      const double x = first + plotWidth * i + random.uniform(-2.5, 2.5);
      const glm::dvec2 centre(x, first + plotWidth * j + random.uniform(-2.5, 2.5));
      if (random.uniform() < 0.85)
      {
        addHouse(mesh, centre, random);
      }
      const int trees = int(random.uniform(0.0, 2.6));
      for (int tree = 0; tree < trees; ++tree)
      {
        const double angle = random.uniform(0.0, 2.0 * pi);
        addTree(mesh, centre + 9.5 * glm::dvec2(std::cos(angle), std::sin(angle)), random);
      }
    }
  }
}

/// Poles every 28 m, and two wires that hang from one to the next.
void addPowerLine(MeshBuilder& mesh, double y)
{
  const double height = 8.0;
  const int pieces = 12; // pieces of a wire between two poles
  std::optional<glm::dvec3> before;
  for (int pole = 0; pole < 8; ++pole)
  {
    const double x = -98.0 + plotWidth * pole;
    mesh.tube(onGround(x, y, -0.3), onGround(x, y, height), 0.10, 8, Material::Metal);
    const glm::dvec3 arm = onGround(x, y, height - 0.5);
    mesh.tube(arm - glm::dvec3(0, 1, 0), arm + glm::dvec3(0, 1, 0), 0.06, 6, Material::Metal);
    const glm::dvec3 top = onGround(x, y, height - 0.4);
    for (double aside : { -0.9, 0.9 })
    {
      const auto hanging = [&](int piece)
      {
        const double t = double(piece) / pieces;
        const glm::dvec3 straight = glm::mix(*before, top, t);
        return straight + glm::dvec3(0, aside, -3.6 * t * (1.0 - t));
      };
      for (int piece = 0; before && piece < pieces; ++piece)
      {
        mesh.tube(hanging(piece), hanging(piece + 1), 0.025, 4, Material::Metal);
      }
    }
    before = top;
  }
}
} // namespace

TruthScene makeTown()
{
  RandomStream random(7);
  MeshBuilder mesh;
  addGround(mesh);
  addPlots(mesh, random);
  for (double y : { -68.0, -20.96, 26.08, 73.12 })
  {
    addPowerLine(mesh, y);
  }
  TruthScene scene;
  scene.name = "town";
  scene.mesh = mesh.take();
  const glm::dvec3 up(0, 0, 1);
  scene.views = {
    { "far", { { -190, -190, 130 }, { 0, 0, 0 }, up, 45.0 }, false },
    { "mid", { { -62, -66, 38 }, { 0, 0, 2 }, up, 45.0 }, true },
    { "close", { onGround(-24, -30, 6), onGround(-8, -4, 3), up, 45.0 }, true },
    { "graze", { onGround(-72, 13.5, 2.2), onGround(40, 20, 1.5), up, 45.0 }, true },
  };
  return scene;
}

} // namespace pointfront::truth
