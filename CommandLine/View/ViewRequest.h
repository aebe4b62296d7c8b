#pragma once

#include "Camera.h"
#include "DrawingOptions.h"

#include <optional>

namespace pointfront
{

/// What `view` shows first.
struct ViewRequest
{
  DrawingOptions drawing;
  ViewDirection direction = ViewDirection::Iso; ///< unless there is a camera
  std::optional<Camera> camera;
};

} // namespace pointfront
