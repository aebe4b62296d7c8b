#pragma once

#include "pointfront/Store/NodeReader.h"
#include "pointfront/Style/ColourCombination.h"
#include "pointfront/Style/ColourMap.h"
#include "pointfront/Style/PointColouring.h"
#include "pointfront/Style/PointFilter.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

namespace pointfront
{

/// How points become pixels. The same names in C++, JSON, the tool and ParaView.
enum class Technique : std::uint8_t
{
  Points, ///< squares of a number of pixels; of other sizes flat discs that face the eye
  Splats, ///< discs in object space: ellipses by the normal, paraboloids without one
  Spheres, ///< hemispheres, depth and normal exact in each pixel (LAYERS-5)
  Silhouettes, ///< splats with a rim of its own colour, pushed back in depth (LAYERS-6)
  Solid, ///< quads from a point down to the terrain (LAYERS-7)
  Ewa ///< splats blended in two passes with a screen-space low-pass (EWA-6)
};

/// How exactly an ellipse is drawn (EWA-5).
enum class SplatAccuracy : std::uint8_t
{
  Affine, ///< the ellipse of the disc's affine approximation at its centre
  Exact, ///< ray and disc in each pixel
  Full ///< Exact with a low-pass that filters what is smaller than a pixel
};

/// How large a splat is (docs/user/styles.md).
struct SplatSize
{
  /// A surface's splats are drawn no larger than that share of the picture's height: nearer to
  /// the eye there is no surface to be seen.
  static constexpr float mostOfHeight = 0.125f;

  enum class Mode : std::uint8_t
  {
    Pixels, ///< diameter, pixels
    World, ///< diameter, world units
    Spacing, ///< the radius that closes the surface times `value`
    Attribute ///< the radius that `column` holds, world units, times `value`
  };
  Mode mode = Mode::Spacing;
  double value = 1.0;
  std::uint32_t column = 0; ///< Attribute

  friend bool operator==(const SplatSize& a, const SplatSize& b)
  {
    return a.mode == b.mode && a.value == b.value && a.column == b.column;
  }
};

/// Which way a disc faces.
enum class SplatOrientation : std::uint8_t
{
  Normal, ///< the point's normal if it has one, else View
  View, ///< towards the eye
  Fixed, ///< one vector for all
  /// In a LayerStyle alone: Normal, but by normals that are computed while nodes load only where
  /// they are worth it: for Technique::Ewa and for light.
  Automatic
};

/// The second colour of a point, and how both are combined.
struct SecondColour
{
  ColourCombination combination = ColourCombination::None; ///< None: the rest means nothing
  std::uint32_t share256 = 128; ///< Mix
  PointColouring colouring;
  std::shared_ptr<const ColourMap> map; ///< where the colouring uses a table; else null
  Rgba8 flat{ 255, 255, 255, 255 }; ///< where it is Flat
};

bool operator==(const SecondColour& a, const SecondColour& b);

/// A layer's style with a store's columns looked up: everything that a back end needs to draw a
/// batch. StyleSheet makes it. It is compared to find out whether something has to be drawn anew.
struct ResolvedStyle
{
  Technique technique = Technique::Points;
  SplatAccuracy accuracy = SplatAccuracy::Affine;
  bool blended = false; ///< Splats: two passes with weights; Ewa always
  SplatSize size{ SplatSize::Mode::Pixels, 1.0, 0 };
  SplatOrientation orientation = SplatOrientation::Normal;
  glm::vec3 fixedNormal{ 0.0f, 0.0f, 1.0f }; ///< Fixed: unit, store axes
  std::optional<std::uint32_t> normalColumn; ///< read for orientation or lighting
  std::optional<std::uint32_t> radiusColumn; ///< splat_radius: read for SplatSize::Mode::Spacing
  std::optional<std::uint32_t> heightColumn; ///< height_above_ground: read for Solid
  PointColouring colouring;
  std::shared_ptr<const ColourMap> map; ///< where the colouring uses a table; else null
  Rgba8 flat{ 255, 255, 255, 255 }; ///< where it is Flat
  SecondColour second;
  Rgba8 rim{ 0, 0, 0, 255 }; ///< Silhouettes
  std::optional<std::array<Rgba8, 2>> wall; ///< Solid: upper and lower end; else as the points
  double opacity = 1.0; ///< 0 to 1
  PointFilter filter; ///< points that do not pass are not drawn
  // Where in the picture its points are seen (PlanParts.h):
  std::int16_t lens = -1; ///< the lens in FrameShading::lenses that shows them; -1: outside all
  bool lensMask = false; ///< they are not seen: what they cover is what the lens covers
  /// 0: opaque; the nearest opaque point of all such styles is seen. Else the number of a
  /// translucent group: its points are one surface, drawn with `opacity` over everything behind it.
  std::uint16_t group = 0;
  std::uint8_t highlight = 0; ///< 1 + number in FrameShading::highlights; 0: none
  std::uint16_t look = 0; ///< FrameShading::look(): how its pixels are shaded

  /// The columns that it reads, ascending.
  ColumnSelection columns() const;
};

bool operator==(const ResolvedStyle& a, const ResolvedStyle& b);
inline bool operator!=(const ResolvedStyle& a, const ResolvedStyle& b)
{
  return !(a == b);
}

} // namespace pointfront
