#pragma once

#include "Camera.h"
#include "DrawingOptions.h"

#include <functional>
#include <optional>
#include <string>

namespace pointfront
{

/// The first view that `view` shows.
struct ViewRequest
{
  DrawingOptions drawing;
  ViewDirection direction = ViewDirection::Iso; ///< unless there is a camera
  std::optional<Camera> camera;
  std::string keep; ///< where a store that is built meanwhile stays; empty: nowhere
  /// Whether a signal asks to end. From the first call on signals only set this: who calls it has
  /// something to remove.
  std::function<bool()> signalled;
};

} // namespace pointfront
