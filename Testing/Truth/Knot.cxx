#include "TruthScene.h"

#include "RandomStream.h"

namespace pointfront::truth
{
namespace
{
constexpr int turns = 800; // vertices along the knot
constexpr int sides = 80; // and around its tube
constexpr double extent = 10.0;

/// The trefoil knot, which winds twice around and three times through a torus.
glm::dvec3 trefoil(double t)
{
  const double distance = 2.0 + std::cos(3.0 * t);
  return { distance * std::cos(2.0 * t), distance * std::sin(2.0 * t), 1.1 * std::sin(3.0 * t) };
}

glm::dvec3 tangent(double t)
{
  const double distance = 2.0 + std::cos(3.0 * t);
  const double change = -3.0 * std::sin(3.0 * t);
  return { change * std::cos(2.0 * t) - 2.0 * distance * std::sin(2.0 * t),
    change * std::sin(2.0 * t) + 2.0 * distance * std::cos(2.0 * t), 3.3 * std::cos(3.0 * t) };
}

/// Bumps of two sizes; whole numbers of them each way, so that the surface closes.
double tubeRadius(double t, double around)
{
  return 0.52 + 0.05 * std::sin(24.0 * t) * std::cos(3.0 * around) +
    0.018 * std::sin(70.0 * t + 5.0 * around) * std::cos(9.0 * around);
}
} // namespace

TruthScene makeKnot()
{
  TruthScene scene;
  scene.name = "knot";
  TriangleMesh& mesh = scene.mesh;
  for (int i = 0; i < turns; ++i)
  {
    const double t = 2.0 * pi * i / turns;
    const glm::dvec3 along = glm::normalize(tangent(t));
    const glm::dvec3 u = glm::normalize(glm::cross(along, glm::dvec3(0, 0, 1)));
    const glm::dvec3 v = glm::cross(along, u);
    for (int j = 0; j < sides; ++j)
    {
      const double around = 2.0 * pi * j / sides;
      mesh.vertices.push_back(
        trefoil(t) + tubeRadius(t, around) * (std::cos(around) * u + std::sin(around) * v));
    }
  }
  const auto vertex = [](int i, int j) { return std::uint32_t((i % turns) * sides + j % sides); };
  for (int i = 0; i < turns; ++i)
  {
    for (int j = 0; j < sides; ++j)
    {
      const std::uint32_t a = vertex(i, j);
      const std::uint32_t b = vertex(i, j + 1);
      const std::uint32_t c = vertex(i + 1, j + 1);
      const std::uint32_t d = vertex(i + 1, j);
      mesh.triangles.push_back({ a, b, c });
      mesh.triangles.push_back({ a, c, d });
    }
  }
  mesh.materials.assign(mesh.triangles.size(), Material::Marble);
  const glm::dvec3 size = mesh.bounds().size();
  const double scale = extent / std::max({ size.x, size.y, size.z });
  const glm::dvec3 centre = mesh.bounds().centre();
  for (glm::dvec3& place : mesh.vertices)
  {
    place = scale * (place - centre);
  }
  mesh.smoothNormals();
  const glm::dvec3 up(0, 0, 1);
  scene.views = {
    { "far", { { 17, -33, 31 }, { 0, 0, 0 }, up, 40.0 }, false },
    { "mid", { { 5.3, -10.3, 9.7 }, { 0, 0, 0 }, up, 40.0 }, false },
    { "close", { { 3.2, -5.2, 3.4 }, { 1.2, -1.6, 0 }, up, 40.0 }, false },
    { "graze", { { 6.5, -4.5, 2.1 }, { -1, 1, 0 }, up, 40.0 }, true },
  };
  return scene;
}

} // namespace pointfront::truth
