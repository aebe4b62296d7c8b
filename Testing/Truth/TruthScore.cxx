#include "TruthScore.h"

#include "pointfront/Picture/PictureComparison.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace pointfront::truth
{
namespace
{
constexpr std::uint8_t half = 128;
constexpr std::uint8_t full = 255;
constexpr double toleranceSpacings = 2.0;
constexpr double leastCosine = 0.25;
constexpr double mostDepthError = 4.0; // spacings

/// Cosine between the surface at a pixel's centre and its ray; 1 where nothing is there.
double cosineAt(const TruthPicture& truth, const PixelRays& pixels, std::size_t index)
{
  if (truth.normal[index] == glm::vec3(0.0f))
  {
    return 1.0;
  }
  const glm::dvec3 ray =
    pixels.through(double(index % pixels.width()) + 0.5, double(index / pixels.width()) + 0.5);
  return std::abs(glm::dot(glm::dvec3(truth.normal[index]), glm::normalize(ray)));
}
} // namespace

Result<TruthScore> scoreAgainst(const TruthPicture& truth, const PixelRays& pixels,
  const SpacingGrade& grade, const Picture& drawn, const std::vector<float>& drawnDepth)
{
  assert(drawnDepth.size() == truth.depth.size());
  const Picture mask = truth.mask();
  ComparisonOptions options;
  options.mask = &mask;
  options.background = background;
  const auto compared = comparePictures(drawn, truth.colours, options);
  if (!compared)
  {
    return compared.error();
  }
  std::size_t covered = 0;
  std::size_t holes = 0;
  std::size_t inFront = 0;
  std::size_t outside = 0;
  std::size_t measured = 0;
  double squares = 0.0;
  for (std::size_t i = 0; i < drawnDepth.size(); ++i)
  {
    outside += truth.coverage[i] == 0 && std::isfinite(drawnDepth[i]) ? 1 : 0;
    if (truth.coverage[i] != full)
    {
      continue;
    }
    ++covered;
    const bool known = std::isfinite(truth.depth[i]); // the centre may see through a gap
    const double h = grade.at(known ? truth.depth[i] : truth.farthest[i]);
    const double tolerance =
      toleranceSpacings * h / std::max(leastCosine, cosineAt(truth, pixels, i));
    const bool hole = drawnDepth[i] > truth.farthest[i] + tolerance;
    const bool front = drawnDepth[i] < truth.nearest[i] - tolerance;
    holes += hole ? 1 : 0;
    inFront += front ? 1 : 0;
    if (!hole && !front && known)
    {
      const double error =
        std::min(std::abs(double(drawnDepth[i]) - truth.depth[i]) / h, mostDepthError);
      squares += error * error;
      ++measured;
    }
  }
  const auto percent = [](std::size_t part, std::size_t whole)
  { return whole == 0 ? 0.0 : 100.0 * double(part) / double(whole); };
  TruthScore score;
  score.psnr = compared->psnrDecibels;
  score.ssim = compared->ssim;
  score.holes = percent(holes, covered);
  score.innerBloat = percent(inFront, covered);
  score.bloat = percent(outside, std::size_t(compared->pixels));
  score.depthError = measured == 0 ? 0.0 : std::sqrt(squares / double(measured));
  return score;
}

} // namespace pointfront::truth
