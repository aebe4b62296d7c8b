#include "pointfront/Generate/TerrainModel.h"

#include "pointfront/Generate/LatticeNoise.h"

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{
constexpr double waterLevel = 38.0; // metres; about a tenth of the ground lies below
constexpr double plotSize = 36.0; // a building plot
constexpr double treeCell = 7.0; // at most one tree a cell
constexpr double townWavelength = 900.0; // decides between town and country
constexpr double woodWavelength = 260.0;

// Streams of random numbers that must not repeat each other.
constexpr std::uint64_t townStream = 101;
constexpr std::uint64_t plotStream = 211;
constexpr std::uint64_t woodStream = 307;
constexpr std::uint64_t treeStream = 401;
constexpr std::uint64_t shadeStream = 503;

/// In [0, 1): independent values out of one cell's hash.
double draw(std::uint64_t cell, std::uint64_t index)
{
  return unitOf(hashOf(cell + index));
}

std::uint8_t channel(double value)
{
  return static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0));
}
} // namespace

double TerrainModel::groundHeight(double x, double y) const
{
  // Hills of some 150 m over kilometres, fields of some metres, furrows of centimetres.
  const double hills = fractalNoise(seed_, x / 1800.0, y / 1800.0, 5);
  const double fields = latticeNoise(seed_ + 40, x / 23.0, y / 23.0);
  return 150.0 * hills * hills + 1.2 * fields;
}

TerrainModel::Roof TerrainModel::roofAt(double x, double y) const
{
  const double town = latticeNoise(seed_ + townStream, x / townWavelength, y / townWavelength);
  if (town < 0.55)
  {
    return {};
  }
  const auto i = static_cast<std::int64_t>(std::floor(x / plotSize));
  const auto j = static_cast<std::int64_t>(std::floor(y / plotSize));
  const std::uint64_t plot = hashOfCell(seed_ + plotStream, i, j);
  if (draw(plot, 0) > 0.72)
  {
    return {}; // a garden
  }
  const double halfX = 5.0 + 8.0 * draw(plot, 1);
  const double halfY = 5.0 + 8.0 * draw(plot, 2);
  const double dx = x - (static_cast<double>(i) + 0.5) * plotSize;
  const double dy = y - (static_cast<double>(j) + 0.5) * plotSize;
  const double insideX = halfX - std::abs(dx);
  const double insideY = halfY - std::abs(dy);
  if (insideX < 0.0 || insideY < 0.0)
  {
    return {};
  }
  Roof roof;
  roof.hit = true;
  roof.height = 4.0 + 3.0 * std::floor(5.0 * town * draw(plot, 3));
  if (draw(plot, 4) < 0.6)
  {
    roof.height += 0.7 * std::min(insideX, 6.0); // gabled, the ridge along y
  }
  roof.wall = std::min(insideX, insideY) < 0.15;
  return roof;
}

double TerrainModel::crownAt(double x, double y) const
{
  const double wood = latticeNoise(seed_ + woodStream, x / woodWavelength, y / woodWavelength);
  const auto i = static_cast<std::int64_t>(std::floor(x / treeCell));
  const auto j = static_cast<std::int64_t>(std::floor(y / treeCell));
  const std::uint64_t cell = hashOfCell(seed_ + treeStream, i, j);
  // Dense in woods, single trees elsewhere.
  if (draw(cell, 0) > (wood > 0.6 ? 0.9 : 0.08))
  {
    return 0.0;
  }
  const double radius = 1.5 + 2.0 * draw(cell, 1);
  const double cx = (static_cast<double>(i) + 0.3 + 0.4 * draw(cell, 2)) * treeCell;
  const double cy = (static_cast<double>(j) + 0.3 + 0.4 * draw(cell, 3)) * treeCell;
  const double distance = std::hypot(x - cx, y - cy);
  if (distance >= radius)
  {
    return 0.0;
  }
  const double height = 6.0 + 14.0 * draw(cell, 4);
  return height * (0.45 + 0.55 * std::sqrt(1.0 - distance * distance / (radius * radius)));
}

TerrainModel::Echo TerrainModel::echoAt(double x, double y, double chance) const
{
  const double ground = groundHeight(x, y);
  Echo echo;
  if (ground < waterLevel)
  {
    echo.height = waterLevel;
    echo.objectClass = Water;
    return echo;
  }
  echo.height = ground;
  if (const Roof roof = roofAt(x, y); roof.hit)
  {
    echo.objectClass = Building;
    echo.height += roof.wall ? roof.height * chance : roof.height;
    return echo;
  }
  const double crown = crownAt(x, y);
  if (crown > 0.0)
  {
    // 60 % from the crown's surface, 25 % from inside it, the rest through to the ground.
    if (chance < 0.85)
    {
      const double inside = chance < 0.6 ? 1.0 : 0.3 + 2.8 * (chance - 0.6);
      echo.height += crown * inside;
      echo.objectClass = HighVegetation;
      echo.returnNumber = chance < 0.6 ? 1 : 2;
      echo.returnCount = 3;
      return echo;
    }
    echo.returnNumber = 3;
    echo.returnCount = 3;
    return echo;
  }
  const double meadow = latticeNoise(seed_ + woodStream + 1, x / 60.0, y / 60.0);
  if (meadow > 0.62 && chance < 0.35)
  {
    echo.height += 0.2 + 1.2 * chance;
    echo.objectClass = LowVegetation;
  }
  return echo;
}

glm::u8vec3 TerrainModel::colourOf(const Echo& echo, double x, double y, double grain) const
{
  const double shade = 0.8 + 0.2 * grain;
  switch (echo.objectClass)
  {
    case Water:
      return { channel(40 * shade), channel(78 * shade), channel(112 * shade) };
    case Building:
    {
      const auto i = static_cast<std::int64_t>(std::floor(x / plotSize));
      const auto j = static_cast<std::int64_t>(std::floor(y / plotSize));
      const double tile = draw(hashOfCell(seed_ + plotStream, i, j), 5);
      const glm::dvec3 roof = tile < 0.5 ? glm::dvec3(170, 88, 66) : glm::dvec3(150, 150, 158);
      return { channel(roof.r * shade), channel(roof.g * shade), channel(roof.b * shade) };
    }
    case HighVegetation:
      return { channel(48 * shade), channel(96 * shade), channel(40 * shade) };
    case LowVegetation:
      return { channel(96 * shade), channel(134 * shade), channel(60 * shade) };
    case Ground:
      break;
  }
  // Fields differ from each other; bare soil to grass.
  const double field = latticeNoise(seed_ + shadeStream, x / 140.0, y / 140.0);
  return { channel((168 - 70 * field) * shade), channel((150 - 20 * field) * shade),
    channel((110 - 46 * field) * shade) };
}

} // namespace pointfront
