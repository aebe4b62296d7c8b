#pragma once

#include "pointfront/Style/ColourMap.h"
#include "pointfront/Style/ColourSource.h"
#include "pointfront/Style/FilterExpression.h"
#include "pointfront/Style/ResolvedStyle.h"

#include <glm/vec3.hpp>

#include <array>
#include <optional>
#include <string>

namespace pointfront
{

/// How large a splat is, by name (SplatSize has the meaning).
struct StyleSize
{
  SplatSize::Mode mode = SplatSize::Mode::Spacing;
  double value = 1.0; ///< > 0: pixels, world units, or a factor
  std::string attribute; ///< Attribute: of one component; empty: enclosing_radius

  friend bool operator==(const StyleSize& a, const StyleSize& b)
  {
    return a.mode == b.mode && a.value == b.value && a.attribute == b.attribute;
  }
};

/// Which way discs face.
struct StyleOrientation
{
  SplatOrientation mode = SplatOrientation::Automatic;
  glm::dvec3 direction{ 0.0, 0.0, 1.0 }; ///< Fixed: not 0, world axes

  friend bool operator==(const StyleOrientation& a, const StyleOrientation& b)
  {
    return a.mode == b.mode && a.direction == b.direction;
  }
};

constexpr double mostLight = 10.0; ///< ambient, diffuse
constexpr double mostEyeDomeStrength = 100.0;
constexpr double mostEyeDomeRadiusPx = 64.0;

/// Light on a style's points; what is unset is as in StyleSheet::shading.
struct StyleLight
{
  bool on = true;
  std::optional<float> ambient;
  std::optional<float> diffuse;

  friend bool operator==(const StyleLight& a, const StyleLight& b)
  {
    return a.on == b.on && a.ambient == b.ambient && a.diffuse == b.diffuse;
  }
};

/// Eye-dome lighting of a style's points; what is unset is as in StyleSheet::shading.
struct StyleEyeDome
{
  bool on = true;
  std::optional<float> strength;
  std::optional<float> radiusPx;

  friend bool operator==(const StyleEyeDome& a, const StyleEyeDome& b)
  {
    return a.on == b.on && a.strength == b.strength && a.radiusPx == b.radiusPx;
  }
};

/// How one object class is drawn, before any store is known. Unset members come from the style
/// below it: below a class is the sheet's default, below that standardStyle().
/// Threads  a value.
struct LayerStyle
{
  std::optional<Technique> technique;
  std::optional<ColourSource> colour;
  std::optional<StyleSize> size;
  std::optional<StyleOrientation> orientation;
  std::optional<double> opacity; ///< 0 to 1
  std::optional<bool> visible; ///< false: neither loaded nor drawn
  std::optional<double> errorFactor; ///< > 0: 2 draws half as fine (LayerLimits)
  /// 0 to 1: of the points and the memory, before other classes (LayerLimits::share).
  std::optional<double> budgetShare;
  std::optional<bool> blended; ///< splats: two passes with weights
  std::optional<SplatAccuracy> accuracy;
  std::optional<Rgba8> rim; ///< silhouettes
  std::optional<std::array<Rgba8, 2>> wall; ///< solid: upper and lower end; else as the points
  std::optional<FilterExpression> where; ///< in the place of the default's
  /// Only points of that epoch of a collection, besides `where`; "": those of tiles without one.
  std::optional<std::string> epoch;
  std::optional<StyleLight> light; ///< else StyleSheet::shading's; spheres are lit
  std::optional<StyleEyeDome> eyeDome; ///< else StyleSheet::shading's

  /// The style with its unset members taken from `below`.
  LayerStyle over(const LayerStyle& below) const;
  bool empty() const { return *this == LayerStyle(); }

  friend bool operator==(const LayerStyle& a, const LayerStyle& b)
  {
    return a.technique == b.technique && a.colour == b.colour && a.size == b.size &&
      a.orientation == b.orientation && a.opacity == b.opacity && a.visible == b.visible &&
      a.errorFactor == b.errorFactor && a.budgetShare == b.budgetShare && a.blended == b.blended &&
      a.accuracy == b.accuracy && a.rim == b.rim && a.wall == b.wall && a.where == b.where &&
      a.epoch == b.epoch && a.light == b.light && a.eyeDome == b.eyeDome;
  }
  friend bool operator!=(const LayerStyle& a, const LayerStyle& b) { return !(a == b); }
};

/// The style without any setting: points that close the surface, in the colour that tells most.
/// Every member but `wall`, `epoch`, `light` and `eyeDome` is set.
LayerStyle standardStyle();

} // namespace pointfront
