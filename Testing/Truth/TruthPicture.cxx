#include "TruthPicture.h"

#include "ParallelRows.h"
#include "SolidTexture.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <limits>

namespace pointfront::truth
{
namespace
{
constexpr float nothing = std::numeric_limits<float>::infinity();
constexpr std::uint32_t medianRows = 120;

glm::dvec3 colourOfHit(const TriangleMesh& mesh, const glm::dvec3& place, const Hit& hit)
{
  return surfaceColour(
    mesh.materials[hit.triangle], place, mesh.normalAt(hit.triangle, hit.b, hit.c), hit.triangle);
}

/// 0 and 255 for none and all only.
std::uint8_t coverageCode(unsigned hits, unsigned samples)
{
  if (hits == 0 || hits == samples)
  {
    return hits == 0 ? 0 : 255;
  }
  return std::uint8_t(std::clamp(hits * 255u / samples, 1u, 254u));
}

void drawPixel(const RayCaster& rays, const PixelRays& pixels, unsigned samples,
  std::uint32_t column, std::uint32_t row, TruthPicture& picture)
{
  const std::size_t index = std::size_t(row) * pixels.width() + column;
  const glm::dvec3 empty(background[0], background[1], background[2]);
  glm::dvec3 sum(0.0);
  unsigned hits = 0;
  float farthest = 0.0f;
  for (unsigned j = 0; j < samples; ++j)
  {
    for (unsigned i = 0; i < samples; ++i)
    {
      const glm::dvec3 ray =
        pixels.through(column + (i + 0.5) / samples, row + (j + 0.5) / samples);
      const Hit hit = rays.cast(pixels.eye(), ray);
      sum += hit ? colourOfHit(rays.mesh(), pixels.eye() + hit.distance * ray, hit) : empty;
      hits += hit ? 1 : 0;
      picture.nearest[index] = std::min(picture.nearest[index], float(hit.distance));
      farthest = hit ? std::max(farthest, float(hit.distance)) : farthest;
    }
  }
  const auto colour = toBytes(sum / double(samples * samples));
  std::copy(colour.begin(), colour.end(), picture.colours.rgba.begin() + std::ptrdiff_t(4 * index));
  picture.coverage[index] = coverageCode(hits, samples * samples);
  picture.farthest[index] = hits != 0 ? farthest : nothing;

  const glm::dvec3 ray = pixels.through(column + 0.5, row + 0.5);
  if (const Hit hit = rays.cast(pixels.eye(), ray))
  {
    const glm::dvec3 normal = rays.mesh().faceNormal(hit.triangle);
    picture.depth[index] = float(hit.distance);
    picture.normal[index] = glm::vec3(glm::dot(normal, ray) > 0.0 ? -normal : normal);
  }
}
} // namespace

Picture TruthPicture::mask() const
{
  Picture mask{ colours.width, colours.height, {} };
  mask.rgba.reserve(4 * coverage.size());
  for (std::uint8_t value : coverage)
  {
    mask.rgba.insert(mask.rgba.end(), { value, value, value, 255 });
  }
  return mask;
}

TruthPicture drawTruth(
  const RayCaster& rays, const PixelRays& pixels, unsigned samples, unsigned threads)
{
  assert(samples > 0);
  TruthPicture picture;
  const std::size_t count = std::size_t(pixels.width()) * pixels.height();
  picture.colours = { pixels.width(), pixels.height(), std::vector<std::uint8_t>(4 * count, 255) };
  picture.coverage.resize(count);
  picture.depth.assign(count, nothing);
  picture.nearest.assign(count, nothing);
  picture.farthest.assign(count, nothing);
  picture.normal.assign(count, glm::vec3(0.0f));
  forEachRow(pixels.height(), threads,
    [&](std::size_t row)
    {
      for (std::uint32_t column = 0; column < pixels.width(); ++column)
      {
        drawPixel(rays, pixels, samples, column, std::uint32_t(row), picture);
      }
    });
  return picture;
}

double medianDepth(const RayCaster& rays, const TruthCamera& camera, double aspect)
{
  const PixelRays pixels(camera, std::uint32_t(medianRows * aspect), medianRows);
  std::vector<double> depths;
  for (std::uint32_t row = 0; row < pixels.height(); ++row)
  {
    for (std::uint32_t column = 0; column < pixels.width(); ++column)
    {
      if (const Hit hit = rays.cast(pixels.eye(), pixels.through(column + 0.5, row + 0.5)))
      {
        depths.push_back(hit.distance);
      }
    }
  }
  assert(!depths.empty());
  const auto middle = depths.begin() + std::ptrdiff_t(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  return *middle;
}

} // namespace pointfront::truth
