#include "pointfront/Style/StandardColours.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace pointfront
{
namespace
{

constexpr std::size_t steps = 256;
constexpr std::uint8_t opaque = 255;

std::uint8_t mixed(std::uint8_t a, std::uint8_t b, double share)
{
  return static_cast<std::uint8_t>(std::lround(a + (b - a) * share));
}

} // namespace

std::vector<Rgba8> coloursBetween(const std::vector<Rgba8>& stops)
{
  assert(!stops.empty());
  std::vector<Rgba8> colours(steps, stops.front());
  const std::size_t last = stops.size() - 1;
  for (std::size_t i = 0; last > 0 && i < steps; ++i)
  {
    const double position =
      static_cast<double>(last) * static_cast<double>(i) / static_cast<double>(steps - 1);
    const std::size_t first = std::min(static_cast<std::size_t>(position), last - 1);
    for (std::size_t channel = 0; channel < 4; ++channel)
    {
      colours[i][channel] = mixed(
        stops[first][channel], stops[first + 1][channel], position - static_cast<double>(first));
    }
  }
  return colours;
}

std::vector<Rgba8> viridisColours()
{
  // Seventeen samples of the map; between them it is straight to within one level in 255.
  return coloursBetween({ { 68, 1, 84, opaque }, { 72, 24, 106, opaque }, { 71, 45, 123, opaque },
    { 66, 64, 134, opaque }, { 59, 82, 139, opaque }, { 51, 99, 141, opaque },
    { 44, 114, 142, opaque }, { 38, 130, 142, opaque }, { 33, 145, 140, opaque },
    { 31, 160, 136, opaque }, { 40, 174, 128, opaque }, { 63, 188, 115, opaque },
    { 94, 201, 98, opaque }, { 132, 212, 75, opaque }, { 173, 220, 48, opaque },
    { 216, 226, 25, opaque }, { 253, 231, 37, opaque } });
}

std::vector<Rgba8> greyColours()
{
  return coloursBetween({ { 0, 0, 0, opaque }, { 255, 255, 255, opaque } });
}

std::vector<Rgba8> classificationColours()
{
  std::vector<Rgba8> colours(steps, { 130, 130, 130, opaque });
  // Codes 0 to 18 of the ASPRS LAS 1.4 specification, table 17.
  const Rgba8 standard[] = {
    { 160, 160, 160, opaque }, // created, never classified
    { 190, 190, 190, opaque }, // unclassified
    { 165, 120, 75, opaque }, // ground
    { 150, 205, 110, opaque }, // low vegetation
    { 85, 170, 70, opaque }, // medium vegetation
    { 30, 120, 45, opaque }, // high vegetation
    { 205, 60, 50, opaque }, // building
    { 225, 70, 200, opaque }, // low point (noise)
    { 220, 200, 150, opaque }, // reserved (model key point)
    { 55, 120, 215, opaque }, // water
    { 120, 85, 60, opaque }, // rail
    { 95, 95, 105, opaque }, // road surface
    { 225, 205, 60, opaque }, // reserved (overlap)
    { 245, 225, 100, opaque }, // wire: guard
    { 250, 190, 40, opaque }, // wire: conductor
    { 235, 140, 30, opaque }, // transmission tower
    { 245, 165, 95, opaque }, // wire: structure connector
    { 150, 95, 175, opaque }, // bridge deck
    { 255, 90, 160, opaque }, // high noise
  };
  std::copy(std::begin(standard), std::end(standard), colours.begin());
  return colours;
}

} // namespace pointfront
