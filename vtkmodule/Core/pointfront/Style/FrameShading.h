#pragma once

#include "pointfront/Style/FrameLens.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pointfront
{

/// A light as deferred lighting uses it. Places and directions are those of view space.
struct FrameLight
{
  static constexpr float noCone = -2.0f;

  glm::vec3 towards{ 0.0f, 0.0f, 1.0f }; ///< unit, from the surface to a light that is far away
  glm::vec3 colour{ 1.0f }; ///< intensity included
  bool positional = false; ///< it shines from `place`; what follows is for such lights
  glm::vec3 place{ 0.0f };
  glm::vec3 aim{ 0.0f, 0.0f, -1.0f }; ///< unit: the middle of its cone
  float coneCosine = noCone; ///< cosine of the angle between aim and the cone's rim
  float exponent = 1.0f; ///< in a cone it fades as the cosine of the angle from aim, to this power
  glm::vec3 attenuation{ 1.0f, 0.0f, 0.0f }; ///< divides by a + b * distance + c * distance^2

  friend bool operator==(const FrameLight& a, const FrameLight& b)
  {
    return a.towards == b.towards && a.colour == b.colour && a.positional == b.positional &&
      a.place == b.place && a.aim == b.aim && a.coneCosine == b.coneCosine &&
      a.exponent == b.exponent && a.attenuation == b.attenuation;
  }
};

/// How pixels of highlighted points are drawn (ResolvedStyle::highlight).
struct FrameHighlight
{
  glm::vec3 colour{ 1.0f };
  float haloPx = 0.0f; ///< around them, on what lies behind them
  float tint = 0.0f; ///< 0 to 1: of their own colour, how much is this one

  friend bool operator==(const FrameHighlight& a, const FrameHighlight& b)
  {
    return a.colour == b.colour && a.haloPx == b.haloPx && a.tint == b.tint;
  }
};

/// A filled pixel depends on its own block of that many pixels a side and on the blocks around.
constexpr int holeFillerReach = 8;

/// How the pixels of a style's points are shaded.
struct FrameLook
{
  /// Diffuse light on pixels with a normal (two-sided); pixels without a normal keep their colour.
  bool lit = false;
  float ambient = 0.3f;
  float diffuse = 0.7f;
  /// Eye-dome lighting on log2 of depth (after Boucheny 2009): 0 is off. Pixels darken by exp(-300
  /// * strength * response): the response is how far, in octaves of depth, a pixel lies behind the
  /// mean of two neighbours on opposite sides, over four such pairs: 0 on planes. The neighbours
  /// may be of any look.
  float eyeDomeStrength = 0.0f;
  float eyeDomeRadiusPx = 1.0f;

  friend bool operator==(const FrameLook& a, const FrameLook& b)
  {
    return a.lit == b.lit && a.ambient == b.ambient && a.diffuse == b.diffuse &&
      a.eyeDomeStrength == b.eyeDomeStrength && a.eyeDomeRadiusPx == b.eyeDomeRadiusPx;
  }
};

/// The work on a frame's pixels after all points are drawn. Its own look is number 0.
struct FrameShading : FrameLook
{
  /// Looks 1, 2, ...: ResolvedStyle::look says which one a style's points have.
  std::vector<FrameLook> furtherLooks;
  std::vector<FrameLight> lights; ///< empty: one at the eye
  /// Pull-push over depth and colour: pixels that no point covers, and those through which a
  /// farther surface shows, take their neighbours' colour where these agree in depth.
  bool fillHoles = false;
  /// The places where points of ResolvedStyle::lens are seen instead of others; a later lens lies
  /// on top.
  std::vector<FrameLens> lenses;
  std::vector<FrameHighlight> highlights; ///< at most mostHighlights

  std::size_t lookCount() const { return 1 + furtherLooks.size(); }
  const FrameLook& look(std::size_t number) const
  {
    return number == 0 || number > furtherLooks.size() ? *this : furtherLooks[number - 1];
  }
  bool anyLit() const
  {
    return lit ||
      std::any_of(
        furtherLooks.begin(), furtherLooks.end(), [](const FrameLook& one) { return one.lit; });
  }
  bool anyEyeDome() const
  {
    return eyeDomeStrength > 0.0f ||
      std::any_of(furtherLooks.begin(), furtherLooks.end(),
        [](const FrameLook& one) { return one.eyeDomeStrength > 0.0f; });
  }

  /// How far from a pixel light, highlights and hole filling look. Light and highlights look at
  /// filled pixels, too.
  int reachPx() const
  {
    int reach = 0;
    for (std::size_t number = 0; number < lookCount(); ++number)
    {
      const FrameLook& one = look(number);
      reach = one.eyeDomeStrength > 0.0f
        ? std::max(reach, static_cast<int>(std::ceil(one.eyeDomeRadiusPx)) + 1)
        : reach;
    }
    for (const FrameHighlight& one : highlights)
    {
      reach = std::max(reach, static_cast<int>(std::ceil(one.haloPx)) + 1);
    }
    return fillHoles ? reach + 2 * holeFillerReach - 1 : reach;
  }

  friend bool operator==(const FrameShading& a, const FrameShading& b)
  {
    return static_cast<const FrameLook&>(a) == static_cast<const FrameLook&>(b) &&
      a.furtherLooks == b.furtherLooks && a.lights == b.lights && a.fillHoles == b.fillHoles;
  }
};

} // namespace pointfront
