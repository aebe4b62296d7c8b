#include "ColourTable.h"

#include <cmath>

namespace pointfront
{

namespace
{
std::uint8_t mixed(std::uint8_t a, std::uint8_t b, double share)
{
  return static_cast<std::uint8_t>(std::lround(a + (b - a) * share));
}
} // namespace

ColourTable viridisTable()
{
  // Seventeen samples of the map; between them it is straight to within one level in 255.
  static const std::uint8_t samples[17][3] = { { 68, 1, 84 }, { 72, 24, 106 }, { 71, 45, 123 },
    { 66, 64, 134 }, { 59, 82, 139 }, { 51, 99, 141 }, { 44, 114, 142 }, { 38, 130, 142 },
    { 33, 145, 140 }, { 31, 160, 136 }, { 40, 174, 128 }, { 63, 188, 115 }, { 94, 201, 98 },
    { 132, 212, 75 }, { 173, 220, 48 }, { 216, 226, 25 }, { 253, 231, 37 } };
  ColourTable table(256);
  for (std::size_t i = 0; i < table.size(); ++i)
  {
    const double position = 16.0 * static_cast<double>(i) / 255.0;
    const auto first = i == 255 ? std::size_t(15) : static_cast<std::size_t>(position);
    for (std::size_t channel = 0; channel < 3; ++channel)
    {
      table[i][channel] = mixed(samples[first][channel], samples[first + 1][channel],
        position - static_cast<double>(first));
    }
  }
  return table;
}

ColourTable greyTable()
{
  ColourTable table;
  for (int i = 0; i < 256; ++i)
  {
    const auto level = static_cast<std::uint8_t>(i);
    table.push_back({ level, level, level });
  }
  return table;
}

ColourTable classificationTable()
{
  // Codes 0 to 18 of the ASPRS LAS 1.4 specification, table 17.
  static const std::uint8_t standard[19][3] = {
    { 160, 160, 160 }, // created, never classified
    { 190, 190, 190 }, // unclassified
    { 165, 120, 75 }, // ground
    { 150, 205, 110 }, // low vegetation
    { 85, 170, 70 }, // medium vegetation
    { 30, 120, 45 }, // high vegetation
    { 205, 60, 50 }, // building
    { 225, 70, 200 }, // low point (noise)
    { 220, 200, 150 }, // reserved (model key point)
    { 55, 120, 215 }, // water
    { 120, 85, 60 }, // rail
    { 95, 95, 105 }, // road surface
    { 225, 205, 60 }, // reserved (overlap)
    { 245, 225, 100 }, // wire: guard
    { 250, 190, 40 }, // wire: conductor
    { 235, 140, 30 }, // transmission tower
    { 245, 165, 95 }, // wire: structure connector
    { 150, 95, 175 }, // bridge deck
    { 255, 90, 160 }, // high noise
  };
  ColourTable table(256, { 130, 130, 130 });
  for (std::size_t code = 0; code < 19; ++code)
  {
    table[code] = { standard[code][0], standard[code][1], standard[code][2] };
  }
  return table;
}

} // namespace pointfront
