#include "HoleFiller.h"
#include "SharedSums.h"
#include "SoftwareRasteriser.h"

#include "pointfront/Threads/ThreadCrew.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace pointfront
{
namespace
{

/// The look of the style that is in the pixel.
const FrameLook& lookAt(
  const FrameShading& shading, const SoftwareTarget& target, std::size_t pixel)
{
  return target.looks.empty() ? shading : shading.look(target.looks[pixel]);
}

/// Changes the colour of each pixel that shows something by `factors(pixel, x, y)`.
template <typename Factors>
void scaleColours(SoftwareTarget& target, const Factors& factors)
{
  ThreadCrew::ofProcess().run(static_cast<std::size_t>(target.height),
    [&](std::size_t y, unsigned)
    {
      for (int x = 0; x < target.width; ++x)
      {
        const std::size_t pixel =
          y * static_cast<std::size_t>(target.width) + static_cast<std::size_t>(x);
        if (target.depth[pixel] == std::numeric_limits<float>::infinity())
        {
          continue;
        }
        const glm::vec3 factor = factors(pixel, x, static_cast<int>(y));
        std::uint8_t bytes[4];
        std::memcpy(bytes, &target.rgba[pixel], 4);
        for (int c = 0; c < 3; ++c)
        {
          const float scaled = static_cast<float>(bytes[c]) * factor[c] + 0.5f;
          bytes[c] = static_cast<std::uint8_t>(std::clamp(scaled, 0.0f, 255.0f));
        }
        std::memcpy(&target.rgba[pixel], bytes, 4);
      }
    });
}

/// The place in view space that a pixel's centre shows at a depth: the inverse of any frustum.
glm::vec3 placeAt(const FrameCamera& camera, int x, int y, float depth)
{
  const glm::dmat4& m = camera.viewToClip;
  const double w = m[3][3] - m[2][3] * depth;
  const glm::dvec2 size(camera.width, camera.height);
  const glm::dvec2 clip = (2.0 * glm::dvec2(x + 0.5, y + 0.5) / size - 1.0) * w;
  return { (clip.x + m[2][0] * depth - m[3][0]) / m[0][0],
    (clip.y + m[2][1] * depth - m[3][1]) / m[1][1], -depth };
}

/// A light that nothing weakens, by its numbers, is as bright as can be where it shines.
constexpr float leastFall = 1.0e-30f;

/// The light that a positional lamp gives to a surface: 0 on the side that it does not reach.
float brightness(const FrameLight& light, const glm::vec3& place, const glm::vec3& normal)
{
  const glm::vec3 from = place - light.place;
  const float distance = std::max(glm::length(from), std::numeric_limits<float>::min());
  const glm::vec3 ray = from / distance;
  const float fall = light.attenuation.x + light.attenuation.y * distance +
    light.attenuation.z * distance * distance;
  float share = std::max(-glm::dot(normal, ray), 0.0f) / std::max(fall, leastFall);
  if (light.coneCosine != FrameLight::noCone)
  {
    const float cosine = glm::dot(ray, light.aim);
    share *= cosine >= light.coneCosine ? std::pow(std::max(cosine, 0.0f), light.exponent) : 0.0f;
  }
  return share;
}

void light(const FrameCamera& camera, const FrameShading& shading, SoftwareTarget& target)
{
  std::vector<FrameLight> lights = shading.lights;
  if (lights.empty())
  {
    lights.emplace_back(); // at the eye
  }
  scaleColours(target,
    [&](std::size_t pixel, int x, int y)
    {
      const float* const n = &target.normals[3 * pixel];
      const FrameLook& look = lookAt(shading, target, pixel);
      if (!look.lit || (n[0] == 0.0f && n[1] == 0.0f && n[2] == 0.0f))
      {
        return glm::vec3(1.0f);
      }
      glm::vec3 sum(look.ambient);
      for (const FrameLight& one : lights)
      {
        const float facing = n[0] * one.towards.x + n[1] * one.towards.y + n[2] * one.towards.z;
        const float share = one.positional
          ? brightness(one,
              placeAt(camera, target.left + x, target.bottom + y, target.depth[pixel]),
              { n[0], n[1], n[2] })
          : std::max(facing, 0.0f);
        sum += one.colour * (look.diffuse * share);
      }
      return sum;
    });
}

/// Depths as logarithms; a parallel view's count from its near plane plus the height of what it
/// shows, since where its eye lies says nothing.
std::vector<float> octavesOf(const FrameCamera& camera, const SoftwareTarget& target)
{
  const glm::dmat4& clip = camera.viewToClip;
  const double nearDepth = (clip[3][2] + clip[3][3]) / (clip[2][2] + clip[2][3]);
  const auto offset =
    static_cast<float>(camera.parallel ? camera.wholeWorldHeight() - nearDepth : 0.0);
  std::vector<float> octaves(target.depth.size());
  ThreadCrew::ofProcess().run(static_cast<std::size_t>(target.height),
    [&](std::size_t y, unsigned)
    {
      const std::size_t begin = y * static_cast<std::size_t>(target.width);
      for (std::size_t p = begin; p < begin + static_cast<std::size_t>(target.width); ++p)
      {
        octaves[p] = std::log2(std::max(target.depth[p] + offset, 1e-30f));
      }
    });
  return octaves;
}

/// A pixel darkens by how far it lies behind the mean of two neighbours that face each other across
/// it: nothing on a plane, however it is tilted; behind edges and in creases much.
void eyeDome(const FrameCamera& camera, const FrameShading& shading, SoftwareTarget& target)
{
  const std::vector<float> octaves = octavesOf(camera, target);
  const auto octaveAt = [&](int x, int y, float own)
  {
    if (x < 0 || y < 0 || x >= target.width || y >= target.height)
    {
      return own;
    }
    const std::int64_t pixel = std::int64_t(y) * target.width + x;
    const float found = octaves[static_cast<std::size_t>(pixel)];
    return std::isinf(found) ? own : found;
  };
  scaleColours(target,
    [&](std::size_t pixel, int x, int y)
    {
      const FrameLook& look = lookAt(shading, target, pixel);
      if (!(look.eyeDomeStrength > 0.0f))
      {
        return glm::vec3(1.0f);
      }
      const int reach = std::max(1, static_cast<int>(std::lround(look.eyeDomeRadiusPx)));
      const int pairs[4][2] = { { reach, 0 }, { 0, reach }, { reach, reach }, { reach, -reach } };
      const float own = octaves[pixel];
      float response = 0.0f;
      for (const auto& pair : pairs)
      {
        const float between =
          octaveAt(x + pair[0], y + pair[1], own) + octaveAt(x - pair[0], y - pair[1], own);
        response += std::max(0.0f, own - 0.5f * between);
      }
      return glm::vec3(std::exp(-eyeDomeGain * look.eyeDomeStrength * 0.25f * response));
    });
}

} // namespace

void shade(const FrameCamera& camera, const FrameShading& shading, SoftwareTarget& target,
  PictureExchange* others)
{
  if (target.width == 0 || target.height == 0)
  {
    return;
  }
  if (shading.anyLit() && !target.normals.empty())
  {
    light(camera, shading, target);
  }
  if (others)
  {
    // Also where this process drew nothing: all exchange the same.
    target.looks.resize(shading.lookCount() > 1 ? target.depth.size() : 0);
    target.highlights.resize(shading.highlights.empty() ? 0 : target.depth.size());
    sharePicture(*others, target);
  }
  // From what is lit: a filled pixel has no normal of its own.
  if (shading.fillHoles && !target.keepPoints) // filled pixels are no points
  {
    fillHoles(camera, target);
  }
  if (shading.anyEyeDome())
  {
    eyeDome(camera, shading, target);
  }
}

} // namespace pointfront
