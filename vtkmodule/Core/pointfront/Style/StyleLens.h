#pragma once

#include "pointfront/Style/FrameLens.h"
#include "pointfront/Style/LayerStyle.h"

#include <cstddef>
#include <cstdint>
#include <map>

namespace pointfront
{

/// A lens: its place, and the styles that hold inside it (LAYERS-10).
/// Precedence  inside: its style of the class, its default, then what is drawn outside.
/// Threads     a value.
struct StyleLens
{
  FrameLens place;
  std::uint8_t aroundClass = 0; ///< AroundClass
  double aroundRadius = 0.0; ///< AroundClass: world units, > 0
  LayerStyle standard;
  std::map<std::uint8_t, LayerStyle> classes;

  friend bool operator==(const StyleLens& a, const StyleLens& b)
  {
    return a.place == b.place && a.aroundClass == b.aroundClass &&
      a.aroundRadius == b.aroundRadius && a.standard == b.standard && a.classes == b.classes;
  }
};

/// The widest rim of a highlight, pixels.
constexpr float mostHaloPx = 16.0f;
/// Most classes that are highlighted at once: a pixel's mark is a part of a byte.
constexpr std::size_t mostHighlights = 120;

/// A class whose points are highlighted.
struct StyleHighlight
{
  std::uint8_t objectClass = 0;
  Rgba8 colour{ 255, 204, 0, 255 };
  float haloPx = 2.0f; ///< >= 0: width of the rim around what is seen of the class
  float tint = 0.25f; ///< 0 to 1: how much of the colour the class's own pixels take

  friend bool operator==(const StyleHighlight& a, const StyleHighlight& b)
  {
    return a.objectClass == b.objectClass && a.colour == b.colour && a.haloPx == b.haloPx &&
      a.tint == b.tint;
  }
};

} // namespace pointfront
