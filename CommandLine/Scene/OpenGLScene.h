#pragma once

#include "StoreScene.h"

#include <memory>

namespace pointfront
{

/// Opens a scene that VTK draws in a window that is not shown, through OpenGL: an X server is
/// needed. The only function of its library, which OpenGLModule loads.
/// Errors  as StoreScene::open(); Unsupported without an X server, and for pictures that are larger
///         than OpenGL's.
extern "C" void pointfrontOpenOpenGLScene(
  const DrawingOptions& options, Result<std::unique_ptr<StoreScene>>& scene);

} // namespace pointfront
