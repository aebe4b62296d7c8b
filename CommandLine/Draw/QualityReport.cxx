#include "QualityReport.h"

#include "Command.h"

#include "pointfront/Quality/QualityCurve.h"

#include <nlohmann/json.hpp>

namespace pointfront
{
namespace
{

nlohmann::ordered_json rangeJson(const CurveRange& range)
{
  return { range.least, range.middle, range.most };
}

nlohmann::ordered_json expectedJson(const std::string& technique, double errorPx)
{
  const auto expected = expectedDifference(technique, errorPx);
  if (!expected)
  {
    return {};
  }
  nlohmann::ordered_json object;
  object["technique"] = technique;
  object["error_px"] = expected->errorPx;
  object["psnr"] = rangeJson(expected->psnr);
  object["ssim"] = rangeJson(expected->ssim);
  object["share_over_8"] = rangeJson(expected->off);
  object["source"] = curveSource();
  return object;
}

} // namespace

void tellQuality(const std::string& command, const DrawingOptions& drawing)
{
  if (drawing.quality && drawing.quality->reached)
  {
    complain(command, drawing.quality->sentence);
  }
  else if (drawing.quality)
  {
    warn(command, drawing.quality->sentence);
  }
}

void addQuality(
  nlohmann::ordered_json& statistics, const DrawingOptions& drawing, const FrameRecord& last)
{
  if (drawing.quality)
  {
    const QualityChoice& choice = *drawing.quality;
    statistics["quality"] = { { "asked", drawing.qualityAsked },
      { "technique", choice.place->technique }, { "error_px", choice.place->errorPx },
      { "ssim", rangeJson(choice.place->ssim) }, { "frame_ms", rangeJson(choice.place->frameMs) },
      { "reached", choice.reached }, { "source", curveSource() } };
  }
  statistics["expected"] = expectedJson(last.technique, last.errorPx);
}

} // namespace pointfront
