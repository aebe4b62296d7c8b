#include "pointfront/Quality/QualityCurve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pointfront
{
namespace
{

/// Pixels of a square in the curve's pictures of plain points.
constexpr double measuredPointPx = 2.0;

bool closesSurface(const ResolvedStyle& style)
{
  return style.size.mode == SplatSize::Mode::Spacing && style.size.value == 1.0;
}

std::string splatsOf(const ResolvedStyle& style)
{
  const bool oriented = style.orientation == SplatOrientation::Normal && style.normalColumn;
  const bool blended = style.blended || style.technique == Technique::Ewa;
  const bool affine = style.accuracy == SplatAccuracy::Affine;
  if (!closesSurface(style) || style.orientation == SplatOrientation::Fixed ||
    (!oriented && blended))
  {
    return {};
  }
  if (!oriented)
  {
    return "discs";
  }
  if (style.technique == Technique::Ewa && style.accuracy == SplatAccuracy::Full)
  {
    return "ewa full";
  }
  return !affine                        ? std::string()
    : style.technique == Technique::Ewa ? "ewa"
    : blended                           ? "blended"
                                        : "ellipses";
}

std::string techniqueOf(const ResolvedStyle& style)
{
  if (style.lens >= 0 || style.group != 0 || style.opacity < 1.0 || style.highlight != 0)
  {
    return {};
  }
  if (style.technique == Technique::Points)
  {
    const bool measured =
      style.size.mode == SplatSize::Mode::Pixels && style.size.value == measuredPointPx;
    return measured ? "points" : closesSurface(style) ? "flat discs" : std::string();
  }
  const bool splats = style.technique == Technique::Splats || style.technique == Technique::Ewa;
  return splats ? splatsOf(style) : std::string();
}

CurveRange between(const CurveRange& fine, const CurveRange& coarse, double share)
{
  const auto mix = [share](double a, double b) { return a + share * (b - a); };
  return { mix(fine.least, coarse.least), mix(fine.middle, coarse.middle),
    mix(fine.most, coarse.most) };
}

} // namespace

std::string curveSource()
{
  return "docs/tradeoffs.md, " + std::to_string(curveScenes()) + " scenes";
}

void MeasuredTechnique::add(const ResolvedStyle& style)
{
  const std::string technique = techniqueOf(style);
  name_ = any_ && name_ != technique ? std::string() : technique;
  any_ = true;
}

std::optional<CurvePlace> expectedDifference(const std::string& technique, double errorPx)
{
  const std::vector<CurvePlace>& curve = qualityCurve();
  const auto isIt = [&](const CurvePlace& place) { return technique == place.technique; };
  const auto first = std::find_if(curve.begin(), curve.end(), isIt);
  const auto end = std::find_if_not(first, curve.end(), isIt);
  if (first == end || !(errorPx <= (end - 1)->errorPx))
  {
    return std::nullopt;
  }
  const auto coarse =
    std::find_if(first, end, [&](const CurvePlace& place) { return place.errorPx >= errorPx; });
  if (coarse == first)
  {
    return *first;
  }
  const CurvePlace& fine = *(coarse - 1);
  const double share = std::log(errorPx / fine.errorPx) / std::log(coarse->errorPx / fine.errorPx);
  const auto of = [&](CurveRange CurvePlace::*column)
  { return between(fine.*column, (*coarse).*column, share); };
  return CurvePlace{ fine.technique, errorPx, of(&CurvePlace::psnr), of(&CurvePlace::ssim),
    of(&CurvePlace::off), of(&CurvePlace::frameMs), of(&CurvePlace::completeMs),
    of(&CurvePlace::megabytes), of(&CurvePlace::peakMiB) };
}

} // namespace pointfront
