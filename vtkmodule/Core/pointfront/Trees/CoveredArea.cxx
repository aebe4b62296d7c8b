#include "pointfront/Trees/CoveredArea.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace pointfront
{
namespace
{
using Cube = std::array<std::uint32_t, 3>;

constexpr std::uint32_t topBits = 20; ///< the box has so many halvings
/// Cubes that hold eight points on average: those of a closed surface then have few gaps.
constexpr std::size_t pointsACube = 8;

/// Distinct places of at most CoveredArea::mostLookedAt points in their box, a cube of 2^topBits
/// places along each edge.
struct Places
{
  std::vector<Cube> cubes;
  double edge = 0.0; ///< the box's, world units
};

Places placesIn(const std::vector<TreePosition>& positions, const glm::dvec3& scale)
{
  Places places;
  TreePosition low(std::numeric_limits<std::uint32_t>::max());
  TreePosition high(0);
  const std::size_t step = 1 + (positions.size() - 1) / CoveredArea::mostLookedAt;
  for (std::size_t i = 0; i < positions.size(); i += step)
  {
    low = glm::min(low, positions[i]);
    high = glm::max(high, positions[i]);
  }
  const glm::dvec3 size = glm::dvec3(high - low) * scale;
  places.edge = std::max({ size.x, size.y, size.z });
  for (std::size_t i = 0; i < positions.size() && places.edge > 0.0; i += step)
  {
    const glm::dvec3 share = glm::dvec3(positions[i] - low) * scale / places.edge;
    const glm::uvec3 cube(share * double((std::uint32_t(1) << topBits) - 1));
    places.cubes.push_back({ cube.x, cube.y, cube.z });
  }
  std::sort(places.cubes.begin(), places.cubes.end());
  places.cubes.erase(std::unique(places.cubes.begin(), places.cubes.end()), places.cubes.end());
  return places;
}

/// How many cubes of 2^bits places along each edge hold places; `flat`: squares.
std::size_t countOf(const std::vector<Cube>& places, std::uint32_t bits, bool flat)
{
  std::vector<Cube> cubes;
  cubes.reserve(places.size());
  for (const Cube& place : places)
  {
    cubes.push_back({ place[0] >> bits, place[1] >> bits, flat ? 0 : place[2] >> bits });
  }
  std::sort(cubes.begin(), cubes.end());
  return static_cast<std::size_t>(std::unique(cubes.begin(), cubes.end()) - cubes.begin());
}
} // namespace

CoveredArea CoveredArea::of(const std::vector<TreePosition>& positions, const glm::dvec3& scale)
{
  CoveredArea area;
  if (positions.empty())
  {
    return area;
  }
  const Places places = placesIn(positions, scale);
  for (std::uint32_t bits = topBits; !places.cubes.empty() && bits-- > 0;)
  {
    const std::size_t cubes = countOf(places.cubes, bits, false);
    if (cubes * pointsACube >= places.cubes.size())
    {
      const double edge = std::ldexp(places.edge, int(bits) - int(topBits));
      area.surface = double(cubes) * edge * edge;
      area.fromAbove = double(countOf(places.cubes, bits, true)) * edge * edge;
      return area;
    }
  }
  return area;
}

} // namespace pointfront
