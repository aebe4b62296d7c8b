#include "pointfront/Quality/QualityChoice.h"

#include "pointfront/Base/NearestName.h"
#include "pointfront/Base/NumberText.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

namespace pointfront
{
namespace
{

/// The techniques that are chosen from. Others are never better: ewa draws what blended does, and
/// discs are what ellipses are without normals.
struct Offered
{
  std::string_view name;
  Technique technique;
  bool blended;
  SplatAccuracy accuracy;
};
constexpr std::array<Offered, 3> offered{ {
  { "ellipses", Technique::Splats, false, SplatAccuracy::Affine },
  { "blended", Technique::Splats, true, SplatAccuracy::Affine },
  { "ewa full", Technique::Ewa, true, SplatAccuracy::Full },
} };

const Offered* offeredOf(const CurvePlace& place)
{
  const auto found = std::find_if(offered.begin(), offered.end(),
    [&](const Offered& one) { return one.name == place.technique; });
  return found == offered.end() ? nullptr : &*found;
}

/// The best of the offered places by `better`, of those that `fits` if there are any.
template <typename Fits, typename Better, typename Nearer>
QualityChoice best(const Fits& fits, const Better& better, const Nearer& nearer)
{
  QualityChoice choice;
  choice.reached = false;
  for (const CurvePlace& place : qualityCurve())
  {
    if (!offeredOf(place))
    {
      continue;
    }
    const bool fit = fits(place);
    const bool takes = !choice.place || (fit && !choice.reached) ||
      (fit == choice.reached &&
        (fit ? better(place, *choice.place) : nearer(place, *choice.place)));
    if (takes)
    {
      choice.place = place;
      choice.reached = fit;
    }
  }
  return choice;
}

QualityChoice told(QualityChoice choice, const std::string& asked)
{
  const CurvePlace& place = *choice.place;
  const Offered& one = *offeredOf(place);
  choice.preset = { place.technique, one.technique, one.blended, one.accuracy, place.errorPx };
  choice.sentence = "quality " + asked + ": " + place.technique + " at " +
    numberText(place.errorPx, 6) + " px" +
    (choice.reached ? "" : ", the nearest that was measured") + "; SSIM " +
    decimalText(place.ssim.least, 3) + " to " + decimalText(place.ssim.most, 3) +
    ", in the middle " + decimalText(place.ssim.middle, 3) + "; a frame " +
    decimalText(place.frameMs.least, 0) + " to " + decimalText(place.frameMs.most, 0) +
    " ms there (" + curveSource() + ")";
  return choice;
}

/// The number that begins `text`, if `unit` is all that follows.
std::optional<double> numberOf(const std::string& text, const char* unit)
{
  std::string_view rest(text);
  const double value = takeNumber(rest);
  return rest == unit && std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

} // namespace

Result<QualityChoice> chooseQuality(const std::string& asked)
{
  if (const QualityPreset* const preset = qualityPresetOf(asked))
  {
    return QualityChoice{ *preset, std::nullopt, true, "" };
  }
  const auto faster = [](const CurvePlace& a, const CurvePlace& b)
  { return a.frameMs.middle < b.frameMs.middle; };
  const auto truer = [](const CurvePlace& a, const CurvePlace& b)
  { return a.ssim.middle > b.ssim.middle; };
  if (const auto ssim = numberOf(asked, ""); ssim && *ssim > 0.0 && *ssim <= 1.0)
  {
    return told(
      best([&](const CurvePlace& place) { return place.ssim.middle >= *ssim; }, faster, truer),
      asked);
  }
  if (const auto ms = numberOf(asked, "ms"); ms && *ms > 0.0)
  {
    const auto shorter = [](const CurvePlace& a, const CurvePlace& b)
    { return a.frameMs.most < b.frameMs.most; };
    return told(
      best([&](const CurvePlace& place) { return place.frameMs.most <= *ms; }, truer, shorter),
      asked);
  }
  std::vector<std::string> presets;
  for (const QualityPreset& preset : qualityPresets)
  {
    presets.emplace_back(preset.name);
  }
  return makeError(Error::Kind::BadArgument,
    "'" + asked +
      "' is no quality: use draft, balanced, exact, an SSIM above 0 and up to 1 (0.95), or "
      "milliseconds of a frame (33ms)" +
      didYouMean(asked, presets));
}

} // namespace pointfront
