#pragma once

#include "pointfront/Style/ResolvedStyle.h"

#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// A measure over the scenes of the curve.
struct CurveRange
{
  double least = 0.0;
  double middle = 0.0; ///< the median
  double most = 0.0;
};

/// A technique at an error, as docs/tradeoffs.md measured it: complete pictures in the colours of
/// the points, against the truth, inside its silhouette.
struct CurvePlace
{
  const char* technique; ///< as in docs/tradeoffs/curve.csv
  double errorPx;
  CurveRange psnr; ///< dB
  CurveRange ssim;
  CurveRange off; ///< share of the pixels that are off by more than 8 of 255, 0 to 1
  // On the machine of that page:
  CurveRange frameMs; ///< median frame of an orbit
  CurveRange completeMs; ///< from the start of the tool to the complete picture
  CurveRange megabytes; ///< read for it, 10^6 bytes
  CurveRange peakMiB; ///< the most memory that the tool held
};

/// All places, technique by technique, finest error first. `curve_source.py` writes them from
/// docs/tradeoffs/curve.csv.
const std::vector<CurvePlace>& qualityCurve();
/// How many scenes each range is of.
int curveScenes();
/// "docs/tradeoffs.md, 6 scenes": the source of what is told of a picture.
std::string curveSource();

/// The technique by which styles draw, in the words of the curve. Add each style that draws.
class MeasuredTechnique
{
public:
  void add(const ResolvedStyle& style);
  /// Empty: nothing was added, not all are the same, or the curve has none of them. Translucent
  /// styles, lenses, walls, sizes other than those of the curve and spheres were not measured.
  const std::string& name() const { return name_; }

private:
  std::string name_;
  bool any_ = false;
};

/// How far a picture is from the truth, by the curve: between its places by the logarithm of the
/// error. Nothing for another technique and beyond the coarsest error; below the finest error that
/// one counts, as does 0, which says that all points in sight are drawn.
/// `place.technique` and `place.errorPx` say what the numbers are of.
std::optional<CurvePlace> expectedDifference(const std::string& technique, double errorPx);

} // namespace pointfront
