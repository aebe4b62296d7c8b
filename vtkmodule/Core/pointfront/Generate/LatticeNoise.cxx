#include "pointfront/Generate/LatticeNoise.h"

#include <cmath>

namespace pointfront
{
namespace
{
double smooth(double t)
{
  return t * t * (3.0 - 2.0 * t);
}
double mix(double a, double b, double t)
{
  return a + (b - a) * t;
}
} // namespace

double latticeNoise(std::uint64_t seed, double x, double y)
{
  const double fx = std::floor(x);
  const double fy = std::floor(y);
  const auto i = static_cast<std::int64_t>(fx);
  const auto j = static_cast<std::int64_t>(fy);
  const double tx = smooth(x - fx);
  const double ty = smooth(y - fy);
  const double low = mix(unitOf(hashOfCell(seed, i, j)), unitOf(hashOfCell(seed, i + 1, j)), tx);
  const double high =
    mix(unitOf(hashOfCell(seed, i, j + 1)), unitOf(hashOfCell(seed, i + 1, j + 1)), tx);
  return mix(low, high, ty);
}

double fractalNoise(std::uint64_t seed, double x, double y, int octaves)
{
  double sum = 0.0;
  double weight = 0.5;
  double total = 0.0;
  for (int octave = 0; octave < octaves; ++octave)
  {
    sum += weight * latticeNoise(seed + static_cast<std::uint64_t>(octave), x, y);
    total += weight;
    weight *= 0.5;
    x = 2.0 * x + 17.0; // the shift keeps lattice points of the octaves apart
    y = 2.0 * y + 31.0;
  }
  return sum / total;
}

} // namespace pointfront
