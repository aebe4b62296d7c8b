#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// Red, green, blue: one entry for each step from the low to the high end of a range.
using ColourTable = std::vector<std::array<std::uint8_t, 3>>;

/// 256 steps from dark violet over green to yellow, of even perceived difference and monotonic
/// lightness, safe for colour-blind readers (viridis; Smith & van der Walt, 2015).
ColourTable viridisTable();
/// 256 greys, black to white.
ColourTable greyTable();
/// One colour for each class code 0 to 255 of the ASPRS LAS 1.4 table (ground brown, vegetation
/// green, building red, water blue ...); codes without a meaning are grey.
ColourTable classificationTable();

} // namespace pointfront
