#pragma once

#include "pointfront/Style/ColourMap.h"

#include <vector>

namespace pointfront
{

/// 256 steps from dark violet over green to yellow, of even perceived difference and monotonic
/// lightness, safe for colour-blind readers (viridis; Smith & van der Walt, 2015).
std::vector<Rgba8> viridisColours();
/// 256 greys, black to white.
std::vector<Rgba8> greyColours();
/// One colour for each class code 0 to 255 of the ASPRS LAS 1.4 table (ground brown, vegetation
/// green, building red, water blue ...); codes without a meaning are grey.
std::vector<Rgba8> classificationColours();
/// 256 steps through the given colours (one at least) at equal distances, linear between two.
std::vector<Rgba8> coloursBetween(const std::vector<Rgba8>& stops);

} // namespace pointfront
