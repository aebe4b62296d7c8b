#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Quality/QualityCurve.h"
#include "pointfront/Style/QualityPreset.h"

#include <optional>
#include <string>

namespace pointfront
{

/// The meaning of what was asked of --quality and SetQuality().
struct QualityChoice
{
  QualityPreset preset{}; ///< its name is that of a preset, or the technique's of the curve
  /// The chosen place on the curve, if a number was asked.
  std::optional<CurvePlace> place;
  bool reached = true; ///< false: no place on the curve has what was asked; this is the nearest
  std::string sentence; ///< for the user, where a number was asked
};

/// A preset's name; or an SSIM, "0.95": the fastest place on the curve whose middle scene has it;
/// or milliseconds, "33ms": the place nearest to the truth whose median frame took no longer in any
/// scene. Times are those of the machine of docs/tradeoffs.md.
/// Errors  BadArgument for anything else.
Result<QualityChoice> chooseQuality(const std::string& asked);

} // namespace pointfront
