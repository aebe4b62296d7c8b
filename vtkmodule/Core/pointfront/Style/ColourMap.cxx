#include "pointfront/Style/ColourMap.h"

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{

/// An entry begins that share of its width early. Heights of flat ground lie on a bound between two
/// entries as often as not, the middle of their range is one; so both back ends give them the upper
/// entry, however they round. So near to a whole number a value counts as one, too: 57 steps of 0.1
/// miss it. Twin: entriesBegin of ColourMapTexture.glsl.
constexpr double early = 1.0 / 512.0;

} // namespace

Rgba8 ColourMap::at(double value) const
{
  if (std::isnan(value))
  {
    return missing;
  }
  const auto last = static_cast<double>(entries.size() - 1);
  if (indexed)
  {
    const double place = value - range[0];
    const double code = std::floor(place + 0.5);
    const bool known = std::abs(place - code) <= early && code >= 0.0 && code <= last;
    return known ? entries[static_cast<std::size_t>(code)] : missing;
  }
  if (value < range[0] && usesBelow)
  {
    return below;
  }
  if (value > range[1] && usesAbove)
  {
    return above;
  }
  const double unit = std::isfinite(range[1] - range[0]) ? 1.0 : 0.5;
  const auto scaled = [&](double v) { return logarithmic ? std::log10(v) : unit * v; };
  const double width = scaled(range[1]) - scaled(range[0]);
  const double clamped = std::clamp(value, range[0], std::max(range[0], range[1]));
  const double share = width > 0.0 ? (scaled(clamped) - scaled(range[0])) / width : 0.0;
  const double place = std::floor(share * static_cast<double>(entries.size()) + early);
  return entries[static_cast<std::size_t>(std::clamp(place, 0.0, last))];
}

} // namespace pointfront
