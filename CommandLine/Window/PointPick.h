#pragma once

#include "PickedPoint.h"

#include "pointfront/Base/Result.h"

#include <glm/vec2.hpp>

#include <optional>

class vtkRenderer;

namespace pointfront
{

class MappedStores;

/// Pixels beside the mouse in which a point is looked for: points are small.
constexpr int reachPx = 6;

/// The point that is drawn at a pixel, or within `reachPx` of it. The window's picture is
/// lost: it has to be drawn again.
/// Gives   nothing where there is background.
/// Errors  those of readPoint().
Result<std::optional<PickedPoint>> pointAt(
  const glm::ivec2& pixel, vtkRenderer* renderer, const MappedStores& stores);

} // namespace pointfront
