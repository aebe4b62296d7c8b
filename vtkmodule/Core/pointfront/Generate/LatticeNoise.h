#pragma once

#include <cstdint>

namespace pointfront
{

/// A stateless random number: the same key gives the same value on every machine and thread.
/// Source  the finaliser of SplitMix64 (Steele, Lea, Flood 2014).
inline std::uint64_t hashOf(std::uint64_t key)
{
  key += 0x9e3779b97f4a7c15ull;
  key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9ull;
  key = (key ^ (key >> 27)) * 0x94d049bb133111ebull;
  return key ^ (key >> 31);
}

/// In [0, 1), from the upper 53 bits.
inline double unitOf(std::uint64_t hash)
{
  return static_cast<double>(hash >> 11) * 0x1.0p-53;
}

/// The hash of a lattice cell.
inline std::uint64_t hashOfCell(std::uint64_t seed, std::int64_t i, std::int64_t j)
{
  return hashOf(hashOf(seed ^ static_cast<std::uint64_t>(i)) ^
    (static_cast<std::uint64_t>(j) * 0x9e3779b97f4a7c15ull));
}

/// Smooth value noise in [0, 1]: lattice values of spacing 1, interpolated with 3t^2 - 2t^3, so the
/// surface has a continuous slope.
double latticeNoise(std::uint64_t seed, double x, double y);

/// Sum of `octaves` of latticeNoise, each of half the wavelength and half the height; in [0, 1].
double fractalNoise(std::uint64_t seed, double x, double y, int octaves);

} // namespace pointfront
