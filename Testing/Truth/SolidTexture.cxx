#include "SolidTexture.h"

#include "pointfront/Generate/LatticeNoise.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace pointfront::truth
{
namespace
{
constexpr double roadDistance = 28.0; // metres between the middles of two roads

/// A number in [0, 1) for a cell of a lattice.
double cellValue(std::int64_t i, std::int64_t j, std::int64_t k)
{
  return unitOf(hashOfCell(hashOf(static_cast<std::uint64_t>(k)), i, j));
}

/// Smooth noise in [0, 1) with one value a metre.
double noise(const glm::dvec3& p)
{
  const glm::dvec3 cell = glm::floor(p);
  const glm::dvec3 t = p - cell;
  const glm::dvec3 s = t * t * (3.0 - 2.0 * t);
  const auto i = std::int64_t(cell.x);
  const auto j = std::int64_t(cell.y);
  const auto k = std::int64_t(cell.z);
  double layers[2] = {};
  for (std::int64_t up = 0; up < 2; ++up)
  {
    const double near = glm::mix(cellValue(i, j, k + up), cellValue(i + 1, j, k + up), s.x);
    const double far = glm::mix(cellValue(i, j + 1, k + up), cellValue(i + 1, j + 1, k + up), s.x);
    layers[up] = glm::mix(near, far, s.y);
  }
  return glm::mix(layers[0], layers[1], s.z);
}

double fraction(double x)
{
  return x - std::floor(x);
}

/// Distance to the middle of the nearest of the roads that run along the other axis.
double fromRoad(double x)
{
  return std::abs(x - roadDistance * (std::floor(x / roadDistance) + 0.5));
}

glm::dvec3 ground(const glm::dvec3& p)
{
  const double coarse = noise(0.12 * p);
  const double fine = noise(4.0 * p);
  const double fromX = fromRoad(p.x);
  const double fromY = fromRoad(p.y);
  const double distance = std::min(fromX, fromY);
  if (distance >= 3.0)
  {
    const glm::dvec3 grassOrEarth = glm::mix(
      glm::dvec3(96, 122, 60), glm::dvec3(150, 132, 88), glm::smoothstep(0.35, 0.65, coarse));
    return grassOrEarth * (0.6 + 0.25 * noise(1.1 * p) + 0.25 * fine);
  }
  if (distance > 2.6)
  {
    return { 165, 160, 150 }; // kerb
  }
  const double along = fromX < fromY ? p.y : p.x;
  if (distance < 0.12 && fraction(along / 4.0) < 0.5)
  {
    return { 225, 225, 220 }; // the broken line in the middle
  }
  return glm::dvec3(92, 92, 98) * (0.85 + 0.2 * fine);
}

glm::dvec3 wall(const glm::dvec3& p)
{
  const double house =
    cellValue(std::lround(p.x / roadDistance), std::lround(p.y / roadDistance), 3);
  const double across = (p.x + p.y) / 2.6;
  const double up = p.z / 2.8;
  const bool window =
    std::abs(across - std::round(across)) < 0.2 && std::abs(up - std::round(up)) < 0.22;
  const glm::dvec3 colour = window
    ? glm::dvec3(45, 55, 70)
    : glm::mix(glm::dvec3(205, 190, 160), glm::dvec3(180, 120, 100), house);
  return colour * (0.9 + 0.1 * noise(3.0 * p));
}

glm::dvec3 roof(const glm::dvec3& p)
{
  const double tile = fraction(2.2 * p.z) < 0.25 ? 0.7 : 1.0;
  return glm::dvec3(168, 74, 52) * (0.75 + 0.25 * noise(2.5 * p)) * tile;
}

glm::dvec3 marble(const glm::dvec3& p)
{
  const double phase = 6.2831853 * (0.55 * p.x + 0.45 * p.y + 0.7 * p.z) + 5.0 * noise(0.9 * p);
  glm::dvec3 colour = glm::mix(glm::dvec3(214, 190, 150), glm::dvec3(60, 95, 140),
    glm::smoothstep(-0.15, 0.15, std::sin(phase)));
  colour *= (0.55 + 0.45 * noise(5.0 * p)) * (0.75 + 0.25 * noise(14.0 * p));
  const bool spot = noise(2.2 * p + 9.0) > 0.72;
  return spot ? glm::mix(colour, glm::dvec3(190, 50, 40), 0.8) : colour;
}

glm::dvec3 paint(Material material, const glm::dvec3& p, std::size_t triangle)
{
  switch (material)
  {
    case Material::Ground:
      return ground(p);
    case Material::Wall:
      return wall(p);
    case Material::Roof:
      return roof(p);
    case Material::Leaf:
      return glm::mix(
        glm::dvec3(48, 92, 34), glm::dvec3(120, 150, 60), cellValue(std::int64_t(triangle), 17, 5));
    case Material::Trunk:
      return glm::dvec3(100, 76, 52) * (0.7 + 0.3 * noise(6.0 * p));
    case Material::Metal:
      return { 150, 150, 155 };
    case Material::Marble:
      return marble(p);
  }
  return {};
}
} // namespace

glm::dvec3 surfaceColour(
  Material material, const glm::dvec3& position, const glm::dvec3& normal, std::size_t triangle)
{
  const glm::dvec3 sun = glm::normalize(glm::dvec3(0.5, -0.35, 0.8));
  double cosine = glm::dot(normal, sun);
  cosine = material == Material::Leaf ? std::abs(cosine) : std::max(cosine, 0.0);
  return paint(material, position, triangle) * (0.5 + 0.5 * cosine);
}

std::array<std::uint8_t, 3> toBytes(const glm::dvec3& colour)
{
  const glm::dvec3 rounded = glm::clamp(glm::floor(colour + 0.5), 0.0, 255.0);
  return { std::uint8_t(rounded.x), std::uint8_t(rounded.y), std::uint8_t(rounded.z) };
}

} // namespace pointfront::truth
